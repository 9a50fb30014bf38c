// The language server, from its start to its end.
import * as vscode from "vscode";
import { CodeLensRequest, ExecuteCommandRequest, LanguageClient, type CodeLens } from "vscode-languageclient/node";
import type { Picture, Wanted } from "./preview/follow";
import { LANGUAGE } from "./preview/panel";
import { expanded, trouble } from "./program";

/** The commands of the extension that the server may offer above items. */
export const OFFERED = ["btc.learn", "btc.run", "btc.showTree"];

/** The path of `btc`, as it is set for a file. */
export function btcPath(uri?: vscode.Uri): string {
  const setting = vscode.workspace.getConfiguration("btc", uri).get<string>("path", "btc");
  const folder = uri && vscode.workspace.getWorkspaceFolder(uri);
  return expanded(setting, (folder ?? vscode.workspace.workspaceFolders?.[0])?.uri.fsPath);
}

/** Whether `btc` can be run; if not, says why, and how to mend it. */
export async function hasBtc(path: string): Promise<boolean> {
  const why = await trouble(path);
  if (why !== undefined) {
    void vscode.window.showErrorMessage(why, "Open the Setting", "Try Again").then((choice) => {
      if (choice === "Open the Setting") {
        void vscode.commands.executeCommand("workbench.action.openSettings", "btc.path");
      } else if (choice === "Try Again") {
        void vscode.commands.executeCommand("btc.restart");
      }
    });
  }
  return why === undefined;
}

export class Server {
  private client: LanguageClient | undefined;

  async start(): Promise<void> {
    const command = btcPath();
    if (!(await hasBtc(command))) {
      return;
    }
    const watcher = vscode.workspace.createFileSystemWatcher("**/*.{bt,csv}");
    const client = new LanguageClient("btc", "btc", { command, args: ["lsp"] }, {
      documentSelector: [{ language: LANGUAGE }],
      initializationOptions: { commands: OFFERED },
      synchronize: { fileEvents: watcher },
    });
    this.client = client;
    try {
      await client.start();
    } catch (why) {
      this.client = undefined;
      const message = why instanceof Error ? why.message : String(why);
      void vscode.window.showErrorMessage(`\`${command} lsp\` does not start: ${message}`);
    }
  }

  async stop(): Promise<void> {
    const { client } = this;
    this.client = undefined;
    await client?.dispose();
  }

  /** The picture of a tree. */
  async picture(wanted: Wanted): Promise<Picture> {
    return this.running().sendRequest(ExecuteCommandRequest.type, { command: "btc.tree", arguments: [wanted] });
  }

  /** What the server offers above the items of a file. */
  async offers(uri: vscode.Uri): Promise<CodeLens[]> {
    const lenses = await this.running().sendRequest(CodeLensRequest.type, { textDocument: { uri: uri.toString() } });
    return lenses ?? [];
  }

  private running(): LanguageClient {
    if (this.client === undefined) {
      throw new Error("the language server is not running");
    }
    return this.client;
  }
}
