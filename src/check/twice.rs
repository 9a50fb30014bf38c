//! A name that is declared twice where another one is declared nowhere.

use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::spelling::spelled;

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

/// The name that a diagnostic misses, where no other is near it.
fn missing(found: &Diagnostic) -> Option<&str> {
    let plain = found.fixes.is_empty();
    let quoted = |message: &'static str| -> Option<&str> { found.message.strip_suffix(message) };
    let name = match found.code {
        Code::E0202 => quoted(" is not declared")?,
        Code::E0406 => found.message.split(" needs a sensor ").nth(1)?,
        _ => return None,
    };
    plain.then(|| name.trim_matches('`'))
}
