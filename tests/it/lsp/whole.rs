//! The server without a connection: texts that are cut and broken at any place, and renaming of all that has a name.

use super::nowhere::Nowhere;
use super::repository;
use btc::driver::load::{Loaded, load};
use btc::lsp::Server;
use serde_json::{Value, json};
use std::fs;

const URI: &str = "file:///robots/a.bt";

fn opened(text: &str) -> Server<'static> {
    let mut server = Server::new(&Nowhere, &json!({}));
    open(&mut server, text);
    server
}

fn open(server: &mut Server, text: &str) {
    let item = json!({ "uri": URI, "languageId": "bt", "version": 1, "text": text });
    server.notice("textDocument/didOpen", json!({ "textDocument": item }));
}

/// Asks all that can be asked of a document and of a place in it.
fn ask_all(server: &mut Server, place: &Value) {
    let document = json!({ "uri": URI });
    let range = json!({ "start": place, "end": place });
    let options = json!({ "tabSize": 4, "insertSpaces": true });
    assert_eq!(server.told().len(), 1);
    for method in [
        "hover",
        "definition",
        "documentHighlight",
        "completion",
        "signatureHelp",
        "documentSymbol",
        "foldingRange",
        "semanticTokens/full",
        "inlayHint",
        "codeAction",
        "codeLens",
        "formatting",
        "rangeFormatting",
    ] {
        let params = json!({
            "textDocument": document, "position": place, "range": range, "options": options,
            "context": { "diagnostics": [], "triggerKind": 1, "isRetrigger": false },
        });
        let answer = server.answer(&format!("textDocument/{method}"), params);
        assert!(answer.is_ok(), "{method}: {answer:?}");
    }
    let tree = json!({ "uri": URI, "position": place });
    let command = json!({ "command": "btc.tree", "arguments": [tree] });
    let answer = server.answer("workspace/executeCommand", command);
    assert!(answer.is_ok(), "{answer:?}");
}

/// The line and the column of the end of a text.
fn end(text: &str) -> Value {
    let last = text.rsplit('\n').next().unwrap();
    let line = text.matches('\n').count();
    json!({ "line": line, "character": last.encode_utf16().count() })
}

#[test]
fn a_text_that_is_cut_anywhere_is_answered() {
    let text = fs::read_to_string(repository("tests/cases/slips/duel.bt")).unwrap();
    let text = text.replace("// ", "// größe 😀 ");
    let mut server = opened("");
    // Every seventh byte, so that the test stays short.
    for (at, _) in text.char_indices().filter(|(at, _)| at % 7 == 0) {
        let cut = &text[..at];
        let document = json!({ "uri": URI, "version": at });
        let changes = json!([{ "text": cut }]);
        server.notice(
            "textDocument/didChange",
            json!({ "textDocument": document, "contentChanges": changes }),
        );
        ask_all(&mut server, &end(cut));
    }
}

#[test]
fn a_text_that_is_broken_anywhere_is_answered() {
    let text = fs::read_to_string(repository("tests/cases/slips/kitchen.bt")).unwrap();
    let pieces = [
        "", "{", "}", "(", ")", "`", "\"", "😀", "\n", "//", "=", "choose ", "in ", "5 m", "\r\n",
        ",",
    ];
    let mut server = opened(&text);
    let mut random: u64 = 7;
    let mut next = |below: usize| {
        random = random
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((random >> 33) as usize) % below
    };
    let lines = text.lines().count() + 2;
    for version in 2..150 {
        if version % 25 == 0 {
            let document = json!({ "uri": URI, "version": version });
            let whole = json!({ "textDocument": document, "contentChanges": [{ "text": text }] });
            server.notice("textDocument/didChange", whole);
        }
        let place = json!({ "line": next(lines), "character": next(90) });
        let to = json!({ "line": place["line"], "character": place["character"].as_u64().unwrap() + next(4) as u64 });
        let change =
            json!({ "range": { "start": place, "end": to }, "text": pieces[next(pieces.len())] });
        let document = json!({ "uri": URI, "version": version });
        server.notice(
            "textDocument/didChange",
            json!({ "textDocument": document, "contentChanges": [change] }),
        );
        ask_all(&mut server, &place);
    }
}

