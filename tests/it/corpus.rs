//! What fuzzing has found, and what it begins with: the files of `fuzz/corpus/`.

use crate::laws;
use crate::laws::random::Random;
use btc::syntax::words;
use std::path::{Path, PathBuf};

/// The files of a corpus, by name.
fn corpus(target: &str) -> Vec<(PathBuf, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("fuzz/corpus")
        .join(target);
    let files = std::fs::read_dir(folder).unwrap();
    let mut files: Vec<_> = files.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    assert!(files.len() >= 10, "{} files", files.len());
    let read = |path: PathBuf| {
        let bytes = std::fs::read(&path).unwrap();
        (path, bytes)
    };
    files.into_iter().map(read).collect()
}

/// A file with one to four of its parts left out, doubled, changed, or taken from another.
fn mutant(bytes: &[u8], other: &[u8], random: &mut Random) -> Vec<u8> {
    let part = |of: &[u8], random: &mut Random| {
        let from = random.below(of.len() + 1);
        from..(from + 1 + random.below(12)).min(of.len())
    };
    let mut mutant = bytes.to_vec();
    for _ in 0..1 + random.below(4) {
        let at = part(&mutant, random);
        match random.below(4) {
            0 => drop(mutant.drain(at)),
            1 => {
                let doubled = mutant[at.clone()].to_vec();
                mutant.splice(at.start..at.start, doubled);
            }
            2 => {
                let taken = other[part(other, random)].to_vec();
                mutant.splice(at.start..at.start, taken);
            }
            _ => {
                if let Some(byte) = mutant.get_mut(at.start) {
                    *byte ^= 1 << random.below(8);
                }
            }
        }
    }
    mutant
}

/// There is a folder for each fuzz target, and a test below for each folder.
#[test]
fn every_target_has_a_corpus_and_a_test() {
    let fuzz = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz");
    let names = |folder: &str| {
        let entries = std::fs::read_dir(fuzz.join(folder)).unwrap();
        let mut names: Vec<String> = entries
            .map(|entry| {
                let path = entry.unwrap().path();
                path.file_stem().unwrap().to_str().unwrap().to_owned()
            })
            .collect();
        names.sort();
        names
    };
    let targets = names("fuzz_targets");
    assert_eq!(names("corpus"), targets);
    let tested = LAWS.map(|(name, _)| name);
    assert_eq!(targets, tested);
}

/// What the fuzz targets of programs are told to put together.
#[test]
fn the_dictionary_has_the_words_of_the_language() {
    let dictionary = include_str!("../../fuzz/bt.dict");
    // libFuzzer reads no others.
    assert!(dictionary.is_ascii());
    let nodes = words::NODES.map(|(word, _)| word);
    let answers = words::ANSWERS.map(|(word, _)| word);
    let all = [
        &words::ITEMS[..],
        &words::ASPECTS,
        &words::UNITS,
        &nodes,
        &answers,
    ];
    for word in all.concat() {
        let line = format!("\n\"{}\"\n", word.as_bytes().escape_ascii());
        assert!(dictionary.contains(&line), "`{word}` is missing");
    }
}

/// What holds of any bytes.
type Law = fn(&[u8]);

/// The laws, by the names of their targets.
const LAWS: [(&str, Law); 6] = [
    ("check", laws::check::holds),
    ("format", laws::format::holds),
    ("parse", laws::parse::holds),
    ("pla", laws::pla::holds),
    ("proof", laws::proof::holds),
    ("table", laws::table::holds),
];

#[test]
fn the_laws_hold_on_their_corpora() {
    for (target, holds) in LAWS {
        for (path, bytes) in corpus(target) {
            // What stands here when a law is broken is the name of the file.
            println!("{}", path.display());
            holds(&bytes);
        }
    }
}

/// A few mutants of each file, or as many as `BTC_MUTANTS` says.
#[test]
fn the_laws_hold_on_mutants_of_their_corpora() {
    let many = std::env::var("BTC_MUTANTS").map_or(3, |many| many.parse().unwrap());
    for (target, holds) in LAWS {
        let random = &mut Random::new(many);
        let files = corpus(target);
        for (path, bytes) in &files {
            for _ in 0..many {
                let (_, other) = &files[random.below(files.len())];
                let mutant = mutant(bytes, other, random);
                println!(
                    "a mutant of {}: {:?}",
                    path.display(),
                    mutant.escape_ascii().to_string()
                );
                holds(&mutant);
            }
        }
    }
}
