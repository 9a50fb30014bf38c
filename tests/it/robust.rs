//! Whatever the text, nothing panics, every message lies in its file, and a program without errors is whole.

use crate::laws::check::{told, whole};
use crate::program::{self, NoFiles};
use btc::driver::load::load;

/// Small reproducible numbers.
pub(crate) struct Dice(pub(crate) u64);

impl Dice {
    pub(crate) fn roll(&mut self, sides: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        usize::try_from(self.0 % sides as u64).unwrap()
    }

    pub(crate) fn pick<'t, T: ?Sized>(&mut self, of: &[&'t T]) -> &'t T {
        of[self.roll(of.len())]
    }
}

fn examples() -> [&'static str; 3] {
    [
        include_str!("../../examples/delivery_small.bt"),
        include_str!("../../examples/delivery_large.bt"),
        include_str!("../cases/warehouse.bt"),
    ]
}

/// Words, numbers, marks and blanks, one after another.
fn tokens(text: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let word = |c: char| c.is_alphanumeric() || c == '_';
        let length = if word(first) {
            rest.find(|c| !word(c)).unwrap_or(rest.len())
        } else if first == ' ' {
            rest.find(|c| c != ' ').unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        let (token, after) = rest.split_at(length);
        tokens.push(token);
        rest = after;
    }
    tokens
}

#[test]
fn mutations_of_the_examples() {
    let mut dice = Dice(0x9e37_79b9_7f4a_7c15);
    let mut fine = 0;
    for text in examples() {
        let original = tokens(text);
        for round in 0..120 {
            let mut mutant = original.clone();
            for _ in 0..=round % 3 {
                let (i, j) = (dice.roll(mutant.len()), dice.roll(mutant.len()));
                match dice.roll(4) {
                    0 => drop(mutant.remove(i)),
                    1 => mutant.insert(i, mutant[i]),
                    2 => mutant.swap(i, j),
                    // A token from elsewhere: a mistake of meaning more often than of form.
                    _ => mutant[i] = original[j % original.len()],
                }
            }
            fine += usize::from(!whole(mutant.concat().into()).has_errors());
        }
    }
    assert!(fine > 0, "no mutant was without errors");
}

#[test]
fn numbers_and_names_exchanged() {
    let mut dice = Dice(0x0123_4567_89ab_cdef);
    for text in examples() {
        let original = tokens(text);
        let word = |token: &&str| token.starts_with(char::is_alphabetic);
        let words: Vec<&str> = original.iter().copied().filter(word).collect();
        let strange = [
            "0",
            "-1",
            "1e308",
            "1e-320",
            "1e400",
            "0.5",
            "9007199254740993",
            "true",
        ];
        for _ in 0..100 {
            let mut mutant = original.clone();
            let i = dice.roll(mutant.len());
            if word(&mutant[i]) {
                mutant[i] = words[dice.roll(words.len())];
            } else if mutant[i].starts_with(char::is_numeric) {
                mutant[i] = strange[dice.roll(strange.len())];
            }
            whole(mutant.concat().into());
        }
    }
}

#[test]
fn truncations_and_bytes() {
    let mut dice = Dice(0xfeed_beef_dead_cafe);
    for text in examples() {
        for end in (0..text.len()).step_by(47) {
            whole(text.as_bytes()[..end].to_vec());
        }
        for _ in 0..60 {
            let mut bytes = text.as_bytes().to_vec();
            for _ in 0..3 {
                let at = dice.roll(bytes.len());
                bytes[at] = u8::try_from(dice.roll(256)).unwrap();
            }
            whole(bytes);
        }
    }
    for length in 0..60 {
        whole(
            (0..length)
                .map(|_| u8::try_from(dice.roll(256)).unwrap())
                .collect(),
        );
    }
}

/// One item after another, made of its number.
fn many(n: usize, item: impl Fn(usize) -> String) -> String {
    (0..n).map(item).collect()
}

#[test]
fn thousands_of_items() {
    let text = many(3_000, |i| format!("state s{i}: number = {i}\n"));
    assert!(!whole(text.into()).has_errors());
    let text = many(2_000, |i| {
        format!("predicate p{i}\nbehavior b{i} {{ control {{}} }}\n")
    });
    let guards = many(2_000, |i| format!("    p{i} => b{i},\n"));
    let text = format!("{text}tree wide = selector {{\n{guards}}}\n");
    assert!(!whole(text.into()).has_errors());
}

/// What was likely meant by thousands of unknown names is looked for among thousands of known ones, in linear time.
#[test]
fn thousands_of_unknown_names() {
    let n = 20_000;
    let text = many(n, |i| format!("predicate p{i} = unknown_{i}_name\n"));
    let loaded = load("mutant.bt", text.into(), &mut NoFiles);
    assert_eq!(loaded.diagnostics.len(), n);
    program::shown(&loaded);
}

