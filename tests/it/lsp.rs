//! The language server: conversations over standard input and output, one in each file of `tests/cases/lsp`, and texts
//! that are broken at any place.
//!
//! A conversation begins with files, each after `== NAME`; after `==` alone stand the steps, one a line. A place is a piece
//! of the text as it is then, with `|` at the cursor.

mod client;
mod nowhere;
mod shown;
mod whole;

use client::Client;
use serde_json::{Value, json};
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// The files of a case, and its steps.
fn parts(case: &str) -> (Vec<(String, String)>, Vec<String>) {
    let mut files: Vec<(String, String)> = Vec::new();
    let mut steps = Vec::new();
    let mut in_steps = false;
    for line in case.lines() {
        match line.strip_prefix("==") {
            Some("") => in_steps = true,
            Some(name) => files.push((name.trim().to_owned(), String::new())),
            None if in_steps && !line.is_empty() => steps.push(line.to_owned()),
            None if in_steps => {}
            None => {
                let (_, text) = files.last_mut().unwrap();
                text.push_str(line);
                text.push('\n');
            }
        }
    }
    (files, steps)
}

fn conversation(case: &str) -> String {
    let (files, steps) = parts(case);
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().canonicalize().unwrap();
    for (name, text) in &files {
        let path = root.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    let mut client = Client::new(&root);
    let mut shown = String::new();
    for step in steps {
        let answer = client.step(&step);
        writeln!(shown, "> {step}\n{}\n", shown::short(&answer, &root)).unwrap();
    }
    client.goodbye();
    shown.trim_end().to_owned()
}

#[test]
fn conversations() {
    crate::snapshot::settings().bind(|| {
        insta::glob!("..", "cases/lsp/*.lsp", |path| {
            let case = fs::read_to_string(path).unwrap();
            insta::assert_snapshot!("lsp", conversation(&case));
        });
    });
}

/// What the server says that it can do is what it answers to.
#[test]
fn it_answers_to_what_it_says_that_it_can_do() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().canonicalize().unwrap();
    fs::write(root.join("a.bt"), "use std\n").unwrap();
    let mut client = Client::new(&root);
    let mut able: Vec<String> = client
        .capabilities
        .as_object()
        .unwrap()
        .keys()
        .cloned()
        .collect();
    able.retain(|name| name.ends_with("Provider"));
    assert_eq!(able.len(), 17, "{able:?}");
    let unknown = client.request("textDocument/moniker", json!({}));
    assert_eq!(unknown["error"]["code"], -32601);
    let wrong = client.request("textDocument/hover", json!({ "textDocument": 3 }));
    assert_eq!(wrong["error"]["code"], -32602);
    let closed = client.request(
        "textDocument/hover",
        json!({ "textDocument": { "uri": "file:///not/open.bt" }, "position": { "line": 0, "character": 0 } }),
    );
    assert_eq!(closed["error"]["code"], -32602);
    for wrong in [
        json!({}),
        json!({ "command": "btc.tree", "arguments": [{ "uri": 3 }] }),
    ] {
        let refused = client.request("workspace/executeCommand", wrong);
        assert_eq!(refused["error"]["code"], -32602);
    }
    let unknown = client.request(
        "workspace/executeCommand",
        json!({ "command": "btc.dance" }),
    );
    assert_eq!(unknown["error"]["code"], -32803);
    client.notify("textDocument/didChange", json!({ "textDocument": 1 }));
    client.notify("$/unheard", Value::Null);
    client.step("open a.bt");
    client.goodbye();
}

/// A path of this repository.
fn repository(path: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}
