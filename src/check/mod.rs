//! Names, types, units and constants: the syntax tree becomes the checked program.
//!
//! Every body is checked once for itself, with its parameters known by type only; then families, behaviours and
//! subtrees are unrolled by checking their bodies again under their arguments. What goes wrong only under the
//! arguments is reported where they are given. A mistake is reported once: an expression of [`types::Type::Error`]
//! agrees with everything that is built on it.

mod behavior;
mod block;
mod builtin;
mod call;
mod claim;
mod context;
mod dynamics;
mod expr;
mod learn;
mod names;
mod predicate;
mod reading;
mod shape;
mod task;
mod tree;
mod type_expr;
mod types;
mod units;
mod world;

use crate::diagnostic::{self, Code, Diagnostic};
use crate::ir::Program;
use crate::source::Span;
use crate::syntax::ast::{self, ItemKind};
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

/// What the passes share.
struct Checker<'a> {
    names: Names<'a>,
    program: Program,
    diagnostics: Vec<Diagnostic>,
    context: Context,
    /// Whether the body that starts at this place was free of mistakes when it was checked for itself.
    clean_bodies: BTreeMap<Span, bool>,
    /// The bodies that are being unrolled, to find circles.
    open_bodies: Vec<Span>,
    predicates: BTreeMap<String, Option<predicate::PredicateId>>,
    behaviors: BTreeMap<String, Option<behavior::BehaviorId>>,
    states: BTreeMap<&'a str, dynamics::StateSlot>,
    events: BTreeMap<&'a str, dynamics::EventId>,
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
    }

    fn report(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }

    /// Reports what the language has and btc has not built.
    fn not_yet(&mut self, span: Span, what: &str) {
        self.report(
            Diagnostic::new(Code::E0701, span, format!("{what} are not built yet"))
                .label("the language has this, this version of btc cannot run it"),
        );
    }

    /// Runs a pass and takes back what it reported.
    fn captured<T>(&mut self, pass: impl FnOnce(&mut Self) -> T) -> (T, Vec<Diagnostic>) {
        let before = std::mem::take(&mut self.diagnostics);
        let result = pass(self);
        (result, std::mem::replace(&mut self.diagnostics, before))
    }
}
