//! The paper's example (section VIII-A): ten minterms, Figure 8.

use crate::laws::build::asked;
use btc::ir::Id;
use btc::ir::task::History;
use btc::ir::tree::{Atom, Composite, Guard, Node, Status};
use btc::policy::{Minterm, Policy, Row, Transition};
use btc::tree::decanonicalise::{Care, Failing, Method, decanonicalise};
use btc::tree::equivalence::{Environment, Side, Verdict, compare};
use btc::tree::prove::Refuted;

const A: usize = 0;
const B: usize = 1;
const C: usize = 2;
const DOCK: usize = 3;

fn minterm(carrying: bool, low: bool, done: usize) -> Minterm {
    Minterm::new([carrying, low].into_iter().chain((0..4).map(|b| b == done)))
}

/// What the robot learns, with what happens to it.
pub(crate) fn policy() -> Policy {
    let mut atoms = vec![Atom::Predicate(Id::new(0)), Atom::Predicate(Id::new(1))];
    atoms.extend((0..4).map(|b| Atom::Done(Id::new(b))));
    let mut rows: Vec<Row> = [
        (true, false, A, B),
        (false, false, B, A),
        (true, true, A, C),
        (false, true, B, C),
        (true, true, C, DOCK),
        (false, true, C, DOCK),
        (true, false, DOCK, B),
        (false, false, DOCK, A),
        (true, false, C, B),
        (false, false, C, A),
    ]
    .into_iter()
    .map(|(carrying, low, done, does)| Row {
        minterm: minterm(carrying, low, done),
        free: None,
        behavior: Id::new(does),
        visits: 1,
        values: vec![None; 4],
    })
    .collect();
    rows.sort_by(|a, b| a.minterm.cmp(&b.minterm));
    use Status::{Running, Success};
    let mut transitions: Vec<Transition> = [
        ((true, false, A), B, Success, (false, false, B)),
        ((true, false, A), B, Running, (true, true, A)),
        ((false, false, B), A, Success, (true, false, A)),
        ((false, false, B), A, Running, (false, true, B)),
        ((true, true, A), C, Success, (true, true, C)),
        ((false, true, B), C, Success, (false, true, C)),
        ((true, true, C), DOCK, Success, (true, false, DOCK)),
        ((false, true, C), DOCK, Success, (false, false, DOCK)),
        ((true, false, DOCK), B, Success, (false, false, B)),
        ((false, false, DOCK), A, Success, (true, false, A)),
    ]
    .into_iter()
    .map(|(from, does, status, to)| Transition {
        from: minterm(from.0, from.1, from.2),
        behavior: Id::new(does),
        status,
        to: Some(minterm(to.0, to.1, to.2)),
        count: 1,
    })
    .collect();
    transitions.sort();
    Policy {
        fields: Vec::new(),
        atoms,
        behaviors: (0..4).map(Id::new).collect(),
        history: History {
            window: 1,
            success: true,
            failure: false,
        },
        rows,
        starts: vec![(minterm(false, false, B), 1), (minterm(true, false, A), 1)],
        transitions,
    }
}

fn when(predicate: usize, node: Node) -> Node {
    Node::Composite {
        kind: Composite::Sequence,
        memory: false,
        children: vec![
            Node::Condition(Guard::Atom(Atom::Predicate(Id::new(predicate)))),
            node,
        ],
    }
}

/// `selector { battery_low => memory sequence { goto(C), dock(C) }, carrying_package => goto(B), goto(A) }`
pub(crate) fn figure_8() -> Node {
    let leaf = |b| Node::Behavior(Id::new(b));
    Node::Composite {
        kind: Composite::Selector,
        memory: false,
        children: vec![
            when(
                1,
                Node::Composite {
                    kind: Composite::Sequence,
                    memory: true,
                    children: vec![leaf(C), leaf(DOCK)],
                },
            ),
            when(0, leaf(B)),
            leaf(A),
        ],
    }
}

