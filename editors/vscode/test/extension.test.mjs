// The panel and the commands in an editor that is played: what they ask for, show and run.
import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { after, beforeEach, test } from "node:test";
import { build } from "esbuild";
import { btc } from "./support/server.mjs";
import * as vscode from "./support/vscode.mjs";

const scratch = mkdtempSync(join(tmpdir(), "btc-extension-"));
after(() => rmSync(scratch, { recursive: true }));

// The modules of the extension as they are, with the played editor in place of VS Code, and no client of the server.
const played = new URL("support/vscode.mjs", import.meta.url);
const source = (name) => new URL(`../src/${name}.ts`, import.meta.url).pathname;
const client = `
  export const CodeLensRequest = {}, ExecuteCommandRequest = { type: "workspace/executeCommand" };
  export class LanguageClient {
    constructor(id, name, server, options) { Object.assign(this, { server, options }); }
    async start() {
      globalThis.clients.push("start " + this.server.command);
      await new Promise((resolve) => setTimeout(resolve, 10));
      if (globalThis.clients.broken) throw new Error("broken");
    }
    async dispose() {
      await new Promise((resolve) => setTimeout(resolve, 10));
      globalThis.clients.push("end " + this.server.command);
      if (globalThis.clients.broken) throw new Error("broken");
    }
    sendRequest(type, params) { return { type, params, ...this.options.initializationOptions }; }
  }
`;
const bundled = join(scratch, "extension.mjs");
await build({
  stdin: {
    contents: ["preview/panel", "commands", "program", "server"].map((name) => `export * from ${JSON.stringify(source(name))};`).join("\n"),
    resolveDir: scratch,
  },
  bundle: true,
  platform: "node",
  format: "esm",
  outfile: bundled,
  plugins: [{
    name: "played",
    setup({ onResolve }) {
      onResolve({ filter: /^vscode$/ }, () => ({ path: played.href, external: true }));
      onResolve({ filter: /^vscode-languageclient/ }, () => ({ path: "languageclient", namespace: "none" }));
    },
  }, {
    name: "none",
    setup({ onLoad }) {
      onLoad({ filter: /.*/, namespace: "none" }, () => ({ contents: client }));
    },
  }],
});
const { Panel, Commands, Server, expanded, trouble } = await import(pathToFileURL(bundled).href);

const A = "file:///robots/a%20b.bt";
const asked = [];
let picture;
const panel = new Panel(new vscode.Uri("/extension"), async (wanted) => (asked.push(wanted), picture(wanted)), []);
const offers = [];
const commands = new Commands({ offers: async () => offers }, panel);
const editor = (uri, line, character) => ({ document: { uri: vscode.Uri.parse(uri), languageId: "behaviortree" }, selection: { active: { line, character } } });
const settled = (ms = 20) => new Promise((resolve) => setTimeout(resolve, ms));

beforeEach(() => {
  asked.length = vscode.done.length = offers.length = 0;
  Object.assign(vscode.answers, { path: btc, code: 0, pick: undefined, error: undefined });
  picture = ({ tree }) => ({ trees: ["x", "y"], tree: tree ?? "x", svg: `<svg>${tree ?? "x"}</svg>` });
});

test("the panel shows what is under the cursor, follows it, and keeps what is chosen", async () => {
  vscode.window.activeTextEditor = editor(A, 3, 4);
  await commands.showTree();
  await settled();
  const [shown] = vscode.panels;
  assert.deepEqual(asked.at(-1), { uri: A, tree: asked.at(-1).tree, position: { line: 3, character: 4 } });
  assert.equal(shown.title, "Tree x");
  assert.equal(shown.sent.at(-1).svg, "<svg>x</svg>");
  assert.match(shown.webview.html, /script-src 'nonce-[0-9a-f]{32}'/);
  assert.match(shown.webview.html, /src="https:\/\/editor.test\/extension\/dist\/page.js"/);

  await vscode.fire("selection", { textEditor: editor(A, 9, 0) });
  await settled();
  assert.deepEqual(asked.at(-1).position, { line: 9, character: 0 });

  await shown.say({ kind: "choose", tree: "y" });
  assert.deepEqual([shown.title, shown.sent.at(-1).follows], ["Tree y", false]);
  const before = asked.length;
  await vscode.fire("selection", { textEditor: editor(A, 1, 0) });
  await settled();
  assert.equal(asked.length, before, "what is chosen stays");

  await shown.say({ kind: "ready" });
  assert.equal(shown.sent.at(-1).tree, "y", "a page that was hidden is told again");
});

test("it is drawn anew after a change, once for many keystrokes; an answer that is too late is not shown", async () => {
  const [shown] = vscode.panels;
  const change = () => vscode.fire("text", { document: { languageId: "behaviortree" } });
  for (let n = 0; n < 10; n += 1) {
    await change();
  }
  await vscode.fire("text", { document: { languageId: "rust" } });
  await settled(250);
  assert.equal(asked.length, 1);

  let answer;
  picture = () => new Promise((resolve) => (answer = resolve));
  await change();
  await settled(150);
  const sent = shown.sent.length;
  await change();
  await settled(150);
  const late = answer;
  late({ trees: ["x", "y"], tree: "y", svg: "<svg>late</svg>" });
  await settled();
  assert.equal(shown.sent.length, sent, "the late answer");
  answer({ trees: ["x", "y"], tree: "y", svg: "<svg>new</svg>" });
  await settled();
  assert.equal(shown.sent.at(-1).svg, "<svg>new</svg>");
});

