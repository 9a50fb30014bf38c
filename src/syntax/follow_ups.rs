//! Mistakes that follow from others: of those that one slip brings about, one is told.

use super::ast::{File, Item, ItemKind};
use super::words::{ASPECTS, NAMES};
use crate::diagnostic::{self, Applicability, Code, Diagnostic, suggest};
use crate::source::Span;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// What is advised where a child of a tree stands behind the `}` of its tree.
pub(super) const CLOSED_ABOVE: &str = "the `}` of its tree stands above: is there one too many?";

/// Leaves out what follows from another mistake, and notes where the text was not understood.
pub(super) fn left_out(text: &str, tree: &mut File, sorted: Vec<Diagnostic>) -> Vec<Diagnostic> {
    // What is only warned of is no cause of a mistake.
    let (sorted, warnings): (Vec<Diagnostic>, Vec<Diagnostic>) =
        sorted.into_iter().partition(Diagnostic::is_error);
    let sorted = under_their_heads(text, sorted);
    tree.lost.any = !sorted.is_empty();
    tree.lost.unnamed |=
        is_cut(text, &sorted) || sorted.iter().any(|found| is_lost_use(text, found));
    let mut places: Vec<Span> = tree
        .lost
        .places
        .iter()
        .map(|span| lines(text, *span))
        .collect();
    let wide = |found: &&Diagnostic| {
        is_bracket(found.code) && slice(text, found) != "(" || opens_no_node(found)
    };
    let brackets = sorted.iter().filter(wide);
    let is_understood = |item: &&Item| !matches!(item.kind, ItemKind::Error);
    let understood = tree.items.iter().filter(is_understood);
    let understood: Vec<u32> = understood.map(|item| item.span.start).collect();
    let regions = Regions::new(
        brackets
            .map(|found| region(tree, &understood, found))
            .collect(),
    );
    let place_of = |found: &Diagnostic| {
        let at = found.span();
        let place = lines(text, at);
        regions.around(at).map_or(place, |region| place.to(region))
    };
    let mut told: Vec<Diagnostic> = Vec::new();
    let mut rest = sorted.into_iter().peekable();
    while let Some(first) = rest.next() {
        let mut place = place_of(&first);
        let mut together = vec![first];
        while let Some(next) = rest.peek() {
            let within = next.span().start < place.end;
            let goes_on = lines(text, next.span()).start <= place.end + 1
                && is_rest(text, next)
                && !together
                    .last()
                    .is_some_and(|last| is_beside(text, last, next))
                && together.iter().any(|found| found.code != Code::E0118);
            if !within && !goes_on {
                break;
            }
            place = place.to(place_of(next));
            together.extend(rest.next().filter(|_| within));
        }
        places.push(place);
        told.extend(causes(text, together));
    }
    tree.lost.places = places;
    // A `}` too many closes a tree: what stands behind it is told, and not the comma between.
    let closed = |found: &Diagnostic| {
        found.code == Code::E0105 && found.help.iter().any(|help| help == CLOSED_ABOVE)
    };
    let follows: Vec<bool> = told
        .iter()
        .zip(told.iter().skip(1))
        .map(|(found, next)| found.code == Code::E0118 && closed(next))
        .collect();
    let mut follows = follows.into_iter();
    told.retain(|_| !follows.next().unwrap_or(false));
    let told = told.into_iter().map(|found| match closed(&found) {
        true => too_early(text, found),
        false => found,
    });
    let mut told = one_of_a_habit(text, told.collect());
    // In a line that is not understood nobody knows what a sign was to be.
    let wrong: BTreeSet<Span> = told.iter().map(|found| lines(text, found.span())).collect();
    let stands = |found: &Diagnostic| !wrong.contains(&lines(text, found.span()));
    told.extend(warnings.into_iter().filter(stands));
    diagnostic::sort(&mut told);
    told
}

