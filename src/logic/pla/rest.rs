//! What of some cubes no others contain.

use crate::logic::packed::Packed;
use std::cmp::Reverse;

/// The smallest cube that contains all minterms of `region` that lie in some cube of `on` and in none of `others`; `None` if
/// there are none. When no work is left, what was not looked at counts as a whole.
pub(super) fn rest(
    region: &Packed,
    on: &[&Packed],
    others: &[&Packed],
    work: &mut u64,
) -> Option<Packed> {
    let first = false;
    Search { first, work }.rest(region, on, others, None)
}

/// Whether some minterm of `region` lies in some cube of `on` and in none of `others`; true when no work is left.
pub(super) fn is_left(region: &Packed, on: &[&Packed], others: &[&Packed], work: &mut u64) -> bool {
    let first = true;
    let mut search = Search { first, work };
    search.rest(region, on, others, None).is_some()
}

struct Search<'w> {
    /// Whether some of what is left is enough.
    first: bool,
    work: &'w mut u64,
}

impl Search<'_> {
    /// The smallest cube around what is left and `known`, by Shannon expansion. A part of the region that lies in `known` is
    /// not looked at.
    fn rest(
        &mut self,
        region: &Packed,
        on: &[&Packed],
        others: &[&Packed],
        known: Option<Packed>,
    ) -> Option<Packed> {
        let read = (on.len() + others.len() + 1) * region.words();
        *self.work = self.work.saturating_sub(read as u64);
        let is_enough = |known: &Packed| self.first || known.contains(region);
        if known.as_ref().is_some_and(is_enough) {
            return known;
        }
        let whole = |known: Option<Packed>| match known {
            Some(known) => Some(known.supercube(region)),
            None => Some(region.clone()),
        };
        if *self.work == 0 {
            return whole(known);
        }
        let on = meeting(on, region);
        if on.is_empty() {
            return known;
        }
        let others = meeting(others, region);
        if others.iter().any(|other| other.contains(region)) {
            return known;
        }
        match region.outside(others.iter().copied()) {
            None => return known,
            Some(part) if part != *region => return self.rest(&part, &on, &others, known),
            Some(_) => {}
        }
        let Some((atom, only)) = split(region, &others) else {
            let all = on.iter().map(|cube| cube.and(region)).chain(known);
            return all.reduce(|all, cube| all.supercube(&cube));
        };
        let is_on = on.iter().any(|cube| cube.contains(region));
        if self.first && is_on && share(region, &others) < 1.0 {
            return whole(known);
        }
        let half = |value| {
            let mut half = region.clone();
            half.set(atom, Some(value));
            half
        };
        // Where the others fix the atom to one value alone, they contain no more of the other half than of this one.
        let value = !only.unwrap_or(false);
        let empty = known.is_none();
        let known = self.rest(&half(value), &on, &others, known);
        if empty && known.is_none() && is_on && only.is_some() {
            return None;
        }
        self.rest(&half(!value), &on, &others, known)
    }
}

/// The sum of the parts of the region that cubes contain.
fn share(region: &Packed, cubes: &[&Packed]) -> f64 {
    let fixed = |cube: &&Packed| {
        let more = cube.literals_beside(region);
        0.5_f64.powi(i32::try_from(more).unwrap_or(i32::MAX))
    };
    cubes.iter().map(fixed).sum()
}

fn meeting<'a>(cubes: &[&'a Packed], region: &Packed) -> Vec<&'a Packed> {
    let cubes = cubes.iter().copied();
    cubes.filter(|cube| cube.meets(region)).collect()
}

/// The atom that most cubes fix of those that are free in the region, first of those that some fix to 1 and some to 0; with
/// the value, if all fix it to the same. `None` if there are no cubes.
fn split(region: &Packed, cubes: &[&Packed]) -> Option<(usize, Option<bool>)> {
    let mut counts: Vec<[usize; 2]> = Vec::new();
    for (atom, value) in cubes.iter().flat_map(|cube| cube.fixed()) {
        if counts.len() <= atom {
            counts.resize(atom + 1, [0, 0]);
        }
        if let Some([zeros, ones]) = counts.get_mut(atom) {
            *(if value { ones } else { zeros }) += 1;
        }
    }
    let counts = counts.into_iter().enumerate();
    let open = counts.filter(|(atom, count)| *count != [0, 0] && region.get(*atom).is_none());
    let key = |(atom, [zeros, ones]): &(usize, [usize; 2])| {
        (zeros.min(ones) > &0, zeros + ones, Reverse(*atom))
    };
    let (atom, [zeros, ones]) = open.max_by_key(key)?;
    let only = (zeros == 0 || ones == 0).then_some(ones > 0);
    Some((atom, only))
}

#[cfg(test)]
mod tests {
    use super::{is_left, rest};
    use crate::logic::packed::Packed;

    fn cube(text: &str) -> Packed {
        let mut cube = Packed::universe(text.len());
        for (atom, c) in text.chars().enumerate() {
            cube.set(atom, (c != '-').then_some(c == '1'));
        }
        cube
    }

    #[test]
    fn what_is_left_has_the_smallest_cube() {
        let of = |region: &str, on: &[&str], others: &[&str]| {
            let on: Vec<Packed> = on.iter().map(|text| cube(text)).collect();
            let others: Vec<Packed> = others.iter().map(|text| cube(text)).collect();
            let (on, others): (Vec<_>, Vec<_>) = (on.iter().collect(), others.iter().collect());
            let left = is_left(&cube(region), &on, &others, &mut 1_000);
            let rest = rest(&cube(region), &on, &others, &mut 1_000);
            assert_eq!(rest.is_some(), left);
            rest
        };
        assert_eq!(of("1--", &["---"], &["-1-"]), Some(cube("10-")));
        assert_eq!(of("1--", &["--1", "00-"], &["-1-"]), Some(cube("101")));
        assert_eq!(of("1--", &["---"], &["-1-", "-0-"]), None);
        assert_eq!(of("1--", &["0--"], &[]), None);
        assert_eq!(
            of("----", &["-1--", "0---"], &["1---", "--0-", "0-11"]),
            Some(cube("0-10"))
        );
        assert_eq!(of("----", &["----"], &["1---", "-0--", "0---"]), None);
    }
}
