//! Behaviour trees: subtrees inlined, guards over atoms.

use super::law::Behavior;
use super::name::Name;
use super::program::Predicate;
use super::table::Id;
use super::task::Task;
use serde::{Deserialize, Serialize};
use std::fmt;

/// A named tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    /// Its name.
    pub name: Name,
    /// The `///` lines before it.
    pub docs: Vec<String>,
    /// The task that it is for, whose predicates and behaviours it uses.
    pub task: Option<Id<Task>>,
    /// The tree.
    pub root: Node,
}

impl Tree {
    /// A tree for no task, without documentation.
    pub fn plain(name: Name, root: Node) -> Self {
        Self {
            name,
            docs: Vec::new(),
            task: None,
            root,
        }
    }
}

/// What a guard can ask: a predicate, or what the history window says of a behaviour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Atom {
    /// An observed predicate.
    Predicate(Id<Predicate>),
    /// `done(b)`: a success of b is in the window.
    Done(Id<Behavior>),
    /// `failed(b)`: a failure of b is in the window.
    Failed(Id<Behavior>),
}

impl Atom {
    /// The word that asks for a success in the history window.
    pub const DONE: &str = "done";
    /// The word that asks for a failure in the history window.
    pub const FAILED: &str = "failed";

    /// What the history window says, if that is what it asks: success for `done`, failure for `failed`.
    pub fn outcome(self) -> Option<Status> {
        match self {
            Atom::Predicate(_) => None,
            Atom::Done(_) => Some(Status::Success),
            Atom::Failed(_) => Some(Status::Failure),
        }
    }
}

/// Literals that exclude one another: atoms with values that they never have all at once.
pub type Exclusion = Vec<(Atom, bool)>;

/// A boolean formula over atoms.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Guard {
    /// Always, or never.
    Const(bool),
    /// An atom.
    Atom(Atom),
    /// Negation.
    Not(Box<Guard>),
    /// Conjunction of two or more.
    And(Vec<Guard>),
    /// Disjunction of two or more.
    Or(Vec<Guard>),
}

impl Guard {
    /// Its value where the atoms have the values that `holds` gives.
    pub fn eval(&self, holds: &mut impl FnMut(Atom) -> bool) -> bool {
        match self {
            Guard::Const(value) => *value,
            Guard::Atom(atom) => holds(*atom),
            Guard::Not(guard) => !guard.eval(holds),
            Guard::And(guards) => guards.iter().all(|guard| guard.eval(holds)),
            Guard::Or(guards) => guards.iter().any(|guard| guard.eval(holds)),
        }
    }
}

/// What a node of a tree, or a behaviour, answers to a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Status {
    /// It has reached its goal.
    Success,
    /// It cannot go on.
    Failure,
    /// It goes on.
    Running,
}

impl Status {
    /// `success`, `failure` or `running`.
    pub fn name(self) -> &'static str {
        match self {
            Status::Success => "success",
            Status::Failure => "failure",
            Status::Running => "running",
        }
    }
}

/// A node.
///
/// `guard => node` is a reactive sequence of a condition and the node: there is no node of its own for it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Node {
    /// Answers at once.
    Condition(Guard),
    /// A behaviour leaf.
    Behavior(Id<Behavior>),
    /// `selector`, `sequence`, with or without memory. Never empty.
    Composite {
        /// Which of the two.
        kind: Composite,
        /// Whether it resumes at the running child.
        memory: bool,
        /// The children, from the left.
        children: Vec<Node>,
    },
    /// `parallel(n)`: success when `successes` children have succeeded, failure when they no longer can.
    Parallel {
        /// How many have to succeed.
        successes: u32,
        /// The children, from the left.
        children: Vec<Node>,
    },
    /// A decorator.
    Decorator {
        /// Which one.
        kind: Decorator,
        /// What it decorates.
        child: Box<Node>,
    },
}

/// The two composites.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Composite {
    /// Tries its children until one does not fail.
    Selector,
    /// Tries its children until one does not succeed.
    Sequence,
}

impl Composite {
    /// Its words in the language: `selector`, `memory selector`, `sequence` or `memory sequence`.
    pub fn word(self, memory: bool) -> &'static str {
        match (self, memory) {
            (Composite::Selector, false) => "selector",
            (Composite::Selector, true) => "memory selector",
            (Composite::Sequence, false) => "sequence",
            (Composite::Sequence, true) => "memory sequence",
        }
    }
}

/// The decorators.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Decorator {
    /// Exchanges success and failure.
    Invert,
    /// Turns failure into success.
    Succeed,
    /// Turns success into failure.
    Fail,
    /// After a failure, tries again (running), until it has failed this many times.
    Retry(u32),
    /// After a success, starts again (running), until it has succeeded this many times.
    Repeat(u32),
    /// Fails once it has been reached for this many ticks.
    Timeout(u64),
}

