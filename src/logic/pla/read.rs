//! The reader of PLAs.

use super::error::{PlaError, PlaErrorKind};
use super::{Kind, Part, Pla};
use rustc_hash::FxHashSet;
use std::ops::Range;

/// The most mistakes that are reported for one file.
const MISTAKES: usize = 20;

/// The PLA in a text.
///
/// A row begins on a line of its own and may go on in the next: inputs `0`, `1`, `-` (also `2` and `~`), then outputs `0`, `1`,
/// `-`, `~` (also `3` for `0`, `4` for `1`, `2` for `-`); blanks and `|` between them say nothing. Names may go on in the next
/// line as well, may stand before the sizes, and the last outputs may have none. Everything after `#` is a comment, and so is,
/// as in Espresso, a line before the sizes that is no keyword: a title.
///
/// # Errors
/// Every mistake, with its place; no more than a screenful.
pub fn read(text: &str) -> Result<Pla, Vec<PlaError>> {
    let mut reader = Reader::default();
    // A byte order mark says nothing.
    let mut at = text.len() - text.trim_start_matches('\u{FEFF}').len();
    for line in text.get(at..).unwrap_or_default().split_inclusive('\n') {
        reader.line(line, at);
        at += line.len();
        if reader.ended || reader.mistakes.len() >= MISTAKES {
            break;
        }
    }
    reader.complete();
    if reader.has_inputs && reader.has_outputs {
        reader.count_names();
    } else if reader.mistakes.is_empty() {
        reader.wrong(0..text.len().min(1), PlaErrorKind::Size);
    }
    if reader.mistakes.is_empty() {
        Ok(reader.pla)
    } else {
        Err(reader.mistakes)
    }
}

#[derive(Default)]
struct Reader {
    pla: Pla,
    has_inputs: bool,
    has_outputs: bool,
    ended: bool,
    /// The row that has begun.
    open: Option<Open>,
    /// The names that may go on in the next line.
    naming: Option<Naming>,
    /// The names that are whole.
    named: Vec<Naming>,
    mistakes: Vec<PlaError>,
}

/// A row that has begun: where it stands so far, its first word, and how many of its characters are known.
struct Open {
    span: Range<usize>,
    first: usize,
    found: usize,
}

/// Whether a line could be a row, or a part of one.
fn is_row(line: &str) -> bool {
    let of_a_row = |c| matches!(c, '0'..='4' | '-' | '~' | '|' | ' ' | '\t');
    line.chars().all(of_a_row)
}

/// What is being named, and where its keyword stands.
struct Naming {
    outputs: bool,
    span: Range<usize>,
}

/// The most inputs, and the most outputs.
const MOST: u32 = 1 << 20;

impl Reader {
    fn wrong(&mut self, span: Range<usize>, kind: PlaErrorKind) {
        self.mistakes.push(PlaError { span, kind });
    }

    fn line(&mut self, line: &str, at: usize) {
        let said = line.split('#').next().unwrap_or_default();
        let text = said.trim();
        if text.is_empty() {
            return;
        }
        let at = at + (said.len() - said.trim_start().len());
        if text.starts_with('.') {
            self.complete();
            self.keyword(text, at);
        } else if self.goes_on_naming(text) {
            self.name(text, at);
        } else if self.has_inputs && self.has_outputs {
            self.named();
            self.row(text, at);
        } else if is_row(text) {
            self.wrong(at..at + text.len(), PlaErrorKind::Size);
            self.ended = true;
        }
    }

    /// Ends what is open: a row, or names.
    fn complete(&mut self) {
        self.named();
        if let Some(open) = self.open.take() {
            let wanted = self.pla.inputs + self.pla.outputs;
            let found = open.found;
            self.wrong(open.span, PlaErrorKind::Width { wanted, found });
        }
    }

