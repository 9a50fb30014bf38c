//! The tables of the book's chapters on the language, by the words that they explain: what an editor says of what is built in.

use std::sync::OnceLock;

/// A chapter of the book.
macro_rules! chapters {
    ($($name:literal),*) => {
        [$(include_str!(concat!("../../docs/book/src/language/", $name, ".md"))),*]
    };
}

/// The chapters that have tables of words.
const PAGES: [&str; 8] = chapters![
    "worlds",
    "state",
    "predicates",
    "behaviours",
    "tasks",
    "trees",
    "tests",
    "expressions"
];

/// A form of a word, from the first column of a table.
#[derive(Clone, Debug)]
pub struct Form {
    /// The heading that it stands under.
    pub section: &'static str,
    /// The word: `distance`.
    pub word: &'static str,
    /// How it is written: `distance(a, b)`.
    pub written: &'static str,
    /// What the other columns say.
    pub says: String,
}

impl Form {
    /// Whether it is written with arguments.
    pub fn is_called(&self) -> bool {
        let rest = self.written.strip_prefix(self.word);
        rest.is_some_and(|rest| rest.starts_with('('))
    }

    /// The words for its arguments, each with the bytes of `written` that they take.
    pub fn parameters(&self) -> Vec<(usize, usize)> {
        let Some(open) = self.written.find('(').filter(|_| self.is_called()) else {
            return Vec::new();
        };
        let end = self.written.rfind(')').unwrap_or(self.written.len());
        let list = self.written.get(open + 1..end).unwrap_or_default();
        let mut start = open + 1;
        let parts = list.split(',').map(|part| {
            let blank = part.len() - part.trim_start().len();
            let found = (start + blank, start + blank + part.trim().len());
            start += part.len() + 1;
            found
        });
        parts.collect()
    }
}

/// Every form, in the order of the chapters.
pub fn forms() -> &'static [Form] {
    static FORMS: OnceLock<Vec<Form>> = OnceLock::new();
    FORMS.get_or_init(read)
}

/// The forms of a word.
pub fn of(word: &str) -> impl Iterator<Item = &'static Form> {
    forms().iter().filter(move |form| form.word == word)
}

/// The forms under a heading.
pub fn under(section: &str) -> impl Iterator<Item = &'static Form> {
    forms().iter().filter(move |form| form.section == section)
}

fn read() -> Vec<Form> {
    let mut forms = Vec::new();
    let mut section = "";
    for line in PAGES.iter().flat_map(|page| page.lines()) {
        if line.starts_with('#') {
            section = line.trim_start_matches('#').trim();
        }
        let Some(row) = line
            .strip_prefix("| ")
            .and_then(|row| row.strip_suffix('|'))
        else {
            continue;
        };
        let mut cells = row.split(" | ").map(str::trim);
        let first = cells.next().unwrap_or_default();
        let rest: Vec<&str> = cells.filter(|cell| !cell.is_empty()).collect();
        let says = unlinked(&rest.join("; "));
        // Between backquotes stands every second part.
        let written = first.split('`').skip(1).step_by(2);
        forms.extend(written.filter_map(|written| {
            let letter = |c: char| c.is_ascii_alphanumeric() || c == '_';
            let end = written.find(|c| !letter(c)).unwrap_or(written.len());
            let word = written.get(..end).filter(|word| !word.is_empty())?;
            Some(Form {
                section,
                word,
                written,
                says: says.clone(),
            })
        }));
    }
    forms
}

/// A text without the addresses of its links, which lead nowhere outside of the book.
fn unlinked(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once("](") {
        match before.rsplit_once('[') {
            Some((start, label)) => {
                plain.push_str(start);
                plain.push_str(label);
            }
            None => plain.push_str(before),
        }
        rest = after.split_once(')').map_or("", |(_, rest)| rest);
    }
    plain + rest
}

#[cfg(test)]
mod tests {
    use super::of;
    use crate::check::{built_in_names, built_in_types};
    use crate::syntax::words::{ASPECTS, NODES};

    #[test]
    fn every_word_is_explained() {
        let nodes = NODES.iter().map(|(word, _)| *word);
        let words = built_in_names().chain(built_in_types()).chain(ASPECTS);
        let missing: Vec<&str> = words
            .chain(nodes)
            .filter(|word| of(word).next().is_none())
            .collect();
        assert_eq!(missing, Vec::<&str>::new());
    }

    #[test]
    fn parameters_are_found_in_what_is_written() {
        let clamp = of("clamp").nth(1).unwrap();
        let words: Vec<&str> = (clamp.parameters().into_iter())
            .map(|(start, end)| &clamp.written[start..end])
            .collect();
        assert_eq!(words, ["x", "low", "high"]);
    }
}
