// What the TextMate grammar colours as a word of the language are the words of the language, and its blocks end.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import test from "node:test";
import { pestWords, wordRules } from "../words.mjs";
import { programs, repository } from "./support/files.mjs";
import { coloured } from "./support/tokens.mjs";

const pest = readFileSync(join(repository, "grammar/bt.pest"), "utf8");
const words = new Set(wordRules(pest).flatMap((rule) => pestWords(pest, rule)));
const isWord = (scope) => /^(keyword|storage|constant\.language|support\.module)\./.test(scope);

function colouredWords(texts) {
  const tokens = texts.flatMap(({ text }) => coloured(text).tokens);
  const found = tokens.filter(({ text, scopes }) => /[a-z]/i.test(text) && isWord(scopes.at(-1)));
  return new Set(found.flatMap(({ text }) => text.match(/[A-Za-z]\w*/g)));
}

test("every word of the language is coloured where it means something", () => {
  assert.ok(words.size > 70, `${words.size}`);
  const found = colouredWords(programs("editors/vscode/test/grammar"));
  const missing = [...words].filter((word) => !found.has(word));
  assert.deepEqual(missing, [], "write a line with the word into test/grammar");
});

// `is` is spelled among the marks, and `sha256:` is part of a hash there.
test("no other word is coloured as one of the language", () => {
  const found = colouredWords(programs("editors/vscode/test/grammar", "examples", "src/library", "tests/worlds", "tests/cases/run"));
  const others = [...found].filter((word) => !words.has(word) && !["is", "sha256"].includes(word));
  assert.deepEqual(others, []);
});

const sound = programs("examples", "src/library", "tests/worlds", "tests/cases/run", "tests/cases/sound");

test("in a sound program every block is closed at the end", () => {
  assert.ok(sound.length > 30, `${sound.length}`);
  for (const { path, text } of sound) {
    assert.deepEqual(coloured(`${text}\n`).open, ["source.behaviortree"], path);
  }
});

test("in a sound program what is declared is coloured as that", () => {
  const kinds = { world: "type.world", task: "type.task", tree: "function.tree", predicate: "function.predicate", behavior: "function.behavior" };
  for (const { path, text } of sound) {
    const { tokens } = coloured(text);
    for (const [, kind, name] of text.matchAll(/^(world|task|tree|predicate|behavior)\s+(\w+|`[^`]+`)/gm)) {
      const found = tokens.some((token) => token.text === name && token.scopes.some((scope) => scope === `entity.name.${kinds[kind]}.behaviortree`));
      assert.ok(found, `${path}: ${kind} ${name}`);
    }
  }
});