#[test]
fn both_methods_find_figure_8() {
    for method in [Method::Paper, Method::Search] {
        for care in [Care::Seen, Care::Reachable] {
            let found = decanonicalise(&policy(), &asked(method, care)).unwrap();
            assert_eq!(found.root, figure_8(), "{method:?} {care:?}");
            assert_eq!(found.size.nodes, 10);
            assert!(found.proof.closed);
            assert_eq!(found.proof.transitions, 10);
            let minterms = if care == Care::Seen { 10 } else { 8 };
            assert_eq!(found.proof.minterms, minterms);
        }
    }
}

#[test]
fn without_transitions_no_memory_node_is_printed() {
    let mut bare = policy();
    bare.transitions.clear();
    bare.starts.clear();
    let found = decanonicalise(&bare, &asked(Method::Paper, Care::Seen)).unwrap();
    assert!(
        !format!("{:?}", found.root).contains("memory: true"),
        "{:?}",
        found.root
    );
    assert!(!found.proof.recorded);
}

#[test]
fn a_changed_guard_is_told_by_a_shortest_trace() {
    let mut other = figure_8();
    if let Node::Composite { children, .. } = &mut other {
        children.swap(0, 1);
    }
    let policy = policy();
    let (expert, other) = (figure_8(), other);
    let verdict = compare(
        Side::Tree(&expert),
        Side::Tree(&other),
        Environment::Greedy(&policy),
    );
    let Ok(Verdict::Differ(trace)) = verdict else {
        panic!("{verdict:?}");
    };
    // carrying, low: reached when the battery runs low on the way to B
    assert_eq!(trace.steps.len(), 1);
    assert_eq!(trace.valuation, minterm(true, true, A));
    assert_eq!(
        (trace.left, trace.right),
        (Some(Id::new(C)), Some(Id::new(B)))
    );
}

#[test]
fn the_least_policies_have_trees() {
    let one = |atoms: usize, does: &[usize]| {
        let mut policy = policy();
        policy.atoms.truncate(atoms);
        policy.transitions.clear();
        policy.starts.clear();
        policy.history = History::default();
        policy.rows = does
            .iter()
            .enumerate()
            .map(|(i, b)| Row {
                minterm: Minterm::new((0..atoms).map(|a| i >> a & 1 == 1)),
                free: None,
                behavior: Id::new(*b),
                visits: 1,
                values: vec![None; 4],
            })
            .collect();
        policy.rows.sort_by(|a, b| a.minterm.cmp(&b.minterm));
        policy
    };
    for method in [Method::Paper, Method::Search] {
        let tree = |policy: &Policy| decanonicalise(policy, &asked(method, Care::Seen));
        // No predicates and no history: the bare leaf.
        assert_eq!(
            tree(&one(0, &[2])).unwrap().root,
            Node::Behavior(Id::new(2))
        );
        // One behaviour everywhere.
        assert_eq!(
            tree(&one(2, &[1, 1, 1])).unwrap().root,
            Node::Behavior(Id::new(1))
        );
        // One predicate decides.
        assert_eq!(tree(&one(1, &[0, 1])).unwrap().size.nodes, 5);
        // Nothing is known.
        assert_eq!(tree(&one(2, &[])), Err(Refuted::Empty));
    }
}

#[test]
fn decisions_that_fail_are_listed_with_what_the_tree_does_next() {
    let mut policy = policy();
    let stuck = minterm(true, false, DOCK);
    policy.transitions.push(Transition {
        from: stuck.clone(),
        behavior: Id::new(B),
        status: Status::Failure,
        to: Some(stuck.clone()),
        count: 7,
    });
    policy.transitions.sort();
    let found = decanonicalise(&policy, &asked(Method::Search, Care::Seen)).unwrap();
    let expected = Failing {
        minterm: stuck,
        behavior: Id::new(B),
        count: 7,
        repeated: 7,
        then: vec![Some(Id::new(A))],
    };
    assert_eq!(found.failing, [expected]);
}