impl Decorator {
    /// Its word in the language, without its number.
    pub fn word(self) -> &'static str {
        match self {
            Decorator::Invert => "invert",
            Decorator::Succeed => "succeed",
            Decorator::Fail => "fail",
            Decorator::Retry(_) => "retry",
            Decorator::Repeat(_) => "repeat",
            Decorator::Timeout(_) => "timeout",
        }
    }
}

/// As a drawing shows it: `invert`, `retry 3`, `timeout 2 ticks`.
impl fmt::Display for Decorator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = self.word();
        match self {
            Decorator::Invert | Decorator::Succeed | Decorator::Fail => f.write_str(word),
            Decorator::Retry(times) | Decorator::Repeat(times) => write!(f, "{word} {times}"),
            Decorator::Timeout(1) => write!(f, "{word} 1 tick"),
            Decorator::Timeout(ticks) => write!(f, "{word} {ticks} ticks"),
        }
    }
}

impl Guard {
    /// Calls `visit` for every atom, from the left.
    pub fn visit_atoms(&self, visit: &mut impl FnMut(Atom)) {
        match self {
            Guard::Const(_) => {}
            Guard::Atom(atom) => visit(*atom),
            Guard::Not(guard) => guard.visit_atoms(visit),
            Guard::And(guards) | Guard::Or(guards) => {
                guards.iter().for_each(|guard| guard.visit_atoms(visit));
            }
        }
    }
}

impl Guard {
    fn with_behaviors(self, of: &impl Fn(Id<Behavior>) -> Id<Behavior>) -> Self {
        let all = |guards: Vec<Guard>| {
            let guards = guards.into_iter();
            guards.map(|guard| guard.with_behaviors(of)).collect()
        };
        match self {
            Guard::Atom(Atom::Done(id)) => Guard::Atom(Atom::Done(of(id))),
            Guard::Atom(Atom::Failed(id)) => Guard::Atom(Atom::Failed(of(id))),
            Guard::Const(_) | Guard::Atom(Atom::Predicate(_)) => self,
            Guard::Not(guard) => Guard::Not(Box::new(guard.with_behaviors(of))),
            Guard::And(guards) => Guard::And(all(guards)),
            Guard::Or(guards) => Guard::Or(all(guards)),
        }
    }
}

impl Node {
    /// The children, from the left.
    pub fn children(&self) -> &[Node] {
        match self {
            Node::Condition(_) | Node::Behavior(_) => &[],
            Node::Composite { children, .. } | Node::Parallel { children, .. } => children,
            Node::Decorator { child, .. } => std::slice::from_ref(child),
        }
    }

    /// Whether it, or a node below it, is a memory node.
    pub fn remembers(&self) -> bool {
        let memory = matches!(self, Node::Composite { memory: true, .. });
        memory || self.children().iter().any(Node::remembers)
    }

    /// Calls `visit` for every atom of every condition, from the left.
    pub fn visit_atoms(&self, visit: &mut impl FnMut(Atom)) {
        if let Node::Condition(guard) = self {
            guard.visit_atoms(visit);
        }
        for child in self.children() {
            child.visit_atoms(visit);
        }
    }

    /// Whether it gives the same answer when it has answered and is ticked again in the same tick.
    pub fn answers_again(&self) -> bool {
        let keeps = match self {
            Node::Condition(Guard::Const(_)) | Node::Parallel { .. } => true,
            Node::Composite { memory, .. } => *memory,
            Node::Decorator { kind, .. } => matches!(
                kind,
                Decorator::Retry(_) | Decorator::Repeat(_) | Decorator::Timeout(_)
            ),
            Node::Condition(_) | Node::Behavior(_) => false,
        };
        !keeps && self.children().iter().all(Node::answers_again)
    }

    /// Puts what `of` gives in the place of every behaviour: in the leaves, and in the history that conditions ask.
    #[must_use]
    pub fn with_behaviors(self, of: &impl Fn(Id<Behavior>) -> Id<Behavior>) -> Self {
        let all = |children: Vec<Node>| {
            let children = children.into_iter();
            children.map(|child| child.with_behaviors(of)).collect()
        };
        match self {
            Node::Condition(guard) => Node::Condition(guard.with_behaviors(of)),
            Node::Behavior(id) => Node::Behavior(of(id)),
            Node::Composite {
                kind,
                memory,
                children,
            } => Node::Composite {
                kind,
                memory,
                children: all(children),
            },
            Node::Parallel {
                successes,
                children,
            } => Node::Parallel {
                successes,
                children: all(children),
            },
            Node::Decorator { kind, child } => Node::Decorator {
                kind,
                child: Box::new(child.with_behaviors(of)),
            },
        }
    }

    /// Calls `visit` for every behaviour leaf, from the left.
    pub fn visit_behaviors(&self, visit: &mut impl FnMut(Id<Behavior>)) {
        if let Node::Behavior(id) = self {
            visit(*id);
        }
        for child in self.children() {
            child.visit_behaviors(visit);
        }
    }
}
