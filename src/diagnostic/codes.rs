//! The codes of diagnostics, each with its title and its explanation.
//!
//! E01xx syntax, E02xx names, E03xx types and units, E04xx the world, E05xx tasks and learning, E06xx trees,
//! E080x PLA files, E081x tables of any origin, E082x trees for robots, W… warnings. An explanation is a file of its own
//! under `explain/`, with a wrong and a right example that the tests run.

use super::Severity;
use std::fmt;

macro_rules! codes {
    ($($code:ident $title:literal,)*) => {
        /// The code of a diagnostic.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Code {
            $(#[doc = $title] $code,)*
        }

        impl Code {
            /// Every code, in order.
            pub const ALL: &'static [Code] = &[$(Code::$code,)*];

            /// The code as it is printed, such as `E0301`.
            pub fn name(self) -> &'static str {
                match self { $(Code::$code => stringify!($code),)* }
            }

            /// What the code says, in a few words.
            pub fn title(self) -> &'static str {
                match self { $(Code::$code => $title,)* }
            }

            /// The explanation, in Markdown, with a wrong and a right example.
            pub fn explanation(self) -> &'static str {
                match self {
                    $(Code::$code => include_str!(concat!("explain/", stringify!($code), ".md")),)*
                }
            }
        }
    };
}

