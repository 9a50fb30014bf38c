// The panel beside the text: a page of the editor, with a `Follower` behind it.
import { randomBytes } from "node:crypto";
import * as vscode from "vscode";
import { Follower, type Picture, type Said, type Shown, type Wanted } from "./follow";
import { page } from "./page";

export const LANGUAGE = "behaviortree";
const TYPE = "btc.tree";
/** How many milliseconds after a keystroke the tree is drawn. */
const DELAY = 80;

export type Ask = (wanted: Wanted) => Promise<Picture>;

/** There is one panel, or none. */
export class Panel implements vscode.WebviewPanelSerializer<Partial<Shown>> {
  private panel: vscode.WebviewPanel | undefined;
  private follower: Follower;
  private soon: NodeJS.Timeout | undefined;

  constructor(
    private readonly extension: vscode.Uri,
    private readonly ask: Ask,
    subscriptions: vscode.Disposable[],
  ) {
    this.follower = this.newFollower();
    subscriptions.push(
      vscode.window.registerWebviewPanelSerializer(TYPE, this),
      vscode.workspace.onDidChangeTextDocument(({ document }) => {
        if (document.languageId === LANGUAGE) {
          // By then the server has been told as well.
          clearTimeout(this.soon);
          this.soon = setTimeout(() => this.redraw(), DELAY);
        }
      }),
      vscode.window.onDidChangeTextEditorSelection(({ textEditor }) => this.moved(textEditor)),
      vscode.window.onDidChangeActiveTextEditor((editor) => this.moved(editor)),
    );
  }

  /** Shows a tree of a file. */
  async show(uri: vscode.Uri, tree?: string): Promise<void> {
    if (this.panel === undefined) {
      const options = { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true };
      this.adopt(vscode.window.createWebviewPanel(TYPE, "Tree", options));
    } else {
      this.panel.reveal(undefined, true);
    }
    this.moved(vscode.window.activeTextEditor);
    await this.follower.open(uri.toString(), tree);
  }

  /** The editor was started again with the panel open. */
  async deserializeWebviewPanel(panel: vscode.WebviewPanel, state: Partial<Shown> | undefined): Promise<void> {
    this.adopt(panel);
    if (state?.uri !== undefined) {
      await this.follower.open(state.uri, state.follows === true ? undefined : state.tree);
    }
  }

  /** Draws again what is shown, for something has changed. */
  redraw(): void {
    if (this.panel !== undefined) {
      void this.follower.changed();
    }
  }

  private newFollower(): Follower {
    return new Follower(this.ask, (shown) => this.send(shown));
  }

  private adopt(panel: vscode.WebviewPanel): void {
    this.panel = panel;
    this.follower = this.newFollower();
    const resource = (...parts: string[]) => panel.webview.asWebviewUri(vscode.Uri.joinPath(this.extension, ...parts)).toString();
    panel.webview.options = { enableScripts: true, localResourceRoots: [this.extension] };
    panel.webview.onDidReceiveMessage((said: Said) => this.hear(said));
    panel.onDidDispose(() => (this.panel = undefined));
    panel.webview.html = page({
      script: resource("dist", "page.js"),
      style: resource("preview.css"),
      source: panel.webview.cspSource,
      nonce: randomBytes(16).toString("hex"),
    });
  }

  private send(shown: Shown): void {
    if (this.panel !== undefined) {
      this.panel.title = shown.tree === undefined ? "Tree" : `Tree ${shown.tree}`;
      void this.panel.webview.postMessage(shown);
    }
  }

  private moved(editor: vscode.TextEditor | undefined): void {
    if (this.panel !== undefined && editor?.document.languageId === LANGUAGE) {
      const { line, character } = editor.selection.active;
      void this.follower.moved(editor.document.uri.toString(), { line, character });
    }
  }

  private async hear(said: Said): Promise<void> {
    switch (said.kind) {
      case "ready":
        if (this.follower.now !== undefined) {
          this.send(this.follower.now);
        }
        return;
      case "choose":
        return this.follower.choose(said.tree);
      case "follow":
        return this.follower.follow(said.on);
      case "save":
        return this.save();
    }
  }

  private async save(): Promise<void> {
    const { uri, tree, svg } = this.follower.now ?? {};
    if (uri === undefined || svg === undefined) {
      return;
    }
    const defaultUri = vscode.Uri.joinPath(vscode.Uri.parse(uri), "..", `${tree ?? "tree"}.svg`);
    const target = await vscode.window.showSaveDialog({ defaultUri, filters: { SVG: ["svg"] } });
    if (target !== undefined) {
      await vscode.workspace.fs.writeFile(target, new TextEncoder().encode(svg));
    }
  }
}
