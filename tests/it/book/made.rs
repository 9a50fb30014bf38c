//! The pages that are made of something else: the grammar, the library, the explanations, the help.

use super::pages::hold;
use btc::diagnostic::Code;
use std::fmt::Write;

/// A page, with the remark of where it is from.
fn page(name: &str, title: &str, source: &str, text: &str) {
    let text = format!("# {title}\n\n<!-- Made by a test from {source}. -->\n\n{text}");
    hold(
        &format!("docs/book/src/{name}.md"),
        &format!("{}\n", text.trim_end()),
    );
}

/// The text of the lines that begin with a mark.
fn marked<'a>(text: &'a str, mark: &str) -> Vec<&'a str> {
    let lines = text.lines().filter_map(|line| line.strip_prefix(mark));
    lines.map(str::trim).collect()
}

#[test]
fn the_grammar() {
    let source = include_str!("../../../grammar/bt.pest");
    let mut text = marked(source, "//!").join("\n") + "\n";
    text.push_str(
        "\nThe notation is that of [pest](https://pest.rs/book/grammars/syntax.html): `~` is a sequence, `|` an ordered choice, \
         `!` and `&` look ahead,\nand a rule with `@` or `$` has no blanks between its parts.\n",
    );
    let mut sections = source.split("\n// ---- ");
    let head = sections.next().unwrap();
    let rules = head.lines().filter(|line| !line.starts_with("//!"));
    let rules: Vec<&str> = rules.collect();
    let block = |text: &str| format!("\n```pest\n{}\n```\n", text.trim_matches('\n'));
    text.push_str(&block(&rules.join("\n")));
    for section in sections {
        let (title, rules) = section.split_once('\n').unwrap();
        let (first, rest) = title.split_at(1);
        let (rest, remark) = rest.split_once("; ").unwrap_or((rest, ""));
        write!(text, "\n## {}{rest}\n", first.to_uppercase()).unwrap();
        if !remark.is_empty() {
            let (first, rest) = remark.split_at(1);
            write!(text, "\n{}{rest}.\n", first.to_uppercase()).unwrap();
        }
        text.push_str(&block(rules));
    }
    page("grammar", "The grammar", "`grammar/bt.pest`", &text);
}

#[test]
fn the_library() {
    let source = include_str!("../../../src/library/std.bt");
    let mut text = marked(source, "//!").join("\n") + "\n";
    text.push_str(
        "\n`use std` brings what stands here. [Behaviours](language/behaviours.md#the-standard-library) has a table of it.\n",
    );
    // An item is what stands between two empty lines with a doc comment at its head.
    let items = source.split("\n\n").filter(|item| item.starts_with("///"));
    let sections = [("let ", "Shared expressions"), ("behavior ", "Behaviours")];
    let mut held = 0;
    for (kind, title) in sections {
        write!(text, "\n## {title}\n").unwrap();
        for item in items.clone() {
            let docs = marked(item, "///").join("\n");
            let code: Vec<&str> = item.lines().filter(|l| !l.starts_with("///")).collect();
            let Some(rest) = code[0].strip_prefix(kind) else {
                continue;
            };
            let name = rest.split([' ', '(']).next().unwrap();
            write!(text, "\n### {name}\n\n{docs}\n\n").unwrap();
            write!(text, "```bt\n{}\n```\n", code.join("\n").trim_end()).unwrap();
            held += 1;
        }
    }
    let declared = source
        .lines()
        .filter(|line| line.starts_with("behavior ") || line.starts_with("let "));
    assert_eq!(held, declared.count(), "each has a doc comment");
    page(
        "library",
        "The standard library",
        "`src/library/std.bt`",
        &text,
    );
}

