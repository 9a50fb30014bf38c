//! Ticks: what each node kind does, and the compiled tree beside the naive one on random trees.

use crate::laws::build::{
    condition, decorated, done, leaf, memory_selector, memory_sequence, not, p, parallel, selector,
    sequence, when,
};
use crate::laws::naive::{self, Memory};
use crate::laws::random::Random;
use btc::ir::Id;
use btc::ir::law::Behavior;
use btc::ir::tree::{Atom, Decorator, Guard, Node, Status};
use btc::tree::batch::{Answers, Batch, Rows};
use btc::tree::tick::Runner;
use std::collections::VecDeque;

/// Ticks a tree over two predicates; every tick is written `predicates:behaviour=status …>answer`, such as
/// `10:0=S 1=R>R`.
fn check(root: &Node, ticks: &[&str]) {
    let status = |c: &str| match c {
        "S" => Status::Success,
        "F" => Status::Failure,
        _ => Status::Running,
    };
    let atoms = [Atom::Predicate(Id::new(0)), Atom::Predicate(Id::new(1))];
    let mut runner = Runner::new(root, &atoms).unwrap();
    let mut memory = Memory::new();
    for (number, text) in ticks.iter().enumerate() {
        let (values, rest) = text.split_once(':').unwrap();
        let (leaves, answer) = rest.split_once('>').unwrap();
        let held: Vec<bool> = values.chars().map(|c| c == '1').collect();
        let expected: Vec<(usize, Status)> = leaves
            .split_whitespace()
            .map(|leaf| leaf.split_once('=').unwrap())
            .map(|(b, s)| (b.parse().unwrap(), status(s)))
            .collect();
        let word = held
            .iter()
            .enumerate()
            .fold(0, |w, (i, v)| w | u64::from(*v) << i);
        let mut left: VecDeque<_> = expected.iter().copied().collect();
        let found = runner.tick(&[word], |b| {
            let (behavior, status) = left.pop_front().unwrap_or((usize::MAX, Status::Running));
            assert_eq!(b.index(), behavior, "tick {number}: {text}");
            status
        });
        assert!(
            left.is_empty(),
            "tick {number}: {text}: {left:?} not ticked"
        );
        assert_eq!(found, status(answer), "tick {number}: {text}");
        let holds = |atom: Atom| {
            atoms
                .iter()
                .position(|a| *a == atom)
                .is_some_and(|i| held[i])
        };
        let mut left: VecDeque<_> = expected.into();
        let tick = naive::tick(root, &memory, &holds, &mut |_| left.pop_front().unwrap().1);
        assert_eq!(tick.status, found, "tick {number}: naive");
        memory = tick.memory;
    }
}

#[test]
fn a_memory_sequence_goes_on_in_the_next_tick() {
    let root = selector(vec![
        when(p(0), memory_sequence(vec![leaf(0), leaf(1)])),
        leaf(2),
    ]);
    check(
        &root,
        &[
            "00:2=R>R",
            "10:0=R>R",
            "10:0=S>R", // the success moves it on, the next child has to wait
            "10:1=R>R",
            "10:1=S>S", // finished: it starts over
            "10:0=S>R",
            "10:1=F 2=R>R", // failed: the selector goes on, it starts over
            "10:0=S>R",
            "00:2=R>R", // a tick that does not reach it: it starts over
            "10:0=R>R",
        ],
    );
}

#[test]
fn conditions_and_reactive_nodes_go_on_in_the_same_tick() {
    let root = memory_sequence(vec![
        condition(p(0)),
        leaf(0),
        condition(p(1)),
        sequence(vec![leaf(1), leaf(2)]),
    ]);
    check(
        &root,
        &[
            "00:>F",
            "10:0=R>R",
            "00:0=S>R", // what it has passed is not asked again
            "01:1=S 2=R>R",
            "00:1=S 2=S>S",
            "10:0=S>R",
            "00:>F",
            "10:0=R>R",
        ],
    );
}

#[test]
fn a_memory_selector_resumes_after_failures() {
    let root = memory_selector(vec![when(p(0), leaf(0)), leaf(1)]);
    check(
        &root,
        &[
            "00:1=R>R", // a guard that does not hold is no failure to wait for
            "10:1=F>F", "10:0=F>R", "10:1=S>S", "10:0=R>R",
        ],
    );
}

