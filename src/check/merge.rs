//! One message for what is one mistake, though it shows in several places.

use super::report::listed;
use crate::diagnostic::{Code, Diagnostic, Label};
use crate::source::Span;
use std::collections::BTreeMap;

/// Makes one diagnostic of those that say the same of one thing in several places: a name that nothing declares, a
/// sensor or a world that is missing, entries of one list that are of the wrong kind, a wall that is taken for a place.
/// `declared` says where the name at a place is declared.
pub fn merge(sorted: &mut Vec<Diagnostic>, declared: impl Fn(Span) -> Option<Span>) {
    let mut first: BTreeMap<(Code, String), usize> = BTreeMap::new();
    let mut merged: Vec<Diagnostic> = Vec::new();
    let mut further: BTreeMap<usize, Vec<Span>> = BTreeMap::new();
    for found in sorted.drain(..) {
        let about = match found.code {
            // The sensors that a robot lacks for one use are one mistake, and so are the members of a family that never end.
            Code::E0406 | Code::E0611
                if merged
                    .last()
                    .is_some_and(|last| last.code == found.code && last.span() == found.span()) =>
            {
                if let Some(last) = merged.last_mut() {
                    last.notes.push(format!("and {}", found.message));
                }
                continue;
            }
            // `x` and `y` of a start are one place.
            Code::E0202
                if found
                    .help
                    .iter()
                    .any(|help| help.contains("where it starts")) =>
            {
                String::new()
            }
            Code::E0202 | Code::E0406 | Code::W0603 => found.message.clone(),
            Code::E0305 if comes_with_each_use(&found.message) => found.message.clone(),
            Code::E0407 | Code::W0301 => String::new(),
            // What the world, or the length of an episode or of a tick, makes of several things.
            Code::W0512 => found.notes.concat(),
            Code::E0309 if found.message.ends_with(" is at least one tick") => String::new(),
            Code::E0404 | Code::W0401 => match about_places(&found.message) {
                Some(about) => about,
                None => {
                    merged.push(found);
                    continue;
                }
            },
            // The same of what stands side by side: the coordinates of a point, the arguments of a call.
            Code::E0301 | Code::E0302 | Code::E0305 | Code::E0403 | Code::E0601
                if merged.last().is_some_and(|last| is_beside(last, &found)) =>
            {
                if let Some(last) = merged.last_mut() {
                    join(last, found);
                }
                continue;
            }
            // The kind of one place, which many uses show.
            Code::E0302 if found.labels.len() == 2 && found.message.contains(" of the kind ") => {
                format!("{:?}", found.span())
            }
            // A `let`, taken again and again for what it is not.
            Code::E0203 | Code::E0310 | Code::E0601
                if is_shared(&found) && declared(found.span()).is_some() =>
            {
                let at = format!("{:?}", declared(found.span()));
                match first.get(&(Code::E0601, at.clone())) {
                    Some(first) => further.entry(*first).or_default().push(found.span()),
                    None => {
                        first.insert((Code::E0601, at), merged.len());
                        merged.push(found);
                    }
                }
                continue;
            }
            // One name, taken again and again for what it is not.
            Code::E0601 if declared(found.span()).is_some() => {
                format!("{:?}", declared(found.span()))
            }
            Code::E0302 if declared(found.span()).is_some() => {
                let wanted = found.message.rsplit(" is ").next().unwrap_or_default();
                format!("{:?} {wanted}", declared(found.span()))
            }
            Code::E0203
                if merged
                    .last()
                    .is_some_and(|last| last.message == found.message) =>
            {
                found.message.clone()
            }
            Code::E0203 => {
                // Only what stands side by side is of one list.
                let message = found.message.clone();
                first.insert((found.code, message), merged.len());
                merged.push(found);
                continue;
            }
            _ => {
                merged.push(found);
                continue;
            }
        };
        match first.get(&(found.code, about.clone())) {
            Some(at) => {
                if found.code == Code::W0301
                    && let Some(first) = merged.get_mut(*at)
                {
                    join_fixes(first, &found);
                }
                // Where the reason is told, the uses are what shows it.
                let use_of = |found: &Diagnostic| found.labels.get(1).map(|label| label.span);
                let said = merged
                    .get(*at)
                    .is_some_and(|first| first.span() == found.span());
                let place = use_of(&found).filter(|_| said).unwrap_or(found.span());
                further.entry(*at).or_default().push(place);
            }
            None => {
                first.insert((found.code, about), merged.len());
                merged.push(found);
            }
        }
    }
    for (at, places) in further {
        let Some(found) = merged.get_mut(at) else {
            continue;
        };
        *found = found.clone().and_at(&places, "and here");
    }
    *sorted = merged;
}

