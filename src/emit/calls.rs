//! Words that spell calls. A table knows `goto(A)` as a word; in a program that defines `goto` it is a call. A robot has
//! one `goto` either way.

use crate::ir::name::{Argument, Given, Name};
use crate::ir::{Id, Program};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// How deep calls may stand in calls.
const DEEPEST: usize = 8;

/// The program, its predicates and behaviours called as a robot calls them.
///
/// A word that spells a call is that call, unless the program has another name that is the same call.
pub(super) fn called(program: &Program) -> Cow<'_, Program> {
    let predicates = calls(
        program
            .predicates
            .iter()
            .map(|(id, found)| (id, &found.name)),
    );
    let behaviors = calls(
        program
            .behaviors
            .iter()
            .map(|(id, found)| (id, &found.name)),
    );
    if predicates.is_empty() && behaviors.is_empty() {
        return Cow::Borrowed(program);
    }
    let mut program = program.clone();
    for (id, call) in predicates {
        program.predicates[id].name = call;
    }
    for (id, call) in behaviors {
        program.behaviors[id].name = call;
    }
    Cow::Owned(program)
}

/// The calls that names spell, where nothing else has the same name.
fn calls<'n, T>(names: impl Iterator<Item = (Id<T>, &'n Name)>) -> Vec<(Id<T>, Name)> {
    let mut spelled: BTreeMap<String, usize> = BTreeMap::new();
    let mut calls = Vec::new();
    for (id, name) in names {
        let call = name.as_word().and_then(|word| call(word, DEEPEST));
        for name in std::iter::once(name).chain(&call) {
            *spelled.entry(name.to_string()).or_default() += 1;
        }
        calls.extend(call.map(|call| (id, call)));
    }
    calls.retain(|(_, call)| spelled.get(&call.to_string()) == Some(&1));
    calls
}

/// The call that a word spells. Its parameters are numbered, so arguments have to stand by position.
fn call(word: &str, depth: usize) -> Option<Name> {
    let depth = depth.checked_sub(1)?;
    let (family, inside) = word.strip_suffix(')')?.split_once('(')?;
    let family = family.trim();
    let legal = |c: char| c.is_ascii_alphanumeric() || c == '_';
    if family.is_empty() || !family.chars().all(legal) {
        return None;
    }
    let given = arguments(inside)?
        .into_iter()
        .map(|text| given(text, depth));
    let given: Vec<Given> = given.collect::<Option<_>>()?;
    let arguments = given.into_iter().zip(1..).map(|(value, number)| Argument {
        parameter: format!("argument_{number}"),
        value: Some(value),
    });
    Some(Name::instance(family, arguments.collect()))
}

/// The arguments between the brackets of a call; `None` where brackets or backquotes do not close.
fn arguments(text: &str) -> Option<Vec<&str>> {
    let (mut depth, mut quoted, mut start) = (0_usize, false, 0);
    let mut found = Vec::new();
    for (at, c) in text.char_indices() {
        match c {
            '`' => quoted = !quoted,
            _ if quoted => {}
            '(' => depth += 1,
            ')' => depth = depth.checked_sub(1)?,
            ',' if depth == 0 => {
                found.push(text.get(start..at)?.trim());
                start = at + 1;
            }
            _ => {}
        }
    }
    found.push(text.get(start..)?.trim());
    (depth == 0 && !quoted).then_some(found)
}

/// An argument by position.
fn given(text: &str, depth: usize) -> Option<Given> {
    if let Some(word) = text.strip_prefix('`').and_then(|t| t.strip_suffix('`')) {
        let plain = !word.is_empty() && !word.contains('`');
        return plain.then(|| Given::Name(Name::word(word)));
    }
    if let Some(call) = call(text, depth) {
        return Some(Given::Name(call));
    }
    let word = text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    match text {
        _ if text.is_empty() || text.contains(['`', '=', '{', '}']) => None,
        _ if word && !text.starts_with(|c: char| c.is_ascii_digit()) => {
            Some(Given::Name(Name::word(text)))
        }
        _ => Some(Given::Text(text.to_owned())),
    }
}

#[cfg(test)]
mod tests {
    use super::{DEEPEST, call};

    #[test]
    fn a_word_is_the_call_that_it_spells() {
        let spelled =
            |word| call(word, DEEPEST).map(|name| (name.family.clone(), name.to_string()));
        for (word, family, call) in [
            ("goto(A)", "goto", "goto(A)"),
            ("goto( A ,1 m)", "goto", "goto(A, 1 m)"),
            ("goto(`p 2`)", "goto", "goto(`p 2`)"),
            ("near(at(A, B), C)", "near", "near(at(A, B), C)"),
        ] {
            assert_eq!(spelled(word), Some((family.to_owned(), call.to_owned())));
        }
        for word in [
            "goto",
            "goto()",
            "goto(A",
            "goto(A,)",
            "(A)",
            "go to(A)",
            "goto(m = 1)",
            "goto(A)(B)",
            "goto(A))",
            "goto(`A)",
            "goto({A})",
        ] {
            assert_eq!(spelled(word), None, "{word}");
        }
    }
}
