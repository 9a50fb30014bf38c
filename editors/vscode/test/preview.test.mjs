// The preview in a browser: the page, its policy and its script are the extension's, the pictures are the server's. Only the
// editor is played: it hands messages from the one to the other, as `panel.ts` does.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { build } from "esbuild";
import { chromium } from "playwright-core";
import { started } from "./support/server.mjs";

const ORIGIN = "https://editor.test";
const uri = "file:///nowhere/yard.bt";
const text = `use std
world yard {
    tick  = 100 ms
    arena = rect((0 m, 0 m), (6 m, 4 m))
    place shed = disc((0.6 m, 2 m), 20 cm)
    place gate = disc((5.4 m, 2 m), 20 cm)
    robot mower {
        body  = disc(17 cm)
        drive = differential(max_speed = 0.4 m/s, max_turn = 2 rad/s)
    }
}
state charge: ratio = 100%
each tick { charge -= 0.1% }
predicate low = charge < 30%
predicate empty = charge <= 0%
task mow {
    observe low
    choose  goto(shed), goto(gate)
    end after 5 min
    reward { on empty: -1 }
}
tree hand for mow = selector {
    low => goto(shed),
    goto(gate),
}
tree \`there and back\` for mow = memory sequence { goto(gate), goto(shed) }
`;

let server, browser, page, follower;
const said = [];
const complaints = [];

