//! Claims on events: bounds that hold whenever one stops, and what is said of a claim.

use crate::command::{btc, err, out};
use crate::program::{NoFiles, shown};
use btc::driver::load::load;
use btc::driver::verify;
use btc::random::Random;
use btc::report::verdict::Answer;
use btc::trial::anytime::Anytime;

/// Whoever looks after every trial and stops at the first exclusion is wrong in at most 5 % of all sequences.
#[test]
fn bounds_hold_at_all_times() {
    const SEQUENCES: u64 = 400;
    for (stream, p) in [0.002, 0.05, 0.3, 0.5].into_iter().enumerate() {
        let mut wrong = 0;
        for sequence in 0..SEQUENCES {
            let mut random = Random::new(1, stream as u64, sequence);
            let mut trials = Anytime::default();
            wrong += u64::from((0..2000).any(|_| {
                trials.add(random.chance(p));
                trials.excludes(p)
            }));
        }
        assert!(wrong <= SEQUENCES / 20, "{wrong} of {SEQUENCES} at {p}");
    }
}

/// The interval is where nothing is excluded, and it gets as narrow as one likes.
#[test]
fn intervals_shrink_around_the_rate() {
    let mut random = Random::new(1, 9, 0);
    let mut trials = Anytime::default();
    let mut last = 1.0;
    for _ in 0..4 {
        for _ in 0..2500 {
            trials.add(random.chance(0.3));
        }
        let [low, high] = trials.interval95();
        assert!(low < 0.3 && 0.3 < high);
        assert!(trials.excludes(low - 1e-6) && trials.excludes(high + 1e-6));
        assert!(!trials.excludes((low + high) / 2.0));
        assert!(high - low < last);
        last = high - low;
    }
    assert!(last < 0.05, "{last}");
    let mut none = Anytime::default();
    (0..1000).for_each(|_| none.add(false));
    assert_eq!(none.interval95()[0], 0.0);
    assert!(!none.is_above(0.0) && !none.is_below(0.0) && none.is_below(0.01));
}

/// A coin falls when the robot has waited for a second: heads with the given chance.
fn toss(chance: &str, claim: &str) -> String {
    format!(
        "use std
world table {{
    tick = 100 ms
    arena = rect((0 m, 0 m), (2 m, 2 m))
    robot gambler {{
        body = disc(10 cm)
        drive = holonomic(max_speed = 1 m/s, max_turn = 1 rad/s)
    }}
}}
state up: bool = false
state fell: bool = false
event landed = success(wait)
event heads = up and fell
event tails = not up and fell
on landed {{
    up = chance({chance})
    fell = true
}}
predicate has_fallen = fell
task toss {{
    observe has_fallen
    choose wait
    end on heads
    end on tails
    end after 1 min
    reward {{
        on heads: 1
        on tails: -1
    }}
}}
learn toss {{ episodes = 40 }}
tree hand for toss = wait
claim {claim}"
    )
}

/// What is said of a claim on the tree by hand.
fn coin(chance: &str, claim: &str) -> (Answer, String) {
    let text = toss(chance, &format!("hand {claim}"));
    let loaded = load("coin.bt", text.into_bytes(), &mut NoFiles);
    assert!(!loaded.has_errors(), "{}", shown(&loaded));
    let [proved] = verify::claims(&loaded).unwrap().try_into().unwrap();
    (proved.answer, proved.text)
}

#[test]
fn claims_are_decided_as_soon_as_the_episodes_say_so() {
    let cases = [
        ("50%", "never tails with probability >= 95%", Answer::Fails),
        ("50%", "never tails with probability >= 20%", Answer::Holds),
        (
            "90%",
            "reaches heads within 10 s with probability >= 80%",
            Answer::Holds,
        ),
        (
            "90%",
            "reaches heads within 10 s with probability >= 90%",
            Answer::Undecided,
        ),
        ("90%", "never tails", Answer::Fails),
        ("100%", "never tails", Answer::Holds),
        (
            "100%",
            "never tails with probability >= 99.9%",
            Answer::Holds,
        ),
        (
            "100%",
            "reaches heads within 1 s with probability >= 50%",
            Answer::Fails,
        ),
    ];
    let mut told = String::new();
    for (chance, claim, expected) in cases {
        let (answer, text) = coin(chance, claim);
        assert_eq!(answer, expected, "{text}");
        told.push_str(&format!("{chance} heads\n{text}\n\n"));
    }
    crate::snapshot::check("claims", told.trim_end());
}

/// A learned tree that breaks a claim shows how, and the command that shows the whole of it plays that very episode.
#[test]
fn a_claim_on_a_learned_tree_shows_the_run_in_which_it_fails() {
    let folder = tempfile::tempdir().unwrap();
    let text = toss("50%", "learned never tails");
    std::fs::write(folder.path().join("coin.bt"), text).unwrap();
    let learned = btc(folder.path(), &["learn", "coin.bt", "-o", "out"]);
    assert_eq!(learned.status.code(), Some(1), "{}", err(&learned));
    let told = err(&learned);
    let (_, shown) = told.split_once("shown by `btc ").unwrap();
    let (command, lines) = shown.split_once("`:\n").unwrap();
    assert!(command.starts_with("run out/learned.bt --tree learned --episode "));
    assert!(lines.contains("tails"), "{lines}");
    let arguments: Vec<&str> = command.split(' ').collect();
    let traced = btc(folder.path(), &arguments);
    assert!(out(&traced).contains("tails"), "{}", out(&traced));
}