    /// Whether a line has more names: fewer are known than columns, or it is not known how many there are, and it is no row.
    fn goes_on_naming(&self, text: &str) -> bool {
        let Some(naming) = &self.naming else {
            return false;
        };
        let is_counted = match naming.outputs {
            true => self.has_outputs,
            false => self.has_inputs,
        };
        let (found, wanted) = self.names(naming.outputs);
        (found < wanted || !is_counted) && !is_row(text)
    }

    /// How many inputs or outputs have names, and how many there are.
    fn names(&self, outputs: bool) -> (usize, usize) {
        match outputs {
            true => (self.pla.output_names.len(), self.pla.outputs),
            false => (self.pla.input_names.len(), self.pla.inputs),
        }
    }

    fn name(&mut self, text: &str, at: usize) {
        let words = text.split_whitespace().map(str::to_owned);
        if let Some(naming) = &mut self.naming {
            naming.span.end = at + text.len();
            match naming.outputs {
                true => self.pla.output_names.extend(words),
                false => self.pla.input_names.extend(words),
            }
        }
    }

    /// Ends a list of names.
    fn named(&mut self) {
        self.named.extend(self.naming.take());
    }

    /// Holds the names against the sizes. Names of outputs that are missing are made.
    fn count_names(&mut self) {
        for Naming { outputs, span } in std::mem::take(&mut self.named) {
            let (found, wanted) = self.names(outputs);
            if outputs && (1..wanted).contains(&found) {
                let names = &mut self.pla.output_names;
                let given: FxHashSet<String> = names.iter().cloned().collect();
                names.extend((found..wanted).map(|output| {
                    let mut name = format!("out{output}");
                    while given.contains(&name) {
                        name.push('_');
                    }
                    name
                }));
            } else if found != wanted {
                self.wrong(span, PlaErrorKind::Names { wanted, found });
            }
        }
        self.mistakes.sort_by_key(|mistake| mistake.span.start);
    }

    fn keyword(&mut self, text: &str, at: usize) {
        let mut words = text.split_whitespace();
        let keyword = words.next().unwrap_or_default();
        let span = at..at + text.len();
        match keyword {
            ".i" => {
                if let Some(number) = self.number(keyword, words.next(), span, self.has_inputs) {
                    self.pla.inputs = number;
                    self.has_inputs = true;
                }
            }
            ".o" => {
                if let Some(number) = self.number(keyword, words.next(), span, self.has_outputs) {
                    self.pla.outputs = number;
                    self.has_outputs = true;
                }
            }
            ".ilb" | ".ob" => self.begin_names(keyword, words, span),
            // A phase of ones asks for the outputs as they are.
            ".phase" if words.clone().all(|word| word.bytes().all(|c| c == b'1')) => {}
            ".phase" => self.wrong(span, PlaErrorKind::Phase),
            ".mv" | ".kiss" | ".symbolic" | ".symbolic-output" => {
                let word = at..at + keyword.len();
                self.wrong(word, PlaErrorKind::Valued(keyword.to_owned()));
            }
            ".type" => match words.next().map(|word| (word, Kind::parse(word))) {
                Some((_, Some(kind))) => self.pla.kind = kind,
                Some((word, None)) => self.wrong(span, PlaErrorKind::Type(word.to_owned())),
                None => self.wrong(span, PlaErrorKind::Type(String::new())),
            },
            // The rows are counted as they come.
            ".p" => {}
            ".e" | ".end" => self.ended = true,
            other => {
                let word = at..at + other.len();
                self.wrong(word, PlaErrorKind::Keyword(other.to_owned()));
            }
        }
    }

