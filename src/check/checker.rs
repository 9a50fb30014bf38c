//! The state that all passes share, and the order of the passes.

use super::body::Bodies;
use super::clash::Clash;
use super::context::{Bound, Context, Region};
use super::decl::behavior::BehaviorId;
use super::decl::event::EventId;
use super::decl::input::InputSlot;
use super::decl::predicate::PredicateId;
use super::decl::state::StateSlot;
use super::expr::InPercent;
use super::lint::{
    Again, Asked, Assigned, Assignments, Bounded, Causes, Condition, Equality, FailClause, Joints,
    Links, Quantity,
};
use super::meaning::Meanings;
use super::members::{Kinds, Member};
use super::merge;
use super::names::Names;
use super::task::history::Unkept;
use super::tune::Tunes;
use super::twice;
use super::types::Type;
use super::{Checked, Input};
use crate::diagnostic::{self, Diagnostic};
use crate::geometry::Point;
use crate::ir::expr::{ExprId, Local, Temp};
use crate::ir::law::Behavior;
use crate::ir::table::Table;
use crate::ir::task::History;
use crate::ir::world::{Robot, World};
use crate::ir::{Id, Name, Program};
use crate::source::Span;
use crate::syntax::ast::{self, Expr, Ident, ItemKind, Outcome};
use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet};

