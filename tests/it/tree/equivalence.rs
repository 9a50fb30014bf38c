//! Equivalence of trees, beside plain enumeration with the naive interpreter.

use super::build::{leaf, memory_sequence, p, selector, when};
use super::grown::Soil;
use super::random::Random;
use crate::naive::{Memory, tick};
use btc::ir::Id;
use btc::ir::law::Behavior;
use btc::ir::task::History;
use btc::ir::tree::{Atom, Guard, Node, Status};
use btc::policy::{Minterm, Policy, Row};
use btc::tree::atoms::{atoms, behaviors};
use btc::tree::equivalence::{Environment, Means, Side, Trace, Verdict, compare};
use std::collections::{BTreeMap, BTreeSet};

fn any(left: &Node, right: &Node, history: History) -> Verdict {
    let environment = Environment::Any(history);
    compare(Side::Tree(left), Side::Tree(right), environment).unwrap()
}

fn history(random: &mut Random) -> History {
    History {
        window: random.below(3),
        success: random.chance(80),
        failure: random.chance(60),
    }
}

fn asked(left: &Node, right: &Node) -> Vec<Atom> {
    atoms(left).union(&atoms(right)).copied().collect()
}

/// What the window remembers.
fn kept(history: History, status: Status) -> bool {
    match status {
        Status::Success => history.success,
        Status::Failure => history.failure,
        Status::Running => false,
    }
}

/// The last terminations, full from the start; what nobody asks for is a termination of behaviour 99.
type Window = Vec<(usize, Status)>;

const NOBODY: (usize, Status) = (99, Status::Success);

fn windows(atoms: &[Atom], history: History) -> Vec<Window> {
    let kinds: Vec<(usize, Status)> = atoms
        .iter()
        .filter_map(|atom| match atom {
            Atom::Done(b) => Some((b.index(), Status::Success)),
            Atom::Failed(b) => Some((b.index(), Status::Failure)),
            Atom::Predicate(_) => None,
        })
        .filter(|(_, status)| kept(history, *status))
        .chain([NOBODY])
        .collect();
    let mut all = vec![Window::new()];
    for _ in 0..history.window {
        let longer = |window: &Window| -> Vec<Window> {
            let one = |kind: &(usize, Status)| [window.clone(), vec![*kind]].concat();
            kinds.iter().map(one).collect()
        };
        all = all.iter().flat_map(longer).collect();
    }
    all
}

/// The valuations that a window allows.
fn valuations(atoms: &[Atom], window: &Window) -> Vec<Minterm> {
    let predicates = atoms
        .iter()
        .filter(|a| matches!(a, Atom::Predicate(_)))
        .count();
    let of = |bits: usize| {
        let mut bit = predicates;
        Minterm::new(atoms.iter().map(|atom| match atom {
            Atom::Predicate(_) => {
                bit -= 1;
                bits >> bit & 1 == 1
            }
            Atom::Done(b) => window.contains(&(b.index(), Status::Success)),
            Atom::Failed(b) => window.contains(&(b.index(), Status::Failure)),
        }))
    };
    (0..1 << predicates).map(of).collect()
}

/// Every assignment of a status to each of the behaviours.
fn assignments(behaviors: &BTreeSet<Id<Behavior>>) -> Vec<BTreeMap<Id<Behavior>, Status>> {
    let mut all = vec![BTreeMap::new()];
    for behavior in behaviors {
        let with = |statuses: &BTreeMap<Id<Behavior>, Status>| {
            [Status::Running, Status::Success, Status::Failure].map(|status| {
                let mut statuses = statuses.clone();
                statuses.insert(*behavior, status);
                statuses
            })
        };
        all = all.iter().flat_map(with).collect();
    }
    all
}

/// Both memories and a window, with one tick from there.
struct Lockstep<'a> {
    sides: [&'a Node; 2],
    atoms: Vec<Atom>,
    history: History,
    statuses: Vec<BTreeMap<Id<Behavior>, Status>>,
}

type State = (Memory, Memory, Window);

