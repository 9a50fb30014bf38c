//! A keystroke in a file of 2000 lines: the text changes, what is wrong with it is told, and what an editor asks at once.
#![allow(clippy::unwrap_used, reason = "a bench fails where it goes wrong")]

use btc::driver::load::load;
use btc::lsp::Server;
use criterion::{Criterion, criterion_group, criterion_main};
use serde_json::{Value, json};
use std::fmt::Write;
use std::hint::black_box;

#[path = "../tests/it/lsp/nowhere.rs"]
mod nowhere;
use nowhere::Nowhere;

/// A sound program of 2000 lines of all sorts, with a world of 60 places.
fn program() -> String {
    let mut text = String::from(
        "use std\n\nworld hall {\n    tick  = 100 ms\n    arena = rect((0 m, 0 m), (40 m, 40 m))\n",
    );
    for n in 0..60 {
        let (x, y) = (2 + n % 8 * 4, 2 + n / 8 * 4);
        writeln!(
            text,
            "    /// Room {n}.\n    place room_{n} = disc(({x} m, {y} m), 20 cm)"
        )
        .unwrap();
    }
    text.push_str("    robot porter {\n        body  = disc(17 cm)\n        drive = differential(max_speed = 0.4 m/s, max_turn = 2 rad/s)\n    }\n}\n\n");
    let mut n = 0;
    while text.lines().count() < 1970 {
        let room = n % 60;
        write!(
            text,
            "/// How full room {n} is.
state full_{n}: ratio = 20%
let spare_{n} = 100% - full_{n}
event emptied_{n} = success(empty_{n}) and full_{n} > 5%
/// Room {n} should be seen to.
predicate due_{n} = full_{n} > 60% and spare_{n} < 90%

each tick {{
    full_{n} += 0.01%
}}
on emptied_{n} {{ full_{n} = 0% }}

/// Goes to room {n} and stays.
behavior empty_{n}(pace: speed = 20 cm/s) {{
    requires not touching
    succeed when inside(room_{room}) and elapsed > 2 s
    control {{
        let course = wrap(direction(room_{room}) - heading)
        drive(speed = min(pace, max_speed), turn = clamp(4 Hz * course, max_turn))
    }}
}}

"
        )
        .unwrap();
        n += 1;
    }
    let chosen: Vec<String> = (0..n).map(|n| format!("empty_{n}")).collect();
    let task = "task serve {\n    observe due_0, due_1, due_2\n    choose  empty_0, empty_1, empty_2\n    end on emptied_0\n    end after 5 min\n    reward {\n        on emptied_0: 1\n        otherwise: -0.01\n    }\n}\n\n";
    text.push_str(&task.replace("empty_0, empty_1, empty_2", &chosen.join(", ")));
    text.push_str("tree hand for serve = selector {\n    due_0 => empty_0,\n    due_1 => empty_1,\n    due_2 => empty_2,\n    empty_0,\n}\n");
    text
}

const URI: &str = "file:///robots/hall.bt";

fn keystroke(criterion: &mut Criterion) {
    let text = program();
    let lines = text.lines().count();
    assert!((1950..2050).contains(&lines), "{lines}");
    let loaded = load("hall.bt", text.clone().into(), &mut Nowhere);
    let wrong = loaded.diagnostics.iter().find(|found| found.is_error());
    assert!(wrong.is_none(), "{:?}", wrong.map(|found| &found.message));

    let mut server = Server::new(&Nowhere, &json!({}));
    let item = json!({ "uri": URI, "languageId": "bt", "version": 0, "text": text });
    server.notice("textDocument/didOpen", json!({ "textDocument": item }));
    server.told();
    let line = text
        .lines()
        .position(|line| line.starts_with("predicate due_40"))
        .unwrap();
    let mut version = 0;
    let mut on = false;
    // A letter is typed and taken away again: a broken text and a sound one.
    let mut strike = |server: &mut Server| {
        version += 1;
        on = !on;
        let (from, to, new) = if on { (0, 0, "x") } else { (0, 1, "") };
        let range = json!({ "start": { "line": line, "character": from }, "end": { "line": line, "character": to } });
        let document = json!({ "uri": URI, "version": version });
        let change = json!({ "textDocument": document, "contentChanges": [{ "range": range, "text": new }] });
        server.notice("textDocument/didChange", change);
    };
    let mut group = criterion.benchmark_group("editor");
    group.sample_size(60);
    group.bench_function("keystroke_2000_lines", |bencher| {
        bencher.iter(|| {
            strike(&mut server);
            black_box(server.told())
        });
    });
    for (name, method) in [
        ("completion", "textDocument/completion"),
        ("hover", "textDocument/hover"),
        ("colours", "textDocument/semanticTokens/full"),
        ("format", "textDocument/formatting"),
    ] {
        let params: Value = json!({
            "textDocument": { "uri": URI }, "position": { "line": line, "character": 20 },
            "options": { "tabSize": 4, "insertSpaces": true },
        });
        group.bench_function(name, |bencher| {
            bencher.iter(|| black_box(server.answer(method, params.clone()).is_ok()));
        });
    }
    group.finish();
}

criterion_group!(benches, keystroke);
criterion_main!(benches);
