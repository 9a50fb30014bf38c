//! Guards with less in them.

use crate::ir::tree::Guard;
use crate::tree::guard::with_part;

/// The guard without one of its parts, for each part at each level; each part alone; and no guard at all.
pub(super) fn looser(guard: &Guard) -> Vec<Guard> {
    let mut found = lesser(guard);
    if *guard != Guard::Const(true) {
        found.push(Guard::Const(true));
    }
    found
}

fn lesser(guard: &Guard) -> Vec<Guard> {
    let (Guard::And(parts) | Guard::Or(parts)) = guard else {
        return Vec::new();
    };
    let mut found = Vec::new();
    for (at, part) in parts.iter().enumerate() {
        found.push(with_part(guard, at, None));
        let less = lesser(part).into_iter();
        found.extend(less.map(|less| with_part(guard, at, Some(less))));
        found.push(part.clone());
    }
    found
}