/// The state that all passes share.
pub struct Checker<'a> {
    /// Every declared name.
    pub names: Names<'a>,
    /// What the names of the text stand for.
    pub meanings: Meanings,
    /// The program, as far as it is checked.
    pub program: Program,
    /// What has been reported.
    pub diagnostics: Vec<Diagnostic>,
    /// Where the expression at hand stands.
    pub context: Context<'a>,
    /// The bodies that have been checked or are being checked.
    pub bodies: Bodies<'a>,
    /// The uses of states, parameters and constants that do not agree with their types.
    pub clashes: Vec<Clash<'a>>,
    /// Where the types of parameters are written, by the places of their names.
    pub parameter_types: BTreeMap<Span, Span>,
    /// The parameters whose type and default do not agree.
    pub unsure: Vec<Span>,
    /// How many expressions are being checked within one another.
    pub depth: usize,
    /// What the history of the task at hand keeps, while its `start` is checked, with the task's name.
    pub kept: Option<(Name, History)>,
    /// What is needed of the histories of tasks, by their names, that do not keep it.
    pub unkept: BTreeMap<String, (History, Vec<Unkept>)>,
    /// Where the tree at hand asks the history window.
    pub asked: Vec<(Span, Outcome)>,
    /// Where the program asks whether a behaviour has ended.
    pub endings: BTreeSet<Asked>,
    /// The conditions of events, effects, doors, prices and branches.
    pub conditions: Vec<Condition>,
    /// The values that states never have and of which a warning has been told.
    pub causes: Causes,
    /// The families of predicates that always or never hold.
    pub constant: BTreeSet<String>,
    /// The conditions of each `else if`.
    pub links: Links,
    /// What each `and` and `or` joins.
    pub joints: Joints,
    /// Where a program calls behaviours of the library.
    pub library_calls: BTreeMap<Span, Id<Behavior>>,
    /// Each `fail when`, by where it stands, as the behaviours have it.
    pub fails: BTreeMap<Span, Vec<FailClause>>,
    /// What stands a second time where once is enough.
    pub again: BTreeMap<Span, Again>,
    /// What the statements of the effect at hand set.
    pub assignments: Assignments,
    /// What effects set, whatever else holds where they are done.
    pub assigned: Vec<Assigned>,
    /// The values, bounded from one side, that statements set states to.
    pub bounded: Bounded,
    /// Where statements change something by nothing.
    pub idle: BTreeSet<Span>,
    /// The times that behaviours are given and the speeds in control laws, as they are written.
    pub quantities: BTreeMap<Span, Quantity>,
    /// The names that statements bind, with their values.
    pub lets: Vec<(Id<Temp>, ExprId)>,
    /// Where a state is to be exactly so much.
    pub equalities: Vec<Equality<'a>>,
    /// The states that a value of a block hides.
    pub hidden: BTreeSet<&'a str>,
    /// Where robots start, as far as that is constant.
    pub positions: Vec<(Span, Id<Robot>, Point)>,
    /// The parameter that the expression at hand is given to, with what it is a parameter of.
    pub given: Option<(&'a str, &'a str)>,
    /// The arguments that an alias holds from its start, for the behaviour that it stands for.
    pub held: Table<Local>,
    /// The type of which the name at hand is to be a value.
    pub wanted: Option<Type>,
    /// The numbers that may be tuned.
    pub tunes: Tunes,
    /// The names that bodies of the user bind, by where they are bound.
    pub bound: BTreeMap<Span, Bound<'a>>,
    /// Where names are bound of which it was told that nothing reads them.
    pub unread: BTreeSet<Span>,
    /// The predicates, by name with arguments, of another robot with its name; `None` for one with a mistake.
    pub predicates: BTreeMap<Name, Option<PredicateId>>,
    /// The behaviours, by name with arguments; `None` for one with a mistake.
    pub behaviors: BTreeMap<Name, Option<BehaviorId>>,
    /// The inputs, by name, each with its type; a category has none of its own.
    pub inputs: BTreeMap<&'a str, InputSlot>,
    /// The states, by name.
    pub states: BTreeMap<&'a str, StateSlot>,
    /// The events that have been checked, by name: a single event is a family of one.
    pub events: BTreeMap<&'a str, Vec<Member<EventId>>>,
    /// The places and walls with their kinds.
    pub kinds: Kinds,
    /// The robot that the expression at hand is read by.
    pub subject: Id<Robot>,
    /// The robots that run a tree of their own, in order: their names, and what they run.
    pub scripts: Vec<(&'a Ident, &'a Expr)>,
    /// The constants without a unit that have been used as ratios.
    pub plain_ratios: BTreeMap<Span, &'a Expr>,
    /// The states that start as whole numbers, by where that is said, with the percentages beside them.
    pub percents: BTreeMap<Span, InPercent<'a>>,
    /// The trees that claims and tests ask for and that are not whole, with where they are asked for.
    pub needed: Vec<(&'a ast::Tree, Span)>,
    /// The length of a tick in seconds, once the world has said it.
    pub tick: Option<f64>,
    /// Whether there is a world, right or wrong.
    pub has_world: bool,
    /// Whether the drive of some robot was not understood.
    pub drive_unsure: bool,
    /// Whether an entry of the world was not understood, which may be one more member of a kind.
    pub entries_lost: bool,
    /// Whether a kind was likely meant to be another one: what ranges over that one lacks a member, and what never happens or
    /// never matters follows from that.
    pub kind_misspelt: bool,
    /// Whether the file pins the record of a tree that was learned.
    pub recorded: bool,
    /// Whether nobody knows which robot learns, or what another one runs.
    pub robots_unsure: bool,
    /// Whether it was reported that the library is not used.
    pub library_missed: bool,
    /// How many names may still be looked at for one that was likely meant.
    pub guesses: Cell<usize>,
}

/// How many names are looked at for one that was likely meant, in all.
const GUESSES: usize = 50_000;

