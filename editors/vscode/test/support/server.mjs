// A conversation with `btc lsp`, as the extension has it.
import { spawn } from "node:child_process";
import { createRequire } from "node:module";
import { join } from "node:path";
import { repository } from "./files.mjs";
const require = createRequire(import.meta.url);
const { createMessageConnection, StreamMessageReader, StreamMessageWriter } = require("vscode-jsonrpc/node");

/** The program under test: `BTC`, or what cargo has built. */
export const btc = process.env.BTC ?? join(repository, "target/debug/btc");

export async function started(root) {
  const child = spawn(btc, ["lsp"], { stdio: ["pipe", "pipe", "inherit"] });
  const connection = createMessageConnection(new StreamMessageReader(child.stdout), new StreamMessageWriter(child.stdin));
  connection.listen();
  await connection.sendRequest("initialize", { processId: process.pid, rootUri: root, capabilities: {} });
  await connection.sendNotification("initialized", {});
  let version = 0;
  return {
    open: (uri, text) =>
      connection.sendNotification("textDocument/didOpen", { textDocument: { uri, languageId: "behaviortree", version: (version += 1), text } }),
    change: (uri, text) =>
      connection.sendNotification("textDocument/didChange", { textDocument: { uri, version: (version += 1) }, contentChanges: [{ text }] }),
    picture: (wanted) => connection.sendRequest("workspace/executeCommand", { command: "btc.tree", arguments: [wanted] }),
    async stop() {
      await connection.sendRequest("shutdown");
      await connection.sendNotification("exit");
      connection.dispose();
    },
  };
}
