//! The methods on processes whose values are known.

use super::toys;
use btc::ir::expr::Binary;
use btc::ir::law::Behavior;
use btc::ir::task::{Discount, Method as Kind};
use btc::ir::{Expr, Id, Pool};
use btc::learn::discount::Discounting;
use btc::learn::method::{self, Settings};
use btc::learn::process::{End, Key, Process};
use btc::learn::q_table::{Admission, QTable};
use btc::learn::schedule::Schedule;
use btc::learn::train::{Course, Trained, train};
use btc::world::Start;

const ALL: [Kind; 3] = [Kind::QLearning, Kind::DoubleQ, Kind::Model];

const PER_DECISION: Discount = Discount::PerDecision(0.9);

/// The table that a method learns, with a step size of 1/visits^`power` and half of the choices random.
fn learned(
    kind: Kind,
    process: &mut impl Process,
    choices: usize,
    discount: Discount,
    (episodes, power): (u64, f64),
) -> QTable {
    let mut pool = Pool::default();
    let visits = pool.leaf(Expr::Visits);
    let power = pool.num(-power);
    let rate = pool.binary(Binary::Pow, visits, power);
    let explore = pool.num(0.5);
    let mut method = method::of(
        kind,
        &Settings {
            choices,
            initial: 0.0,
            rate: Schedule::new(&pool, rate),
            average: false,
            seed: 3,
        },
    );
    let choices: Vec<Id<Behavior>> = (0..choices).map(Id::new).collect();
    let course = Course {
        choices: &choices,
        patience: None,
        start: Start::default(),
        episodes,
        explore: Schedule::new(&pool, explore),
        discounting: Discounting {
            discount,
            tick: 0.1,
        },
        dwell: 0,
    };
    let mut trained = Trained::new(3);
    train(
        process,
        method.as_mut(),
        &course,
        &mut trained,
        |_, _| {},
        |_, _| {},
    );
    method.table().clone()
}

fn q(table: &QTable, key: Key, choice: usize) -> f64 {
    table.cells(table.find(key).unwrap())[choice].q
}

fn close(a: f64, b: f64, within: f64, what: Kind) {
    assert!((a - b).abs() <= within, "{what:?}: {a} is not {b}");
}

#[test]
fn a_corridor_is_worth_what_arithmetic_says() {
    for kind in ALL {
        let table = learned(kind, &mut toys::corridor(), 3, PER_DECISION, (4000, 0.5));
        let mut value = 10.0;
        for cell in (0..5).rev() {
            assert_eq!(table.greedy(table.find(cell).unwrap()), Some(0));
            close(q(&table, cell, 0), value, 0.02, kind);
            // What fails leaves the robot where it is: a step for nothing.
            close(q(&table, cell, 2), -1.0 + 0.9 * value, 0.05, kind);
            value = -1.0 + 0.9 * value;
        }
    }
}

#[test]
fn an_arm_is_worth_its_mean() {
    for kind in ALL {
        let table = learned(kind, &mut toys::arms(), 2, PER_DECISION, (20_000, 1.0));
        close(q(&table, 0, 0), 1.0, 0.05, kind);
        close(q(&table, 0, 1), 0.5, 1e-9, kind);
        let cells = table.cells(table.find(0).unwrap());
        assert_eq!(cells.iter().map(|cell| cell.visits).sum::<u64>(), 20_000);
        // The squares of the targets: half of them 4, half 0.
        close(cells[0].squares / cells[0].visits as f64, 2.0, 0.1, kind);
    }
}

#[test]
fn an_episode_at_its_limit_would_have_gone_on_and_an_ended_one_not() {
    for kind in ALL {
        let of = |end| learned(kind, &mut toys::single(end), 1, PER_DECISION, (4000, 0.5));
        close(q(&of(End::Terminal(0)), 0, 0), 1.0, 1e-9, kind);
        close(q(&of(End::Limit), 0, 0), 10.0, 0.01, kind);
    }
}

#[test]
fn time_discounts_by_how_long_a_decision_took() {
    // 20 ticks of 0.1 s at 0.9 a second: 0.81 a decision.
    for kind in ALL {
        let mut process = toys::single(End::Limit);
        let table = learned(
            kind,
            &mut process,
            1,
            Discount::PerTime(0.9, 1.0),
            (4000, 0.5),
        );
        close(q(&table, 0, 0), 1.0 / (1.0 - 0.81), 0.01, kind);
    }
}

#[test]
fn a_decision_that_was_cut_is_not_learned_as_a_whole_one() {
    for kind in ALL {
        let table = learned(kind, &mut toys::often_cut(), 2, PER_DECISION, (4000, 0.5));
        // Half of the decisions of choice 0 are cut. Those that are not bring 4 and end the episode.
        close(q(&table, 0, 0), 4.0, 1e-9, kind);
        // All of choice 1 are cut: as long as nothing else is known, it brings −0.1 and the same minterm again.
        close(q(&table, 0, 1), -0.1 + 0.9 * 4.0, 0.1, kind);
        let cells = table.cells(table.find(0).unwrap());
        assert_eq!([cells[0].cut, cells[1].cut], [false, true], "{kind:?}");
        assert_eq!(table.greedy(table.find(0).unwrap()), Some(0));
    }
}

#[test]
fn the_first_whole_decision_takes_the_place_of_cut_ones() {
    let mut table = QTable::new(1, 0.5);
    let row = table.row(0);
    let mut meet = |cut| {
        let admission = table.admits(row, 0, cut);
        if admission != Admission::Refused {
            let cell = table.cell_mut(row, 0).unwrap();
            cell.visits += 1;
            cell.q = if cut { -1.0 } else { 2.0 };
        }
        let cell = table.cells(row)[0];
        (admission, cell.visits, cell.q)
    };
    assert_eq!(meet(true), (Admission::Granted, 1, -1.0));
    assert_eq!(meet(true), (Admission::Granted, 2, -1.0));
    assert_eq!(meet(false), (Admission::Anew, 1, 2.0));
    assert_eq!(meet(true), (Admission::Refused, 1, 2.0));
    assert_eq!(meet(false), (Admission::Granted, 2, 2.0));
}

#[test]
fn two_tables_do_not_take_noise_for_value() {
    // The best of ten noisy estimates looks good; judged by the other table it is worth −0.1 at most.
    let value = |kind| {
        let table = learned(
            kind,
            &mut toys::biased(),
            10,
            Discount::PerDecision(1.0),
            (2000, 0.1),
        );
        q(&table, 0, 1)
    };
    let (single, double) = (value(Kind::QLearning), value(Kind::DoubleQ));
    assert!(single > 0.1, "{single}");
    assert!(double < 0.0, "{double}");
}

#[test]
fn greedy_is_over_what_was_tried() {
    let mut table = QTable::new(3, 100.0);
    let row = table.row(5);
    assert_eq!(table.greedy(row), None);
    for (choice, q) in [(1, -2.0), (2, -2.0)] {
        let cell = table.cell_mut(row, choice).unwrap();
        (cell.visits, cell.q) = (1, q);
    }
    assert_eq!(table.greedy(row), Some(1), "the first of equals");
    assert_eq!(table.best(row), 0, "what is not known yet may be better");
    assert_eq!(table.best_value(row), 100.0);
}