    fn begin_names<'w>(
        &mut self,
        keyword: &str,
        words: impl Iterator<Item = &'w str>,
        span: Range<usize>,
    ) {
        let outputs = keyword == ".ob";
        if self.named.iter().any(|named| named.outputs == outputs) {
            self.wrong(span, PlaErrorKind::Again(keyword.to_owned()));
            return;
        }
        let names = words.map(str::to_owned).collect();
        match outputs {
            true => self.pla.output_names = names,
            false => self.pla.input_names = names,
        }
        self.naming = Some(Naming { outputs, span });
    }

    fn number(
        &mut self,
        keyword: &str,
        word: Option<&str>,
        span: Range<usize>,
        again: bool,
    ) -> Option<usize> {
        if again {
            self.wrong(span, PlaErrorKind::Again(keyword.to_owned()));
            return None;
        }
        let digits = word.filter(|word| word.bytes().all(|c| c.is_ascii_digit()));
        // What is longer than any number that fits is too large.
        let number = digits.map(|digits| digits.parse::<u32>().unwrap_or(u32::MAX));
        match number {
            None => self.wrong(span, PlaErrorKind::Number(keyword.to_owned())),
            Some(number) if number > MOST => {
                self.wrong(span, PlaErrorKind::Many(keyword.to_owned(), MOST));
                // Without the size, no row can be read.
                self.ended = true;
            }
            Some(number) => return Some(number as usize),
        }
        None
    }

    fn row(&mut self, text: &str, at: usize) {
        let wanted = self.pla.inputs + self.pla.outputs;
        let blank = |c: &u8| matches!(c, b' ' | b'\t' | b'|');
        let more = text.bytes().filter(|c| !blank(c)).count();
        if more == 0 {
            return;
        }
        // A row that goes on ends with this line or a later one; else the line is a row of its own.
        if self
            .open
            .as_ref()
            .is_some_and(|open| open.found + more > wanted)
        {
            self.complete();
        }
        let open = self.open.take();
        let mut open = open.unwrap_or_else(|| self.begin(at));
        open.span.end = at + text.len();
        for (i, c) in text.bytes().enumerate().filter(|(_, c)| !blank(c)) {
            let known = match open.found < self.pla.inputs {
                true => self.input(c, open.first, open.found),
                false => self.output(c),
            };
            if !known {
                let c = text.get(i..).and_then(|rest| rest.chars().next());
                let c = c.unwrap_or(char::REPLACEMENT_CHARACTER);
                self.wrong(at + i..at + i + c.len_utf8(), PlaErrorKind::Character(c));
                return;
            }
            open.found += 1;
        }
        if open.found < wanted {
            self.open = Some(open);
            return;
        }
        if open.found > wanted {
            let found = open.found;
            self.wrong(open.span.clone(), PlaErrorKind::Width { wanted, found });
        }
        let start = u32::try_from(open.span.start).unwrap_or(u32::MAX);
        self.pla.starts.push(start);
    }

    /// Begins a row.
    fn begin(&mut self, at: usize) -> Open {
        let first = self.pla.values.len();
        self.pla.values.resize(first + self.pla.words(), 0);
        if !self.pla.free.is_empty() {
            self.pla.free.resize(self.pla.values.len(), 0);
        }
        Open {
            span: at..at,
            first,
            found: 0,
        }
    }

    /// Takes an input in; `first` is the first word of its row.
    fn input(&mut self, c: u8, first: usize, input: usize) -> bool {
        let set = |words: &mut Vec<u64>| {
            if let Some(word) = words.get_mut(first + input / 64) {
                *word |= 1 << (input % 64);
            }
        };
        match c {
            b'0' => {}
            b'1' => set(&mut self.pla.values),
            b'-' | b'2' | b'~' => {
                self.pla.free.resize(self.pla.values.len(), 0);
                set(&mut self.pla.free);
            }
            _ => return false,
        }
        true
    }

    fn output(&mut self, c: u8) -> bool {
        let part = match c {
            b'1' | b'4' => Part::On,
            b'0' | b'3' => Part::Off,
            b'-' | b'2' => Part::Free,
            b'~' => Part::Silent,
            _ => return false,
        };
        self.pla.parts.push(part);
        true
    }
}
