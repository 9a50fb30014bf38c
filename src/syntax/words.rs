//! The words of the language.

use super::ast::{Answer, AssignOp, BinaryOp, Link, Outcome, UnaryOp, Word};

/// The words that begin an item.
pub const ITEMS: [&str; 16] = [
    "use",
    "world",
    "enum",
    "input",
    "state",
    "event",
    "each",
    "on",
    "let",
    "predicate",
    "behavior",
    "task",
    "learn",
    "tree",
    "claim",
    "test",
];

/// The functions that range over a kind.
pub const RANGING: [&str; 4] = ["any", "all", "count", "nearest"];

/// The words that begin an aspect of a task; without parentheses or backquotes, they do not stand in a list.
pub const ASPECTS: [&str; 7] = [
    "observe", "choose", "history", "patience", "start", "end", "reward",
];

/// The shared expressions of the library.
pub const SHARED: [&str; 3] = ["turning", "pace", "clear_of_walls"];

/// The behaviours of the library.
pub const DRIVING: [&str; 12] = [
    "goto",
    "approach",
    "chase",
    "follow",
    "flee",
    "patrol",
    "turn_to",
    "dock",
    "follow_wall",
    "wander",
    "idle",
    "wait",
];

/// The types that are built in.
pub const TYPES: [&str; 15] = [
    "bool",
    "number",
    "ratio",
    "length",
    "time",
    "angle",
    "speed",
    "turn_rate",
    "frequency",
    "point",
    "place",
    "wall",
    "robot",
    "sensor",
    "target",
];

/// The words by which other languages choose among values.
pub(super) const SWITCHES: [&str; 3] = ["match", "switch", "case"];

/// How a value is chosen here.
pub(super) const CHOICE: &str =
    "a value is chosen by `if a == b { … } else if a == c { … } else { … }`";

/// How a value by the time is said, for who writes `2% per tick`.
pub(super) const RATE: &str = "a rate in every tick: `battery -= 1%/s * tick`";

/// What is reckoned of numbers.
pub const FUNCTIONS: [&str; 20] = [
    "abs", "sign", "min", "max", "clamp", "wrap", "sqrt", "exp", "ln", "floor", "ceil", "round",
    "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "uniform",
];

/// What is never written without arguments.
pub(super) const CALLED: [&str; 18] = [
    "goto",
    "approach",
    "chase",
    "follow",
    "flee",
    "turn_to",
    "dock",
    "success",
    "failure",
    "running",
    "done",
    "failed",
    "distance",
    "visible",
    "inside",
    "bearing",
    "direction",
    "facing",
];