/// What is offered above items are commands of the editor: one that has none is offered none.
#[test]
fn only_commands_that_the_editor_has_are_offered() {
    let text = fs::read_to_string(repository("examples/delivery_small.bt")).unwrap();
    let offered = |commands: Value| -> Vec<Value> {
        let options = json!({ "initializationOptions": { "commands": commands } });
        let mut server = Server::new(&Nowhere, &options);
        open(&mut server, &text);
        let params = json!({ "textDocument": { "uri": URI } });
        let lenses = server.answer("textDocument/codeLens", params).unwrap();
        let lenses = lenses.as_array().unwrap().iter();
        lenses
            .map(|lens| lens["command"]["command"].clone())
            .collect()
    };
    assert_eq!(offered(Value::Null), Vec::<Value>::new());
    assert_eq!(offered(json!(["btc.dance"])), Vec::<Value>::new());
    let shown = offered(json!(["btc.showTree"]));
    assert_eq!(
        shown,
        vec![json!("btc.showTree"); 2],
        "above the task and the tree"
    );
}

/// Each name of a program can be changed; the program is as sound as it was, and means the same.
#[test]
fn all_that_has_a_name_can_be_renamed() {
    for path in ["tests/cases/slips/kitchen.bt", "tests/cases/slips/duel.bt"] {
        let text = fs::read_to_string(repository(path)).unwrap();
        let load = |text: &str| -> Loaded { load("a.bt", text.into(), &mut Nowhere) };
        let before = load(&text);
        let errors = |loaded: &Loaded| loaded.diagnostics.len();
        assert_eq!(errors(&before), 0);
        let source = before.sources.get(before.main).unwrap();
        let mut renamed = 0;
        for (name, _) in before
            .meanings
            .declared()
            .filter(|(name, _)| name.file == before.main)
        {
            let mut server = opened(&text);
            let (line, character) = source.position_utf16(name.start);
            let place = json!({ "line": line, "character": character });
            let params = json!({ "textDocument": { "uri": URI }, "position": place, "newName": "fresh name" });
            let called = before.sources.text(name);
            let edit = match server.answer("textDocument/rename", params) {
                Ok(edit) => edit,
                // The library reads sensors by these names.
                Err(_) if matches!(called, "left" | "right") => continue,
                Err(why) => panic!("{path}: {called}: {why:?}"),
            };
            let edits = edit["changes"][URI].as_array().unwrap();
            let mut new = text.clone();
            for edit in edits.iter().rev() {
                let at = |place: &Value| {
                    let (line, column) = (&place["line"], &place["character"]);
                    let number = |it: &Value| it.as_u64().unwrap() as usize;
                    source.offset_utf16(number(line), number(column)) as usize
                };
                let range = at(&edit["range"]["start"])..at(&edit["range"]["end"]);
                new.replace_range(range, "`fresh name`");
            }
            let after = load(&new);
            let told = crate::program::shown(&after);
            assert!(!after.has_errors(), "{path}: {called}: {told}");
            assert_eq!(
                after.meanings.uses().count(),
                before.meanings.uses().count(),
                "{called}"
            );
            renamed += 1;
        }
        assert!(renamed > 30, "{renamed}");
    }
}

/// Of each line and column, the byte, and back: also beside characters of two and of four units.
#[test]
fn places_are_counted_in_utf_16() {
    let text = "a😀b\r\nü\n\n😀";
    let source = btc::source::Source::new("", text);
    // What ends a line is no place within it.
    let letters = text.char_indices();
    for (at, _) in letters.filter(|(_, letter)| *letter != '\n') {
        let (line, column) = source.position_utf16(at as u32);
        assert_eq!(source.offset_utf16(line, column) as usize, at);
    }
    assert_eq!(
        source.offset_utf16(0, 2),
        1,
        "within a character is before it"
    );
    assert_eq!(source.offset_utf16(0, 99), 6, "beyond a line is its end");
    assert_eq!(source.offset_utf16(9, 0) as usize, text.len());
}
