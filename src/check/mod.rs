//! Names, types, units and constants: the syntax tree becomes the checked program.
//!
//! Every body is checked once for itself, with its parameters known by type only; then families, behaviours and
//! subtrees are unrolled by checking their bodies again under their arguments. What goes wrong only under the
//! arguments is reported where they are given. A mistake is reported once: an expression of `Type::Error`
//! agrees with everything that is built on it.

mod argument;
mod arithmetic;
mod body;
mod builtin;
mod context;
mod decl;
mod expr;
mod names;
mod task;
mod tree;
mod types;
mod world;

use crate::diagnostic::{self, Code, Diagnostic};
use crate::ir::task::History;
use crate::ir::{Name, Program};
use crate::source::Span;
use crate::syntax::ast::{self, ItemKind, Outcome};
use context::{Context, Region};
use names::Names;
use std::collections::BTreeMap;

/// A parsed file.
#[derive(Clone, Copy, Debug)]
pub struct Input<'a> {
    /// Its syntax tree.
    pub ast: &'a ast::File,
    /// Whether it is of the embedded library.
    pub library: bool,
}

/// What came of a program.
#[derive(Debug)]
pub struct Checked {
    /// The program; of use only where no diagnostic is an error.
    pub program: Program,
    /// Every mistake and warning.
    pub diagnostics: Vec<Diagnostic>,
}

/// Checks the files of a program, those that are used before those that use them.
pub fn check(files: &[Input]) -> Checked {
    let mut diagnostics = Vec::new();
    let names = Names::collect(files, &mut diagnostics);
    let mut checker = Checker {
        names,
        program: Program::default(),
        diagnostics,
        context: Context::new(Region::World),
        clean_bodies: BTreeMap::new(),
        open_bodies: Vec::new(),
        bodies_unrolled: 0,
        gave_up: false,
        depth: 0,
        kept: None,
        asked: Vec::new(),
        bound: BTreeMap::new(),
        predicates: BTreeMap::new(),
        behaviors: BTreeMap::new(),
        states: BTreeMap::new(),
        events: BTreeMap::new(),
        tick: None,
        has_world: false,
    };
    checker.program(files);
    diagnostic::sort(&mut checker.diagnostics);
    Checked {
        program: checker.program,
        diagnostics: checker.diagnostics,
    }
}

/// A name that a body binds.
#[derive(Clone, Copy, Debug)]
struct Bound<'a> {
    name: &'a str,
    what: &'static str,
    read: bool,
}

/// What the passes share.
struct Checker<'a> {
    names: Names<'a>,
    program: Program,
    diagnostics: Vec<Diagnostic>,
    context: Context,
    /// Whether the body that starts at this place was free of mistakes when it was checked for itself.
    clean_bodies: BTreeMap<Span, bool>,
    /// The bodies that are being checked within one another, to find circles.
    open_bodies: Vec<body::Open<'a>>,
    /// How many bodies have been unrolled so far.
    bodies_unrolled: usize,
    /// Whether it was reported that definitions grow too large.
    gave_up: bool,
    /// How many expressions are being checked within one another.
    depth: usize,
    /// What the history of the task at hand keeps, while its `start` is checked.
    kept: Option<History>,
    /// Where the tree at hand asks the history window.
    asked: Vec<(Span, Outcome)>,
    /// The names that bodies of the user bind, with what they are and whether anything reads them.
    bound: BTreeMap<Span, Bound<'a>>,
    predicates: BTreeMap<Name, Option<decl::predicate::PredicateId>>,
    behaviors: BTreeMap<Name, Option<decl::behavior::BehaviorId>>,
    states: BTreeMap<&'a str, decl::dynamics::StateSlot>,
    events: BTreeMap<&'a str, decl::dynamics::EventId>,
    /// The length of a tick in seconds, once the world has said it.
    tick: Option<f64>,
    /// Whether there is a world, be it wrong.
    has_world: bool,
}