/// One message for lines that are entries of a list in a task: below a word that was to begin it, `choosse`, or below an entry that
/// lacks its comma.
fn under_their_heads(text: &str, sorted: Vec<Diagnostic>) -> Vec<Diagnostic> {
    let is_unknown = |found: &Diagnostic| {
        found.code == Code::E0123 && found.message.ends_with(NO_ASPECT) && found.fixes.is_empty()
    };
    let mut told: Vec<Diagnostic> = Vec::new();
    // How far the lines reach that the last head has taken.
    let mut taken: Option<usize> = None;
    for found in sorted {
        let line = lines(text, found.span()).range();
        if taken.is_some_and(|end| line.start <= end + 1) && is_unknown(&found) {
            taken = Some(line.end);
            continue;
        }
        // A line above that is not understood itself is no entry.
        let is_above = |last: &Diagnostic| lines(text, last.span()).range().end + 1 == line.start;
        let follows = told.last().is_some_and(is_above);
        let parted = || match follows {
            true => None,
            false => parted(text, &found, line.clone()),
        };
        let head = is_unknown(&found).then(|| head(text, &found, line.start).or_else(parted));
        let head = head.flatten();
        taken = head.as_ref().map(|_| line.end);
        told.push(head.unwrap_or(found));
    }
    told
}

/// How the message ends of a word that begins no aspect of a task.
const NO_ASPECT: &str = " does not begin an aspect of a task";

/// What is said of the line before that at `start` if it is a word alone that was to be an aspect of a task.
fn head(text: &str, found: &Diagnostic, start: usize) -> Option<Diagnostic> {
    let before = text.get(..start.checked_sub(1)?)?;
    let from = before.rfind('\n').map_or(0, |at| at + 1);
    let line = before.get(from..)?;
    let word = line.trim();
    let meant = suggest::nearest(word, ASPECTS.iter().copied())?;
    let from = from + line.len() - line.trim_start().len();
    let span = Span::new(found.span().file, from, from + word.len());
    let message = format!("`{word}`{NO_ASPECT}");
    Some(
        Diagnostic::new(Code::E0123, span, message)
            .label(format!("did you mean `{meant}`?"))
            .fix(
                format!("write `{meant}`"),
                span,
                meant,
                Applicability::Unsafe,
            ),
    )
}

/// What is said of a line that goes on with a list whose entry above it lacks its comma.
fn parted(text: &str, found: &Diagnostic, line: Range<usize>) -> Option<Diagnostic> {
    let before = text.get(..line.start.checked_sub(1)?)?;
    let from = before.rfind('\n').map_or(0, |at| at + 1);
    let above = before.get(from..)?;
    let above = above.split("//").next().unwrap_or(above).trim_end();
    let margin = |line: &str| line.len() - line.trim_start().len();
    let first = above.split_whitespace().next()?;
    // Below the beginning of an aspect its entries stand further in, and below one of these on the same margin.
    let deep = margin(text.get(line)?);
    let goes_on = match ASPECTS.contains(&first) {
        true => deep > margin(above) && above.trim_start() != first,
        false => deep == margin(above),
    };
    let ends = above.ends_with(|letter: char| letter.is_alphanumeric() || "_)`".contains(letter));
    if !goes_on || !ends {
        return None;
    }
    let comma = from + above.len();
    let comma = Span::new(found.span().file, comma, comma);
    let message = format!("a comma is missing before `{}`", slice(text, found));
    Some(
        Diagnostic::new(Code::E0112, found.span(), message)
            .label("this begins another one")
            .note("commas part the entries of a list")
            .fix("put a comma", comma, ",", Applicability::Safe),
    )
}

fn lacks_its_type(found: &Diagnostic) -> bool {
    found.code == Code::E0128 && found.message.ends_with(" has no type")
}

