//! One message of two that one slip brings about: a name that is declared twice where another one is declared nowhere,
//! a parameter whose name or type disagrees with its body and with its uses.

use crate::diagnostic::{Applicability, Code, Diagnostic, Label, suggest};
use crate::source::Span;
use crate::spelling::spelled;
use std::collections::{BTreeMap, BTreeSet};

/// Makes one mistake of two: of what is declared twice, one was likely to bear the only name that nothing declares, as
/// happens to a line that was copied.
pub fn misnamed(found: &mut Vec<Diagnostic>) {
    let is_twice =
        |it: &&Diagnostic| it.code == Code::E0201 && it.message.ends_with("is declared twice");
    let mut twice = found.iter().enumerate().filter(|(_, it)| is_twice(it));
    let (Some((at, _)), None) = (twice.next(), twice.next()) else {
        return;
    };
    let mut unknown = found
        .iter()
        .enumerate()
        .filter_map(|(at, it)| Some((at, missing(it)?)));
    let (Some((follows, name)), None) = (unknown.next(), unknown.next()) else {
        return;
    };
    let name = spelled(name).to_string();
    if let Some(first) = found.get_mut(at) {
        let span = first.span();
        let other = first.clone().fix(
            format!("if this is to be `{name}`, which nothing declares, write `{name}`"),
            span,
            name,
            Applicability::Unsafe,
        );
        *first = other;
    }
    found.remove(follows);
}

/// Leaves out what is told of uses where the body that they use shows the same. `body` gives where that of a name stands.
pub fn shown_by_bodies(found: &mut Vec<Diagnostic>, body: impl Fn(&str) -> Option<Span>) {
    let is_within = |name: &str, at: Span| {
        let body = body(name);
        body.is_some_and(|body| {
            body.file == at.file && body.start <= at.start && at.end <= body.end
        })
    };
    let mut unknown: BTreeMap<(String, String), (usize, Span)> = BTreeMap::new();
    let mut unlike: BTreeMap<(String, String), Vec<Span>> = BTreeMap::new();
    let mut never: BTreeSet<String> = BTreeSet::new();
    for (at, it) in found.iter().enumerate() {
        match it.code {
            Code::E0202 => {
                let names = renamed(it, "", " is not declared");
                unknown.extend(names.map(|names| (names, (at, it.span()))));
            }
            Code::E0302 => {
                let sides = it.message.split_once(" cannot be compared with ");
                if let Some((one, other)) = sides {
                    let places = unlike.entry((one.to_owned(), other.to_owned()));
                    places.or_default().push(it.span());
                }
            }
            Code::E0611 => {
                never.insert(it.message.clone());
            }
            _ => {}
        }
    }
    let mut uses: BTreeMap<usize, Vec<Diagnostic>> = BTreeMap::new();
    let mut follows = |it: &Diagnostic| match it.code {
        Code::E0305 => {
            let begins = it.message.find(" has no parameter ");
            let owner = begins.and_then(|end| it.message.get(..end));
            let before = owner.map(|owner| format!("{owner} has no parameter "));
            let names = before.and_then(|before| renamed(it, &before, ""));
            let known = names.and_then(|names| unknown.get(&names));
            let owner = owner.and_then(|owner| owner.rsplit('`').nth(1));
            let body = known.filter(|(_, at)| owner.is_some_and(|owner| is_within(owner, *at)));
            if let Some((body, _)) = body {
                uses.entry(*body).or_default().push(it.clone());
            }
            body.is_some()
        }
        Code::E0302 => given(&it.message).is_some_and(|(owner, is, wanted)| {
            let both = |one: &str, other: &str| {
                let places = unlike.get(&(one.to_owned(), other.to_owned()));
                let mut places = places.into_iter().flatten();
                places.any(|at| is_within(owner, *at))
            };
            both(is, wanted) || both(wanted, is)
        }),
        // What never ends is told where something waits for it.
        Code::W0609 => never.contains(&it.message),
        _ => false,
    };
    let gone: Vec<bool> = found.iter().map(&mut follows).collect();
    for (body, uses) in uses {
        if let Some(body) = found.get_mut(body) {
            for of in uses {
                let places = of.labels.into_iter().take(1);
                body.labels.extend(places.map(|place| Label {
                    message: "and here".to_owned(),
                    ..place
                }));
                let edits = of.fixes.into_iter().flat_map(|fix| fix.edits);
                if let Some(fix) = body.fixes.first_mut() {
                    fix.edits.extend(edits);
                }
            }
        }
    }
    let mut gone = gone.into_iter();
    found.retain(|_| !gone.next().unwrap_or(false));
}

/// The name that a message is about, between what stands `before` and `after` it, with the one that its fix writes.
fn renamed(found: &Diagnostic, before: &str, after: &str) -> Option<(String, String)> {
    let name = found.message.strip_prefix(before)?.strip_suffix(after)?;
    let [fix] = found.fixes.as_slice() else {
        return None;
    };
    let (_, right) = fix.edits.first()?;
    Some((name.trim_matches('`').to_owned(), right.clone()))
}

/// What has a parameter, the type that this is of, and the one that it is given: "`c` of `carries` is …, not …".
fn given(message: &str) -> Option<(&str, &str, &str)> {
    let (parameter, types) = message.split_once(" is ")?;
    let (_, owner) = parameter.split_once("` of `")?;
    let (is, wanted) = types.split_once(", not ")?;
    Some((owner.strip_suffix('`')?, is, wanted))
}

/// The name that a diagnostic misses, unless it is a slip of another one.
fn missing(found: &Diagnostic) -> Option<&str> {
    let quoted = |message: &'static str| -> Option<&str> { found.message.strip_suffix(message) };
    let name = match found.code {
        Code::E0202 => quoted(" is not declared")?,
        Code::E0406 => found.message.split(" needs a sensor ").nth(1)?,
        _ => return None,
    };
    let name = name.trim_matches('`');
    // What is only like another name may be the one that a copied line was to declare; a slip of another name is not.
    let mut offered = found.fixes.iter().flat_map(|fix| &fix.edits);
    let is_slip = offered.any(|(_, right)| suggest::is_slip(name, right));
    (!is_slip).then_some(name)
}
