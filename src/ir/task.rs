//! Tasks, learners and claims.

use super::expr::ExprId;
use super::law::{Behavior, Block};
use super::name::Name;
use super::program::{Event, Predicate, Program, State};
use super::table::Id;
use super::tree::{Node, Status, Tree};
use super::world::Robot;
use rustc_hash::FxHashMap;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// What is worth doing, and when an episode starts and ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Task {
    /// Its name.
    pub name: Name,
    /// The predicates of a minterm, in order.
    pub observe: Vec<Id<Predicate>>,
    /// The behaviours of the policy, in order; ties are decided by it.
    pub choose: Vec<Id<Behavior>>,
    /// The history window.
    pub history: History,
    /// A decision is due after this many ticks without another reason.
    pub patience: Option<u64>,
    /// How an episode starts; the lines run in order.
    pub start: Vec<StartLine>,
    /// Events that end an episode.
    pub end_on: Vec<ExprId>,
    /// Ticks after which an episode is cut.
    pub end_after: u64,
    /// The first line whose event fires gives the reward.
    pub reward: Vec<RewardLine>,
    /// The reward of every other transition.
    pub otherwise: ExprId,
    /// What time pays, whether or not a transition ends with it.
    pub prices: Vec<Price>,
    /// Which entries of the text its own come from.
    pub written: Written,
}

impl Task {
    /// What the lines of `reward` on its own events pay for each line of `end on`, whatever else happens in the same tick; `None` where
    /// there are none, one is no constant, or some are gains and others are not.
    pub fn worths(&self, program: &Program) -> Vec<Option<f64>> {
        let mut lines: FxHashMap<ExprId, Vec<usize>> = FxHashMap::default();
        for (number, line) in self.reward.iter().enumerate() {
            for event in program.alternatives(line.event, true) {
                lines.entry(event).or_default().push(number);
            }
        }
        let paid = |number: &usize| program.pool.constant(self.reward.get(*number)?.value);
        let worth = |end: &ExprId| {
            let events = program.alternatives(*end, true);
            let own = events.iter().filter_map(|event| lines.get(event));
            let own: BTreeSet<usize> = own.flatten().copied().collect();
            let paid: Vec<f64> = own.iter().map(paid).collect::<Option<_>>()?;
            let (first, others) = paid.split_first()?;
            let is_alike = |value: &f64| (*value > 0.0) == (*first > 0.0);
            others.iter().all(is_alike).then_some(*first)
        };
        self.end_on.iter().map(worth).collect()
    }

    /// The first behaviour of a tree that the task does not choose among.
    pub fn lacks(&self, tree: &Tree) -> Option<Id<Behavior>> {
        let mut lacking = None;
        tree.root.visit_behaviors(&mut |behavior| {
            let lacks = !self.choose.contains(&behavior);
            lacking = lacking.or(lacks.then_some(behavior));
        });
        lacking
    }
}

/// What stands in a tree for behaviours that the task does not choose among: each with one of those it does.
pub type StandIns = Vec<(Id<Behavior>, Id<Behavior>)>;

impl Task {
    /// The tree with what the task chooses among in the place of what it does not: the same behaviour with another number. `None` if
    /// there is no such one.
    pub fn fitted(&self, program: &Program, tree: &Tree) -> Option<(Node, StandIns)> {
        let mut asked = BTreeSet::new();
        tree.root.visit_behaviors(&mut |behavior| {
            asked.insert(behavior);
        });
        let lacking = asked.into_iter().filter(|id| !self.choose.contains(id));
        let stand_in = |id: Id<Behavior>| {
            let alike = |other: &&Id<Behavior>| {
                program.behaviors[id]
                    .name
                    .differs_in_numbers(&program.behaviors[**other].name)
            };
            Some((id, *self.choose.iter().find(alike)?))
        };
        let stand_ins: StandIns = lacking.map(stand_in).collect::<Option<_>>()?;
        let of = |id| {
            let mut stand_ins = stand_ins.iter();
            let own = stand_ins.find(|(lacking, _)| *lacking == id);
            own.map_or(id, |(_, other)| *other)
        };
        Some((tree.root.clone().with_behaviors(&of), stand_ins))
    }
}