/// Whether a `let` is taken for something else.
fn is_shared(found: &Diagnostic) -> bool {
    let label = found.labels.first();
    label.is_some_and(|label| label.message.ends_with("is a shared expression"))
}

/// How far what stands side by side is apart, in bytes.
const BESIDE: u32 = 24;

/// Whether two diagnostics say the same of what stands side by side.
fn is_beside(last: &Diagnostic, found: &Diagnostic) -> bool {
    let end = last.labels.last().map_or(last.span(), |label| label.span);
    let start = found.span();
    let plain = found.labels.len() == 1;
    let alike = last.message == found.message
        || lack_units(last) && lack_units(found)
        || last.code == found.code
            && owner(&last.message).is_some_and(|it| owner(&found.message) == Some(it));
    alike
        && plain
        && end.file == start.file
        && start.start >= end.end
        && start.start - end.end <= BESIDE
}

/// Adds a place to a diagnostic that says the same of the one before it, with its fix.
fn join(last: &mut Diagnostic, found: Diagnostic) {
    last.labels.push(Label {
        span: found.span(),
        message: "and here".to_owned(),
    });
    join_fixes(last, &found);
}

/// Adds the changes that mend another mistake of the same kind; without them the mistake is not mended.
fn join_fixes(last: &mut Diagnostic, found: &Diagnostic) {
    let (units, percent) = (lack_units(found), found.code == Code::W0301);
    match (last.fixes.as_mut_slice(), found.fixes.as_slice()) {
        ([one], [other]) => {
            one.edits.extend(other.edits.iter().cloned());
            one.applicability = one.applicability.max(other.applicability);
            if one.title != other.title {
                one.title = match (units, percent) {
                    (true, _) => "give each its unit".to_owned(),
                    (_, true) => "write each with `%`".to_owned(),
                    _ => {
                        let words: Vec<&str> = one.edits.iter().map(|(_, it)| it.trim()).collect();
                        format!("write {}", listed(&words, "and"))
                    }
                };
            }
        }
        _ => last.fixes.clear(),
    }
}

/// Whether a number lacks its unit, as the fix says.
fn lack_units(found: &Diagnostic) -> bool {
    let mut fixes = found.fixes.iter();
    found.code == Code::E0301 && fixes.any(|fix| fix.title.starts_with("give "))
}

/// Whether a mistake with arguments comes with each use of what is called.
fn comes_with_each_use(message: &str) -> bool {
    message.contains(" needs its argument ") || message.ends_with(" takes no arguments")
}

/// What has no setting, or no parameter, of a name.
fn owner(message: &str) -> Option<&str> {
    let parts = [" has no setting ", " has no parameter "];
    parts
        .iter()
        .find_map(|part| Some(message.split_once(part)?.0))
}

/// What is said of places, each for itself, where one wall or one robot is the reason.
fn about_places(message: &str) -> Option<String> {
    let of_wall = message.split_once(" lies in the wall ");
    let of_robot = [
        "no way leads to the place",
        "the robot does not fit into the place",
    ];
    let of_robot = of_robot.iter().find(|begin| message.starts_with(**begin));
    of_wall
        .map(|(_, wall)| wall.to_owned())
        .or_else(|| of_robot.map(|begin| (*begin).to_owned()))
}