codes! {
    E0101 "unexpected text",
    E0102 "a bracket that is never closed",
    E0103 "a bracket that closes nothing",
    E0104 "the nesting is too deep",
    E0105 "no such kind of item",
    E0106 "a quote that is not closed",
    E0107 "a text where none can stand",
    E0108 "`==` where `=` gives a value",
    E0109 "`=` where `==` compares",
    E0110 "an operator of another language",
    E0111 "comparisons do not chain",
    E0112 "a comma is missing",
    E0113 "a blank between a name and its `(`",
    E0114 "no such unit",
    E0115 "a blank inside a unit",
    E0116 "`=>` is missing after a guard",
    E0117 "`elif` is `else if`",
    E0118 "a mark that nothing needs",
    E0119 "`true` and `false` are small",
    E0120 "no such kind of node",
    E0121 "a character that looks like another",
    E0122 "a word of the language as a name",
    E0123 "no such clause or aspect",
    E0124 "no number",
    E0125 "`%` is never a remainder",
    E0126 "a value by `if` needs an `else`",
    E0127 "the wrong mark before a value",
    E0128 "a parameter without a type",
    E0129 "a comment of another language",
    E0130 "a file that is not text",
    E0131 "a letter that a name cannot have",
    E0132 "too much text",
    E0133 "a field that nothing has",
    E0134 "a conflict of a merge",

    E0201 "declared twice",
    E0202 "not declared",
    E0203 "a name of the wrong kind",
    E0204 "a built-in name",
    E0205 "defined by itself",
    E0206 "used before it is declared",
    E0207 "declared only",
    E0208 "a file that cannot be read",
    E0209 "definitions within definitions without end",
    E0210 "files that use each other in a circle",
    E0211 "not the file that is named",
    E0212 "a folder that is not one result",

    E0301 "units do not match",
    E0302 "types do not match",
    E0303 "not a constant",
    E0304 "a type without a unit",
    E0305 "arguments do not match",
    E0306 "a random draw where none is allowed",
    E0307 "not known here",
    E0308 "an exponent that leaves the unit unknown",
    E0309 "out of range",
    E0310 "cannot be set",
    E0311 "driven twice",
    E0312 "an enum without variants",
    E0313 "a category that is not compared with its values",

    E0401 "more than one world",
    E0402 "something of the world is missing",
    E0403 "unknown to the world",
    E0404 "impossible geometry",
    E0405 "a place that faces nowhere",
    E0406 "a sensor is missing",
    E0407 "a world is missing",
    E0408 "more than one robot that learns",
    E0409 "a world that cannot be built",
    E0410 "an input beside a world",
    E0411 "a robot that reads itself",

    E0501 "unknown to a learner",
    E0502 "something of a task or a learner is missing",
    E0503 "said twice",
    E0504 "nothing of that name in the program",
    E0505 "nothing was learned",

    E0601 "a guard that is not a predicate",
    E0602 "an empty composite",
    E0603 "a decorator with several children",
    E0604 "a memory that the node cannot have",
    E0605 "two children drive",
    E0606 "arguments of a node do not match",
    E0607 "the history is not kept",
    E0608 "a proof with terms",
    E0609 "a tree that is not equal to its policy",
    E0610 "a table that does not fit",
    E0611 "an end that never comes",
    E0612 "a test that fails",
    E0613 "a behaviour that the tree does not have",
    E0614 "what a test cannot set",
    E0615 "an expectation that is not whole",

    E0801 "a keyword of a PLA that does not fit",
    E0802 "a row of a PLA of another width",
    E0803 "a character without meaning in a PLA",
    E0804 "a PLA without its size",
    E0805 "a PLA that contradicts itself",
    E0806 "a complement that is too large",
    E0807 "a PLA that is not a decision list",

    E0811 "a text that is not a table",
    E0812 "a row that is not whole",
    E0813 "a column that is missing or does not belong there",
    E0814 "a value that a cell cannot have",
    E0815 "rows that contradict each other",
    E0816 "a name that the language cannot have",
    E0817 "a table without the values that slack needs",
    E0818 "no minterm in which an episode starts",
    E0819 "a tree without canonical form",
    E0821 "a node that the robot's library does not have",
    E0822 "a time that the robot's library cannot keep",
    E0823 "rows that allow several behaviours",
    E0824 "a column without its kind",
    E0825 "a policy that does not say enough",
    E0826 "a table of values",

    W0101 "a character that is not seen",
    W0102 "a sign that is not what it looks like",
    W0103 "a guard with its node on the next line",

    W0201 "a name that nothing reads",
    W0202 "a state that is set and never read",
    W0203 "a program that has changed since",
    W0204 "a name that hides another",
    W0205 "a state or a local that never changes",
    W0301 "a plain number for a ratio",
    W0302 "a region that is never reached",
    W0303 "one thing said twice",
    W0304 "a measure that is to be exact",
    W0305 "a point in a whole number",
    W0306 "a bearing where a direction is meant",
    W0307 "a value that is overwritten",
    W0308 "an effect that changes nothing",
    W0309 "a start that reads what it sets later",
    W0310 "a start that may be shut in",
    W0311 "a bound on the wrong side",
    W0312 "a value that is read after its reset",
    W0313 "a time that does not run",

    W0401 "a part of the world that does nothing",
    W0402 "a size out of proportion",

    W0501 "a setting without effect",
    W0502 "a behaviour that never succeeded",
    W0503 "an event that never happened",
    W0504 "a reward that the tree gives up",
    W0505 "nothing is rewarded",
    W0506 "an end that training hardly met",
    W0507 "learned from too little",
    W0508 "a failure that is repeated",
    W0509 "a reward that is never paid",
    W0510 "rewards of 0",
    W0511 "an end that is neither good nor bad",
    W0512 "a time that no episode lasts",
    W0513 "conditions that say the same",
    W0514 "a requirement that is not observed",
    W0515 "a cost per decision and a behaviour without duration",
    W0516 "a sum without an end",
    W0517 "a setting of 0 that learns nothing",
    W0518 "two choices that do the same",
    W0519 "a reward that is paid in every tick",
    W0520 "a claim that allows most of what it denies",
    W0521 "a moment that is taken for a time",
    W0522 "an episode that ends as it starts",
    W0523 "a tree that learning leaves out",
    W0524 "a discount that looks next to nowhere",
    W0525 "exploration that grows",
    W0526 "a claim that cannot hold",
    W0527 "a reward for what a claim rules out",
    W0528 "a learner that hardly learns",

    W0601 "a condition that always or never holds",
    W0602 "a node that is never reached",
    W0603 "a predicate that the tree does not ask",
    W0604 "a condition that asks nothing more",
    W0605 "a decorator that changes nothing",
    W0606 "a child that is there already",
    W0607 "a tree that runs nothing",
    W0608 "a sequence that never succeeds",
    W0609 "an answer that a behaviour never gives",
}

impl Code {
    /// The code of that name, in any case.
    pub fn parse(name: &str) -> Option<Self> {
        Self::ALL
            .iter()
            .copied()
            .find(|code| code.name().eq_ignore_ascii_case(name.trim()))
    }

    /// How grave it is: `W…` warns.
    pub fn severity(self) -> Severity {
        if self.name().starts_with('W') {
            Severity::Warning
        } else {
            Severity::Error
        }
    }
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