/// `while condition, per time: value`
#[derive(Clone, Debug, PartialEq)]
pub struct Price {
    /// As it is written.
    pub name: String,
    /// What has to hold.
    pub during: ExprId,
    /// What a second pays; reads the state before effects.
    pub per_second: ExprId,
}

/// Which entries of the text those of a task come from, by their places there: an entry that ranges over the members of a
/// kind is several.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Written {
    /// Of each observed predicate.
    pub observe: Vec<usize>,
    /// Of each behaviour to choose.
    pub choose: Vec<usize>,
    /// Of each line of `end on`.
    pub end_on: Vec<usize>,
    /// The conditions of `end on`, as they are written.
    pub ends: Vec<String>,
    /// Of each line of `reward`.
    pub reward: Vec<usize>,
}

/// The window over the last terminations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct History {
    /// How many terminations it holds; 0 for no history.
    pub window: usize,
    /// Whether successes enter it.
    pub success: bool,
    /// Whether failures enter it.
    pub failure: bool,
}

/// `on event: value`
#[derive(Clone, Debug, PartialEq)]
pub struct RewardLine {
    /// As it is written.
    pub name: String,
    /// Whether it fires.
    pub event: ExprId,
    /// The reward; reads the state before effects.
    pub value: ExprId,
}

/// One line of a `start`.
#[derive(Clone, Debug, PartialEq)]
pub enum StartLine {
    /// `pose = anywhere`: uniform over the free arena, any heading; `anywhere(place)`: over the free part of a place, which
    /// is known by its number.
    Anywhere(Option<ExprId>),
    /// `position = (x, y)`
    Position(ExprId, ExprId),
    /// `heading = a`
    Heading(ExprId),
    /// One of these of another robot, by its place among all robots.
    Other(Id<Robot>, Placing),
    /// A state variable: its numbers, all of them read before the first is set.
    State(Vec<(Id<State>, ExprId)>),
    /// A member of a family that is known only as the episode starts: the left side as it is written, and what sets it.
    Member(String, Block),
    /// The newest termination in the window, as its [code](StartLine::code), or [none](StartLine::NO_END). Older places of the window stay
    /// empty.
    History(ExprId),
}

/// A start line for the pose of another robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Placing {
    /// As [`StartLine::Anywhere`].
    Anywhere(Option<ExprId>),
    /// As [`StartLine::Position`].
    Position(ExprId, ExprId),
    /// As [`StartLine::Heading`].
    Heading(ExprId),
}

impl StartLine {
    /// The code of no termination.
    pub const NO_END: f64 = -1.0;

    /// A termination as a number: twice the behaviour's index, plus one for a failure.
    pub fn code(behavior: Id<Behavior>, status: Status) -> f64 {
        (behavior.index() * 2 + usize::from(status == Status::Failure)) as f64
    }

    /// The termination of a code, if it is one.
    pub fn termination(code: f64) -> Option<(Id<Behavior>, Status)> {
        let code = (code >= 0.0).then_some(code as usize)?;
        let status = if code.is_multiple_of(2) {
            Status::Success
        } else {
            Status::Failure
        };
        Some((Id::new(code / 2), status))
    }

    /// Whether a later line of the same start would undo this one. Of two that draw their member, each may set another.
    pub fn undone_by(&self, later: &Self) -> bool {
        let anew = match (self, later) {
            (StartLine::Member(..), _) => return false,
            (StartLine::Position(..) | StartLine::Heading(_), StartLine::Anywhere(_)) => true,
            (StartLine::Other(a, one), StartLine::Other(b, Placing::Anywhere(_))) => {
                a == b && !matches!(one, Placing::Anywhere(_))
            }
            _ => false,
        };
        anew || self.replaced_by(later)
    }

