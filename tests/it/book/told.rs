//! The programs that pages show, and what they have commands print.
//!
//! The words of a block say what it is:
//!
//! - `KIND NAME` with a dot in the name: a file, which the commands below find under this name;
//! - `bt in NAME`: items that take the places of those with the same first two words in that file, or are added to it;
//! - `bt from NAME`: what stands in that file;
//! - `console`: commands, `$ …`, each with all that it prints. A line `…` stands for any number of lines.
//!
//! The commands of a page run in a folder of their own, in which `examples/` is. `cd` lasts to the end of the page. The
//! pictures of a page that a command has written to the last folder are those of the book.

use super::pages::{Block, Page, blocks, files, hold, pages, root};
use btc::driver::Text;
use btc::driver::format::format;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Exchanges items of a program.
fn exchange(program: &str, items: &str) -> String {
    let mut text = program.to_owned();
    let heads = |line: &str| line.starts_with(|c: char| c.is_ascii_alphabetic());
    let mut lines = items.split_inclusive('\n').peekable();
    let mut docs = String::new();
    while let Some(line) = lines.next() {
        if !heads(line) {
            docs.push_str(line);
            continue;
        }
        let mut item = std::mem::take(&mut docs).trim_start().to_owned() + line;
        while let Some(more) = lines.next_if(|next| !heads(next) && !next.starts_with("///")) {
            item.push_str(more);
        }
        let item = item.trim_end().to_owned() + "\n";
        let words: Vec<&str> = line.split(' ').take(2).collect();
        let head = words.join(" ").trim_end_matches('(').to_owned() + " ";
        match place(&text, &head) {
            Some(place) => text.replace_range(place, &item),
            None => text = format!("{}\n\n{item}", text.trim_end()),
        }
    }
    text
}

/// Where the item stands that begins so.
fn place(text: &str, head: &str) -> Option<std::ops::Range<usize>> {
    let begin = match text.starts_with(head) {
        true => 0,
        false => text.find(&format!("\n{head}"))? + 1,
    };
    let line = begin + text[begin..].find('\n')? + 1;
    let ends = text[begin..line].trim_end().ends_with('{');
    let end = match ends {
        true => line + text[line..].find("\n}\n")? + "\n}\n".len(),
        false => line,
    };
    Some(begin..end)
}

/// The shown output, if the told one is it; else what is to be shown.
fn agreed(shown: &str, told: &str) -> Result<(), String> {
    let Some((head, tail)) = shown.split_once("…\n") else {
        return match shown == told {
            true => Ok(()),
            false => Err(told.to_owned()),
        };
    };
    if told.len() >= head.len() + tail.len() && told.starts_with(head) && told.ends_with(tail) {
        return Ok(());
    }
    let lines: Vec<&str> = told.split_inclusive('\n').collect();
    let (first, last) = (head.lines().count(), tail.lines().count());
    match lines.len() > first + last {
        true => {
            let last = &lines[lines.len() - last..];
            Err(format!("{}…\n{}", lines[..first].concat(), last.concat()))
        }
        false => Err(told.to_owned()),
    }
}

/// The folder of a page.
struct Folder {
    all: tempfile::TempDir,
    /// Where commands run.
    at: PathBuf,
}

impl Folder {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let (bin, examples) = (folder.path().join(".bin"), folder.path().join("examples"));
        fs::create_dir(&bin).unwrap();
        fs::create_dir(&examples).unwrap();
        let btc = std::env::var_os("BTC").unwrap_or_else(|| env!("CARGO_BIN_EXE_btc").into());
        symlink(root(btc.to_str().unwrap()), bin.join("btc")).unwrap();
        for ending in [".bt", ".csv"] {
            for path in files(&root("examples"), ending) {
                fs::copy(&path, examples.join(path.file_name().unwrap())).unwrap();
            }
        }
        Self {
            at: folder.path().to_owned(),
            all: folder,
        }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.all.path().join(name)
    }

    /// What a command prints, on both outputs.
    fn told(&mut self, command: &str) -> String {
        if let Some(folder) = command.strip_prefix("cd ") {
            self.at.push(folder);
            return String::new();
        }
        let log = self.path(".bin/log");
        let file = fs::File::create(&log).unwrap();
        let path = std::env::var("PATH").unwrap();
        let bin = self.path(".bin");
        Command::new("sh")
            .args(["-c", command])
            .current_dir(&self.at)
            .env("PATH", format!("{}:{path}", bin.display()))
            .env("COLUMNS", "100")
            .stdin(Stdio::null())
            .stdout(file.try_clone().unwrap())
            .stderr(file)
            .status()
            .unwrap();
        fs::read_to_string(log).unwrap()
    }
}

