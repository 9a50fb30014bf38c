//! No text makes the parser panic, run long, or stay silent about what it does not understand.

use crate::laws::parse::swallow;
use btc::diagnostic::Diagnostic;
use btc::source::FileId;
use btc::syntax::{parse, print};
use proptest::prelude::*;

const EXAMPLES: [&str; 2] = [
    include_str!("../../../examples/delivery_small.bt"),
    include_str!("../../../examples/delivery_large.bt"),
];

/// Texts in the alphabet of the language, which reach deeper than arbitrary ones.
fn near_miss() -> impl Strategy<Value = String> {
    let token = prop::sample::select(vec![
        "world",
        "robot",
        "state",
        "event",
        "on",
        "each tick",
        "let",
        "predicate",
        "behavior",
        "task",
        "learn",
        "tree",
        "claim",
        "test",
        "given",
        "tick",
        "of",
        "succeeds",
        "use",
        "if",
        "else",
        "for",
        "in",
        "not",
        "and",
        "or",
        "memory",
        "selector",
        "x",
        "f(",
        "`n`",
        "`",
        "\"",
        "{",
        "}",
        "(",
        ")",
        "=",
        "==",
        "=>",
        "->",
        ",",
        ":",
        "+",
        "-",
        "*",
        "/",
        "^",
        "<",
        ">=",
        "%",
        "5",
        "5 m/s",
        "1.",
        ".",
        "//",
        "///",
        "\n",
        "\n",
        "start",
        "reward",
        "observe",
        "control",
        "requires",
        "end",
        "otherwise",
        "λ",
        "–",
    ]);
    prop::collection::vec(token, 0..60).prop_map(|tokens| tokens.join(" "))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn arbitrary_texts_are_swallowed(text in any::<String>()) {
        swallow(&text);
    }

    #[test]
    fn near_misses_are_swallowed(text in near_miss()) {
        swallow(&text);
    }

    #[test]
    fn mutations_are_swallowed(
        example in 0..2_usize,
        cuts in prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>(), 0..4_usize), 1..4),
    ) {
        let mut text = EXAMPLES[example].to_owned();
        for (place, other, kind) in cuts {
            let tokens: Vec<(usize, usize)> = tokens(&text);
            if tokens.is_empty() {
                break;
            }
            let (start, end) = *place.get(&tokens);
            let token = text[start..end].to_owned();
            match kind {
                0 => text.replace_range(start..end, ""),
                1 => text.insert_str(end, &format!(" {token}")),
                2 => {
                    let (at, _) = *other.get(&tokens);
                    text.insert_str(at, &format!("{token} "));
                }
                _ => text.truncate(start),
            }
        }
        swallow(&text);
    }
}

/// The places of words, numbers and marks.
fn tokens(text: &str) -> Vec<(usize, usize)> {
    let mut places = Vec::new();
    let mut start = 0;
    for (at, letter) in text.char_indices() {
        let ends = !(letter.is_alphanumeric() || letter == '_');
        if ends && at > start {
            places.push((start, at));
        }
        if ends {
            if !letter.is_whitespace() {
                places.push((at, at + letter.len_utf8()));
            }
            start = at + letter.len_utf8();
        }
    }
    places
}

/// Deep nests of every kind are refused with a message, or parse, on the small stack of a test's thread.
#[test]
fn deep_nests_end_in_a_message() {
    let nests = [
        ("let x = ", "(", "1", ")"),
        ("let x = ", "f(", "1", ")"),
        ("let x = ", "not ", "a", ""),
        ("let x = ", "-", "1", ""),
        ("let x = ", "2^", "2", ""),
        ("let x = ", "1 + ", "2", ""),
        ("let x = ", "a and ", "b", ""),
        ("let x = ", "if a { ", "1", " } else { 2 }"),
        ("let x = ", "if a { 1 } else ", "{ 2 }", ""),
        ("tree t = ", "selector { ", "a", " }"),
        ("tree t = ", "retry(3) { ", "a", " }"),
        ("tree t = ", "g => ", "a", ""),
        ("on a { ", "if a { ", "b = 1", " }"),
        ("on a { ", "if a { b = 1 } else ", "{ b = 2 }", ""),
        ("on a { ", "{ ", "", ""),
        ("", "{", "", ""),
        ("", "(", "", ""),
        ("let x = ", "f(a (", "", ""),
        ("let x = ", "f(g, ", "", ""),
        ("tree t = ", "selector { ", "", ""),
    ];
    for (head, open, middle, close) in nests {
        for depth in [10, 60, 63, 64, 65, 100, 990, 5_000, 100_000] {
            let text = format!(
                "{head}{}{middle}{}",
                open.repeat(depth),
                close.repeat(depth)
            );
            let (_, diagnostics) = parse(FileId(0), &text);
            if let Ok(formatted) = print::format(&text) {
                // A chain of `and` is as deep as the logarithm of its length.
                assert!(depth <= 1_000 || open == "a and ");
                // Signs in a row are warned of.
                let again = parse(FileId(0), &formatted).1;
                assert!(!again.iter().any(Diagnostic::is_error));
            } else {
                assert!(!diagnostics.is_empty());
            }
        }
    }
}

/// Depth is limited, not length: operands that stand beside each other do not nest.
#[test]
fn long_chains_of_short_operands_parse() {
    let chains = [
        vec!["a and b"; 500].join(" or "),
        vec!["(a and not b)"; 500].join(" or "),
        vec!["a * b"; 900].join(" + "),
        format!("f({})", vec![vec!["a"; 900].join(" + "); 10].join(", ")),
    ];
    for chain in chains {
        let text = format!("let x = {chain}");
        assert!(parse(FileId(0), &text).1.is_empty());
        assert!(
            parse(FileId(0), &print::format(&text).unwrap())
                .1
                .is_empty()
        );
    }
}

/// A chain that begins with a bracket hangs this below all of its operators.
#[test]
fn chains_within_chains_add_up() {
    let chain = "+ a ".repeat(300);
    for (depth, parses) in [(3, true), (4, false)] {
        let text = format!(
            "let x = {}a {}",
            "(".repeat(depth),
            format!("{chain})").repeat(depth)
        );
        assert_eq!(parse(FileId(0), &text).1.is_empty(), parses);
    }
}
