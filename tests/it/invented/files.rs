//! Programs that stand in several files mean what they mean in one.

use super::all;
use crate::program::shown;
use btc::driver::load::{Loaded, Reader, load};
use btc::driver::run::{Subject, run};
use btc::driver::trace::{Step, trace};
use std::collections::BTreeMap;

/// Files by name.
struct Files(BTreeMap<String, String>);

impl Reader for Files {
    fn read(&mut self, path: &str) -> Result<Vec<u8>, String> {
        let text = self.0.get(path).ok_or("there is no such file")?;
        Ok(text.clone().into())
    }
}

/// The words that begin an item at the margin.
const ITEMS: [&str; 14] = [
    "enum ",
    "world ",
    "state ",
    "let ",
    "predicate ",
    "behavior ",
    "event ",
    "each ",
    "on ",
    "task ",
    "tree ",
    "learn ",
    "claim ",
    "test ",
];

/// The items of a text, each with its comments.
fn items(text: &str) -> Vec<String> {
    let mut items: Vec<String> = Vec::new();
    let mut depth = 0_usize;
    let mut comments = String::new();
    for line in text.lines() {
        if depth == 0 && line.starts_with("///") {
            comments += line;
            comments.push('\n');
            continue;
        }
        if depth == 0 && ITEMS.iter().any(|word| line.starts_with(word)) {
            items.push(std::mem::take(&mut comments));
        }
        depth = depth + line.matches('{').count() - line.matches('}').count();
        if let Some(item) = items.last_mut() {
            *item += line;
            item.push('\n');
        }
    }
    items
}

/// The program with its first items in a file, the next ones in one that this is used by, and the rest in the main file.
fn parted(text: &str, seed: u64) -> Loaded {
    let items = items(text);
    let (first, second) = (
        seed as usize % items.len(),
        (seed as usize * 7) % items.len(),
    );
    let (first, second) = (first.min(second), first.max(second));
    let of = |range: std::ops::Range<usize>| items[range].concat();
    let mut files = Files(BTreeMap::from([
        (
            "parts/first.bt".to_owned(),
            format!("use std\n{}", of(0..first)),
        ),
        (
            "parts/second.bt".to_owned(),
            format!("use \"first.bt\"\nuse std\n{}", of(first..second)),
        ),
    ]));
    let main = format!(
        "use \"parts/second.bt\"\nuse std\nuse \"parts/first.bt\"\n{}",
        of(second..items.len())
    );
    load("invented.bt", main.into_bytes(), &mut files)
}

#[test]
fn they_mean_the_same_in_several_files() {
    all(|seed, text, whole, trees| {
        let parted = parted(text, seed);
        assert!(
            !parted.has_errors(),
            "seed {seed}\n{text}\n{}",
            shown(&parted)
        );
        for tree in trees {
            let [one, other] = [whole, &parted].map(|program| {
                let subject = Subject::tree(program, tree).unwrap();
                let traced = trace(program, &subject, 0..1, seed, Step::Decision)
                    .unwrap()
                    .csv();
                (
                    traced,
                    format!("{:?}", run(program, &subject, 2, seed).unwrap()),
                )
            });
            assert_eq!(one, other, "seed {seed}, {tree}\n{text}");
        }
    });
}
