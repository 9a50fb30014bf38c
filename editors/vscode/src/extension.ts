// What the editor calls when a `.bt` file is opened.
import * as vscode from "vscode";
import { Commands, type About } from "./commands";
import { Panel } from "./preview/panel";
import { Server } from "./server";

export async function activate({ extensionUri, subscriptions }: vscode.ExtensionContext): Promise<void> {
  const server = new Server();
  const panel = new Panel(extensionUri, (wanted) => server.picture(wanted), subscriptions);
  const commands = new Commands(server, panel);
  const restart = async () => {
    await server.restart();
    panel.redraw();
  };
  let soon: NodeJS.Timeout | undefined;
  const reconsider = () => {
    // While the settings are written, they are empty for a moment.
    clearTimeout(soon);
    soon = setTimeout(() => void server.reconsider().then(() => panel.redraw()), 500);
  };
  const register = (name: string, run: (about?: About) => Promise<void>) => vscode.commands.registerCommand(name, run);
  subscriptions.push(
    { dispose: () => void server.stop() },
    register("btc.learn", (about) => commands.learn(about)),
    register("btc.run", (about) => commands.run(about)),
    register("btc.check", () => commands.check()),
    register("btc.showTree", (about) => commands.showTree(about)),
    register("btc.restart", restart),
    vscode.workspace.onDidChangeConfiguration((event) => {
      if (event.affectsConfiguration("btc.path")) {
        reconsider();
      }
    }),
  );
  await server.restart();
}