/// Thousands of lines that are not understood, and what asks for them, cost no more each than a few do.
#[test]
fn thousands_of_broken_items() {
    let n = 5_000;
    for item in [
        "event eN = s fooN\n",
        "predicate pN = (1 m\n",
        "state sN: lenght = 0 m\npredicate pN = sN > 1 m\n",
        "on eN { xN = yN\n",
        "tree tN = selector { if aN => bN }\n",
    ] {
        let text = many(n, |i| item.replace('N', &i.to_string()));
        let loaded = load("mutant.bt", text.into(), &mut NoFiles);
        assert!(loaded.has_errors(), "{item}");
        program::shown(&loaded);
    }
}

#[test]
fn long_ways_through_definitions() {
    // Each uses the one before, in either order of declaration.
    for uses in ["X + 1", "X + X", "if X > 1 { X } else { 2 }"] {
        for reversed in [false, true] {
            let item = |i: usize| {
                let i = if reversed { 1_999 - i } else { i };
                match i {
                    0 => "let a0: number = 1\n".to_owned(),
                    i => {
                        let before = format!("a{}", i - 1);
                        format!("let a{i}: number = {}\n", uses.replace('X', &before))
                    }
                }
            };
            let loaded = whole(many(2_000, item).into());
            let told = loaded.diagnostics.iter().filter(|found| found.is_error());
            assert_eq!(told.count(), 1, "{uses}");
        }
    }
    let trees = many(2_000, |i| match i {
        0 => "behavior wait { control {} }\ntree t0 = wait\n".to_owned(),
        i => format!("tree t{i} = sequence {{ t{0}, t{0} }}\n", i - 1),
    });
    assert!(whole(trees.into()).has_errors());
    let aliases = many(2_000, |i| match i {
        0 => "behavior b0 { control {} }\n".to_owned(),
        i => format!("behavior b{i} = b{}\n", i - 1),
    });
    whole(aliases.into());
    let predicates = many(2_000, |i| match i {
        0 => "predicate p0 = true\n".to_owned(),
        i => format!("predicate p{i} = p{0} and not p{0}\n", i - 1),
    });
    assert!(whole(predicates.into()).has_errors());
}

#[test]
fn deep_and_long_expressions() {
    let sum = format!(
        "let a: number = 1{}\nlet b: number = a + a\n",
        " + 1".repeat(990)
    );
    told(sum.into());
    let sum = format!("let a: number = 1{}\n", " + 1".repeat(150));
    assert!(!whole(sum.into()).has_errors());
    for (open, close) in [
        ("(", ")"),
        ("-", ""),
        ("not ", ""),
        ("abs(", ")"),
        ("2 ^ ", ""),
    ] {
        for n in [30, 60, 500, 20_000] {
            let text = format!("let a = {}1{}\n", open.repeat(n), close.repeat(n));
            told(text.into());
        }
    }
    let deep = format!(
        "behavior wait {{ control {{}} }}\ntree deep = {}wait{}\n",
        "sequence { ".repeat(60),
        " }".repeat(60)
    );
    whole(deep.into());
    let cascade = |i: usize| match i {
        0 => format!("let a0: number = 1{}\n", " + 1".repeat(900)),
        i => format!("let a{i}: number = a{}{}\n", i - 1, " + 1".repeat(900)),
    };
    assert!(told(many(60, cascade).into()).has_errors());
}

#[test]
fn strange_numbers() {
    let world = |tick: &str, x: &str, rest: &str| {
        format!(
            "use std
world yard {{
    tick  = {tick}
    arena = rect((0 m, 0 m), (6 m, 4 m))
    place A = disc(({x}, 1 m), 15 cm)
    robot digger {{
        body  = disc(17 cm)
        drive = differential(max_speed = 0.4 m/s, max_turn = 2 rad/s)
    }}
}}
{rest}"
        )
    };
    let task = |history: &str, end: &str, reward: &str| {
        format!(
            "task come {{
    choose goto(A)
    history last {history} success
    end after {end}
    reward {{ otherwise: {reward} }}
}}
"
        )
    };
    assert!(!whole(world("100 ms", "1 m", &task("1", "10 s", "-1")).into()).has_errors());
    for tick in [
        "0 s", "-1 s", "1e-320 s", "1e308 h", "0 s / 0", "1 s / 0", "1 tick",
    ] {
        whole(world(tick, "1 m", &task("1", "10 s", "-1")).into());
    }
    for x in [
        "0 m / 0",
        "1 m / 0",
        "-1e308 km",
        "1e400 m",
        "0 m * ln(0)",
        "1 m * sqrt(-1)",
    ] {
        assert!(whole(world("100 ms", x, "").into()).has_errors(), "{x}");
    }
    for history in ["0", "65", "1e18", "1_000_000_000", "0 / 0", "-3", "1.5"] {
        let text = world("100 ms", "1 m", &task(history, "10 s", "-1"));
        assert!(whole(text.into()).has_errors(), "{history}");
    }
    for end in ["0 s", "1e300 h", "1e-9 s", "0 s / 0", "1 s / 0"] {
        let text = world("100 ms", "1 m", &task("1", end, "-1"));
        assert!(whole(text.into()).has_errors(), "{end}");
    }
    for reward in ["0 / 0", "1 / 0", "-1e308 * 10"] {
        whole(world("100 ms", "1 m", &task("1", "10 s", reward)).into());
    }
}
