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
  /** The path that it was started by last. */
  private path: string | undefined;
  /** The start or the end that is under way; the next one waits for it. */
  private last: Promise<void> = Promise.resolve();

  /** Starts the server, in place of the one that runs. */
  restart(): Promise<void> {
    return this.queued(async () => {
      await this.end().catch(() => undefined);
      await this.begin();
    });
  }

  /** Starts it anew if it is found at another path now. */
  async reconsider(): Promise<void> {
    await this.last.catch(() => undefined);
    if (btcPath() !== this.path) {
      await this.restart();
    }
  }

  stop(): Promise<void> {
    return this.queued(() => this.end());
  }

  private queued(step: () => Promise<void>): Promise<void> {
    return (this.last = this.last.catch(() => undefined).then(step));
  }

  private async begin(): Promise<void> {
    const command = (this.path = btcPath());
    if (!(await hasBtc(command))) {
      return;
    }
    const watcher = vscode.workspace.createFileSystemWatcher("**/*.{bt,csv}");
    const client = new LanguageClient("btc", "btc", { command, args: ["lsp"] }, {
      documentSelector: [{ language: LANGUAGE }],
      initializationOptions: { commands: OFFERED },
      synchronize: { fileEvents: watcher },
    });
    try {
      await client.start();
      this.client = client;
    } catch (why) {
      watcher.dispose();
      const message = why instanceof Error ? why.message : String(why);
      void vscode.window.showErrorMessage(`\`${command} lsp\` does not start: ${message}`);
    }
  }

  private async end(): Promise<void> {
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