/// What each side selects, how the left one's selection ends, and what comes then.
type Ticked = ([Option<Id<Behavior>>; 2], Status, State);

impl<'a> Lockstep<'a> {
    fn new(left: &'a Node, right: &'a Node, history: History) -> Self {
        let all = behaviors(left).union(&behaviors(right)).copied().collect();
        Self {
            sides: [left, right],
            atoms: asked(left, right),
            history,
            statuses: assignments(&all),
        }
    }

    fn starts(&self) -> BTreeSet<State> {
        let windows = windows(&self.atoms, self.history).into_iter();
        windows.map(|w| (Memory::new(), Memory::new(), w)).collect()
    }

    /// What both select, and where that leads by each assignment of statuses.
    fn ticks(&self, state: &State, minterm: &Minterm) -> Vec<Ticked> {
        let holds = super::walk::holds(&self.atoms, minterm);
        let (left, right, window) = state;
        let one = |statuses: &BTreeMap<Id<Behavior>, Status>| {
            let [l, r] = [(self.sides[0], left), (self.sides[1], right)]
                .map(|(root, memory)| tick(root, memory, &holds, &mut |b| statuses[&b]));
            let selected = [&l, &r].map(|t| t.ticked.first().copied());
            let status = selected[0].map_or(Status::Running, |b| statuses[&b]);
            let mut window = window.clone();
            if let Some(b) = selected[0]
                && kept(self.history, status)
                && self.history.window > 0
            {
                window.remove(0);
                let asked = match status {
                    Status::Success => Atom::Done(b),
                    _ => Atom::Failed(b),
                };
                let known = self.atoms.contains(&asked);
                window.push(if known { (b.index(), status) } else { NOBODY });
            }
            (selected, status, (l.memory, r.memory, window))
        };
        self.statuses.iter().map(one).collect()
    }

    /// How many ticks the sides agree for on the shortest way apart, with the least valuation in which they part at
    /// once; `None` if they never do. Gives up beyond `most` states.
    fn parts(&self, most: usize) -> Option<Option<(usize, Option<Minterm>)>> {
        let mut known = self.starts();
        let mut layer: Vec<State> = known.iter().cloned().collect();
        let mut depth = 0;
        while !layer.is_empty() {
            let mut next = vec![];
            let mut least: Option<Minterm> = None;
            for state in &layer {
                for minterm in valuations(&self.atoms, &state.2) {
                    for (selected, _, to) in self.ticks(state, &minterm) {
                        if selected[0] != selected[1] {
                            least = Some(least.map_or(minterm.clone(), |m| m.min(minterm.clone())));
                        } else if known.insert(to.clone()) {
                            next.push(to);
                        }
                    }
                }
            }
            if least.is_some() {
                return Some(Some((depth, least.filter(|_| depth == 0))));
            }
            if known.len() > most {
                return None;
            }
            layer = next;
            depth += 1;
        }
        Some(None)
    }

    /// Replays a trace: each step is one that both can take, and in the last tick they part as it says.
    fn replay(&self, trace: &Trace) {
        assert_eq!(trace.atoms, self.atoms);
        let mut states = self.starts();
        for step in &trace.steps {
            states = states
                .iter()
                .filter(|state| valuations(&self.atoms, &state.2).contains(&step.valuation))
                .flat_map(|state| self.ticks(state, &step.valuation))
                .filter(|(selected, status, _)| {
                    *selected == [step.behavior; 2] && *status == step.status
                })
                .map(|(.., to)| to)
                .collect();
        }
        let last = states
            .iter()
            .filter(|state| valuations(&self.atoms, &state.2).contains(&trace.valuation))
            .flat_map(|state| self.ticks(state, &trace.valuation))
            .any(|(selected, ..)| selected == [trace.left, trace.right]);
        assert!(last && trace.left != trace.right, "{trace:?}");
    }
}

