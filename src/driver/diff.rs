//! `btc diff`: what a tree or a table decides otherwise than an older one.

mod onward;

use super::load::Loaded;
use super::refused::Refused;
use super::text::Text;
use super::verify::{assumed, within};
use super::{allowed, table as tables, target};
use crate::check::exclusions;
use crate::ir::law::Behavior;
use crate::ir::program::Predicate;
use crate::ir::task::{History, Task};
use crate::ir::tree::{Atom, Guard, Node, Tree};
use crate::ir::{Id, Program};
use crate::learn::episode::Episode;
use crate::learn::simulated::Purpose;
use crate::learn::statistics::Mean;
use crate::policy::table::Table;
use crate::policy::{Policy, Row, decisions};
use crate::report::difference::{Difference, Figures, Outcome, What};
use crate::report::verdict;
use crate::syntax::ast::ItemKind;
use crate::tree::atoms::atoms;
use crate::tree::change::changes;
use crate::tree::equivalence::{Environment, Side as Compared, Verdict};
use crate::trial::play;
use std::collections::BTreeSet;

/// One of the two that are compared.
#[derive(Clone, Copy, Debug)]
pub enum Side<'a> {
    /// A tree of a program: the one of that name, or the one that the file is about.
    Program(&'a Loaded, Option<&'a str>),
    /// A tree that stands in no file, for a task of a program.
    Tree(&'a Loaded, &'a Tree),
    /// A policy table.
    Table(Text<'a>),
}

/// A side in the program of both.
enum Read {
    Tree(Node, Option<Id<Task>>),
    /// A policy, and the table that it was read from.
    Table(Box<Policy>, Box<Table>),
}

/// Compares an old side with a new one; where both have a world in common they also play `episodes` there.
///
/// # Errors
/// There is no such tree, or a table cannot be read.
pub fn diff(old: Side, new: Side, episodes: u64, seed: u64) -> Result<Difference, Refused> {
    let base = [new, old].into_iter().find_map(|side| match side {
        Side::Program(loaded, _) | Side::Tree(loaded, _) => Some(loaded),
        Side::Table(_) => None,
    });
    let mut program = base.map_or_else(Program::default, |loaded| loaded.program.clone());
    let mut after = read(new, base, &mut program)?;
    let mut before = read(old, base, &mut program)?;
    let names = [called(old)?, called(new)?];
    if let (Read::Table(old, before), Read::Table(new, after)) = (&before, &after)
        && is_same((old, before), (new, after))
    {
        return Ok(Difference {
            names,
            outcome: Outcome::Same(What::Tables),
            by_predicates: false,
            figures: None,
            program,
        });
    }
    let several = |side: Side<'_>, read: &Read| match (side, read) {
        (Side::Table(_), Read::Table(_, table)) => table.has_sets().then(|| table.header.clone()),
        _ => None,
    };
    let headers = [several(old, &before), several(new, &after)];
    let several = [old, new]
        .into_iter()
        .zip(headers)
        .find_map(|(side, header)| match side {
            Side::Table(text) => Some((text, header?)),
            _ => None,
        });
    if let Some((text, header)) = several {
        settle(&mut before, &mut after).ok_or_else(|| {
            let message = "rows that allow several behaviours are compared with trees without memory, part by part, \
                           and with tables of the same predicates";
            allowed::refused(text, header, message)
        })?;
    }
    let history = history(&program, &before, &after);
    let (outcome, by_predicates) = outcome(&program, &before, &after, history, &names);
    let figures = match outcome {
        Outcome::Same(_) | Outcome::Equal(_) => None,
        _ => played(&program, &before, &after, episodes, seed),
    };
    Ok(Difference {
        names,
        outcome,
        by_predicates,
        figures,
        program,
    })
}

/// Whether two tables have the same rows over the same atoms, and allow the same.
fn is_same((old, before): (&Policy, &Table), (new, after): (&Policy, &Table)) -> bool {
    let mut rows = old.rows.iter().zip(&new.rows);
    let is_row = |(a, b): (&Row, &Row)| (&a.minterm, &a.free) == (&b.minterm, &b.free);
    let does = |policy: &Policy, table: &Table| {
        let allowed = allowed::sets(policy, table).into_iter();
        let sets = allowed.map(|own| own.into_iter().collect::<BTreeSet<_>>());
        sets.collect::<Vec<_>>()
    };
    old.atoms == new.atoms
        && old.rows.len() == new.rows.len()
        && rows.all(is_row)
        && does(old, before) == does(new, after)
}

/// Where a row allows several behaviours, takes the one that the other side takes there, if it is among them; `None` if that cannot
/// be told.
fn settle(before: &mut Read, after: &mut Read) -> Option<()> {
    match (before, after) {
        (Read::Tree(root, _), Read::Table(policy, table))
        | (Read::Table(policy, table), Read::Tree(root, _)) => {
            allowed::as_tree((policy, table), root)
        }
        (Read::Table(old, before), Read::Table(new, after)) => {
            allowed::as_both((old, before), (new, after))
        }
        (Read::Tree(..), Read::Tree(..)) => Some(()),
    }
}