/// A `}` that closes a tree of which more children follow, told at that `}`, where it stands right before them.
fn too_early(text: &str, found: Diagnostic) -> Diagnostic {
    let child = found.span();
    let before = text.get(..child.range().start).unwrap_or_default();
    let marks = |letter: char| letter.is_whitespace() || letter == ',';
    let before = before.trim_end_matches(marks);
    if !before.ends_with('}') {
        return found;
    }
    let close = Span::new(child.file, before.len() - 1, before.len());
    let message = "this `}` closes the tree, and more of its children follow";
    Diagnostic::new(Code::E0103, close, message)
        .label("one too many?")
        .also(child, "this stands in a tree")
        .fix("drop the `}`", close, "", Applicability::Unsafe)
}

/// One message for all the marks of one sign that nothing needs: who ends one line by it ends them all so. And one for all the
/// places where a name has the same marks in it.
fn one_of_a_habit(text: &str, told: Vec<Diagnostic>) -> Vec<Diagnostic> {
    let mut kept: Vec<Diagnostic> = Vec::new();
    let mut first: BTreeMap<String, (usize, Vec<Span>)> = BTreeMap::new();
    for found in told {
        if let Some(last) = kept.last_mut()
            && lacks_its_type(last)
            && lacks_its_type(&found)
            && lines(text, last.span()) == lines(text, found.span())
        {
            *last = last.clone().also(found.span(), "and this");
            continue;
        }
        let marked = found.help.iter().find(|help| help.starts_with(NAMES));
        let habit = match (found.code, marked) {
            (Code::E0118, _) => slice(text, &found).to_owned(),
            // `goto(A);`
            (Code::E0101, _) if slice(text, &found) == ";" && found.fixes.len() == 1 => {
                format!("; {}", found.fixes.first().map_or("", |fix| &fix.title))
            }
            (_, Some(help)) => help.clone(),
            _ => {
                kept.push(found);
                continue;
            }
        };
        let mark = slice(text, &found);
        let Some((at, further)) = first.get_mut(&habit) else {
            first.insert(habit, (kept.len(), Vec::new()));
            kept.push(found);
            continue;
        };
        let Some(habit) = kept.get_mut(*at) else {
            continue;
        };
        further.push(found.span());
        if let (Some(all), Some(one)) = (habit.fixes.first_mut(), found.fixes.into_iter().next()) {
            all.title = match found.code {
                Code::E0118 => format!("drop every `{mark}` that nothing needs"),
                _ => "part all of them by commas".to_owned(),
            };
            all.edits.extend(one.edits);
        }
    }
    for (at, further) in first.into_values() {
        if let Some(habit) = kept.get_mut(at) {
            *habit = habit.clone().and_at(&further, "and here");
        }
    }
    kept
}

/// Whether the rest of the text is missing: it ends within a line, in what was not understood.
fn is_cut(text: &str, found: &[Diagnostic]) -> bool {
    let end = text.trim_end().len();
    let at_end = |found: &Diagnostic| {
        found.code == Code::E0102 || lines(text, found.span()).range().end >= end
    };
    !text.is_empty() && !text.ends_with('\n') && found.iter().any(at_end)
}

/// Whether a mistake leaves it open which file is used.
fn is_lost_use(text: &str, found: &Diagnostic) -> bool {
    let line = text
        .get(lines(text, found.span()).range())
        .unwrap_or_default();
    found.code == Code::E0106 && line.trim_start().starts_with("use ")
}

