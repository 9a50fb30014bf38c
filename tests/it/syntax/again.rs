//! A text that changes has the tree that it would have if it were parsed for the first time.

use crate::robust::Dice;
use btc::diagnostic::Diagnostic;
use btc::source::FileId;
use btc::syntax::{Memory, parse};
use std::path::Path;

/// Programs of many lines, some with mistakes in them.
fn programs() -> Vec<String> {
    let folders = [
        "examples",
        "tests/worlds",
        "tests/cases/run",
        "tests/cases/slips",
        "tests/cases/check",
    ];
    let mut programs = Vec::new();
    for folder in folders {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        let files = std::fs::read_dir(folder).unwrap();
        let mut files: Vec<_> = files.map(|entry| entry.unwrap().path()).collect();
        files.retain(|path| path.extension().is_some_and(|extension| extension == "bt"));
        files.sort();
        programs.extend(
            files
                .iter()
                .map(|path| std::fs::read_to_string(path).unwrap()),
        );
    }
    programs
}

/// A place of the text, between two characters.
fn place(text: &str, dice: &mut Dice) -> usize {
    let mut at = dice.roll(text.len() + 1);
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// The first byte of a line.
fn line(text: &str, dice: &mut Dice) -> usize {
    let at = place(text, dice);
    text[..at].rfind('\n').map_or(0, |at| at + 1)
}

/// Changes a text as someone does who writes: characters, lines, brackets, pieces of other programs.
fn edit(text: &mut String, other: &str, dice: &mut Dice) {
    let typed = [
        "x",
        "{",
        "}",
        "(",
        ")",
        "\n",
        "\"",
        "`",
        "//",
        "/// said\n",
        ",",
        "=",
        " ",
        "?",
        "é",
        "state s: number = 0\n",
        "on x {\n",
        "let ",
        "each tick {\n",
        "use std\n",
        "tree ",
    ];
    match dice.roll(6) {
        0 | 1 => text.insert_str(place(text, dice), typed[dice.roll(typed.len())]),
        2 => text.insert_str(line(text, dice), typed[dice.roll(typed.len())]),
        3 => {
            let at = place(text, dice);
            if let Some(letter) = text[at..].chars().next() {
                text.replace_range(at..at + letter.len_utf8(), "");
            }
        }
        4 => {
            let (one, two) = (line(text, dice), line(text, dice));
            let end = two.max(one).min(one.min(two) + 200);
            let end = text[..end].rfind('\n').map_or(one.min(two), |at| at + 1);
            text.replace_range(one.min(two)..end.max(one.min(two)), "");
        }
        _ => {
            let (from, to) = (line(other, dice), line(other, dice));
            let piece = &other[from.min(to)..from.max(to)];
            let piece: String = piece.split_inclusive('\n').take(12).collect();
            text.insert_str(line(text, dice), &piece);
        }
    }
}

#[test]
fn a_changed_text_is_parsed_as_a_new_one() {
    let programs = programs();
    let mut dice = Dice(0x51ed_270b_9a3c_11ef);
    for round in 0..60 {
        let mut text = programs[dice.roll(programs.len())].clone();
        let mut memory = Memory::default();
        let mut before = text.clone();
        memory.parse("a.bt", FileId(0), &text);
        for step in 0..25 {
            if dice.roll(4) == 0 {
                std::mem::swap(&mut text, &mut before);
            } else {
                before.clone_from(&text);
                let other = &programs[dice.roll(programs.len())];
                edit(&mut text, other, &mut dice);
            }
            let again = memory.parse("a.bt", FileId(0), &text);
            let anew = parse(FileId(0), &text);
            let why = || {
                let told = |found: &[Diagnostic]| {
                    let told = found.iter().map(|it| (it.span(), it.message.clone()));
                    told.collect::<Vec<_>>()
                };
                let ((a, x), (b, y)) = (&again, &anew);
                format!("{:#?}", [(&a.lost, told(x)), (&b.lost, told(y))])
            };
            assert!(
                again == anew,
                "round {round}, step {step}: {}\n{text}",
                why()
            );
        }
    }
}
