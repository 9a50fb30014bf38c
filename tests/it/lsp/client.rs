//! An editor that speaks with `btc lsp`.

use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// An editor with its server.
pub(super) struct Client {
    child: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
    root: PathBuf,
    next: i64,
    /// The texts of the open documents, with their versions.
    open: BTreeMap<String, (i64, String)>,
    /// What the server said that it can do.
    pub(super) capabilities: Value,
    /// What was shown of the actions that were asked for last.
    actions: Value,
}

impl Client {
    /// Starts a server in a folder and introduces the editor.
    pub(super) fn new(root: &Path) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_btc"))
            .arg("lsp")
            .current_dir(root)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let input = child.stdin.take().unwrap();
        let output = BufReader::new(child.stdout.take().unwrap());
        let mut client = Self {
            child,
            input,
            output,
            root: root.to_owned(),
            next: 0,
            open: BTreeMap::new(),
            capabilities: Value::Null,
            actions: Value::Null,
        };
        let folder = json!({ "uri": client.uri(""), "name": "robots" });
        let snippets = json!({ "textDocument": { "completion": { "completionItem": { "snippetSupport": true } } } });
        let answer = client.request(
            "initialize",
            json!({
                "processId": null, "rootUri": null, "workspaceFolders": [folder], "capabilities": snippets,
                "initializationOptions": { "commands": ["btc.learn", "btc.run", "btc.showTree"] },
            }),
        );
        client.capabilities = answer["result"]["capabilities"].clone();
        client.notify("initialized", json!({}));
        client
    }

    fn uri(&self, name: &str) -> String {
        let path = self.root.join(name);
        format!("file://{}", path.to_str().unwrap().trim_end_matches('/'))
    }

    fn send(&mut self, message: &Value) {
        let text = message.to_string();
        write!(self.input, "Content-Length: {}\r\n\r\n{text}", text.len()).unwrap();
        self.input.flush().unwrap();
    }

    fn receive(&mut self) -> Value {
        let mut length = 0;
        loop {
            let mut line = String::new();
            assert!(
                self.output.read_line(&mut line).unwrap() > 0,
                "the server is gone"
            );
            match line.trim().split_once(": ") {
                Some(("Content-Length", bytes)) => length = bytes.parse().unwrap(),
                Some(_) => {}
                None => break,
            }
        }
        let mut bytes = vec![0; length];
        self.output.read_exact(&mut bytes).unwrap();
        serde_json::from_slice(&bytes).unwrap()
    }

    /// The answer to a request, with its `result` or its `error`.
    pub(super) fn request(&mut self, method: &str, params: Value) -> Value {
        self.next += 1;
        let id = self.next;
        self.send(&json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }));
        loop {
            let message = self.receive();
            if message["id"] == id {
                return message;
            }
        }
    }

    /// Says something that is not answered.
    pub(super) fn notify(&mut self, method: &str, params: Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    /// What the server tells of documents after this one has changed, up to what it tells of a later question.
    fn told(&mut self, name: &str) -> Value {
        let uri = self.uri(name);
        let mut told = serde_json::Map::new();
        let mut asked = None;
        loop {
            let message = self.receive();
            if message["method"] == "textDocument/publishDiagnostics" {
                let params = &message["params"];
                let of = params["uri"].as_str().unwrap().to_owned();
                let own = of == uri;
                told.insert(of, params["diagnostics"].clone());
                if own && asked.is_none() {
                    self.next += 1;
                    asked = Some(self.next);
                    self.send(&json!({ "jsonrpc": "2.0", "id": self.next, "method": "btc/done" }));
                }
            } else if asked.is_some() && message["id"] == json!(asked) {
                told.sort_keys();
                return Value::Object(told);
            }
        }
    }

    /// Says goodbye; the server ends with success.
    pub(super) fn goodbye(mut self) {
        self.request("shutdown", Value::Null);
        self.notify("exit", Value::Null);
        assert!(self.child.wait().unwrap().success());
    }

    /// The place that a piece of the text of a document shows.
    fn position(&self, name: &str, piece: &str) -> Value {
        let (_, text) = &self.open[name];
        let (before, after) = piece.split_once('|').unwrap();
        let at = text.find(&format!("{before}{after}"));
        let at = at.unwrap_or_else(|| panic!("{piece} is not in {name}")) + before.len();
        place(text, at)
    }

    /// Takes one step of a conversation: what comes of it.
    pub(super) fn step(&mut self, step: &str) -> Value {
        let mut words = step.splitn(3, ' ');
        let (verb, name, rest) = (
            words.next().unwrap(),
            words.next().unwrap_or_default(),
            words.next().unwrap_or_default(),
        );
        let document = json!({ "uri": self.uri(name) });
        let at = |client: &Self, piece: &str| json!({ "textDocument": document, "position": client.position(name, piece) });
        let method = match verb {
            "open" => {
                let text = std::fs::read_to_string(self.root.join(name)).unwrap();
                self.open.insert(name.to_owned(), (1, text.clone()));
                let item = json!({ "uri": self.uri(name), "languageId": "bt", "version": 1, "text": text });
                self.notify("textDocument/didOpen", json!({ "textDocument": item }));
                return self.told(name);
            }
            "close" => {
                self.open.remove(name);
                self.notify("textDocument/didClose", json!({ "textDocument": document }));
                return self.told(name);
            }
            // `change FILE OLD ~> NEW`
            "change" => {
                let (old, new) = rest.split_once(" ~>").unwrap();
                let new = new.strip_prefix(' ').unwrap_or(new).replace("\\n", "\n");
                let old = old.replace("\\n", "\n");
                let (_, text) = &self.open[name];
                let from = text
                    .find(&old)
                    .unwrap_or_else(|| panic!("{old} is not in {name}"));
                let range =
                    json!({ "start": place(text, from), "end": place(text, from + old.len()) });
                return self.change(name, vec![json!({ "range": range, "newText": new })]);
            }
            // `apply FILE NUMBER`: does what one of the actions says.
            "apply" => {
                let number: usize = rest.parse().unwrap();
                let edits = self.actions[number]["edit"]["changes"][self.uri(name)].clone();
                return self.change(name, edits.as_array().unwrap().clone());
            }
            "hover" => "textDocument/hover",
            "definition" => "textDocument/definition",
            "highlight" => "textDocument/documentHighlight",
            "complete" => {
                let params = at(self, rest);
                let answer = self.request("textDocument/completion", params);
                let items = answer["result"].as_array().unwrap().iter().map(|item| {
                    let parts = ["label", "detail", "insertText"].map(|part| item[part].as_str());
                    let parts: Vec<&str> = parts.into_iter().flatten().collect();
                    json!(parts.join(" | "))
                });
                return json!({ "result": items.collect::<Vec<Value>>() });
            }
            "signature" => "textDocument/signatureHelp",
            "prepare" => "textDocument/prepareRename",
            "references" => {
                let mut params = at(self, rest);
                params["context"] = json!({ "includeDeclaration": true });
                return self.request("textDocument/references", params);
            }
            // `rename FILE PLACE ~> NEW`
            "rename" => {
                let (piece, new) = rest.split_once(" ~> ").unwrap();
                let mut params = at(self, piece);
                params["newName"] = json!(new);
                return self.request("textDocument/rename", params);
            }
            "symbols" => {
                return self.request(
                    "textDocument/documentSymbol",
                    json!({ "textDocument": document }),
                );
            }
            "workspace" => return self.request("workspace/symbol", json!({ "query": name })),
            "fold" => {
                return self.request(
                    "textDocument/foldingRange",
                    json!({ "textDocument": document }),
                );
            }
            "lenses" => {
                let answer =
                    self.request("textDocument/codeLens", json!({ "textDocument": document }));
                let lenses = answer["result"].as_array().unwrap().iter().map(|lens| {
                    let command = &lens["command"];
                    let mut said = command["arguments"][0].clone();
                    let told =
                        [&command["title"], &command["command"]].map(|it| it.as_str().unwrap());
                    assert_eq!(
                        said.as_object_mut().unwrap().remove("uri"),
                        Some(json!(self.uri(name)))
                    );
                    json!([lens["range"], told.join(" | "), said])
                });
                return json!({ "result": lenses.collect::<Vec<Value>>() });
            }
            // `tree FILE`, `tree FILE NAME`, `tree FILE PLACE`: what the picture is of.
            "tree" => {
                let mut wanted = json!({ "uri": self.uri(name) });
                match rest {
                    "" => {}
                    piece if piece.contains('|') => wanted["position"] = self.position(name, piece),
                    tree => wanted["tree"] = json!(tree),
                }
                let params = json!({ "command": "btc.tree", "arguments": [wanted] });
                let mut answer = self.request("workspace/executeCommand", params);
                if let Some(svg) = answer["result"]["svg"].as_str() {
                    let (_, rest) = svg.split_once("<desc>").unwrap();
                    answer["result"]["svg"] = json!(rest.split_once("</desc>").unwrap().0);
                }
                return answer;
            }
            "colours" => return self.colours(name, &document),
            "actions" => {
                let place = self.position(name, rest);
                let range = json!({ "start": place, "end": place });
                let answer = self.request(
                    "textDocument/codeAction",
                    json!({ "textDocument": document, "range": range, "context": { "diagnostics": [] } }),
                );
                self.actions = answer["result"].clone();
                return answer;
            }
            "hints" => {
                let range = json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 999, "character": 0 } });
                return self.request(
                    "textDocument/inlayHint",
                    json!({ "textDocument": document, "range": range }),
                );
            }
            "format" => {
                let options = json!({ "tabSize": 4, "insertSpaces": true });
                let mut params = json!({ "textDocument": document, "options": options });
                if rest.is_empty() {
                    return self.request("textDocument/formatting", params);
                }
                let place = self.position(name, rest);
                params["range"] = json!({ "start": place, "end": place });
                return self.request("textDocument/rangeFormatting", params);
            }
            other => panic!("no step is called {other}"),
        };
        let params = at(self, rest);
        self.request(method, params)
    }

    /// Changes a document as an editor does, edit by edit from the end.
    fn change(&mut self, name: &str, mut edits: Vec<Value>) -> Value {
        edits.sort_by_key(|edit| {
            let start = &edit["range"]["start"];
            std::cmp::Reverse((start["line"].as_u64(), start["character"].as_u64()))
        });
        let (version, text) = self.open.get_mut(name).unwrap();
        *version += 1;
        let mut changes = Vec::new();
        for edit in edits {
            let new = edit["newText"].as_str().unwrap();
            let at = |place: &Value| byte(text, place);
            let range = at(&edit["range"]["start"])..at(&edit["range"]["end"]);
            text.replace_range(range, new);
            changes.push(json!({ "range": edit["range"], "text": new }));
        }
        let version = *version;
        let document = json!({ "uri": self.uri(name), "version": version });
        self.notify(
            "textDocument/didChange",
            json!({ "textDocument": document, "contentChanges": changes }),
        );
        self.told(name)
    }

    /// The tokens of a document, each with its type.
    fn colours(&mut self, name: &str, document: &Value) -> Value {
        let answer = self.request(
            "textDocument/semanticTokens/full",
            json!({ "textDocument": document }),
        );
        let legend = &self.capabilities["semanticTokensProvider"]["legend"]["tokenTypes"];
        let (_, text) = &self.open[name];
        let (mut line, mut column) = (0, 0);
        let data: Vec<u64> = answer["result"]["data"]
            .as_array()
            .unwrap()
            .iter()
            .map(|it| it.as_u64().unwrap())
            .collect();
        let tokens = data.chunks(5).map(|token| {
            if token[0] > 0 {
                (line, column) = (line + token[0], 0);
            }
            column += token[1];
            let from = byte(text, &json!({ "line": line, "character": column }));
            let to = byte(
                text,
                &json!({ "line": line, "character": column + token[2] }),
            );
            let kind = legend[token[3] as usize].as_str().unwrap();
            json!(format!("{} {kind} {}", &text[from..to], token[4]))
        });
        json!({ "result": tokens.collect::<Vec<Value>>() })
    }
}

/// The line and the column in UTF-16 of a byte: by another way than the server's.
fn place(text: &str, byte: usize) -> Value {
    let before = &text[..byte];
    let line = before.matches('\n').count();
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    let units: usize = before[start..].chars().map(char::len_utf16).sum();
    json!({ "line": line, "character": units })
}

/// The byte at a line and a column in UTF-16.
fn byte(text: &str, place: &Value) -> usize {
    let line = place["line"].as_u64().unwrap() as usize;
    let start: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
    let mut left = place["character"].as_u64().unwrap() as usize;
    let mut at = start;
    for letter in text[start..].chars() {
        if left < letter.len_utf16() || letter == '\n' {
            break;
        }
        left -= letter.len_utf16();
        at += letter.len_utf8();
    }
    at
}