/// The commands of a block, each with what is shown below it.
fn commands<'a>(block: &Block<'a>) -> Vec<(&'a str, &'a str)> {
    let mut found = Vec::new();
    let mut rest = block.text;
    while let Some(after) = rest.strip_prefix("$ ") {
        let mut end = after.find('\n').unwrap();
        while after[..end].ends_with('\\') {
            end += 1 + after[end + 1..].find('\n').unwrap();
        }
        let below = &after[end + 1..];
        let next = match below.starts_with("$ ") {
            true => 0,
            false => below.find("\n$ ").map_or(below.len(), |at| at + 1),
        };
        found.push((&after[..end], &below[..next]));
        rest = &below[next..];
    }
    assert!(rest.is_empty(), "line {}: no command", block.line);
    found
}

/// The page as it should be: with all that its commands print today.
fn today(page: &Page) -> String {
    let mut folder = Folder::new();
    let mut text = String::new();
    let mut taken = 0;
    for block in blocks(&page.text) {
        let words: Vec<&str> = block.info.split(' ').collect();
        match words.as_slice() {
            ["bt", "in", name] => {
                let path = folder.path(name);
                let before = fs::read_to_string(&path).unwrap();
                let after = exchange(&before, block.text);
                fs::write(&path, after).unwrap();
            }
            ["bt", "from", name] => {
                let program = fs::read_to_string(folder.path(name)).unwrap();
                assert!(
                    program.contains(block.text),
                    "{name} has no\n{}",
                    block.text
                );
            }
            [_, name] if name.contains('.') => {
                fs::write(folder.path(name), block.text).unwrap();
            }
            ["console"] => {
                text.push_str(&page.text[taken..block.at]);
                taken = block.at + block.text.len();
                for (command, shown) in commands(&block) {
                    let told = folder.told(command);
                    let told = match agreed(shown, &told) {
                        Ok(()) => shown.to_owned(),
                        Err(told) => told,
                    };
                    text.push_str(&format!("$ {command}\n{told}"));
                }
            }
            _ => {}
        }
    }
    pictures(page, &folder);
    text + &page.text[taken..]
}

/// Holds the pictures of a page against those that its commands have written.
fn pictures(page: &Page, folder: &Folder) {
    let shown = page.text.split("![").skip(1);
    for shown in shown.filter_map(|shown| shown.split_once("](")?.1.split(')').next()) {
        if let Ok(picture) = fs::read_to_string(folder.at.join(shown)) {
            let beside = Path::new(&page.name).parent().unwrap().join(shown);
            hold(&format!("docs/book/src/{}", beside.display()), &picture);
        }
    }
}

/// Whether a page has commands that take their time.
fn is_slow(page: &Page) -> bool {
    let consoles = blocks(&page.text);
    let consoles = consoles.iter().filter(|block| block.info == "console");
    let mut commands = consoles.flat_map(commands).map(|(command, _)| command);
    let takes = ["btc learn", "btc tune", "btc suggest", "--episodes 1000"];
    commands.any(|command| takes.iter().any(|word| command.contains(word)))
}

fn commands_print_what_is_shown(slow: bool) {
    let pages = pages().into_iter().filter(|page| is_slow(page) == slow);
    let has = |page: &Page| blocks(&page.text).iter().any(|b| b.info == "console");
    let pages: Vec<Page> = pages.filter(has).collect();
    assert!(pages.len() > 2);
    for page in pages {
        hold(&format!("docs/book/src/{}", page.name), &today(&page));
    }
}

#[test]
fn quick_commands_print_what_is_shown() {
    commands_print_what_is_shown(false);
}

/// `BTC` may name a binary that was built with optimisation.
#[test]
#[ignore = "learns, which takes half a minute"]
fn slow_commands_print_what_is_shown() {
    commands_print_what_is_shown(true);
}

/// A program of a page is laid out as `btc fmt` does it; those of the language have tests of their own.
#[test]
fn programs_are_laid_out() {
    let pages = pages();
    let pages = pages
        .iter()
        .filter(|page| !page.name.starts_with("language") && !page.text.contains("<!-- Made by"));
    for page in pages {
        for block in blocks(&page.text) {
            let words: Vec<&str> = block.info.split(' ').collect();
            if words[0] != "bt" {
                continue;
            }
            let text = format(Text {
                name: "page.bt",
                bytes: block.text.as_bytes(),
            });
            let place = format!("{}:{}", page.name, block.line);
            assert_eq!(text.expect(&place), block.text, "{place}");
            assert!(
                words.len() > 1 || page.name == "paper.md",
                "{place}: which file is it?"
            );
        }
    }
}
