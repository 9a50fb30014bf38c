//! Decision lists.

use crate::planted::{planted, size};
use btc::logic::{Bits, Columns, Cover, Effort, Order, list};

/// Every row meets first the cover of its own class.
fn assert_decides(columns: &Columns, classes: &[Bits], list: &[(usize, Cover)]) {
    let mut left = Bits::full(columns.rows());
    for (class, cover) in list {
        let taken = columns.cover_meets(cover, &left);
        assert_eq!(taken, classes[*class], "class {class}");
        left.subtract(&taken);
    }
    assert!(left.is_empty());
}

#[test]
fn planted_lists_are_found() {
    for (atoms, rows) in [(11, 61), (24, 10_000), (64, 10_000), (128, 10_000)] {
        for seed in 0..10 {
            let planted = planted(atoms, rows, seed);
            let found = list(
                &planted.columns,
                &planted.classes,
                Order::Learned,
                &Effort::default(),
            );
            assert_decides(&planted.columns, &planted.classes, &found);
            let covers: Vec<Cover> = found.into_iter().map(|(_, cover)| cover).collect();
            let (found, known) = (size(&covers), planted.size());
            assert!(
                found.1 <= known.1,
                "{atoms} × {rows}, seed {seed}: {found:?}, planted {known:?}"
            );
        }
    }
}

#[test]
fn lists_are_the_same_on_any_number_of_threads() {
    let planted = planted(24, 3_000, 5);
    let found = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().unwrap().install(|| {
            [Order::Learned, Order::Given, Order::Rarest].map(|order| {
                list(
                    &planted.columns,
                    &planted.classes,
                    order,
                    &Effort::default(),
                )
            })
        })
    };
    let lists = found(1);
    assert_eq!(lists, found(3));
    for list in &lists {
        assert_decides(&planted.columns, &planted.classes, list);
    }
    let given: Vec<usize> = lists[1].iter().map(|(class, _)| *class).collect();
    assert!(given.is_sorted());
}
