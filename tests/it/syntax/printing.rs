//! Laws of the printer, on programs that are made up and on the examples with comments strewn in.

use crate::laws::format::kept;
use btc::source::FileId;
use btc::syntax::{parse, print};
use proptest::prelude::*;

const EXAMPLES: [&str; 3] = [
    include_str!("../../../examples/delivery_small.bt"),
    include_str!("../../../examples/delivery_large.bt"),
    include_str!("../../cases/tested/follows_the_history.bt"),
];

fn name() -> impl Strategy<Value = String> {
    prop_oneof![
        8 => prop::sample::select(vec![
            "a", "b", "battery", "goto", "carrying_package", "s", "m", "start", "memory", "selector", "per", "of",
            "facing", "when", "place", "sensor", "end", "otherwise", "tick", "x1",
        ]).prop_map(str::to_owned),
        1 => prop::sample::select(vec!["`goto-A`", "`state`", "`ein Name`", "`True`", "`//`"]).prop_map(str::to_owned),
    ]
}

fn number() -> impl Strategy<Value = String> {
    let digits = prop::sample::select(vec!["0", "1", "5_000", "0.25", "1e-3", "12.5e+2"]);
    let unit = prop::sample::select(vec![
        "", "%", " m", " m/s", " rad/m", " deg", " ticks", " m^2/s^2", " Hz",
    ]);
    (digits, unit).prop_map(|(digits, unit)| format!("{digits}{unit}"))
}

fn expr() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![name(), number(), Just("true".to_owned())];
    leaf.prop_recursive(4, 24, 4, |inner| {
        let op = prop::sample::select(vec!["or", "and", "+", "-", "*", "/"]);
        prop_oneof![
            3 => (inner.clone(), op, inner.clone()).prop_map(|(a, op, b)| format!("{a} {op} {b}")),
            1 => (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("(({a}) <= ({b}))")),
            1 => (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("({a})^({b})")),
            1 => inner.clone().prop_map(|a| format!("-({a})")),
            1 => inner.clone().prop_map(|a| format!("(not {a})")),
            1 => (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("({a}, {b})")),
            3 => (name(), prop::collection::vec(inner.clone(), 0..4)).prop_map(|(f, args)| format!("{f}({})", args.join(", "))),
            1 => (name(), name(), inner.clone()).prop_map(|(f, n, a)| format!("{f}({n} = {a})")),
            1 => (name(), name(), inner.clone()).prop_map(|(b, d, a)| format!("any({b} in {d}: {a})")),
            1 => (inner.clone(), inner.clone(), inner.clone())
                .prop_map(|(c, a, b)| format!("if {c} {{ {a} }} else {{ {b} }}")),
            1 => (inner.clone(), name(), inner.clone(), inner)
                .prop_map(|(c, n, a, b)| format!("if {c} {{ let {n} = {a}\n ({b}) }} else if {c} {{ {a} }} else {{ {b} }}")),
        ]
    })
}

/// Quantities, names and powers in a row, with and without the blanks that part a `^` from a unit.
fn powers() -> impl Strategy<Value = String> {
    let blank = || prop::sample::select(vec!["", " "]);
    let operand = prop_oneof![
        number(),
        Just("x".to_owned()),
        Just("-2".to_owned()),
        Just("(2 m)".to_owned())
    ];
    let op = prop::sample::select(vec!["^", "^", "^", " * ", " / ", " - "]);
    let more = (blank(), op, blank(), operand.clone())
        .prop_map(|(left, op, right, operand)| [left, op, right, &operand].concat());
    (operand, prop::collection::vec(more, 1..5)).prop_map(|(first, more)| first + &more.concat())
}

fn stmt() -> impl Strategy<Value = String> {
    let simple = prop_oneof![
        (name(), expr()).prop_map(|(n, e)| format!("{n} = {e}")),
        (name(), expr()).prop_map(|(n, e)| format!("{n}({e}) += {e}")),
        (name(), expr()).prop_map(|(n, e)| format!("{n}({e})")),
        (name(), expr()).prop_map(|(n, e)| format!("let {n} = {e}")),
    ];
    simple.prop_recursive(3, 8, 3, |inner| {
        prop_oneof![
            (expr(), inner.clone()).prop_map(|(c, s)| format!("if {c} {{ {s} }}")),
            (expr(), inner.clone(), inner.clone()).prop_map(|(c, a, b)| format!(
                "if {c} {{\n{a}\n\n{b} }} else if {c} {{ {b} }} else {{ {a}\n}}"
            )),
            (name(), name(), inner).prop_map(|(b, d, s)| format!("for {b} in {d} {{ {s} }}")),
        ]
    })
}

fn node() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![name(), expr().prop_map(|e| format!("done({e})"))];
    leaf.prop_recursive(4, 12, 3, |inner| {
        let word = prop::sample::select(vec![
            "selector",
            "sequence",
            "memory selector",
            "memory sequence",
            "parallel(2)",
            "invert",
            "succeed",
            "fail",
            "retry(3)",
            "timeout(5 s)",
        ]);
        prop_oneof![
            (word, prop::collection::vec(inner.clone(), 0..4))
                .prop_map(|(w, c)| format!("{w} {{ {} }}", c.join(", "))),
            (expr(), inner).prop_map(|(g, n)| format!("{g} => {n}")),
        ]
    })
}

