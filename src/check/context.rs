//! The context of an expression: what is in scope and what is allowed.

use super::Checker;
use super::meaning::Entity;
use super::names::Decl;
use super::types::{Type, Value};
use crate::diagnostic::Code;
use crate::ir::Id;
use crate::ir::expr::Local;
use crate::ir::name::Given;
use crate::source::Span;
use crate::syntax::ast::Ident;
use std::collections::BTreeSet;

/// The part of a program that an expression stands in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Region {
    /// The world and the initial values of states: constants.
    World,
    /// A shared expression.
    Let,
    /// A predicate.
    Predicate,
    /// An event.
    Event,
    /// An effect of every tick.
    EachTick,
    /// An effect of an event.
    Effect,
    /// A reward.
    Reward,
    /// `requires`, `succeed when`, `fail when`.
    Clause,
    /// The initial value of a local.
    Local,
    /// A control law.
    Control,
    /// A line of `start`.
    Start,
    /// The `history` line of a `start`.
    StartHistory,
    /// A schedule of a learner.
    Schedule,
    /// A guard or an argument in a tree.
    Tree,
}

impl Region {
    /// Whether random draws are allowed.
    pub fn draws(self) -> bool {
        matches!(
            self,
            Region::EachTick
                | Region::Effect
                | Region::Local
                | Region::Control
                | Region::Start
                | Region::StartHistory
        )
    }

    /// Whether the text belongs to a behaviour.
    pub fn in_behavior(self) -> bool {
        matches!(self, Region::Clause | Region::Local | Region::Control)
    }

    /// Whether the robot that learns is the only one that reads what stands here.
    pub fn of_the_learner(self) -> bool {
        matches!(
            self,
            Region::Event | Region::Effect | Region::EachTick | Region::Reward
        )
    }

    /// Whether it is known which events happen in this tick.
    pub fn sees_events(self) -> bool {
        matches!(self, Region::Event | Region::Effect | Region::Reward)
    }

    /// Its name, with its article.
    pub fn name(self) -> &'static str {
        match self {
            Region::World => "a constant",
            Region::Let => "a shared expression",
            Region::Predicate => "a predicate",
            Region::Event => "an event",
            Region::EachTick => "an effect of every tick",
            Region::Effect => "an effect",
            Region::Reward => "a reward",
            Region::Clause => "a behaviour's region",
            Region::Local => "a local",
            Region::Control => "a control law",
            Region::Start | Region::StartHistory => "a start line",
            Region::Schedule => "a schedule",
            Region::Tree => "a tree",
        }
    }
}

/// A name that is bound in a body.
#[derive(Clone, Debug)]
pub struct Binding<'a> {
    /// The name, where it is bound.
    pub name: &'a Ident,
    /// Its type.
    pub ty: Type,
    /// Its value.
    pub value: Value,
    /// The variables behind a local, which can be set: two for a point, none where they are not known.
    pub locals: Option<Vec<Id<Local>>>,
    /// What a reference gave for it, as names have it.
    pub given: Option<Given>,
}

impl<'a> Binding<'a> {
    /// A name whose value cannot be set.
    pub fn new(name: &'a Ident, ty: Type, value: Value) -> Self {
        Self {
            name,
            ty,
            value,
            locals: None,
            given: None,
        }
    }

    /// A name that is known by its type only.
    pub fn unknown(name: &'a Ident, ty: Type) -> Self {
        Self::new(name, ty, Value::Unknown)
    }
}

/// Where an expression stands.
#[derive(Clone, Debug)]
pub struct Context<'a> {
    /// The part of the program.
    pub region: Region,
    /// Whether the text belongs to the library.
    pub library: bool,
    /// The names bound so far, the innermost last.
    pub scope: Vec<Binding<'a>>,
    /// The names of blocks that have ended.
    pub ended: BTreeSet<&'a str>,
    /// What is called, where the expression is its only argument, and where that stands.
    pub argument: Option<(Span, String)>,
    /// Whether the expression is, or is used by, what a behaviour or a predicate is given.
    pub is_given: bool,
}

impl<'a> Context<'a> {
    /// A context in the user's text, with nothing bound.
    pub fn new(region: Region) -> Self {
        Self {
            region,
            library: false,
            scope: Vec::new(),
            ended: BTreeSet::new(),
            argument: None,
            is_given: false,
        }
    }

    /// The innermost binding of a name.
    pub fn lookup(&self, name: &str) -> Option<&Binding<'a>> {
        let mut inner = self.scope.iter().rev();
        inner.find(|binding| binding.name.name == name)
    }
}

