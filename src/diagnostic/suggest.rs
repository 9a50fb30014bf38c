//! The name that was likely meant.

use strsim::osa_distance;

/// What people who come from other languages and tools write, and what it is called here, where that is known at all.
const FOREIGN: [(&str, &str); 194] = [
    // shapes and worlds
    ("circle", "disc"),
    ("disk", "disc"),
    ("rectangle", "rect"),
    ("box", "rect"),
    ("square", "rect"),
    ("cube", "rect"),
    ("sphere", "disc"),
    ("ball", "disc"),
    ("cylinder", "disc"),
    ("segment", "line"),
    ("path", "polyline"),
    ("size", "arena"),
    ("bounds", "arena"),
    ("area", "arena"),
    ("dt", "tick"),
    ("step", "tick"),
    ("timestep", "tick"),
    ("radius", "body"),
    ("shape", "body"),
    ("size", "body"),
    ("motion", "drive"),
    ("kinematics", "drive"),
    ("collision", "contact"),
    ("run", "runs"),
    ("brain", "runs"),
    ("policy", "runs"),
    ("behavior", "runs"),
    ("script", "runs"),
    ("lidar", "scanner"),
    ("laser", "scanner"),
    ("sonar", "range_finder"),
    ("ultrasonic", "range_finder"),
    ("infrared", "range_finder"),
    ("diff_drive", "differential"),
    ("differential_drive", "differential"),
    ("omni", "holonomic"),
    ("omnidirectional", "holonomic"),
    ("mecanum", "holonomic"),
    ("speed", "max_speed"),
    ("speed_limit", "max_speed"),
    ("turn", "max_turn"),
    // types
    ("int", "number"),
    ("integer", "number"),
    ("float", "number"),
    ("double", "number"),
    ("real", "number"),
    ("num", "number"),
    ("boolean", "bool"),
    ("percent", "ratio"),
    ("percentage", "ratio"),
    ("fraction", "ratio"),
    ("velocity", "speed"),
    ("duration", "time"),
    ("seconds", "time"),
    ("vec2", "point"),
    ("vector", "point"),
    ("position", "point"),
    ("rotation", "angle"),
    ("degrees", "angle"),
    ("distance", "length"),
    ("meters", "length"),
    // values and functions
    ("random", "anywhere"),
    ("random", "uniform"),
    ("any", "anywhere"),
    ("rand", "uniform"),
    ("gauss", "normal"),
    ("gaussian", "normal"),
    ("choice", "one_of"),
    ("pick", "one_of"),
    ("dist", "distance"),
    ("delta_time", "tick"),
    ("randint", "uniform"),
    ("randrange", "uniform"),
    ("random_uniform", "uniform"),
    ("bernoulli", "chance"),
    ("clip", "clamp"),
    ("saturate", "clamp"),
    ("constrain", "clamp"),
    ("get_distance", "distance"),
    ("now", "elapsed"),
    ("clock", "elapsed"),
    ("collided", "touching"),
    ("collision", "touching"),
    ("bumped", "touching"),
    ("succeeded", "success"),
    ("completed", "success"),
    ("sees", "visible"),
    ("can_see", "visible"),
    ("is_visible", "visible"),
    ("orientation", "heading"),
    ("theta", "heading"),
    ("yaw", "heading"),
    ("pos", "position"),
    ("location", "position"),
    ("time", "elapsed"),
    ("timer", "elapsed"),
    ("closest", "nearest"),
    ("exists", "any"),
    ("some", "any"),
    ("forall", "all"),
    ("every", "all"),
    ("len", "count"),
    ("none", "nowhere"),
    ("None", "nowhere"),
    ("null", "nowhere"),
    ("nil", "nowhere"),
    // behaviours and statements
    ("move", "drive"),
    ("velocity", "speed"),
    ("direction", "course"),
    ("heading", "course"),
    ("angular", "turn"),
    ("omega", "turn"),
    ("steer", "turn"),
    ("steering", "turn"),
    ("yaw_rate", "turn"),
    ("angular_velocity", "turn"),
    ("linear", "speed"),
    ("linear_velocity", "speed"),
    ("tick_rate", "tick"),
    ("move_to", "goto"),
    ("go_to", "goto"),
    ("stop", "idle"),
    ("stay", "idle"),
    ("navigate", "goto"),
    ("navigate_to", "goto"),
    ("NavigateToPose", "goto"),
    ("MoveTo", "goto"),
    ("MoveToActor", "chase"),
    ("explore", "wander"),
    ("roam", "wander"),
    // learners
    ("alpha", "rate"),
    ("learning_rate", "rate"),
    ("epsilon", "explore"),
    ("exploration", "explore"),
    ("gamma", "discount"),
    ("algorithm", "method"),
    ("steps", "episodes"),
    ("total_timesteps", "episodes"),
    ("timesteps", "episodes"),
    ("num_episodes", "episodes"),
    ("n_episodes", "episodes"),
    ("iterations", "episodes"),
    ("epochs", "episodes"),
    ("trials", "episodes"),
    ("lr", "rate"),
    ("default", "unseen"),
    // types of messages
    ("uint8", "number"),
    ("uint16", "number"),
    ("uint32", "number"),
    ("uint64", "number"),
    ("int8", "number"),
    ("int16", "number"),
    ("int32", "number"),
    ("int64", "number"),
    ("float32", "number"),
    ("float64", "number"),
    ("uint", "number"),
    ("long", "number"),
    ("size_t", "number"),
    // worlds, sensors and motions of ROS and of game engines
    ("rate", "tick"),
    ("frequency", "tick"),
    ("fps", "tick"),
    ("hz", "tick"),
    ("delta", "tick"),
    ("deltaTime", "tick"),
    ("max_vel", "max_speed"),
    ("max_velocity", "max_speed"),
    ("max_linear", "max_speed"),
    ("max_lin_vel", "max_speed"),
    ("linear_velocity", "max_speed"),
    ("max_angular", "max_turn"),
    ("max_rotation", "max_turn"),
    ("max_ang_vel", "max_turn"),
    ("linear", "speed"),
    ("rotation", "turn"),
    ("angle", "at"),
    ("direction", "at"),
    ("max_range", "range"),
    ("distance", "range"),
    ("min_angle", "from"),
    ("angle_min", "from"),
    ("max_angle", "to"),
    ("angle_max", "to"),
    ("sleep", "wait"),
    ("delay", "wait"),
    ("Wait", "wait"),
    ("LaserScan", "scanner"),
    ("laserscan", "scanner"),
    ("lidar2d", "scanner"),
    ("ultrasound", "range_finder"),
    ("footprint", "body"),
    ("radius", "within"),
    // how something stands
    ("death", "dead"),
    ("died", "dead"),
];