/// What other languages call what begins an item, a clause, an aspect or a line.
pub(super) const FOREIGN: [(&str, &str); 124] = [
    ("function", "let"),
    ("fn", "let"),
    ("func", "let"),
    ("def", "let"),
    ("const", "let"),
    ("constant", "let"),
    ("define", "let"),
    ("val", "let"),
    ("var", "state"),
    ("int", "state"),
    ("float", "state"),
    ("double", "state"),
    ("number", "state"),
    ("real", "state"),
    ("bool", "state"),
    ("boolean", "state"),
    ("variable", "state"),
    ("type", "enum"),
    ("condition", "predicate"),
    ("observation", "predicate"),
    ("proposition", "predicate"),
    ("fact", "predicate"),
    ("action", "behavior"),
    ("skill", "behavior"),
    ("import", "use"),
    ("include", "use"),
    ("include_std", "use"),
    ("from", "use"),
    ("require", "use"),
    ("every", "each"),
    ("always", "each"),
    ("update", "each"),
    ("when", "on"),
    ("if", "on"),
    ("whenever", "on"),
    ("trigger", "event"),
    ("signal", "event"),
    ("map", "world"),
    ("level", "world"),
    ("scene", "world"),
    ("environment", "world"),
    ("goal", "task"),
    ("mission", "task"),
    ("train", "learn"),
    ("agent", "learn"),
    ("policy", "tree"),
    ("bt", "tree"),
    ("behavior_tree", "tree"),
    ("assert", "claim"),
    ("check", "claim"),
    ("verify", "claim"),
    ("prove", "claim"),
    ("actions", "choose"),
    ("options", "choose"),
    ("behaviors", "choose"),
    ("select", "choose"),
    ("observations", "observe"),
    ("sense", "observe"),
    ("inputs", "observe"),
    ("memory", "history"),
    ("remember", "history"),
    ("rewards", "reward"),
    ("cost", "reward"),
    ("score", "reward"),
    ("terminate", "end"),
    ("done", "end"),
    ("stop", "end"),
    ("finish", "end"),
    ("limit", "end"),
    ("timeout", "end"),
    ("max_time", "end"),
    ("init", "start"),
    ("initial", "start"),
    ("initially", "start"),
    ("reset", "start"),
    ("setup", "start"),
    ("success", "succeed"),
    ("until", "succeed"),
    ("done", "succeed"),
    ("failure", "fail"),
    ("abort", "fail"),
    ("precondition", "requires"),
    ("require", "requires"),
    ("assert", "requires"),
    ("run", "control"),
    ("act", "control"),
    ("do", "control"),
    ("law", "control"),
    ("execute", "control"),
    ("update", "control"),
    ("let", "local"),
    ("var", "local"),
    ("state", "local"),
    ("default", "otherwise"),
    ("else", "otherwise"),
    ("when", "on"),
    ("each", "per"),
    ("every", "per"),
    ("whenever", "on"),
    ("if", "on"),
    ("always", "otherwise"),
    ("during", "while"),
    ("pred", "predicate"),
    ("expect", "tick"),
    ("assert", "tick"),
    ("then", "tick"),
    ("step", "tick"),
    ("when", "given"),
    ("blackboard", "state"),
    ("fluent", "state"),
    ("observation_space", "observe"),
    ("state_space", "observe"),
    ("obs", "observe"),
    ("action_space", "choose"),
    ("max_steps", "end"),
    ("max_episode_steps", "end"),
    ("horizon", "end"),
    ("time_limit", "end"),
    ("reward_machine", "reward"),
    ("reward_function", "reward"),
    ("subtree", "tree"),
    ("param", "let"),
    ("parameter", "let"),
    ("update_rule", "each"),
];

/// What other languages declare, and this one does not.
pub(super) const KINDS: [&str; 8] = [
    "kind", "class", "category", "sort", "group", "tag", "species", "subtype",
];

/// The words that stand within an item, with what that item is and how they stand in it.
pub(super) const INNER: [(&[&str], &str, &str); 7] = [
    (
        &["place", "wall", "arena", "tick", "robot"],
        "a world",
        "world NAME { … }",
    ),
    (
        &["sensor", "body", "drive", "contact", "runs"],
        "a robot, which stands in a world",
        "world NAME { robot NAME { … } }",
    ),
    (
        &[
            "observe", "choose", "history", "patience", "start", "end", "reward",
        ],
        "a task",
        "task NAME { … }",
    ),
    (
        &["local", "requires", "succeed", "fail", "control"],
        "a behaviour",
        "behavior NAME { … }",
    ),
    (
        &[
            "selector", "sequence", "memory", "parallel", "invert", "retry", "repeat", "timeout",
        ],
        "a tree",
        "tree NAME = …",
    ),
    (&LEARNER, "a learner", "learn TASK { … }"),
    (
        &["otherwise", "per"],
        "the reward of a task",
        "task NAME { reward { … } }",
    ),
];

/// The settings of a learner.
pub const LEARNER: [&str; 10] = [
    "method",
    "episodes",
    "rate",
    "initial",
    "objective",
    "discount",
    "explore",
    "unseen",
    "dwell",
    "seed",
];

/// The item that a word stands within, and how it stands there.
pub fn home(word: &str) -> Option<(&'static str, &'static str)> {
    let mut inner = INNER.iter();
    let found = inner.find(|(words, ..)| words.contains(&word));
    found.map(|(_, whole, example)| (*whole, *example))
}

/// The words with which a test says what a behaviour, or the tree, answers.
pub const ANSWERS: [(&str, Answer); 3] = [
    ("succeeds", Answer::Succeeds),
    ("fails", Answer::Fails),
    ("runs", Answer::Runs),
];

/// The units, as a person would list them.
pub const UNITS: [&str; 14] = [
    "m", "cm", "mm", "km", "s", "ms", "min", "h", "tick", "ticks", "deg", "rad", "Hz", "%",
];