/// The tree that a file is about: the one of that name, the only one that it declares, or the only one of all.
fn tree_of(loaded: &Loaded, name: Option<&str>) -> Result<Id<Tree>, Refused> {
    if let Some(name) = name {
        return target::tree(loaded, name);
    }
    let own = loaded.ast.items.iter().filter_map(|item| match &item.kind {
        ItemKind::Tree(tree) if tree.params.is_none() => Some(tree.name.name.as_str()),
        _ => None,
    });
    let own: Vec<&str> = own.collect();
    let learners = loaded.program.learners.values();
    let learned = learners.map(|learner| learner.name.to_string());
    let learned: Vec<String> = learned
        .filter(|name| own.contains(&name.as_str()))
        .collect();
    match (own.as_slice(), learned.as_slice()) {
        ([one], _) => target::tree(loaded, one),
        (_, [one]) => target::tree(loaded, one),
        _ => target::only_tree(loaded),
    }
}

/// What a side is called.
fn called(side: Side) -> Result<String, Refused> {
    Ok(match side {
        Side::Program(loaded, name) => {
            let tree = &loaded.program.trees[tree_of(loaded, name)?].name;
            let file = loaded
                .sources
                .get(loaded.main)
                .map_or("", |source| &source.name);
            format!("`{tree}` of {file}")
        }
        Side::Tree(_, tree) => format!("the tree `{}` that is learned now", tree.name),
        Side::Table(text) => text.name.to_owned(),
    })
}

/// A side, its names looked up in `program` or declared there.
fn read(side: Side, base: Option<&Loaded>, program: &mut Program) -> Result<Read, Refused> {
    let (loaded, tree) = match side {
        Side::Program(loaded, name) => {
            let tree = tree_of(loaded, name)?;
            (loaded, &loaded.program.trees[tree])
        }
        Side::Tree(loaded, tree) => (loaded, tree),
        Side::Table(text) => {
            let table = tables::of_truths(text)?;
            let policy = decisions::joined(&table, program);
            return Ok(Read::Table(Box::new(policy), Box::new(table)));
        }
    };
    let is_base = base.is_some_and(|base| std::ptr::eq(base, loaded));
    if is_base {
        return Ok(Read::Tree(tree.root.clone(), tree.task));
    }
    let task = tree.task.and_then(|task| {
        let name = &loaded.program.tasks[task].name;
        program.tasks.named(name)
    });
    Ok(Read::Tree(
        moved(&tree.root, &loaded.program, program),
        task,
    ))
}

/// A tree of one program in another one, which declares the names that it does not have.
fn moved(node: &Node, from: &Program, to: &mut Program) -> Node {
    match node {
        Node::Condition(guard) => Node::Condition(moved_guard(guard, from, to)),
        Node::Behavior(id) => Node::Behavior(moved_behavior(*id, from, to)),
        Node::Composite {
            kind,
            memory,
            children,
        } => Node::Composite {
            kind: *kind,
            memory: *memory,
            children: children
                .iter()
                .map(|child| moved(child, from, to))
                .collect(),
        },
        Node::Parallel {
            successes,
            children,
        } => Node::Parallel {
            successes: *successes,
            children: children
                .iter()
                .map(|child| moved(child, from, to))
                .collect(),
        },
        Node::Decorator { kind, child } => Node::Decorator {
            kind: *kind,
            child: Box::new(moved(child, from, to)),
        },
    }
}

fn moved_guard(guard: &Guard, from: &Program, to: &mut Program) -> Guard {
    let mut all = |guards: &[Guard]| -> Vec<Guard> {
        let guards = guards.iter();
        guards.map(|guard| moved_guard(guard, from, to)).collect()
    };
    match guard {
        Guard::Const(value) => Guard::Const(*value),
        Guard::Not(inner) => Guard::Not(Box::new(moved_guard(inner, from, to))),
        Guard::And(guards) => Guard::And(all(guards)),
        Guard::Or(guards) => Guard::Or(all(guards)),
        Guard::Atom(atom) => Guard::Atom(match *atom {
            Atom::Predicate(id) => {
                let name = &from.predicates[id].name;
                let known = to.predicates.named(name);
                Atom::Predicate(known.unwrap_or_else(|| {
                    to.predicates.push(Predicate {
                        name: name.clone(),
                        when: None,
                    })
                }))
            }
            Atom::Done(id) => Atom::Done(moved_behavior(id, from, to)),
            Atom::Failed(id) => Atom::Failed(moved_behavior(id, from, to)),
        }),
    }
}

