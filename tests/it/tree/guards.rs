//! The laws of guards and units: building, simplifying and factoring change no value.

use crate::laws::build::leaf;
use crate::laws::grown::Soil;
use crate::laws::random::Random;
use btc::ir::Id;
use btc::ir::tree::{Atom, Composite, Guard};
use btc::logic::{Cover, Cube, Literal};
use btc::tree::Size;
use btc::tree::guard::{
    alternatives, and, common, conjuncts, cover, either, factored, literals, negations, not, or,
    simplified, with_part,
};
use btc::tree::size::Price;
use btc::tree::unit::{Unit, guarded};

const ATOMS: usize = 4;

const SOIL: Soil = Soil {
    predicates: ATOMS,
    behaviors: 1,
    history: false,
    memory: false,
    wild: false,
};

/// The values of a guard under all valuations.
fn values(guard: &Guard) -> Vec<bool> {
    let value = |bits: usize| {
        guard.eval(&mut |atom| match atom {
            Atom::Predicate(id) => bits >> id.index() & 1 == 1,
            Atom::Done(_) | Atom::Failed(_) => false,
        })
    };
    (0..1 << ATOMS).map(value).collect()
}

fn guards() -> impl Iterator<Item = (Guard, Guard)> {
    (0..500).map(|seed| {
        let random = &mut Random::new(seed);
        (SOIL.guard(random, 4), SOIL.guard(random, 4))
    })
}

fn zip(a: &Guard, b: &Guard, join: impl Fn(bool, bool) -> bool) -> Vec<bool> {
    let pairs = values(a).into_iter().zip(values(b));
    pairs.map(|(a, b)| join(a, b)).collect()
}

#[test]
fn what_is_built_has_the_value_that_its_name_says() {
    for (a, b) in guards() {
        let (x, y) = (simplified(a.clone()), simplified(b.clone()));
        assert_eq!(values(&x), values(&a), "{a:?}");
        assert_eq!(values(&not(a.clone())), zip(&a, &a, |a, _| !a), "{a:?}");
        assert_eq!(
            values(&and([x.clone(), y.clone()])),
            zip(&a, &b, |a, b| a && b)
        );
        assert_eq!(
            values(&or([x.clone(), y.clone()])),
            zip(&a, &b, |a, b| a || b)
        );
        assert_eq!(values(&either(&x, &y)), zip(&a, &b, |a, b| a || b));
    }
}

#[test]
fn the_parts_of_a_guard_make_it_up() {
    for (guard, other) in guards() {
        let guard = simplified(guard);
        assert_eq!(
            values(&and(conjuncts(&guard).iter().cloned())),
            values(&guard)
        );
        assert_eq!(
            values(&or(alternatives(&guard).iter().cloned())),
            values(&guard)
        );
        let (shared, rest) = common(&guard);
        assert_eq!(
            values(&and(shared.into_iter().chain([rest]))),
            values(&guard)
        );
        if let Guard::And(parts) | Guard::Or(parts) = &guard {
            let same = with_part(&guard, 0, parts.first().cloned());
            assert_eq!(values(&same), values(&guard));
            let without = with_part(&guard, 0, None);
            assert!(negations(&without) <= negations(&guard));
        }
        // Only atoms are negated in what is simplified.
        let negated = literals(&guard)
            .into_iter()
            .filter(|l| matches!(l, Guard::Not(_)));
        assert!(negated.clone().all(|l| matches!(not(l), Guard::Atom(_))));
        assert!(negations(&guard) >= negated.count());
        let unit = Unit::of(&guarded(other.clone(), leaf(0)));
        assert_eq!((unit.guard, unit.body), (other, leaf(0)));
    }
}

#[test]
fn factoring_changes_no_value_and_adds_no_node() {
    let atoms: Vec<Atom> = (0..ATOMS).map(|i| Atom::Predicate(Id::new(i))).collect();
    for seed in 0..500 {
        let random = &mut Random::new(seed);
        let cubes = (0..random.below(7)).map(|_| {
            let atoms = (0..ATOMS).filter_map(|atom| {
                let positive = random.chance(50);
                random.chance(60).then_some(Literal { atom, positive })
            });
            Cube::new(atoms)
        });
        let flat = Cover::new(cubes.collect::<Vec<_>>());
        let (guard, plain) = (factored(&flat, &atoms), cover(&flat, &atoms));
        assert_eq!(values(&guard), values(&plain), "{flat:?}");
        let size = |guard: &Guard| Size::of(&guarded(guard.clone(), leaf(0))).price();
        assert!(size(&guard) <= size(&plain), "{flat:?}: {guard:?}");
        // A guard adds its price to a tree, besides the sequence and the leaf.
        if guard != Guard::Const(true) {
            let price = Price::of_guard(&guard, Composite::Sequence);
            assert_eq!(size(&guard).nodes, 2 + price.nodes, "{guard:?}");
        }
    }
}
