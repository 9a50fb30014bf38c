//! The name that was likely meant.

use strsim::osa_distance;

/// The candidate nearest to `name`, if one is near enough to be what was meant; the first one of several.
///
/// Nearness is the number of letters inserted, dropped, replaced or exchanged with their neighbour (optimal string
/// alignment); the case of letters counts half a replacement, so that `Sequence` finds `sequence`.
pub fn nearest<'a, I>(name: &str, candidates: I) -> Option<&'a str>
where
    I: IntoIterator<Item = &'a str>,
{
    let own = name.chars().count();
    let near = |candidate: &'a str| {
        let other = candidate.chars().count();
        let length = own.max(other);
        let allowed = 2 * (length / 3).clamp(1, 3);
        if 2 * own.abs_diff(other) > allowed {
            return None;
        }
        let distance = half_edits(name, candidate);
        let near = distance <= allowed && distance < 2 * length && candidate != name;
        near.then_some((distance, candidate))
    };
    let candidates = candidates.into_iter().filter_map(near);
    candidates
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// Twice the edit distance, where a change of case costs one: it is an edit only while case counts.
fn half_edits(left: &str, right: &str) -> usize {
    let lower = |name: &str| name.to_ascii_lowercase();
    osa_distance(left, right) + osa_distance(&lower(left), &lower(right))
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
