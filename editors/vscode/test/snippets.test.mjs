// The snippets as they are before anything is filled in make a sound program.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import test from "node:test";
import { btc } from "./support/server.mjs";

const snippets = JSON.parse(readFileSync(new URL("../snippets/behaviortree.json", import.meta.url), "utf8"));
const plain = (body) => body.join("\n").replace(/\$\{\d+:([^}]*)\}/g, "$1");

test("together they are a sound program, laid out as the formatter lays it out", () => {
  const text = ["use std", ...Object.values(snippets).map(({ body }) => plain(body))].join("\n\n") + "\n";
  const run = (...args) => spawnSync(btc, args, { input: text, encoding: "utf8" });
  const checked = run("check", "--format", "short", "--deny-warnings", "-");
  assert.deepEqual([checked.status, checked.stdout + checked.stderr], [0, ""]);
  assert.equal(run("fmt", "-").stdout, text);
});