impl<'a> Checker<'a> {
    /// Collects the names of the files; nothing is checked yet.
    pub fn new(files: &[Input<'a>]) -> Self {
        let mut diagnostics = Vec::new();
        let mut meanings = Meanings::default();
        Self {
            names: Names::collect(files, &mut meanings, &mut diagnostics),
            meanings,
            program: Program::default(),
            diagnostics,
            context: Context::new(Region::World),
            bodies: Bodies::default(),
            clashes: Vec::new(),
            parameter_types: BTreeMap::new(),
            unsure: Vec::new(),
            depth: 0,
            kept: None,
            unkept: BTreeMap::new(),
            asked: Vec::new(),
            endings: BTreeSet::new(),
            conditions: Vec::new(),
            causes: Causes::new(),
            links: Links::new(),
            joints: Joints::new(),
            constant: BTreeSet::new(),
            plain_ratios: BTreeMap::new(),
            percents: BTreeMap::new(),
            needed: Vec::new(),
            library_calls: BTreeMap::new(),
            fails: BTreeMap::new(),
            again: BTreeMap::new(),
            assignments: Assignments::new(),
            bounded: Bounded::new(),
            assigned: Vec::new(),
            idle: BTreeSet::new(),
            quantities: BTreeMap::new(),
            lets: Vec::new(),
            equalities: Vec::new(),
            hidden: BTreeSet::new(),
            positions: Vec::new(),
            given: None,
            held: Table::default(),
            wanted: None,
            tunes: Tunes::default(),
            bound: BTreeMap::new(),
            unread: BTreeSet::new(),
            predicates: BTreeMap::new(),
            behaviors: BTreeMap::new(),
            inputs: BTreeMap::new(),
            states: BTreeMap::new(),
            events: BTreeMap::new(),
            kinds: Kinds::default(),
            subject: World::acting(),
            scripts: Vec::new(),
            tick: None,
            has_world: false,
            drive_unsure: false,
            entries_lost: false,
            kind_misspelt: false,
            recorded: false,
            robots_unsure: false,
            library_missed: false,
            guesses: Cell::new(GUESSES),
        }
    }

    /// The passes in their order: each reads only what earlier ones have made.
    pub fn program(&mut self, files: &[Input<'a>]) {
        let own = files.iter().filter(|input| !input.library);
        let items = || own.clone().flat_map(|input| &input.ast.items);
        for item in items() {
            if let ItemKind::Enum(decl) = &item.kind {
                self.enumeration(decl);
            }
        }
        self.worlds(items());
        for item in items() {
            match &item.kind {
                ItemKind::Input(input) if self.names.counts(&input.name) => self.input(input),
                ItemKind::State(state) if self.names.counts(&state.name) => self.state(state),
                _ => {}
            }
        }
        for item in items() {
            match &item.kind {
                ItemKind::Let(shared) if self.names.counts(&shared.name) => self.shared(shared),
                ItemKind::Behavior(behavior) if self.names.counts(&behavior.name) => {
                    self.behavior(behavior);
                }
                _ => {}
            }
        }
        for item in items() {
            match &item.kind {
                ItemKind::World(world) => self.conditions_of_walls(world),
                ItemKind::Predicate(predicate) if self.names.counts(&predicate.name) => {
                    self.predicate(predicate);
                }
                ItemKind::Event(event) if self.names.counts(&event.name) => self.event(event),
                _ => {}
            }
        }
        for item in items() {
            match &item.kind {
                ItemKind::EachTick(block) => self.each_tick(block),
                ItemKind::On(on) => self.on(on),
                _ => {}
            }
        }
        for item in items() {
            if let ItemKind::Task(task) = &item.kind
                && self.names.tasks.get(task.name.name.as_str()) == Some(&task)
            {
                self.task(task);
            }
        }
        for item in items() {
            if let ItemKind::Learn(learn) = &item.kind {
                self.learn(learn);
            }
        }
        for item in items() {
            if let ItemKind::Tree(tree) = &item.kind {
                self.tree(tree, &item.docs);
            }
        }
        self.scripts();
        for item in items() {
            if let ItemKind::Claim(claim) = &item.kind {
                self.claim(claim);
            }
        }
        let lost = self.a_script_is_lost();
        for item in items() {
            if let ItemKind::Test(test) = &item.kind {
                self.test(test, lost);
            }
        }
        self.histories_that_keep_too_little();
        self.timeouts_without_a_world();
        self.named_ratios();
        self.percents_of_numbers();
        self.tunables(items());
        self.whole_program(files);
    }

    /// The program with every mistake and warning, in the order of the text.
    pub fn checked(mut self) -> Checked {
        self.settle_clashes();
        diagnostic::sort(&mut self.diagnostics);
        merge::merge(&mut self.diagnostics, |name| {
            self.meanings.declaration(name)
        });
        twice::misnamed(&mut self.diagnostics);
        let names = &self.names;
        twice::shown_by_bodies(&mut self.diagnostics, |name| {
            names.value(name, false)?.0.body()
        });
        Checked {
            program: self.program,
            tunes: self.tunes.sites(),
            meanings: self.meanings,
            diagnostics: self.diagnostics,
        }
    }
}