/// Whether anything reads a name that a body binds.
#[derive(Clone, Copy, Debug)]
pub struct Bound<'a> {
    name: &'a str,
    what: &'static str,
    read: bool,
    needed: bool,
}

impl<'a> Checker<'a> {
    /// Notes a name that a body of the user binds, with what it is.
    pub fn binds(&mut self, name: &'a Ident, what: &'static str) {
        if !self.context.library {
            let entity = match what {
                "parameter" => Entity::Parameter,
                _ => Entity::Local,
            };
            self.meanings.declare(name, entity);
            if !self.bound.contains_key(&name.span) {
                self.hides_what_is_declared(name, what);
            }
            self.bound.entry(name.span).or_insert(Bound {
                name: &name.name,
                what,
                read: false,
                needed: false,
            });
        }
    }

    /// Binds a name in a block whose own names start at `depth` of the scope; none of them may have it already.
    pub fn bind(&mut self, binding: Binding<'a>, what: &'static str, depth: usize) {
        let name = binding.name;
        self.binds(name, what);
        self.is_of_type(name, &binding.ty);
        if what == "value" && !self.context.library {
            self.hides_what_is_set(name);
        }
        let mut beside = self.context.scope.iter().skip(depth);
        if let Some(first) = beside.find(|bound| bound.name.name == name.name) {
            let first = first.name.span;
            self.error(
                Code::E0201,
                name.span,
                format!("`{}` is declared twice", name.name),
            )
            .label("declared again here")
            .also(first, "first declared here");
        }
        self.context.scope.push(binding);
    }

    /// Warns of a `let` that hides a state or a local: mostly an assignment was meant.
    fn hides_what_is_set(&mut self, name: &'a Ident) {
        let called = &name.name;
        let outer = self.context.lookup(called);
        let local = outer.filter(|outer| outer.locals.is_some());
        let what = if let Some(local) = local.map(|local| local.name.span) {
            self.reads(local);
            "local"
        } else if matches!(self.names.value(called, false), Some((Decl::State(_), _))) {
            self.hidden.insert(called);
            "state"
        } else {
            return;
        };
        self.warning(
            Code::W0204,
            name.span,
            format!("this `let` hides the {what} `{called}`"),
        )
        .label("from here on the name means this value")
        .help(format!(
            "to set the {what}, write `{called} = …` without `let`"
        ));
        // Whether it is read, and whether what it hides is ever set, depends on what is meant.
        self.reads(name.span);
    }

    /// Warns of a parameter, a local or a member with the name of something in the world or of a state.
    fn hides_what_is_declared(&mut self, name: &'a Ident, what: &str) {
        let called = &name.name;
        let Some((decl, false)) = self.names.value(called, false) else {
            return;
        };
        let stands = matches!(
            decl,
            Decl::State(_) | Decl::Place(..) | Decl::Wall(..) | Decl::Robot(_) | Decl::Sensor(_)
        );
        let beside = decl.ident().span.file == name.span.file;
        if !stands || !beside || what == "value" {
            return;
        }
        let hidden = match decl {
            Decl::State(_) => "state",
            _ => decl.what().trim_start_matches("a "),
        };
        self.warning(
            Code::W0204,
            name.span,
            format!("this {what} hides the {hidden} `{called}`"),
        )
        .label(format!("where it is bound, the name means this {what}"))
        .help("call one of the two something else");
    }

    /// Notes that a binding is read.
    pub fn reads(&mut self, binding: Span) {
        if let Some(bound) = self.bound.get_mut(&binding) {
            bound.read = true;
        }
    }

    /// Whether nothing has read the name of a binding yet.
    pub fn is_unread(&self, name: &Ident) -> bool {
        self.bound.get(&name.span).is_some_and(|bound| !bound.read)
    }

    /// Notes that a binding has to stand where it stands, read or not.
    pub fn needs(&mut self, binding: Span) {
        if let Some(bound) = self.bound.get_mut(&binding) {
            bound.needed = true;
        }
    }

    /// Warns of names that are bound and never read.
    pub fn unread_names(&mut self) {
        for (span, bound) in std::mem::take(&mut self.bound) {
            let Bound { name, what, .. } = bound;
            if bound.read || name.starts_with('_') {
                continue;
            }
            self.unread.insert(span);
            self.warning(
                Code::W0201,
                span,
                format!("nothing reads the {what} `{name}`"),
            )
            .label("bound here, and never read")
            .help(match (what, bound.needed) {
                ("member", _) => {
                    format!("ask or do something of `{name}`, or call it `_{name}`")
                }
                (_, true) => format!("call it `_{name}` if nothing is to be done with it"),
                (_, false) => format!("take it away, or call it `_{name}` if it is to stay"),
            });
        }
    }
}
