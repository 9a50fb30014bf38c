//! The colours of the book: what they hold for words of the language are its words.

use super::pages::root;
use std::collections::BTreeSet;
use std::fs;

/// The words in backquotes or quotes that stand in the rules of the grammar which are nothing but words.
fn words(grammar: &str) -> BTreeSet<&str> {
    let others = [
        "reserved",
        "known_word",
        "boolean",
        "std",
        "outcome",
        "answer",
        "factor_name",
    ];
    let mut found = BTreeSet::new();
    let mut inside = false;
    for line in grammar.lines() {
        if let Some((name, _)) = line.split_once('=').filter(|_| !line.starts_with(' ')) {
            let name = name.trim();
            inside = name.starts_with("kw_") || others.contains(&name);
        }
        if inside {
            let texts = line.split('"').skip(1).step_by(2);
            let word = |text: &&str| text.chars().all(|c| c.is_ascii_alphabetic());
            found.extend(texts.filter(|text| !text.is_empty()).filter(word));
        }
        inside &= !line.starts_with('}');
    }
    found
}

#[test]
fn the_words_of_the_language_are_coloured() {
    let grammar = include_str!("../../../grammar/bt.pest");
    let script = fs::read_to_string(root("docs/book/theme/bt.js")).unwrap();
    let lists = script.lines().filter_map(|line| {
        let (_, list) = line.split_once(": \"")?;
        list.strip_suffix("\",")
    });
    let coloured: Vec<&str> = lists.flat_map(|list| list.split(' ')).collect();
    let all: BTreeSet<&str> = coloured.iter().copied().collect();
    assert_eq!(
        all,
        words(grammar),
        "coloured (left), in the grammar (right)"
    );
    assert_eq!(coloured.len(), all.len(), "a word is listed twice");
}