/** A module of the extension, without the editor. */
async function module(path) {
  const entry = new URL(`../src/preview/${path}.ts`, import.meta.url).pathname;
  const { outputFiles } = await build({ entryPoints: [entry], bundle: true, format: "esm", write: false });
  return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].text).toString("base64")}`);
}

const chromiumPath = () => process.env.BTC_CHROMIUM ?? execFileSync("sh", ["-c", "command -v chromium"], { encoding: "utf8" }).trim();

before(async () => {
  server = await started("file:///nowhere");
  await server.open(uri, text);
  const [{ Follower }, { page: html }] = await Promise.all([module("follow"), module("page")]);
  browser = await chromium.launch({ executablePath: chromiumPath(), args: ["--no-sandbox"] });
  page = await browser.newPage({ viewport: { width: 700, height: 500 }, colorScheme: "light" });
  page.on("console", (message) => complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(error.message));
  const body = html({ script: `${ORIGIN}/page.js`, style: `${ORIGIN}/preview.css`, source: ORIGIN, nonce: "a1b2" });
  const files = {
    "/": { contentType: "text/html", body },
    "/page.js": { contentType: "text/javascript", body: readFileSync(new URL("../dist/page.js", import.meta.url)) },
    "/preview.css": { contentType: "text/css", body: readFileSync(new URL("../preview.css", import.meta.url)) },
  };
  await page.route("**/*", (route) => {
    const file = files[new URL(route.request().url()).pathname];
    return file === undefined ? route.abort() : route.fulfill(file);
  });
  follower = new Follower(server.picture, (shown) => page.evaluate((data) => window.postMessage(data), shown));
  await page.exposeFunction("toEditor", (message) => {
    said.push(message);
    if (message.kind === "choose") {
      return follower.choose(message.tree);
    }
    if (message.kind === "follow") {
      return follower.follow(message.on);
    }
  });
  await page.addInitScript(() => {
    let state;
    window.acquireVsCodeApi = () => ({
      postMessage: (message) => window.toEditor(message),
      getState: () => state,
      setState: (next) => (state = next),
    });
  });
  await page.goto(`${ORIGIN}/`);
});

after(async () => {
  await browser?.close();
  await server?.stop();
});

const labels = () => page.locator("#picture svg text").allTextContents();
const shows = (label) => page.locator("#picture svg text", { hasText: label }).waitFor();
const at = (piece) => {
  const lines = text.slice(0, text.indexOf(piece)).split("\n");
  return { line: lines.length - 1, character: lines.at(-1).length };
};

test("the page says that it is ready, and shows the first tree", async () => {
  assert.deepEqual(said, [{ kind: "ready" }]);
  await follower.open(uri);
  await shows("goto(shed)");
  assert.deepEqual(await labels(), ["?", "low", "goto(shed)", "goto(gate)"]);
  assert.deepEqual(await page.locator("#trees option").allTextContents(), ["hand", "there and back"]);
  assert.equal(await page.locator("#trees").inputValue(), "hand");
  // The nodes lie within what is seen, none upon another.
  const boxes = await page.locator("#picture svg g > g rect").evaluateAll((nodes) => nodes.map((node) => node.getBoundingClientRect().toJSON()));
  assert.equal(boxes.length, 5);
  for (const [i, one] of boxes.entries()) {
    assert.ok(one.left >= 0 && one.right <= 700 && one.bottom <= 500, JSON.stringify(one));
    for (const other of boxes.slice(i + 1)) {
      assert.ok(one.right <= other.left || other.right <= one.left || one.bottom <= other.top || other.bottom <= one.top);
    }
  }
});

test("it is drawn anew when the file changes", async () => {
  await server.change(uri, text.replace("low => goto(shed),", "low => goto(shed),\n    not low => idle,").replace("goto(shed), goto(gate)\n", "goto(shed), goto(gate), idle\n"));
  await follower.changed();
  await shows("idle");
  assert.ok((await labels()).includes("not low"));
});

test("while the program has mistakes, the last picture stays, and the page says so", async () => {
  await server.change(uri, text.replace("charge < 30%", "charg < 30%"));
  await follower.changed();
  await page.locator("#problem", { hasText: "the program has mistakes" }).waitFor();
  assert.ok((await labels()).includes("idle"));
  assert.equal(await page.locator("#picture svg").evaluate((svg) => getComputedStyle(svg).opacity), "0.45");
  await server.change(uri, text);
  await follower.changed();
  await page.locator("#problem").waitFor({ state: "hidden" });
  assert.ok(!(await labels()).includes("idle"));
});

test("it shows the tree under the cursor, until another one is chosen", async () => {
  await follower.moved(uri, at("goto(gate), goto(shed) }"));
  await page.locator("#picture svg title", { hasText: "memory sequence" }).waitFor({ state: "attached" });
  assert.equal(await page.locator("#trees").inputValue(), "there and back");
  assert.ok(await page.locator("#follow").isChecked());
  // In no tree, the last one stays.
  await follower.moved(uri, at("observe low"));
  assert.equal(await page.locator("#trees").inputValue(), "there and back");
  await page.locator("#trees").selectOption("hand");
  await shows("low");
  assert.ok(!(await page.locator("#follow").isChecked()));
  await follower.moved(uri, at("goto(gate), goto(shed) }"));
  assert.equal(await page.locator("#trees").inputValue(), "hand");
  await page.locator("#follow").check();
  await page.locator("#picture svg title", { hasText: "memory sequence" }).waitFor({ state: "attached" });
  await page.locator("#trees").selectOption("hand");
  await shows("low");
});

test("it has the colours of the editor's theme, not of the system", async () => {
  const fill = () => page.locator("#picture svg .page").evaluate((node) => getComputedStyle(node).fill);
  assert.equal(await fill(), "rgb(255, 255, 255)");
  await page.evaluate(() => (document.body.className = "vscode-dark"));
  await page.waitForFunction(() => getComputedStyle(document.querySelector("#picture svg .page")).fill === "rgb(13, 17, 23)");
  // A new picture, too.
  await page.locator("#picture svg").evaluate((svg) => svg.classList.add("before"));
  await follower.changed();
  await page.locator("#picture svg:not(.before)").waitFor();
  assert.equal(await fill(), "rgb(13, 17, 23)");
  await page.emulateMedia({ colorScheme: "dark" });
  await page.evaluate(() => (document.body.className = "vscode-light"));
  await page.waitForFunction(() => getComputedStyle(document.querySelector("#picture svg .page")).fill === "rgb(255, 255, 255)");
});

test("it fits the panel, grows and shrinks", async () => {
  // The window reaches a new size some frames after it was asked for, so each width is waited for.
  const width = () => page.locator("#picture svg").evaluate((svg) => svg.getBoundingClientRect().width);
  const becomes = (least, most) =>
    page.waitForFunction(
      ([least, most]) => {
        const { width } = document.querySelector("#picture svg").getBoundingClientRect();
        return least <= width && width <= most;
      },
      [least, most],
    );
  const about = (size) => becomes(size - 1, size + 1);
  const natural = await width();
  await page.locator("#in").click();
  await about(natural * 1.25);
  await page.locator("#out").click();
  await page.locator("#out").click();
  await about(natural * 0.8);
  await page.setViewportSize({ width: 200, height: 300 });
  await page.locator("#fit").click();
  await becomes(1, 200);
  await page.setViewportSize({ width: 700, height: 500 });
  await about(natural);
});

test("the picture can be saved, and says what it shows", async () => {
  await page.locator("#save").click();
  assert.deepEqual(said.at(-1), { kind: "save" });
  assert.match(follower.now.svg, /^<svg [\s\S]*<desc>tree hand = selector \{[\s\S]*<\/svg>\s*$/);
  if (process.env.BTC_SCREENSHOT) {
    await page.screenshot({ path: process.env.BTC_SCREENSHOT });
  }
});

test("a program without trees, or none at all, is said to be so", async () => {
  await server.open("file:///nowhere/empty.bt", "use std\n");
  await follower.open("file:///nowhere/empty.bt");
  await page.locator("#problem", { hasText: "the program has no tree" }).waitFor();
  assert.equal(await page.locator("#picture svg").count(), 0);
  await follower.open("file:///nowhere/missing.bt");
  await page.locator("#problem", { hasText: "/nowhere/missing.bt cannot be read" }).waitFor();
});

test("the page breaks none of its own rules", () => {
  assert.deepEqual(complaints, []);
});