/// The mistakes of one place that do not follow from others there.
fn causes(text: &str, together: Vec<Diagnostic>) -> Vec<Diagnostic> {
    let together = before_its_block(together);
    let bracket = together.iter().position(|found| is_bracket(found.code));
    // A bracket that is never closed is told at its beginning: what is not understood after it shows the slip itself,
    // unless the layout shows which bracket it is.
    let shown = together
        .iter()
        .any(|found| found.code == Code::E0102 && found.labels.len() > 2);
    let bracket = bracket.or_else(|| together.iter().position(opens_no_node));
    let slip = together
        .iter()
        .take_while(|found| found.code != Code::E0103)
        .position(|found| is_slip(found.code));
    let together: Vec<Diagnostic> = match (slip.filter(|_| !shown).or(bracket), bracket) {
        (Some(cause), Some(_)) => {
            let told = together.into_iter().enumerate();
            let told = told.filter(|(at, found)| match at.cmp(&cause) {
                Ordering::Less => !is_bracket(found.code),
                Ordering::Equal => true,
                Ordering::Greater => !is_bracket(found.code) && !is_general(found),
            });
            told.map(|(_, found)| found).collect()
        }
        _ => together,
    };
    let mut told: Vec<Diagnostic> = Vec::new();
    let mut of_line: Vec<Diagnostic> = Vec::new();
    for found in together {
        let same = of_line.last().is_some_and(|last: &Diagnostic| {
            lines(text, last.span()).end >= lines(text, found.span()).end
        });
        if !same {
            told.append(&mut in_line(std::mem::take(&mut of_line)));
        }
        of_line.push(found);
    }
    told.append(&mut in_line(of_line));
    told
}

/// Without what follows from an entry that stands behind the `}` of its block: those behind it do so, too, and the `}` of
/// the block around it is left over.
fn before_its_block(mut together: Vec<Diagnostic>) -> Vec<Diagnostic> {
    let is_lost = |found: &Diagnostic| {
        let advised = found
            .help
            .iter()
            .any(|help| help.starts_with("put it there"));
        advised && matches!(found.code, Code::E0105 | Code::E0123)
    };
    let Some(at) = together.iter().position(is_lost) else {
        return together;
    };
    let behind = together.split_off(at + 1);
    let help = together.last().map(|found| found.help.clone());
    let follows = |found: &Diagnostic| {
        found.code == Code::E0103 || is_lost(found) && Some(&found.help) == help.as_ref()
    };
    together.extend(behind.into_iter().filter(|found| !follows(found)));
    together
}

/// Of the mistakes of one line those up to the first text that was not understood. A mark that could be dropped is told
/// only where nothing else is wrong.
fn in_line(mut found: Vec<Diagnostic>) -> Vec<Diagnostic> {
    if found.iter().any(|found| found.code != Code::E0118) {
        found.retain(|found| found.code != Code::E0118);
    } else {
        return found;
    }
    match found.iter().position(is_general) {
        Some(0) => found.truncate(1),
        Some(at) => found.truncate(at),
        None => {}
    }
    found
}

/// Whether a mistake says no more than that a text was not understood.
fn is_general(found: &Diagnostic) -> bool {
    match found.code {
        Code::E0105 | Code::E0123 => found.fixes.is_empty(),
        Code::E0112 | Code::E0114 | Code::E0118 | Code::E0125 => true,
        code => is_slip(code) || is_bracket(code),
    }
}

/// The text that a mistake points at.
fn slice<'t>(text: &'t str, found: &Diagnostic) -> &'t str {
    text.get(found.span().range()).unwrap_or_default()
}

fn is_slip(code: Code) -> bool {
    matches!(code, Code::E0101 | Code::E0126)
}

/// Whether a node has its children in other brackets than braces.
fn opens_no_node(found: &Diagnostic) -> bool {
    let mut help = found.help.iter();
    found.code == Code::E0101
        && help.any(|help| help.starts_with("the children of a node stand in braces"))
}

fn is_bracket(code: Code) -> bool {
    matches!(code, Code::E0102 | Code::E0103)
}

/// Whether a mistake on the line after another one is likely the rest of what was not understood there: a mark, or a
/// word that begins nothing and is like none that does.
fn is_rest(text: &str, found: &Diagnostic) -> bool {
    match found.code {
        Code::E0103 => true,
        Code::E0118 => slice(text, found) == ",",
        Code::E0105 | Code::E0123 => found.fixes.is_empty(),
        _ => false,
    }
}