#[test]
fn without_memory_the_least_valuation_is_found_that_enumeration_finds() {
    let (mut equal, mut different) = (0, 0);
    for seed in 1..=400 {
        let random = &mut Random::new(seed);
        let soil = Soil {
            predicates: 1 + random.below(5),
            behaviors: 3,
            history: random.chance(60),
            memory: false,
            wild: true,
        };
        let left = soil.tree(random, 3);
        let right = match random.chance(50) {
            true => soil.tree(random, 3),
            false => selector(vec![left.clone(), leaf(0)]),
        };
        let history = history(random);
        let both = Lockstep::new(&left, &right, history);
        let expected = both.parts(usize::MAX).unwrap();
        match (any(&left, &right, history), expected) {
            (Verdict::Equal(explored), None) => {
                assert!(matches!(explored.means, Means::Table { .. }));
                equal += 1;
            }
            (Verdict::Differ(trace), Some((0, least))) => {
                assert_eq!(Some(&trace.valuation), least.as_ref(), "seed {seed}");
                both.replay(&trace);
                different += 1;
            }
            found => panic!("seed {seed}: {found:?}\n{left:?}\n{right:?}"),
        }
    }
    assert!(equal > 50 && different > 150, "{equal} {different}");
}

#[test]
fn with_memory_the_shortest_trace_is_found_that_enumeration_finds() {
    let (mut equal, mut different, mut longest) = (0, 0, 0);
    for seed in 1..=250 {
        let random = &mut Random::new(seed);
        let soil = Soil {
            predicates: 1 + random.below(2),
            behaviors: 2 + random.below(2),
            history: random.chance(40),
            memory: true,
            wild: true,
        };
        let left = soil.tree(random, 3);
        let right = match random.below(3) {
            0 => soil.tree(random, 3),
            1 => left.clone(),
            _ => forgetful(&left, &mut random.below(4)),
        };
        let history = history(random);
        let both = Lockstep::new(&left, &right, history);
        let Some(expected) = both.parts(400) else {
            continue;
        };
        match (any(&left, &right, history), expected) {
            (Verdict::Equal(_), None) => equal += 1,
            (Verdict::Differ(trace), Some((depth, _))) => {
                assert_eq!(trace.steps.len(), depth, "seed {seed}\n{left:?}\n{right:?}");
                both.replay(&trace);
                different += 1;
                longest = longest.max(depth);
            }
            found => panic!("seed {seed}: {found:?}\n{left:?}\n{right:?}"),
        }
    }
    assert!(
        equal > 50 && different > 60 && longest >= 3,
        "{equal} {different} {longest}"
    );
}

/// The tree with one of its memory nodes made reactive, or one that was not with memory.
fn forgetful(node: &Node, left: &mut usize) -> Node {
    match node {
        Node::Composite {
            kind,
            memory,
            children,
        } => {
            let hit = *left == 0;
            *left = left.wrapping_sub(1);
            Node::Composite {
                kind: *kind,
                memory: *memory != hit,
                children: children.iter().map(|c| forgetful(c, left)).collect(),
            }
        }
        Node::Decorator { kind, child } => Node::Decorator {
            kind: *kind,
            child: Box::new(forgetful(child, left)),
        },
        other => other.clone(),
    }
}

#[test]
fn a_row_that_leaves_all_free_is_any_environment() {
    let (mut equal, mut different) = (0, 0);
    for seed in 1..=200 {
        let random = &mut Random::new(seed);
        let soil = Soil {
            predicates: 3,
            behaviors: 3,
            history: random.chance(50),
            memory: random.chance(60),
            wild: true,
        };
        let left = soil.tree(random, 3);
        let right = match random.chance(50) {
            true => soil.tree(random, 3),
            false => forgetful(&left, &mut random.below(4)),
        };
        let history = history(random);
        let atoms = asked(&left, &right);
        // What the window does not remember never holds.
        let free = |atom: &Atom| match atom {
            Atom::Predicate(_) => true,
            Atom::Done(_) => history.window > 0 && history.success,
            Atom::Failed(_) => history.window > 0 && history.failure,
        };
        let policy = Policy {
            rows: vec![Row {
                minterm: Minterm::new(atoms.iter().map(|_| false)),
                free: Some(Minterm::new(atoms.iter().map(free))),
                behavior: Id::new(0),
                visits: 0,
                values: vec![],
            }],
            atoms,
            history,
            ..Policy::default()
        };
        let environment = Environment::Observed(&policy);
        let observed = compare(Side::Tree(&left), Side::Tree(&right), environment).unwrap();
        match (any(&left, &right, history), observed) {
            (Verdict::Equal(_), Verdict::Equal(_)) => equal += 1,
            (Verdict::Differ(a), Verdict::Differ(b)) => {
                assert_eq!(a.steps.len(), b.steps.len(), "seed {seed}");
                different += 1;
            }
            found => panic!("seed {seed}: {found:?}\n{left:?}\n{right:?}"),
        }
    }
    assert!(equal > 30 && different > 50, "{equal} {different}");
}