impl<'a> Checker<'a> {
    /// The passes in their order: what a pass reads, earlier ones have made.
    fn program(&mut self, files: &[Input<'a>]) {
        let items = |library: bool| {
            files
                .iter()
                .filter(move |input| input.library == library)
                .flat_map(|input| &input.ast.items)
        };
        self.worlds(items(false));
        for item in items(false) {
            match &item.kind {
                ItemKind::State(state) => self.state(state),
                ItemKind::Enum(decl) => self.enumeration(decl),
                _ => {}
            }
        }
        for item in items(false) {
            match &item.kind {
                ItemKind::Let(shared) => self.shared(shared),
                ItemKind::Behavior(behavior) => self.behavior(behavior),
                _ => {}
            }
        }
        for item in items(false) {
            match &item.kind {
                ItemKind::World(world) => self.conditions_of_walls(world),
                ItemKind::Predicate(predicate) => self.predicate(predicate),
                ItemKind::Event(event) => self.event(event),
                _ => {}
            }
        }
        for item in items(false) {
            match &item.kind {
                ItemKind::EachTick(block) => self.each_tick(block),
                ItemKind::On(on) => self.on(on),
                _ => {}
            }
        }
        for item in items(false) {
            if let ItemKind::Task(task) = &item.kind {
                self.task(task);
            }
        }
        for item in items(false) {
            if let ItemKind::Learn(learn) = &item.kind {
                self.learn(learn);
            }
        }
        for item in items(false) {
            if let ItemKind::Tree(tree) = &item.kind {
                self.tree(tree, &item.docs);
            }
        }
        for item in items(false) {
            if let ItemKind::Claim(claim) = &item.kind {
                self.claim(claim);
            }
        }
        self.unread_names();
    }

    /// Warns of names that are bound and never read; a program with errors has other troubles.
    fn unread_names(&mut self) {
        if self.diagnostics.iter().any(Diagnostic::is_error) {
            return;
        }
        let unread: Vec<Diagnostic> = self
            .bound
            .iter()
            .filter(|(_, bound)| !bound.read && !bound.name.starts_with('_'))
            .map(|(&span, bound)| {
                let Bound { name, what, .. } = bound;
                Diagnostic::new(
                    Code::W0201,
                    span,
                    format!("nothing reads the {what} `{name}`"),
                )
                .label("bound here, and never read")
                .help(format!(
                    "take it away, or call it `_{name}` if it is to stay"
                ))
            })
            .collect();
        self.diagnostics.extend(unread);
    }

    fn report(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }

    /// Reports what the language has and btc has not built: `what` names it in the plural.
    fn not_yet(&mut self, span: Span, what: &str) {
        self.report(
            Diagnostic::new(Code::E0701, span, format!("{what} are not built yet"))
                .label("the language has this, this version of btc cannot run it"),
        );
    }

    /// Notes a name that a body of the user binds.
    fn binds(&mut self, name: &'a ast::Ident, what: &'static str) {
        if !self.context.library {
            self.bound.entry(name.span).or_insert(Bound {
                name: &name.name,
                what,
                read: false,
            });
        }
    }

    /// Notes a name that is bound beside those from `depth` of the scope on; none of them may have it already.
    fn binds_anew(&mut self, name: &'a ast::Ident, what: &'static str, depth: usize) {
        self.binds(name, what);
        let beside = self.context.scope.iter().skip(depth);
        if let Some(first) = beside.into_iter().find(|bound| bound.name == name.name) {
            let first = first.span;
            self.report(
                Diagnostic::new(
                    Code::E0201,
                    name.span,
                    format!("`{}` is declared twice", name.name),
                )
                .label("declared again here")
                .also(first, "first declared here"),
            );
        }
    }

    /// Notes that a binding is read.
    fn reads(&mut self, binding: Span) {
        if let Some(bound) = self.bound.get_mut(&binding) {
            bound.read = true;
        }
    }

    /// Runs a pass and takes back what it reported.
    fn captured<T>(&mut self, pass: impl FnOnce(&mut Self) -> T) -> (T, Vec<Diagnostic>) {
        let before = std::mem::take(&mut self.diagnostics);
        let result = pass(self);
        (result, std::mem::replace(&mut self.diagnostics, before))
    }
}