/// Whether two entries that nobody knows stand one below the other: neither is the rest of the other.
fn is_beside(text: &str, last: &Diagnostic, next: &Diagnostic) -> bool {
    let unknown = |found: &Diagnostic| matches!(found.code, Code::E0105 | Code::E0123);
    let margin = |found: &Diagnostic| {
        let at = found.span();
        let line = lines(text, at).start;
        let before = text.get(line as usize..at.range().start)?;
        before.trim().is_empty().then_some(before)
    };
    let (upper, lower) = (margin(last), margin(next));
    unknown(last) && unknown(next) && upper.is_some() && upper == lower
}

/// What a mistake in brackets may have taken along: its item, for a bracket that closes nothing the one before it, and
/// what follows up to the next item that was understood. `understood` is where such items begin.
fn region(tree: &File, understood: &[u32], bracket: &Diagnostic) -> Span {
    let at = bracket.span();
    let begun = tree
        .items
        .partition_point(|item| item.span.start <= at.start);
    let own = begun.checked_sub(1).and_then(|last| tree.items.get(last));
    let own = own.filter(|item| item.span.end > at.start || bracket.code == Code::E0103);
    let next = understood.partition_point(|start| *start <= at.start);
    Span {
        start: own.map_or(at.start, |item| item.span.start),
        end: understood.get(next).copied().unwrap_or(tree.span.end),
        ..at
    }
}

/// Places that may overlap.
struct Regions {
    /// By where they begin.
    sorted: Vec<Span>,
    /// For each, how far it and those before it reach.
    reach: Vec<u32>,
}

impl Regions {
    fn new(mut sorted: Vec<Span>) -> Self {
        sorted.sort_by_key(|region| region.start);
        let furthest = sorted.iter().scan(0, |furthest, region| {
            *furthest = region.end.max(*furthest);
            Some(*furthest)
        });
        let reach = furthest.collect();
        Self { sorted, reach }
    }

    /// What those cover together in which `at` begins.
    fn around(&self, at: Span) -> Option<Span> {
        let begun = self
            .sorted
            .partition_point(|region| region.start <= at.start);
        let first = self.reach.partition_point(|end| *end <= at.start);
        let end = self.reach.get(begun.checked_sub(1)?)?;
        let first = self.sorted.get(first).filter(|_| first < begun)?;
        Some(Span {
            end: *end,
            ..*first
        })
    }
}

/// The whole lines of a place.
fn lines(text: &str, span: Span) -> Span {
    let range = span.range();
    let before = text.get(..range.start).unwrap_or_default();
    let after = text.get(range.end..).unwrap_or_default();
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    let end = after.find('\n').map_or(text.len(), |at| range.end + at);
    Span::new(span.file, start, end)
}

#[cfg(test)]
mod tests {
    use super::Regions;
    use crate::source::{FileId, Span};

    /// Places are looked up by bisection: what they cover together is what one finds who looks at all of them.
    #[test]
    fn places_around_are_those_that_one_finds_one_by_one() {
        let spans: Vec<Span> = (0_usize..7)
            .flat_map(|start| (start..8).map(move |end| Span::new(FileId(0), start, end)))
            .collect();
        let mut found = 0;
        for (a, b, c) in (0..spans.len()).flat_map(|a| {
            let all = 0..spans.len();
            all.map(move |b| (a, b, (3 * a + 5 * b) % 28))
        }) {
            let places = [spans[a], spans[b], spans[c % spans.len()]];
            let regions = Regions::new(places.to_vec());
            for at in spans.iter().copied() {
                let around = places
                    .iter()
                    .filter(|it| it.start <= at.start && at.start < it.end);
                let naive = around.copied().reduce(Span::to);
                assert_eq!(regions.around(at), naive, "{places:?}, {at:?}");
                found += usize::from(naive.is_some());
            }
        }
        assert!(found > 1000);
    }
}