test("what cannot be drawn leaves the last picture, with the reason", async () => {
  const [shown] = vscode.panels;
  picture = () => {
    throw new Error("the language server is not running");
  };
  panel.redraw();
  await settled();
  const { svg, problem } = shown.sent.at(-1);
  assert.deepEqual([svg, problem], ["<svg>new</svg>", "the language server is not running"]);
});

test("the picture is saved beside the program", async () => {
  await vscode.panels[0].say({ kind: "save" });
  assert.deepEqual(vscode.done, [["written", "/robots/y.svg", "<svg>new</svg>"]]);
});

test("a tree is run by its name in the folder of the workspace", async () => {
  await commands.run({ uri: A, tree: "there and back" });
  assert.deepEqual(vscode.done, [["run", btc, "run", "/robots/a b.bt", "--tree", "there and back", "/robots"]]);
});

test("the tree that was learned is shown, one that was not is not", async () => {
  await commands.learn({ uri: A, learner: "learned" });
  assert.deepEqual(vscode.done, [
    ["run", btc, "learn", "/robots/a b.bt", "--learner", "learned", "--output", "/robots/a b.learned", "/robots"],
    ["shown", "/robots/a b.learned/learned.bt"],
  ]);
  assert.deepEqual(asked.at(-1), { uri: "file:///robots/a%20b.learned/learned.bt", tree: "learned" });
  vscode.done.length = asked.length = 0;
  vscode.answers.code = 1;
  await commands.learn({ uri: A, learner: "learned" });
  assert.equal(vscode.done.length, 1);
  assert.equal(asked.length, 0);
});

test("from the palette, of several trees one is chosen; of none it is said", async () => {
  const lens = (tree) => ({ command: { command: "btc.run", arguments: [{ uri: A, tree }] } });
  offers.push(lens("x"), lens("y"), lens("x"));
  vscode.answers.pick = "y";
  await commands.run();
  assert.deepEqual(vscode.done[0], ["asked", "x", "y"]);
  assert.deepEqual(vscode.done[1].slice(2, 6), ["run", "/robots/a b.bt", "--tree", "y"]);
  vscode.done.length = offers.length = 0;
  await commands.run();
  assert.deepEqual(vscode.done, [["told", "a b.bt has no tree that can be run."]]);
});

test("a file is saved before it is checked", async () => {
  let saved = 0;
  vscode.documents.set("/robots/a b.bt", { uri: vscode.Uri.parse(A), isDirty: true, isUntitled: false, save: async () => (saved += 1) });
  await commands.check();
  assert.deepEqual([saved, vscode.done[0].slice(2, 4)], [1, ["check", "/robots/a b.bt"]]);
});

test("where there is no btc, that is said, with a way out", async () => {
  vscode.answers.path = "/nowhere/btc";
  vscode.answers.error = "Open the Setting";
  await commands.check();
  await settled();
  assert.deepEqual(vscode.done, [
    ["complained", "There is no program `/nowhere/btc`. Install it with `cargo install --locked --path .` in its repository, or set `btc.path`."],
    ["command", "workbench.action.openSettings", "btc.path"],
  ]);
});

test("the server is started anew one time after the other, and where its path has changed", async () => {
  globalThis.clients = [];
  const server = new Server();
  await assert.rejects(server.picture({ uri: A }), /the language server is not running/);
  await Promise.all([server.restart(), server.restart()]);
  assert.deepEqual(clients, [`start ${btc}`, `end ${btc}`, `start ${btc}`]);
  const { type, params, commands } = await server.picture({ uri: A });
  assert.deepEqual([type, params], ["workspace/executeCommand", { command: "btc.tree", arguments: [{ uri: A }] }]);
  assert.deepEqual(commands, ["btc.learn", "btc.run", "btc.showTree"]);
  clients.length = 0;
  await server.reconsider();
  assert.deepEqual(clients, []);

  vscode.answers.path = "/nowhere/btc";
  await server.reconsider();
  assert.deepEqual(clients, [`end ${btc}`]);
  assert.match(vscode.done[0][1], /There is no program/);
  vscode.answers.path = btc;
  clients.broken = true;
  await server.reconsider();
  assert.match(vscode.done.at(-1)[1], /lsp` does not start: broken$/);
  clients.broken = false;
  await server.restart();
  clients.broken = true;
  await assert.rejects(server.stop());
  clients.broken = false;
  await server.restart();
  assert.equal(clients.at(-1), `start ${btc}`, "one that does not end well hinders no other");
});

test("what is no btc is told from it", async () => {
  assert.equal(await trouble(btc), undefined);
  assert.match(await trouble("node"), /^`node` is not the btc compiler: it calls itself “v\d+/);
  const script = join(scratch, "btc");
  writeFileSync(script, "#!/bin/sh\nexit 3\n", { mode: 0o644 });
  assert.equal(await trouble(script), `\`${script}\` may not be run.`);
  rmSync(script);
  writeFileSync(script, "#!/bin/sh\nexit 3\n", { mode: 0o755 });
  assert.match(await trouble(script), /--version` fails: /);
});

test("paths may begin with the home and with the workspace", () => {
  assert.equal(expanded("${workspaceFolder}/bin/btc", "/robots"), "/robots/bin/btc");
  assert.match(expanded("~/btc", undefined), /^\/.+\/btc$/);
  assert.equal(expanded("  ", undefined), "btc");
});
