//! The name that was likely meant.

/// The candidate nearest to `name`, if one is near enough to be what was meant; the first one of several.
///
/// Nearness is the number of letters inserted, dropped, replaced or exchanged with their neighbour (optimal string
/// alignment); the case of letters counts half a replacement, so that `Sequence` finds `sequence`.
pub fn nearest<'a, I>(name: &str, candidates: I) -> Option<&'a str>
where
    I: IntoIterator<Item = &'a str>,
{
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        let length = name.chars().count().max(candidate.chars().count());
        let allowed = 2 * (length / 3).clamp(1, 3);
        let distance = half_edits(name, candidate);
        if distance > allowed || distance >= 2 * length || candidate == name {
            continue;
        }
        if best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// Twice the edit distance, where a change of case costs one.
fn half_edits(left: &str, right: &str) -> usize {
    let left: Vec<char> = left.chars().collect();
    let right: Vec<char> = right.chars().collect();
    let mut before: Vec<usize> = Vec::new();
    let mut above: Vec<usize> = (0..=right.len()).map(|column| 2 * column).collect();
    let mut previous: Option<char> = None;
    for (row, &a) in left.iter().enumerate() {
        let mut current = Vec::with_capacity(right.len() + 1);
        let mut last = 2 * (row + 1);
        current.push(last);
        let mut earlier: Option<char> = None;
        for (column, &b) in right.iter().enumerate() {
            let at =
                |costs: &[usize], index: usize| costs.get(index).copied().unwrap_or(usize::MAX / 2);
            let replaced = at(&above, column) + replacement(a, b);
            let dropped = at(&above, column + 1) + 2;
            let mut least = replaced.min(dropped).min(last + 2);
            if previous == Some(b) && earlier == Some(a) && column > 0 {
                least = least.min(at(&before, column - 1) + 2);
            }
            current.push(least);
            last = least;
            earlier = Some(b);
        }
        before = std::mem::replace(&mut above, current);
        previous = Some(a);
    }
    above.last().copied().unwrap_or(0)
}

fn replacement(a: char, b: char) -> usize {
    if a == b {
        0
    } else if a.eq_ignore_ascii_case(&b) {
        1
    } else {
        2
    }
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn finds_what_was_meant() {
        let words = ["behavior", "predicate", "sequence", "goto"];
        assert_eq!(nearest("behaviour", words), Some("behavior"));
        assert_eq!(nearest("predicat", words), Some("predicate"));
        assert_eq!(nearest("Sequence", words), Some("sequence"));
        assert_eq!(nearest("got", words), Some("goto"));
        assert_eq!(nearest("ogto", words), Some("goto"));
    }

    #[test]
    fn stays_silent_where_nothing_is_near() {
        assert_eq!(nearest("fallback", ["selector", "sequence"]), None);
        assert_eq!(nearest("x", ["y"]), None);
        assert_eq!(nearest("goto", ["goto"]), None);
    }
}