/// The candidate that `name` is in the singular or the plural or is called elsewhere, or else the nearest one, if it is near enough to be what was meant; the
/// first one of several. Where none is near, the one that `name` is the beginning of, or is but for a prefix or an ending.
///
/// Nearness is the number of letters inserted, dropped, replaced or exchanged with their neighbour (optimal string
/// alignment); the case of letters counts half a replacement, so that `Sequence` finds `sequence`.
pub fn nearest<'a, I>(name: &str, candidates: I) -> Option<&'a str>
where
    I: IntoIterator<Item = &'a str>,
{
    nearest_rather(name, candidates, |_| false)
}

/// [`nearest`], where of several that are as near one that is `rather` meant comes first.
pub fn nearest_rather<'a, I>(
    name: &str,
    candidates: I,
    rather: impl Fn(&str) -> bool,
) -> Option<&'a str>
where
    I: IntoIterator<Item = &'a str>,
{
    let candidates: Vec<&'a str> = candidates.into_iter().collect();
    let mut cased = candidates
        .iter()
        .filter(|word| word.eq_ignore_ascii_case(name));
    if let Some(word) = cased.find(|word| **word != name) {
        return Some(word);
    }
    let mut numbered = candidates.iter().filter(|word| {
        name.strip_suffix('s') == Some(**word) || word.strip_suffix('s') == Some(name)
    });
    let numbered = numbered.next().filter(|_| name.len() >= 3);
    let foreign = FOREIGN.iter().filter(|(foreign, _)| *foreign == name);
    // `turn` may be the `max_turn` of a drive; where there are `turns`, it is rather one of these.
    let foreign = foreign.filter(|(foreign, meant)| numbered.is_none() || !meant.contains(foreign));
    let mut meant = foreign.filter_map(|(_, meant)| candidates.iter().find(|word| *word == meant));
    if let Some(meant) = meant.next().or(numbered) {
        return Some(meant);
    }
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
    let nearest = (candidates.iter().copied())
        .filter_map(near)
        .min_by_key(|(distance, word)| {
            (*distance, !rather(word), own.abs_diff(word.chars().count()))
        })
        .map(|(_, candidate)| candidate);
    nearest
        .or_else(|| cut_short(name, &candidates))
        .or_else(|| within(name, &candidates))
}

/// How many names are listed where one of them is asked for.
const FIRST: usize = 8;

/// The first of these names, and whether there are more, for a message that lists what may stand somewhere.
pub fn first(names: &[impl AsRef<str>]) -> String {
    let some: Vec<&str> = names.iter().take(FIRST).map(AsRef::as_ref).collect();
    let more = if names.len() > FIRST { ", …" } else { "" };
    format!("{}{more}", some.join(", "))
}

/// Whether a name is a slip of another one: a letter too much, too few or wrong, or two neighbours exchanged. Names that are
/// told apart by a number, an ending or a letter that stands alone, such as `door_a` and `door_b`, are two names.
pub fn is_slip(name: &str, meant: &str) -> bool {
    let [ours, theirs]: [Vec<char>; 2] = [name, meant].map(|name| name.chars().collect());
    let shorter = ours.len().min(theirs.len());
    let same = ours.iter().zip(&theirs).take_while(|(a, b)| a == b).count();
    let part = |name: &[char]| {
        let around = name.get(same.saturating_sub(1)..(same + 2).min(name.len()));
        around.is_some_and(|around| around.iter().all(|letter| letter.is_alphabetic()))
    };
    let within = same > 0 && same + 1 < ours.len().max(theirs.len()) && same < shorter;
    shorter >= 4 && within && part(&ours) && part(&theirs) && is_near(name, meant)
}