/// Those of time.
pub const TIMES: [&str; 6] = ["s", "ms", "min", "h", "tick", "ticks"];

/// The shapes of places and walls.
pub const SHAPES: [&str; 5] = ["disc", "rect", "polygon", "line", "polyline"];

/// The words of composites and decorators.
pub const NODES: [(&str, Word); 9] = [
    ("selector", Word::Selector),
    ("sequence", Word::Sequence),
    ("parallel", Word::Parallel),
    ("invert", Word::Invert),
    ("succeed", Word::Succeed),
    ("fail", Word::Fail),
    ("retry", Word::Retry),
    ("repeat", Word::Repeat),
    ("timeout", Word::Timeout),
];

/// What other languages call the composites and decorators.
pub(super) const FOREIGN_NODES: [(&str, Word); 30] = [
    ("fallback", Word::Selector),
    ("priority", Word::Selector),
    ("select", Word::Selector),
    ("choice", Word::Selector),
    ("reactive_fallback", Word::Selector),
    ("reactivefallback", Word::Selector),
    ("seq", Word::Sequence),
    ("reactive_sequence", Word::Sequence),
    ("reactivesequence", Word::Sequence),
    ("concurrent", Word::Parallel),
    ("all", Word::Parallel),
    ("inverter", Word::Invert),
    ("negate", Word::Invert),
    ("force_success", Word::Succeed),
    ("succeeder", Word::Succeed),
    ("force_failure", Word::Fail),
    ("loop", Word::Repeat),
    ("deadline", Word::Timeout),
    ("retryuntilsuccessful", Word::Retry),
    ("retry_until_successful", Word::Retry),
    ("forcesuccess", Word::Succeed),
    ("forcefailure", Word::Fail),
    ("failer", Word::Fail),
    ("alwaysfailure", Word::Fail),
    ("keeprunninguntilfailure", Word::Repeat),
    ("reactiveselector", Word::Selector),
    ("priorityselector", Word::Selector),
    ("negation", Word::Invert),
    ("timer", Word::Timeout),
    ("parallelall", Word::Parallel),
];

impl Word {
    /// The word as it is written.
    pub fn spelling(self) -> &'static str {
        NODES
            .iter()
            .find(|(_, word)| *word == self)
            .map_or("selector", |(spelling, _)| spelling)
    }
}

impl Answer {
    /// The word as it is written.
    pub fn spelling(self) -> &'static str {
        ANSWERS
            .iter()
            .find(|(_, answer)| *answer == self)
            .map_or("runs", |(spelling, _)| spelling)
    }
}

impl UnaryOp {
    /// The operator as it is written.
    pub fn spelling(self) -> &'static str {
        match self {
            Self::Neg => "-",
            Self::Pos => "+",
            Self::Not => "not",
        }
    }
}

impl BinaryOp {
    /// The operator as it is written.
    pub fn spelling(self) -> &'static str {
        match self {
            Self::Or => "or",
            Self::And => "and",
            Self::Eq => "==",
            Self::Ne => "!=",
            Self::Lt => "<",
            Self::Le => "<=",
            Self::Gt => ">",
            Self::Ge => ">=",
            Self::Add => "+",
            Self::Sub => "-",
            Self::Mul => "*",
            Self::Div => "/",
            Self::Pow => "^",
        }
    }
}

impl AssignOp {
    /// The operator as it is written.
    pub fn spelling(self) -> &'static str {
        match self {
            Self::Set => "=",
            Self::Add => "+=",
            Self::Sub => "-=",
            Self::Mul => "*=",
            Self::Div => "/=",
        }
    }
}

impl Link {
    /// The word or the mark as it is written.
    pub fn spelling(self) -> &'static str {
        match self {
            Self::Of => "of",
            Self::Per => "per",
            Self::Arrow => "->",
        }
    }
}

impl Outcome {
    /// The word as it is written.
    pub fn spelling(self) -> &'static str {
        match self {
            Self::Success => "success",
            Self::Failure => "failure",
        }
    }
}

/// How the advice begins that a name is one word.
pub const NAMES: &str = "a name is made of letters, digits and `_`";

/// The advice on words with marks between them that are to be this name.
pub fn name_of_words(joined: &str) -> String {
    format!("{NAMES}: `{joined}`; or it stands in backquotes")
}
