// Learn, run and check, as tasks in the terminal.
import * as vscode from "vscode";
import { LANGUAGE, type Panel } from "./preview/panel";
import { btcPath, hasBtc, type Server } from "./server";

/** What a command is given above an item; nothing from the palette. */
export interface About {
  uri: string;
  learner?: string;
  tree?: string;
}

export class Commands {
  constructor(
    private readonly server: Server,
    private readonly panel: Panel,
  ) {}

  /** Learns, then shows the tree that was learned. */
  async learn(given?: About): Promise<void> {
    const about = given ?? (await this.chosen("btc.learn", "Learn with which learner?"));
    if (about === undefined) {
      return;
    }
    const uri = vscode.Uri.parse(about.uri);
    const results = vscode.Uri.file(uri.fsPath.replace(/\.bt$/, "") + ".learned");
    const learner = about.learner === undefined ? [] : ["--learner", about.learner];
    const code = await this.btc("learn", uri, [...learner, "--output", results.fsPath]);
    if (code === 0) {
      const learned = vscode.Uri.joinPath(results, "learned.bt");
      await vscode.window.showTextDocument(learned, { preserveFocus: true });
      await this.panel.show(learned, about.learner);
    }
  }

  /** Runs a tree. */
  async run(given?: About): Promise<void> {
    const about = given ?? (await this.chosen("btc.run", "Run which tree?"));
    if (about !== undefined) {
      const tree = about.tree === undefined ? [] : ["--tree", about.tree];
      await this.btc("run", vscode.Uri.parse(about.uri), tree);
    }
  }

  /** Checks the file of the active editor. */
  async check(): Promise<void> {
    const uri = activeProgram();
    if (uri !== undefined) {
      await this.btc("check", uri, []);
    }
  }

  /** Shows a tree beside the text. */
  async showTree(given?: About | vscode.Uri): Promise<void> {
    // The button of an editor gives the file.
    const about = given instanceof vscode.Uri ? { uri: given.toString() } : given;
    const uri = about === undefined ? activeProgram() : vscode.Uri.parse(about.uri);
    if (uri !== undefined) {
      await this.panel.show(uri, about?.tree);
    }
  }

  /** What the server offers for a command; of several, what someone chooses. */
  private async chosen(command: string, question: string): Promise<About | undefined> {
    const uri = activeProgram();
    if (uri === undefined) {
      return undefined;
    }
    const offers = (await this.server.offers(uri)).filter((lens) => lens.command?.command === command);
    const abouts = new Map<string, About>();
    for (const lens of offers) {
      const about = lens.command?.arguments?.[0] as About;
      abouts.set(about.learner ?? about.tree ?? "", about);
    }
    if (abouts.size === 0) {
      const what = command === "btc.learn" ? "learner" : "tree that can be run";
      void vscode.window.showInformationMessage(`${vscode.workspace.asRelativePath(uri)} has no ${what}.`);
      return undefined;
    }
    const names = [...abouts.keys()];
    const name = names.length === 1 ? names[0] : await vscode.window.showQuickPick(names, { placeHolder: question });
    return name === undefined ? undefined : abouts.get(name);
  }

  /** Runs `btc` on a file in the terminal: its exit code, if it was run. */
  private async btc(command: string, uri: vscode.Uri, rest: string[]): Promise<number | undefined> {
    const document = await vscode.workspace.openTextDocument(uri);
    if (document.isUntitled && !(await document.save())) {
      return undefined;
    }
    if (document.isDirty) {
      await document.save();
    }
    const path = btcPath(uri);
    if (!(await hasBtc(path))) {
      return undefined;
    }
    const folder = vscode.workspace.getWorkspaceFolder(uri);
    const cwd = folder?.uri.fsPath ?? vscode.Uri.joinPath(uri, "..").fsPath;
    const execution = new vscode.ProcessExecution(path, [command, document.uri.fsPath, ...rest], { cwd });
    const name = `${command} ${vscode.workspace.asRelativePath(uri)}`;
    const task = new vscode.Task({ type: "btc" }, folder ?? vscode.TaskScope.Workspace, name, "btc", execution);
    task.presentationOptions = { clear: true, reveal: vscode.TaskRevealKind.Always };
    return new Promise((resolve, reject) => {
      const ended = vscode.tasks.onDidEndTaskProcess((event) => {
        if (event.execution.task === task || event.execution === started) {
          ended.dispose();
          resolve(event.exitCode);
        }
      });
      let started: vscode.TaskExecution | undefined;
      vscode.tasks.executeTask(task).then((execution) => (started = execution), reject);
    });
  }
}

function activeProgram(): vscode.Uri | undefined {
  const document = vscode.window.activeTextEditor?.document;
  if (document?.languageId === LANGUAGE) {
    return document.uri;
  }
  void vscode.window.showInformationMessage("Open a `.bt` file first.");
  return undefined;
}