#[test]
fn reactive_nodes_try_from_the_left() {
    let root = selector(vec![when(p(0), leaf(0)), when(not(p(1)), leaf(1)), leaf(2)]);
    check(
        &root,
        &["10:0=F 1=F 2=R>R", "11:0=S>S", "01:2=F>F", "00:1=R>R"],
    );
    check(
        &sequence(vec![leaf(0), leaf(1)]),
        &["00:0=S 1=R>R", "00:0=R>R", "00:0=F>F"],
    );
}

#[test]
fn decorators_count_ticks_that_reach_them() {
    check(
        &decorated(Decorator::Invert, leaf(0)),
        &["00:0=S>F", "00:0=F>S", "00:0=R>R"],
    );
    check(
        &decorated(Decorator::Succeed, leaf(0)),
        &["00:0=F>S", "00:0=S>S", "00:0=R>R"],
    );
    check(
        &decorated(Decorator::Fail, leaf(0)),
        &["00:0=S>F", "00:0=F>F", "00:0=R>R"],
    );
    let retry = decorated(Decorator::Retry(2), leaf(0));
    check(
        &retry,
        &[
            "00:0=F>R", "00:0=R>R", "00:0=F>F", "00:0=F>R", "00:0=S>S", "00:0=F>R",
        ],
    );
    let repeat = decorated(Decorator::Repeat(2), leaf(0));
    check(
        &repeat,
        &[
            "00:0=S>R", "00:0=R>R", "00:0=S>S", "00:0=S>R", "00:0=F>F", "00:0=S>R",
        ],
    );
    let timeout = selector(vec![
        when(p(0), decorated(Decorator::Timeout(2), leaf(0))),
        leaf(1),
    ]);
    check(
        &timeout,
        &[
            "10:0=R>R", "10:0=R>R", "10:1=R>R", // out of time; it starts over
            "10:0=R>R", "00:1=R>R", "10:0=R>R", "10:0=R>R", "10:1=R>R",
        ],
    );
}

#[test]
fn parallel_counts_answers() {
    let root = parallel(
        2,
        vec![
            condition(p(0)),
            condition(p(1)),
            memory_sequence(vec![leaf(0), leaf(1)]),
        ],
    );
    check(
        &root,
        &[
            "00:0=R>F", // no longer to be reached: the rest is halted
            "10:0=S>R", "10:1=R>R", "11:1=R>S", // reached: the rest is halted
            "10:0=R>R",
        ],
    );
}

#[test]
fn the_compiled_tree_ticks_as_the_naive_one() {
    for seed in 1..=500 {
        let random = &mut Random::new(seed);
        let root = any_node(random, 4);
        let atoms = asked();
        let mut runner = Runner::new(&root, &atoms).unwrap();
        let mut keyed = runner.clone();
        let mut memory = Memory::new();
        let mut words = [0; 2];
        for tick in 0..60 {
            // Often nothing changes, and what runs goes on: `tick_key` does not walk the tree then.
            if tick == 0 || random.below(3) == 0 {
                words = [random.next() & random.next(), random.next()];
            }
            let holds = |atom: Atom| {
                let bit = atoms.iter().position(|a| *a == atom).unwrap();
                words[bit / 64] >> (bit % 64) & 1 == 1
            };
            let script: Vec<Status> = (0..64)
                .map(|_| match random.below(6) {
                    0 => Status::Success,
                    1 => Status::Failure,
                    _ => Status::Running,
                })
                .collect();
            let mut ticked = vec![];
            let status = runner.tick(&words, |behavior| {
                ticked.push(behavior);
                script[ticked.len() - 1]
            });
            let mut calls = 0;
            let expected = naive::tick(&root, &memory, &holds, &mut |_| {
                calls += 1;
                script[calls - 1]
            });
            assert_eq!(
                (status, &ticked),
                (expected.status, &expected.ticked),
                "seed {seed}: {root:?}"
            );
            let mut ticked = vec![];
            let key = u128::from(words[0]) | u128::from(words[1]) << 64;
            let status = keyed.tick_key(key, |behavior| {
                ticked.push(behavior);
                script[ticked.len() - 1]
            });
            assert_eq!(
                (status, &ticked, keyed.memory()),
                (expected.status, &expected.ticked, runner.memory()),
                "seed {seed}, by key: {root:?}"
            );
            memory = expected.memory;
        }
    }
}

