//! Claims on programs of `tests/cases/verified/`, and what of it rests on predicates that exclude one another.

use crate::program::{self, NoFiles, shown};
use btc::check::exclusions;
use btc::driver::diff::{Side, diff};
use btc::driver::load::load;
use btc::driver::verify;
use btc::ir::tree::Atom;
use btc::ir::{Expr, ExprId, Program};
use proptest::prelude::*;
use proptest::sample::select;

#[test]
fn claims_are_answered() {
    crate::snapshot::settings().bind(|| {
        insta::glob!("../cases/verified", "*.bt", |path| {
            let name = path.file_name().unwrap().to_str().unwrap();
            let loaded = program::named(name, path);
            let claims = verify::claims(&loaded).unwrap();
            let told: Vec<String> = claims.into_iter().map(|proved| proved.text).collect();
            let told = format!("{}{}\n", shown(&loaded), told.join("\n"));
            insta::assert_snapshot!("verified", told);
        });
    });
}

fn condition() -> impl Strategy<Value = String> {
    let ops = || select(vec!["<", "<=", ">", ">=", "==", "!="]);
    let leaf = prop_oneof![
        (ops(), 0..4_i32).prop_map(|(op, k)| format!("x {op} {k}")),
        (ops(), 0..4_i32).prop_map(|(op, k)| format!("{k} {op} y")),
        (select(vec!["==", "!="]), select(vec!["a", "b", "c"]))
            .prop_map(|(op, v)| format!("mode {op} {v}")),
        Just("x < y".to_owned()),
        Just("x / y <= 1".to_owned()),
    ];
    leaf.prop_recursive(3, 8, 2, |inner| {
        prop_oneof![
            inner.clone().prop_map(|a| format!("not ({a})")),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("(({a}) and ({b}))")),
            (inner.clone(), inner).prop_map(|(a, b)| format!("(({a}) or ({b}))")),
        ]
    })
}

/// The value of an expression where the inputs have these.
fn value(program: &Program, id: ExprId, inputs: &[f64]) -> f64 {
    let of = |id| value(program, id, inputs);
    match program.pool[id] {
        Expr::Num(number) => number,
        Expr::Bool(truth) => f64::from(truth),
        Expr::Input(id) => inputs[id.index()],
        Expr::Unary(op, a) => op.apply(of(a)),
        Expr::Binary(op, a, b) => op.apply(of(a), of(b)),
        ref other => unreachable!("{other:?}"),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// What is excluded holds for no values of the inputs, whether they are numbers or not.
    #[test]
    fn what_is_excluded_never_holds(conditions in prop::collection::vec(condition(), 1..6)) {
        let mut text = "input x: number\ninput y: number\ninput mode: {a, b, c}\n".to_owned();
        for (at, condition) in conditions.iter().enumerate() {
            text.push_str(&format!("predicate p{at} = {condition}\n"));
        }
        let asked: Vec<String> = (0..conditions.len()).map(|at| format!("p{at}")).collect();
        text.push_str(&format!("behavior go\ntree all = sequence {{ {}, go }}\n", asked.join(", ")));
        let loaded = load("made.bt", text.clone().into(), &mut NoFiles);
        let program = &loaded.program;
        let atoms = program.predicates.ids().map(Atom::Predicate).collect();
        prop_assert_eq!(program.predicates.ids().count(), conditions.len(), "{}", shown(&loaded));
        let excluded = exclusions(program, &atoms);
        let numbers = [f64::NEG_INFINITY, -1.0, 0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, f64::INFINITY, f64::NAN];
        for x in numbers {
            for y in numbers {
                for mode in [0.0, 1.0, 2.0] {
                    let holds = |atom: Atom| match atom {
                        Atom::Predicate(id) => {
                            let when = program.predicates[id].when.unwrap();
                            value(program, when, &[x, y, mode]) != 0.0
                        }
                        _ => unreachable!(),
                    };
                    for literals in &excluded {
                        let together = literals.iter().all(|(atom, value)| holds(*atom) == *value);
                        prop_assert!(!together, "{literals:?} at {x}, {y}, {mode} in\n{text}");
                    }
                }
            }
        }
    }
}

/// Values of one enum, intervals of one reading, and a whole family of them are found to exclude one another.
#[test]
fn what_excludes_one_another_is_found() {
    let text = "input x: length\ninput mode: {a, b, c}\n\
                predicate is_a = mode == a\npredicate is_b = mode == b\npredicate is_c = mode == c\n\
                predicate near = x < 1 m\npredicate nearer = x <= 50 cm\npredicate far = x > 2 m\n\
                behavior go\ntree all = sequence { is_a, is_b, is_c, near, nearer, far, go }\n";
    let loaded = load("made.bt", text.into(), &mut NoFiles);
    let program = &loaded.program;
    let atoms = program.predicates.ids().map(Atom::Predicate).collect();
    let told: Vec<String> = exclusions(program, &atoms)
        .into_iter()
        .map(|literals| {
            let literals = literals.iter().map(|(atom, value)| {
                let not = if *value { "" } else { "not " };
                format!("{not}{}", program.atom_name(*atom))
            });
            literals.collect::<Vec<_>>().join(" and ")
        })
        .collect();
    assert_eq!(
        told,
        [
            "is_a and is_b",
            "is_a and is_c",
            "is_b and is_c",
            "near and far",
            "not near and nearer",
            "nearer and far",
            "not is_a and not is_b and not is_c",
        ]
    );
}

/// What `btc diff` tells rests on the same, and says so.
#[test]
fn changes_are_told_within_what_the_predicates_compare() {
    let of = |tree: &str| {
        let text = format!(
            "input held: {{none, parcel, express}}\n\
             predicate has_parcel = held == parcel\npredicate has_express = held == express\n\
             behavior deliver\nbehavior hurry\nbehavior fetch\ntree hand = selector {{ {tree} }}\n"
        );
        load("made.bt", text.into(), &mut NoFiles)
    };
    let told = |old: &str, new: &str| {
        let (old, new) = (of(old), of(new));
        let (old, new) = (Side::Program(&old, None), Side::Program(&new, None));
        diff(old, new, 1, 1).unwrap().human()
    };
    let turned = told(
        "has_parcel => deliver, has_express => hurry, fetch",
        "has_express => hurry, has_parcel => deliver, fetch",
    );
    let kept = told(
        "has_parcel => deliver, fetch",
        "has_parcel => deliver, has_parcel and not has_express => deliver, fetch",
    );
    let changed = told(
        "has_parcel => deliver, fetch",
        "has_parcel and not has_express => hurry, fetch",
    );
    crate::snapshot::check(
        "changed_within_predicates",
        &[turned, kept, changed].join("\n"),
    );
}
