//! What the crate is built with: licences, sources and versions, held against `deny.toml`, which `cargo deny check` reads too.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

/// A package as `cargo tree` lists it.
struct Package {
    name: String,
    version: String,
    /// Where it is from, if that is not crates.io.
    source: Option<String>,
    licence: String,
}

/// The packages that are built here.
fn packages(edges: &str) -> Vec<Package> {
    let output = Command::new(env!("CARGO"))
        .args(["tree", "--locked", "--offline", "--all-features"])
        .args(["--prefix", "none", "--format", "{p}|{l}", "--edges", edges])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    let text = String::from_utf8(output.stdout).unwrap();
    // What has been listed above with what it needs has a mark.
    let lines = text.lines().map(|line| line.trim_end_matches(" (*)"));
    let lines: BTreeSet<&str> = lines.filter(|line| !line.is_empty()).collect();
    lines.into_iter().map(package).collect()
}

fn package(line: &str) -> Package {
    let (package, licence) = line.split_once('|').unwrap();
    let mut words = package.splitn(3, ' ');
    let mut word = || words.next().map(str::to_owned);
    let (name, version) = (word().unwrap(), word().unwrap());
    let source = word().filter(|source| source != "(proc-macro)");
    Package {
        name,
        version,
        source,
        licence: licence.to_owned(),
    }
}

/// The words of a list in `deny.toml`.
fn list(name: &str) -> BTreeSet<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("deny.toml");
    let text = std::fs::read_to_string(path).unwrap();
    let (_, rest) = text.split_once(&format!("\n{name} = [")).unwrap();
    let (inside, _) = rest.split_once("\n]").unwrap();
    let words: BTreeSet<String> = inside
        .split('"')
        .skip(1)
        .step_by(2)
        .map(str::to_owned)
        .collect();
    assert!(!words.is_empty());
    words
}

/// Whether an expression of licences leaves a choice that is allowed.
fn is_allowed(expression: &str, allowed: &BTreeSet<String>) -> bool {
    let spaced = expression
        .replace('/', " OR ")
        .replace('(', " ( ")
        .replace(')', " ) ");
    let words: Vec<&str> = spaced.split_whitespace().collect();
    let mut at = 0;
    let answer = any(&words, &mut at, allowed);
    assert_eq!(at, words.len(), "{expression}");
    answer
}

fn any(words: &[&str], at: &mut usize, allowed: &BTreeSet<String>) -> bool {
    let mut answer = all(words, at, allowed);
    while words.get(*at) == Some(&"OR") {
        *at += 1;
        answer |= all(words, at, allowed);
    }
    answer
}

fn all(words: &[&str], at: &mut usize, allowed: &BTreeSet<String>) -> bool {
    let mut answer = one(words, at, allowed);
    while words.get(*at) == Some(&"AND") {
        *at += 1;
        answer &= one(words, at, allowed);
    }
    answer
}

fn one(words: &[&str], at: &mut usize, allowed: &BTreeSet<String>) -> bool {
    if words.get(*at) == Some(&"(") {
        *at += 1;
        let answer = any(words, at, allowed);
        assert_eq!(words.get(*at), Some(&")"));
        *at += 1;
        return answer;
    }
    let mut licence = words[*at].to_owned();
    *at += 1;
    if words.get(*at) == Some(&"WITH") {
        licence = format!("{licence} WITH {}", words[*at + 1]);
        *at += 2;
    }
    allowed.contains(&licence)
}

#[test]
fn have_licences_that_are_allowed() {
    let allowed = list("allow");
    let packages = packages("normal,build,dev");
    assert!(packages.len() > 50, "{}", packages.len());
    for found in packages {
        let licence = &found.licence;
        assert!(
            is_allowed(licence, &allowed),
            "{} has `{licence}`",
            found.name
        );
    }
}

#[test]
fn licences_are_read_as_expressions() {
    let allowed = BTreeSet::from([
        "MIT".to_owned(),
        "Apache-2.0 WITH LLVM-exception".to_owned(),
    ]);
    for (expression, answer) in [
        ("MIT", true),
        ("GPL-3.0", false),
        ("GPL-3.0 OR MIT", true),
        ("GPL-3.0/MIT", true),
        ("GPL-3.0 AND MIT", false),
        ("(GPL-3.0 OR MIT) AND MIT", true),
        ("Apache-2.0", false),
        ("Apache-2.0 WITH LLVM-exception AND MIT", true),
    ] {
        assert_eq!(is_allowed(expression, &allowed), answer, "{expression}");
    }
}

#[test]
fn are_from_the_registry() {
    for found in packages("normal,build,dev") {
        match found.name.as_str() {
            env!("CARGO_PKG_NAME") => assert!(found.source.is_some()),
            name => assert_eq!(found.source, None, "{name}"),
        }
    }
}

/// What ships has each package once, unless `deny.toml` lets it in twice.
#[test]
fn ship_in_one_version() {
    let let_in = list("skip");
    let mut versions: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for found in packages("normal") {
        versions.entry(found.name).or_default().push(found.version);
    }
    let twice = versions
        .into_iter()
        .filter(|(_, versions)| versions.len() > 1);
    let twice: BTreeSet<String> = twice.map(|(name, _)| name).collect();
    assert_eq!(twice, let_in);
}