#[test]
fn a_batch_answers_in_each_row_as_a_fresh_runner() {
    for seed in 1..=300 {
        let random = &mut Random::new(seed);
        let root = any_node(random, 4);
        let atoms = asked();
        let keys: Vec<u128> = (0..1 + random.below(2 * Rows::MOST))
            .map(|_| u128::from(random.next() & random.next()) | u128::from(random.next()) << 64)
            .collect();
        // A behaviour answers by its number and the row.
        let script: Vec<Status> = (0..64)
            .map(|_| match random.below(3) {
                0 => Status::Success,
                1 => Status::Failure,
                _ => Status::Running,
            })
            .collect();
        let answer = |behavior: Id<Behavior>, row: usize| script[(row * 5 + behavior.index()) % 64];
        let mut ticked = vec![vec![]; keys.len()];
        let answers = Batch::new(&atoms, &keys).tick(&root, &mut |block, behavior, rows| {
            let mut answers = Answers::default();
            for at in rows.iter() {
                let row = block * Rows::MOST + at;
                ticked[row].push(behavior);
                match answer(behavior, row) {
                    Status::Success => answers.succeeded.insert(at),
                    Status::Failure => answers.failed.insert(at),
                    Status::Running => {}
                }
            }
            answers
        });
        let answers = answers.unwrap();
        let mut runner = Runner::new(&root, &atoms).unwrap();
        for (row, key) in keys.iter().enumerate() {
            runner.reset();
            let mut expected = vec![];
            let status = runner.tick_key(*key, |behavior| {
                expected.push(behavior);
                answer(behavior, row)
            });
            let block = &answers[row / Rows::MOST];
            let within = |rows: Rows| rows.iter().any(|at| at == row % Rows::MOST);
            let found = match (within(block.succeeded), within(block.failed)) {
                (true, false) => Status::Success,
                (false, true) => Status::Failure,
                (false, false) => Status::Running,
                both => panic!("seed {seed}: {both:?}"),
            };
            assert_eq!(
                (found, &ticked[row]),
                (status, &expected),
                "seed {seed}, row {row}: {root:?}"
            );
        }
        assert_eq!(
            Batch::new(&atoms[..3], &keys)
                .tick(&root, &mut |_, _, _| Answers::default())
                .is_err(),
            Runner::new(&root, &atoms[..3]).is_err(),
            "seed {seed}: {root:?}"
        );
    }
}

/// What [`any_node`] asks.
fn asked() -> Vec<Atom> {
    let predicates = (0..70).map(|i| Atom::Predicate(Id::new(i)));
    predicates.chain([Atom::Done(Id::new(0))]).collect()
}

/// Any tree over 70 predicates, `done(0)` and five behaviours.
fn any_node(random: &mut Random, depth: usize) -> Node {
    let many = |random: &mut Random| -> Vec<Node> {
        (0..1 + random.below(3))
            .map(|_| any_node(random, depth - 1))
            .collect()
    };
    if depth == 0 || random.chance(15) {
        return match random.chance(50) {
            true => leaf(random.below(5)),
            false => condition(any_guard(random, 3)),
        };
    }
    match random.below(9) {
        0 | 1 => selector(many(random)),
        2 | 3 => sequence(many(random)),
        4 => memory_selector(many(random)),
        5 | 6 => memory_sequence(many(random)),
        7 => parallel(1 + random.below(2) as u32, many(random)),
        _ => {
            let kind = match random.below(6) {
                0 => Decorator::Invert,
                1 => Decorator::Succeed,
                2 => Decorator::Fail,
                3 => Decorator::Retry(1 + random.below(3) as u32),
                4 => Decorator::Repeat(1 + random.below(3) as u32),
                _ => Decorator::Timeout(1 + random.below(3) as u64),
            };
            decorated(kind, any_node(random, depth - 1))
        }
    }
}

fn any_guard(random: &mut Random, depth: usize) -> Guard {
    let many = |random: &mut Random| -> Vec<Guard> {
        (0..2 + random.below(2))
            .map(|_| any_guard(random, depth - 1))
            .collect()
    };
    match if depth == 0 { 0 } else { random.below(6) } {
        0 | 1 => p(random.below(70)),
        2 => not(any_guard(random, depth - 1)),
        3 => Guard::And(many(random)),
        4 => Guard::Or(many(random)),
        _ => match random.chance(80) {
            true => done(0),
            false => Guard::Const(random.chance(50)),
        },
    }
}
