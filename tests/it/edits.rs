//! One slip, one message: single edits of sound programs, by seed.

use crate::program::NoFiles;
use crate::robust::Dice;
use btc::diagnostic::Diagnostic;
use btc::driver::load::load;
use std::path::Path;

/// The sound programs that use no other files.
fn programs() -> Vec<String> {
    let mut programs = Vec::new();
    for folder in [
        "examples",
        "tests/worlds",
        "tests/worlds/traps",
        "tests/cases",
        "tests/cases/world",
        "tests/cases/export",
    ] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        let mut files: Vec<_> = std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .filter(|path| path.extension().is_some_and(|extension| extension == "bt"))
            .collect();
        files.sort();
        programs.extend(
            files
                .iter()
                .map(|path| std::fs::read_to_string(path).unwrap()),
        );
    }
    programs
}

/// Words, numbers and marks, with what stands between them.
fn tokens(text: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let word = |c: char| c.is_alphanumeric() || c == '_';
        let until = |ends: &dyn Fn(char) -> bool| rest.find(ends).unwrap_or(rest.len());
        let length = if rest.starts_with("//") {
            until(&|c| c == '\n')
        } else if word(first) {
            until(&|c| !word(c))
        } else if first.is_whitespace() {
            until(&|c| !c.is_whitespace())
        } else {
            first.len_utf8()
        };
        let (token, after) = rest.split_at(length);
        tokens.push(token);
        rest = after;
    }
    tokens
}

/// The text with one token or one character deleted, doubled or replaced, and what was done.
fn edited(text: &str, dice: &mut Dice) -> (String, String) {
    let mut tokens = tokens(text);
    let code: Vec<usize> = (0..tokens.len())
        .filter(|at| !tokens[*at].trim().is_empty() && !tokens[*at].starts_with("//"))
        .collect();
    let at = code[dice.roll(code.len())];
    let old = tokens[at];
    let letters: Vec<char> = old.chars().collect();
    let letter = dice.roll(letters.len());
    let with = |new: &str| {
        let before: String = letters[..letter].iter().collect();
        let after: String = letters[letter + 1..].iter().collect();
        format!("{before}{new}{after}")
    };
    let other: Vec<char> = "abcxyz019(){}=:,+-.%\"`#'é".chars().collect();
    let new = match dice.roll(6) {
        0 => String::new(),
        1 => format!("{old} {old}"),
        2 => tokens[code[dice.roll(code.len())]].to_owned(),
        3 => with(""),
        4 => with(&format!("{0}{0}", letters[letter])),
        _ => with(&other[dice.roll(other.len())].to_string()),
    };
    tokens[at] = &new;
    let line = tokens[..at].concat().lines().count();
    (
        tokens.concat(),
        format!("line {line}: `{old}` became `{new}`"),
    )
}

#[test]
fn one_slip_is_one_message() {
    let programs = programs();
    let texts: Vec<&str> = programs.iter().map(String::as_str).collect();
    let mut dice = Dice(0x2545_f491_4f6c_dd1d);
    let (mut wrong, mut single) = (0, 0);
    let mut many = Vec::new();
    for _ in 0..700 {
        let (text, edit) = edited(dice.pick(&texts), &mut dice);
        let loaded = load("edited.bt", text.into(), &mut NoFiles);
        let errors = loaded.diagnostics.iter().filter(|found| found.is_error());
        let told: Vec<&Diagnostic> = errors.collect();
        wrong += usize::from(!told.is_empty());
        single += usize::from(told.len() == 1);
        if told.len() > 3 {
            let messages = told.iter().map(|found| found.message.clone());
            many.push((edit, messages.collect::<Vec<_>>()));
        }
    }
    assert!(many.is_empty(), "more than three messages: {many:#?}");
    assert!(wrong > 500, "{wrong} edits were mistakes");
    assert!(
        100 * single >= 95 * wrong,
        "{single} of {wrong} mistakes were one message"
    );
}