    /// Whether a line of a learner replaces this line of its task: it sets the same thing.
    pub fn replaced_by(&self, other: &Self) -> bool {
        match (self, other) {
            (StartLine::State(a), StartLine::State(b)) => {
                let variables = |line: &[(Id<State>, ExprId)]| line.first().map(|(id, _)| *id);
                variables(a) == variables(b)
            }
            (StartLine::Member(a, _), StartLine::Member(b, _)) => a == b,
            (StartLine::Other(a, one), StartLine::Other(b, other)) => {
                a == b && std::mem::discriminant(one) == std::mem::discriminant(other)
            }
            (StartLine::Anywhere(_), StartLine::Anywhere(_))
            | (StartLine::Position(..), StartLine::Position(..))
            | (StartLine::Heading(_), StartLine::Heading(_))
            | (StartLine::History(_), StartLine::History(_)) => true,
            _ => false,
        }
    }
}

/// How a task is learned.
#[derive(Clone, Debug, PartialEq)]
pub struct Learner {
    /// The name of the tree that it learns.
    pub name: Name,
    /// The task.
    pub task: Id<Task>,
    /// The method.
    pub method: Method,
    /// How many episodes.
    pub episodes: u64,
    /// Their greatest length in ticks.
    pub episode_ticks: u64,
    /// The step size, a function of `visits` and `progress`; [`Method::Model`] has none.
    pub rate: ExprId,
    /// The probability of a random choice, a function of `visits` and `progress`.
    pub explore: ExprId,
    /// What is to be great.
    pub objective: Objective,
    /// The value of a pair that was never tried; of a minterm that was never acted in, to [`Method::Model`].
    pub initial: f64,
    /// What the policy does in a minterm that it has not learned; the first choice if not said.
    pub unseen: Option<Id<Behavior>>,
    /// The seed.
    pub seed: u64,
    /// Ticks for which a choice is kept in training, whatever changes.
    pub dwell: u64,
    /// The task's start lines, with the learner's own instead of those that they replace.
    pub start: Vec<StartLine>,
}

/// The methods of learning.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Tabular Q-learning (Watkins 1989; the paper's).
    QLearning,
    /// Double Q-learning (van Hasselt 2010).
    DoubleQ,
    /// Counts of the seen transitions, solved exactly.
    Model,
}

/// What a policy is to make great.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Objective {
    /// The discounted sum of rewards.
    Discounted(Discount),
    /// The average reward a tick in the long run, told per this many seconds.
    Average(f64),
}

/// How future reward counts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Discount {
    /// This factor a decision.
    PerDecision(f64),
    /// This factor a span of simulated seconds (semi-Markov: Sutton, Precup and Singh 1999).
    PerTime(f64, f64),
}

/// What is claimed of a tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// The tree.
    pub tree: TreeRef,
    /// As it is written.
    pub text: String,
    /// What is claimed.
    pub kind: ClaimKind,
}

/// A tree that is there, or that a learner will learn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TreeRef {
    /// A tree of the program.
    Tree(Id<Tree>),
    /// The tree that a learner learns.
    Learned(Id<Learner>),
}

/// The kinds of claims.
#[derive(Clone, Debug, PartialEq)]
pub enum ClaimKind {
    /// Both trees take the same decisions.
    Equals(TreeRef),
    /// The event never happens.
    Never(Occurrence),
    /// The event happens.
    Reaches(Occurrence),
}

/// An event within a time, with a probability.
#[derive(Clone, Debug, PartialEq)]
pub struct Occurrence {
    /// The event.
    pub event: Id<Event>,
    /// The time in ticks; the whole episode if not said.
    pub within: Option<u64>,
    /// The probability; 1 if not said.
    pub probability: f64,
}