/// Whether a word is another one with a letter too much, too few or wrong, or with two neighbours exchanged. A short word
/// with another letter is another word: `in` is not `on`, and `set` is not `let`.
pub fn is_near(word: &str, meant: &str) -> bool {
    let letters = |word: &str| {
        let mut letters: Vec<char> = word.chars().collect();
        letters.sort_unstable();
        letters
    };
    let (ours, theirs) = (letters(word), letters(meant));
    let replaces = ours.len() == theirs.len() && ours != theirs;
    let long = if replaces { 4 } else { 2 };
    ours.len() >= long && osa_distance(word, meant) == 1
}

/// What other languages put before a name that asks or does something.
const PREFIXES: [&str; 9] = [
    "is_", "has_", "get_", "can_", "do_", "the_", "my_", "at_", "in_",
];

/// The candidate that `name` is, but for a prefix or an ending.
fn within<'a>(name: &str, candidates: &[&'a str]) -> Option<&'a str> {
    let bare = |prefix: &&str| name.strip_prefix(*prefix);
    let bare = PREFIXES.iter().find_map(bare).unwrap_or(name);
    let is = |word: &&&str| **word != name && **word == bare;
    let longer = |word: &&&str| {
        let ending = bare.strip_prefix(**word);
        word.len() >= 4 && ending.is_some_and(|ending| (1..=3).contains(&ending.len()))
    };
    let found = candidates.iter().find(is);
    found.or_else(|| candidates.iter().find(longer)).copied()
}

/// The only candidate that begins with `name`, if that has three letters or more.
fn cut_short<'a>(name: &str, candidates: &[&'a str]) -> Option<&'a str> {
    let begins = |candidate: &&&str| candidate.len() > name.len() && candidate.starts_with(name);
    let mut whole = candidates.iter().filter(begins);
    let only = whole.next().filter(|_| name.len() >= 3)?;
    whole.all(|other| other == only).then_some(only)
}

/// Twice the edit distance, where a change of case costs one: it is an edit only while case counts.
fn half_edits(left: &str, right: &str) -> usize {
    let lower = |name: &str| name.to_ascii_lowercase();
    osa_distance(left, right) + osa_distance(&lower(left), &lower(right))
}

#[cfg(test)]
mod tests {
    use super::{is_near, is_slip, nearest, nearest_rather};

    #[test]
    fn finds_what_was_meant() {
        let words = ["behavior", "predicate", "sequence", "goto"];
        assert_eq!(nearest("behaviour", words), Some("behavior"));
        assert_eq!(nearest("predicat", words), Some("predicate"));
        assert_eq!(nearest("Sequence", words), Some("sequence"));
        assert_eq!(nearest("got", words), Some("goto"));
        assert_eq!(nearest("ogto", words), Some("goto"));
        assert_eq!(nearest("seq", words), Some("sequence"));
        assert_eq!(nearest("wal", ["wall_at", "wall_of"]), None);
        assert_eq!(nearest("is_full", ["full", "low"]), Some("full"));
        assert_eq!(nearest("hauling", ["haul"]), Some("haul"));
        assert_eq!(nearest("turn", ["max_turn", "turns"]), Some("turns"));
        assert_eq!(nearest("chanse", ["chase", "chance"]), Some("chance"));
        let unused = |name: &str| name == "doly";
        assert_eq!(nearest("dolly", ["molly", "doly"]), Some("molly"));
        let rather = nearest_rather("dolly", ["molly", "doly"], unused);
        assert_eq!(rather, Some("doly"));
    }

    #[test]
    fn tells_a_short_word_from_another() {
        assert!(is_near("fo", "of"));
        assert!(is_near("lst", "last"));
        assert!(is_near("whlie", "while"));
        assert!(!is_near("in", "on"));
        assert!(!is_near("set", "let"));
    }

    #[test]
    fn tells_a_slip_from_another_name() {
        assert!(is_slip("shde", "shed"));
        assert!(is_slip("loded", "loaded"));
        assert!(is_slip("carrxing", "carrying"));
        assert!(!is_slip("b1", "b2"));
        assert!(!is_slip("door_a", "door_b"));
        assert!(!is_slip("shed_1", "shed_2"));
        assert!(!is_slip("sheds", "shed"));
        assert!(!is_slip("hauled", "loaded"));
        assert!(!is_slip("shed", "shed"));
    }

    #[test]
    fn stays_silent_where_nothing_is_near() {
        assert_eq!(nearest("fallback", ["selector", "sequence"]), None);
        assert_eq!(nearest("x", ["y"]), None);
        assert_eq!(nearest("goto", ["goto"]), None);
    }
}