fn item() -> impl Strategy<Value = String> {
    prop_oneof![
        Just("use std".to_owned()),
        (name(), expr()).prop_map(|(n, e)| format!("state {n}: bool = {e}")),
        (name(), expr()).prop_map(|(n, e)| format!("state {n}(t: tree_kind) = {e}")),
        (name(), expr()).prop_map(|(n, e)| format!("event {n} = {e}")),
        stmt().prop_map(|s| format!("each tick {{ {s} }}")),
        (name(), stmt()).prop_map(|(n, s)| format!("on {n} {{\n{s}\n}}")),
        (name(), stmt()).prop_map(|(n, s)| format!("on {n}(b: bush) {{ {s} }}")),
        (name(), expr()).prop_map(|(n, e)| format!("let {n}(x: length/time*mass = {e}, y: angle): speed = {e}")),
        (name(), expr(), expr()).prop_map(|(n, e, f)| format!("let {n} = {{ let {n} = {e}\n({f}) }}")),
        name().prop_map(|n| format!("predicate {n}")),
        (name(), expr()).prop_map(|(n, e)| format!("/// documented\npredicate {n}(p: place) = {e}")),
        name().prop_map(|n| format!("behavior {n}")),
        (name(), name(), expr()).prop_map(|(n, m, e)| format!("behavior {n} = {m}({e})")),
        (name(), expr(), stmt()).prop_map(|(n, e, s)| format!(
            "behavior {n}(a: place) {{ local {n}: angle = {e}\nrequires {e}\nsucceed when {e}\nfail when {e}\ncontrol {{ {s} }} }}"
        )),
        (name(), expr(), expr()).prop_map(|(n, e, f)| format!(
            "world {n} {{ tick = {e}\nplace {n}: kind = {e} facing {f}\nwall {n} = {e} when {f}\n\
             robot {n} {{ body = {e}\nsensor a = scanner(from = {e}, to = {f})\nsensor bb = scanner(from = {f}, to = {e}) }} }}"
        )),
        (name(), expr(), expr()).prop_map(|(n, e, f)| format!(
            "task {n} {{ observe `start`, g({e}), f({f})\nchoose f({f}), {n}({e})\nhistory last 2 success, failure\npatience {e}\n\
             start {{ pose = {e}\n f({e}) = {f} }}\nend on {e}\nend after {f}\nreward {{ on {e}: {f}\notherwise: {e} }} }}"
        )),
        (name(), expr(), expr()).prop_map(|(n, e, f)| format!(
            "learn {n} for {n} {{ rate = {e}\nepisodes = {e} of {f}\nper = {e} per {f}\nexplore = {e} -> {f}\nstart {{ a = {e} }} }}"
        )),
        (name(), node()).prop_map(|(n, t)| format!("tree {n}(p: place) for {n} = {t}")),
        (name(), expr()).prop_map(|(n, e)| format!("claim {n} never {e} within {e} with probability >= 95%")),
        (name(), expr(), expr()).prop_map(|(n, e, f)| format!(
            "test \"it ticks\" of {n}({e}) {{ given {e}, not ({f})\ntick => {n}\n\
             tick {e}, {f} for {e} => {n}({f}) fails, {n} succeeds\ntick for {f} => {n} runs }}"
        )),
        Just("enum kind { one, two }".to_owned()),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn printing_keeps_what_is_made_up(items in prop::collection::vec(item(), 1..4)) {
        let text = items.join("\n");
        let diagnostics = parse(FileId(0), &text).1;
        let expected = diagnostics.iter().all(|mistake| mistake.code.name() == "E0115");
        prop_assert!(expected, "does not parse: {:?}\n{}", diagnostics, text);
        kept(&text);
    }

    #[test]
    fn powers_of_quantities_keep_their_meaning(expr in powers()) {
        let text = format!("let y = {expr}");
        let diagnostics = parse(FileId(0), &text).1;
        prop_assume!(diagnostics.is_empty());
        kept(&text);
    }

    #[test]
    fn comments_survive_wherever_they_stand(
        example in 0..3_usize,
        places in prop::collection::vec((any::<prop::sample::Index>(), 0..5_usize), 1..6),
    ) {
        let mut text = EXAMPLES[example].to_owned();
        let blanks: Vec<usize> = text.match_indices([' ', '\n']).map(|(at, _)| at).collect();
        let mut cuts: Vec<(usize, usize)> = places.iter().map(|(index, kind)| (*index.get(&blanks), *kind)).collect();
        cuts.sort_unstable();
        for (number, (at, kind)) in cuts.into_iter().enumerate().rev() {
            let comment = match kind {
                0 => format!(" // remark {number}\n"),
                1 => format!("\n/// remark {number}\n"),
                2 => format!("\n\n\n// remark {number}\n\n\n"),
                3 => format!(" //! remark {number}\n"),
                _ => format!(" /// remark {number}\n"),
            };
            text.insert_str(at, &comment);
        }
        kept(&text);
    }
}

/// A `^` that touches a unit belongs to it; one that does not raises the whole quantity.
#[test]
fn a_power_is_parted_from_a_unit() {
    let pairs = [
        ("3 m ^ 2", "3 m ^ 2"),
        ("3 m^2", "3 m^2"),
        ("10% ^ 2", "10% ^ 2"),
        ("3m^ 0.5", "3 m ^ 0.5"),
        ("1 m ^ 2 m", "1 m ^ 2 m"),
        ("2 m^2 ^ 3", "2 m^2 ^ 3"),
        ("x ^ 2 m ^ 2", "x^2 m ^ 2"),
    ];
    for (written, formatted) in pairs {
        let text = format!("let y = {written}\n");
        assert_eq!(
            print::format(&text).unwrap(),
            format!("let y = {formatted}\n")
        );
        kept(&text);
    }
}

/// A file keeps the ends of its lines.
#[test]
fn carriage_returns_stay() {
    for text in EXAMPLES {
        let returns = text.replace('\n', "\r\n");
        assert_eq!(print::format(&returns).unwrap(), returns);
    }
}