fn moved_behavior(id: Id<Behavior>, from: &Program, to: &mut Program) -> Id<Behavior> {
    let name = &from.behaviors[id].name;
    let known = to.behaviors.named(name);
    known.unwrap_or_else(|| {
        to.behaviors.push(Behavior {
            name: name.clone(),
            law: None,
        })
    })
}

/// The history window of both sides, the longer one.
fn history(program: &Program, before: &Read, after: &Read) -> History {
    let of = |side: &Read| match side {
        Read::Tree(_, Some(task)) => program.tasks[*task].history,
        Read::Tree(root, None) => match program.tasks.values().next() {
            Some(task) if program.tasks.len() == 1 => task.history,
            _ => assumed(&[root]),
        },
        Read::Table(policy, _) => policy.history,
    };
    let (a, b) = (of(before), of(after));
    History {
        window: a.window.max(b.window),
        success: a.success || b.success,
        failure: a.failure || b.failure,
    }
}

/// What became of a policy, and whether that is so because of what the predicates compare.
fn outcome(
    program: &Program,
    before: &Read,
    after: &Read,
    history: History,
    names: &[String; 2],
) -> (Outcome, bool) {
    let sides = [before, after];
    let excluded = exclusions(
        program,
        &sides.iter().flat_map(|side| side.atoms()).collect(),
    );
    let mut parts = None;
    let mut by_predicates = false;
    if let [Read::Tree(old, _), Read::Tree(new, _)] = sides {
        if old == new {
            return (Outcome::Same(What::Trees), false);
        }
        let environment = Environment::Any(history);
        // Any environment knows every atom.
        if let Ok((met, verdict, onward)) = within(program, (old, new), (environment, &excluded)) {
            by_predicates = matches!(met, Environment::Possible(..));
            match &verdict {
                Verdict::Equal(explored) => {
                    let found = (explored.means_text(), &onward);
                    return onward::outcome(program, ((old, new), names), (history, met), found);
                }
                Verdict::Undecided(explored) => {
                    parts = Some(Outcome::Undecided(explored.means_text()))
                }
                Verdict::Differ(trace) => {
                    let [old, new] = names;
                    let along = "in an environment consistent with the history window";
                    let text = verdict::difference(program, (old, new), along, trace);
                    let text = text.split_once('\n').map_or("", |(_, ticks)| ticks);
                    parts = Some(Outcome::Parts(text.to_owned()));
                }
            }
        }
    }
    let told = |excluded| changes(before.decider(), after.decider(), history.window, excluded);
    let found = told(&excluded);
    if !excluded.is_empty() && found.is_ok() {
        by_predicates = told(&[]) != found;
    }
    let outcome = match (found, parts) {
        (Ok(found), None) if found.is_empty() => {
            Outcome::Equal("on every minterm that both speak of".to_owned())
        }
        (Ok(found), _) if !found.is_empty() => Outcome::Other(found),
        (_, Some(parts)) => parts,
        (Err(why), None) => Outcome::Undecided(why.to_string()),
        (Ok(found), None) => Outcome::Other(found),
    };
    (outcome, by_predicates)
}

impl Read {
    /// What it asks.
    fn atoms(&self) -> BTreeSet<Atom> {
        match self {
            Read::Tree(root, _) => atoms(root),
            Read::Table(policy, _) => policy.atoms.iter().copied().collect(),
        }
    }

    fn decider(&self) -> Compared<'_> {
        match self {
            Read::Tree(root, _) => Compared::Tree(root),
            Read::Table(policy, _) => Compared::Policy(policy),
        }
    }
}

/// What both do in the world of the new one, if both can be played there.
fn played(
    program: &Program,
    before: &Read,
    after: &Read,
    episodes: u64,
    seed: u64,
) -> Option<Figures> {
    program.world.as_ref()?;
    let of = |side: &Read| match side {
        Read::Tree(_, task) => *task,
        Read::Table(..) => None,
    };
    let only = program
        .tasks
        .ids()
        .next()
        .filter(|_| program.tasks.len() == 1);
    let task = of(after).or_else(|| of(before)).or(only)?;
    let start = Purpose::Run.start(seed, program.tasks[task].end_after);
    let play = |side: &Read| match side {
        Read::Tree(root, _) => play::tree(program, task, root, episodes, start).ok(),
        Read::Table(..) => None,
    };
    let (old, new) = (play(before)?, play(after)?);
    let totals =
        |played: &[Episode]| -> Vec<f64> { played.iter().map(|episode| episode.total).collect() };
    let (was, is) = (totals(&old), totals(&new));
    let gains: Vec<f64> = was.iter().zip(&is).map(|(was, is)| is - was).collect();
    let lost = |played: &[Episode]| played.iter().filter(|episode| episode.lost).count();
    Some(Figures {
        episodes: old.len(),
        returns: [Mean::of(&was).mean, Mean::of(&is).mean],
        gain: Mean::of(&gains),
        lost: [lost(&old), lost(&new)],
    })
}
