//! Every link of every page of the repository leads to a file, and to a heading in it.

use super::pages::{Page, blocks, files, pages, root};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The text of a page without its blocks, and without code in its lines.
fn prose(text: &str) -> String {
    let mut rest = text.to_owned();
    for block in blocks(text).iter().rev() {
        rest.replace_range(block.at..block.at + block.text.len(), "");
    }
    let line = |line: &str| {
        // Between backquotes stands every second part. Names in backquotes themselves stand between two.
        let line = line.replace("`` ", "`").replace(" ``", "`");
        let parts: Vec<&str> = line.split('`').step_by(2).collect();
        parts.join("``") + "\n"
    };
    rest.lines().map(line).collect()
}

/// Where the links and the pictures of a page lead.
fn targets(text: &str) -> Vec<String> {
    let prose = prose(text);
    let parts = prose.split("](").skip(1);
    let target = |part: &str| part.split([')', ' ']).next().unwrap().to_owned();
    parts.map(target).collect()
}

/// The anchor of a heading, as GitHub and mdBook make it.
fn anchor(heading: &str) -> String {
    let kept = heading.trim().to_lowercase();
    let kept = kept
        .chars()
        .filter(|c| c.is_alphanumeric() || " -_".contains(*c));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

/// The anchors of a page.
fn anchors(text: &str) -> BTreeSet<String> {
    let mut rest = text.to_owned();
    for block in blocks(text).iter().rev() {
        rest.replace_range(block.at..block.at + block.text.len(), "");
    }
    let mut met: BTreeMap<String, usize> = BTreeMap::new();
    let headings = rest.lines().filter_map(|line| {
        let heading = line.trim_start_matches('#');
        (heading.len() < line.len()).then(|| heading.strip_prefix(' '))?
    });
    let mut found = BTreeSet::new();
    for heading in headings {
        let anchor = anchor(heading);
        let before = met.entry(anchor.clone()).or_default();
        found.insert(match before {
            0 => anchor,
            _ => format!("{anchor}-{before}"),
        });
        *before += 1;
    }
    found
}

/// A path without `.` and `..`.
fn straight(path: &Path) -> PathBuf {
    let mut straight = PathBuf::new();
    for part in path.components() {
        match part.as_os_str().to_str().unwrap() {
            "." => {}
            ".." => assert!(straight.pop(), "{}", path.display()),
            _ => straight.push(part),
        }
    }
    straight
}

/// What is wrong with the links of a page.
fn wrong(path: &Path) -> Vec<String> {
    let text = fs::read_to_string(path).unwrap();
    let shown = path.strip_prefix(root("")).unwrap().display();
    let mut wrong = Vec::new();
    for target in targets(&text) {
        if target.contains("://") || target.starts_with("mailto:") {
            continue;
        }
        let (file, heading) = target.split_once('#').unwrap_or((&target, ""));
        let file = match file {
            "" => path.to_owned(),
            file => straight(&path.parent().unwrap().join(file)),
        };
        if !file.exists() {
            wrong.push(format!("{shown}: ({target}) leads to no file"));
        } else if !heading.is_empty()
            && !anchors(&fs::read_to_string(&file).unwrap()).contains(heading)
        {
            wrong.push(format!("{shown}: ({target}) leads to no heading"));
        }
    }
    wrong
}

#[test]
fn links_lead_somewhere() {
    let mut all = files(&root(""), ".md");
    // The explanations are for a terminal.
    all.retain(|path| !path.starts_with(root("src")));
    assert!(all.len() > 40, "{}", all.len());
    let wrong: Vec<String> = all.iter().flat_map(|path| wrong(path)).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// mdBook takes every link to an `.md` for one to a page of its own.
#[test]
fn the_book_links_no_page_outside() {
    for Page { name, text } in pages() {
        for target in targets(&text) {
            let file = target.split('#').next().unwrap();
            let from = root("docs/book/src").join(&name);
            let inside = straight(&from.parent().unwrap().join(file));
            assert!(
                target.contains("://")
                    || !file.ends_with(".md")
                    || inside.starts_with(root("docs/book/src")),
                "{name}: {target}"
            );
        }
    }
}

/// Each page stands once in the table of contents, under its own title.
#[test]
fn the_summary_lists_every_page() {
    let mut all = pages();
    let at = all.iter().position(|page| page.name == "SUMMARY.md");
    let summary = all.remove(at.expect("a table of contents")).text;
    let mut listed = BTreeMap::new();
    for line in summary.lines().filter(|line| line.contains("](")) {
        let (title, rest) = line.split_once("](").unwrap();
        let title = title.split_once('[').unwrap().1;
        let twice = listed.insert(rest.trim_end_matches(')'), title);
        assert!(twice.is_none(), "{line}");
    }
    for page in &all {
        let title = page.text.lines().find_map(|line| line.strip_prefix("# "));
        let listed = listed.get(page.name.as_str()).copied();
        assert_eq!(listed, title, "{}", page.name);
    }
    assert_eq!(listed.len(), all.len());
}