/// What the first four characters of codes stand for, with the page for them.
const KINDS: [(&str, &str, &str); 8] = [
    ("E01", "syntax", "Mistakes of syntax"),
    ("E02", "names", "Mistakes of names and files"),
    ("E03", "types", "Mistakes of types and units"),
    ("E04", "worlds", "Mistakes of worlds"),
    ("E05", "tasks", "Mistakes of tasks and learners"),
    ("E06", "trees", "Mistakes of trees, claims and tests"),
    ("E08", "tables", "Mistakes of tables, PLAs and exports"),
    ("W", "warnings", "Warnings"),
];

#[test]
fn the_diagnostics() {
    let mut index = String::from(
        "What `btc explain CODE` says of each code. A code that begins with E is a mistake: nothing runs before it is mended. \
         One that begins\nwith W is a warning.\n",
    );
    let mut held = 0;
    for (mark, name, title) in KINDS {
        write!(index, "\n## {title}\n\n| code | says |\n| --- | --- |\n").unwrap();
        let mut text = String::new();
        for code in Code::ALL
            .iter()
            .filter(|code| code.name().starts_with(mark))
        {
            let explained = code.explanation().strip_prefix("# ").unwrap();
            let heading = explained.lines().next().unwrap();
            let kept = |c: &char| c.is_alphanumeric() || " -_".contains(*c);
            let anchor: String = heading.to_lowercase().chars().filter(kept).collect();
            let anchor = anchor.replace(' ', "-");
            writeln!(
                index,
                "| [{code}](diagnostics/{name}.md#{anchor}) | {} |",
                code.title()
            )
            .unwrap();
            write!(text, "## {}\n\n", explained.trim_end()).unwrap();
            held += 1;
        }
        page(
            &format!("diagnostics/{name}"),
            title,
            "`src/diagnostic/explain/`",
            &text,
        );
    }
    assert_eq!(held, Code::ALL.len(), "each code has its page");
    page(
        "diagnostics",
        "Diagnostics",
        "`src/diagnostic/explain/`",
        &index,
    );
}

#[test]
fn the_commands() {
    let help = |arguments: &[&str]| {
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_btc"))
            .args(arguments)
            .env("COLUMNS", "84")
            .output()
            .unwrap();
        String::from_utf8(output.stdout).unwrap()
    };
    let all = help(&["--help"]);
    let listed = all.split("Commands:\n").nth(1).unwrap();
    let listed = listed.split("\n\n").next().unwrap();
    let names = listed
        .lines()
        .filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    let names = names.filter(|name| !name.is_empty() && *name != "help");
    let mut text = String::from(
        "What `btc help COMMAND` says. `-` in the place of a file is standard input, and as an output standard output. Exit codes: \
         0 for\nsuccess, 1 for mistakes in the input or a claim that does not hold, 2 for a bad command line, 3 for a claim that \
         is undecided, 128\nand the number of the signal for a run that a signal ended.\n\n\
         `btc completions bash` prints what makes a shell complete commands and options, here Bash; fish, zsh, Elvish and PowerShell \
         have theirs:\n\n\
         ```sh\nbtc completions bash > ~/.local/share/bash-completion/completions/btc\n```\n\n\
         `btc man` writes manual pages, one for each command:\n\n\
         ```sh\nbtc man -o ~/.local/share/man/man1 && man btc-learn\n```\n",
    );
    let common = all.split("\n\nOptions:\n").nth(1).unwrap().trim_end();
    write!(
        text,
        "\nEvery command takes these options:\n\n```text\n{common}\n```\n"
    )
    .unwrap();
    for name in names {
        let said = help(&["help", name]);
        let (does, rest) = said.split_once("\n\n").unwrap();
        // Those of every command stand last.
        let own = rest.split("      --threads <N>").next().unwrap().trim_end();
        let own = own.strip_suffix("Options:").unwrap_or(own);
        write!(
            text,
            "\n## btc {name}\n\n{does}\n\n```text\n{}\n```\n",
            own.trim_end()
        )
        .unwrap();
    }
    page("commands", "Commands", "the program's own help", &text);
}