#[test]
fn a_tree_is_equal_to_itself_even_where_it_drives_on_after_a_failure() {
    let root = selector(vec![
        when(p(0), leaf(0)),
        memory_sequence(vec![leaf(1), leaf(2)]),
    ]);
    let verdict = any(&root, &root, History::default());
    assert!(matches!(verdict, Verdict::Equal(_)), "{verdict:?}");
}

/// A decision list: rule i asks two of the predicates.
fn rules(count: usize, predicates: usize, seed: u64) -> Vec<Node> {
    let random = &mut Random::new(seed);
    (0..count)
        .map(|_| {
            let literal = |random: &mut Random| match random.chance(50) {
                true => p(random.below(predicates)),
                false => Guard::Not(Box::new(p(random.below(predicates)))),
            };
            let guard = Guard::And((0..3).map(|_| literal(random)).collect());
            when(guard, leaf(random.below(8)))
        })
        .collect()
}

#[test]
fn more_predicates_than_a_table_takes_are_asked_of_a_solver() {
    let list = rules(120, 64, 1);
    let left = selector(list.clone());
    // The same rules, grouped: a different tree with the same decisions.
    let groups = list.chunks(7).map(|rules| selector(rules.to_vec()));
    let right = selector(groups.collect());
    let none = History::default();
    match any(&left, &right, none) {
        Verdict::Equal(explored) => assert_eq!(explored.means, Means::Table { atoms: 0 }),
        other => panic!("{other:?}"),
    }
    // Guards that hold nowhere else than before, written otherwise.
    let doubled = list.iter().map(|rule| match rule {
        Node::Composite { children, .. } => selector(vec![
            super::build::sequence(vec![rule.clone()]),
            super::build::sequence(vec![
                super::build::condition(p(0)),
                super::build::sequence(children.clone()),
            ]),
        ]),
        _ => unreachable!("every rule is a sequence"),
    });
    let right = selector(doubled.collect());
    match any(&left, &right, none) {
        Verdict::Equal(explored) => assert_eq!(explored.means, Means::Solver { atoms: 64 }),
        other => panic!("{other:?}"),
    }
    let mut shuffled = list.clone();
    shuffled.swap(40, 90);
    let right = selector(shuffled);
    let Verdict::Differ(trace) = any(&left, &right, none) else {
        panic!("rules 40 and 90 overlap and differ");
    };
    let both = Lockstep {
        statuses: vec![(0..8).map(|b| (Id::new(b), Status::Running)).collect()],
        sides: [&left, &right],
        atoms: asked(&left, &right),
        history: none,
    };
    let fresh = (Memory::new(), Memory::new(), Window::new());
    let (selected, ..) = both.ticks(&fresh, &trace.valuation).remove(0);
    assert_eq!(selected, [trace.left, trace.right]);
    assert_ne!(trace.left, trace.right);
    // No true atom of it could be false.
    for bit in (0..64).filter(|bit| trace.valuation.get(*bit)) {
        let lower = Minterm::new((0..64).map(|i| i != bit && trace.valuation.get(i)));
        let (selected, ..) = both.ticks(&fresh, &lower).remove(0);
        assert_eq!(selected[0], selected[1], "bit {bit}");
    }
}
