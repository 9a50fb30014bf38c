// As much of the editor as the panel and the commands see of it. What they do is noted in `done`; `fire` is what a person does.
import { posix } from "node:path";

const listeners = {};
export const done = [];
export const answers = {};
export const documents = new Map();

export function fire(name, ...args) {
  return Promise.all((listeners[name] ?? []).map((listener) => listener(...args)));
}

const on = (name) => (listener) => {
  (listeners[name] ??= []).push(listener);
  return { dispose: () => (listeners[name] = listeners[name].filter((other) => other !== listener)) };
};

export class Uri {
  constructor(path) {
    this.path = path;
  }
  static file = (path) => new Uri(path);
  static parse = (text) => new Uri(decodeURIComponent(text.replace("file://", "")));
  static joinPath = (uri, ...parts) => new Uri(posix.join(uri.path, ...parts));
  get fsPath() {
    return this.path;
  }
  toString() {
    return `file://${encodeURI(this.path)}`;
  }
}

export const ViewColumn = { Beside: -2 };
export const TaskScope = { Workspace: 2 };
export const TaskRevealKind = { Always: 1 };

export class ProcessExecution {
  constructor(process, args, options) {
    Object.assign(this, { process, args, options });
  }
}

export class Task {
  constructor(definition, scope, name, source, execution) {
    Object.assign(this, { definition, scope, name, source, execution });
  }
}

export const panels = [];

export const window = {
  activeTextEditor: undefined,
  registerWebviewPanelSerializer: () => ({ dispose() {} }),
  onDidChangeTextEditorSelection: on("selection"),
  onDidChangeActiveTextEditor: on("active"),
  createWebviewPanel(type, title) {
    const panel = {
      type,
      title,
      revealed: 0,
      sent: [],
      reveal: () => (panel.revealed += 1),
      onDidDispose: (listener) => (panel.dispose = listener),
      webview: {
        cspSource: "https://editor.test",
        asWebviewUri: (uri) => `https://editor.test${uri.path}`,
        onDidReceiveMessage: (listener) => (panel.say = listener),
        postMessage: async (message) => panel.sent.push(message),
      },
    };
    panels.push(panel);
    return panel;
  },
  showTextDocument: async (uri) => done.push(["shown", uri.fsPath]),
  showInformationMessage: async (text) => void done.push(["told", text]),
  showErrorMessage: async (text) => {
    done.push(["complained", text]);
    return answers.error;
  },
  showQuickPick: async (names) => {
    done.push(["asked", ...names]);
    return answers.pick;
  },
  showSaveDialog: async ({ defaultUri }) => defaultUri,
};

export const workspace = {
  workspaceFolders: [{ uri: new Uri("/robots") }],
  onDidChangeTextDocument: on("text"),
  createFileSystemWatcher: () => ({ dispose() {} }),
  getWorkspaceFolder: (uri) => (uri.path.startsWith("/robots/") ? workspace.workspaceFolders[0] : undefined),
  getConfiguration: () => ({ get: () => answers.path }),
  asRelativePath: (uri) => uri.fsPath.replace("/robots/", ""),
  openTextDocument: async (uri) => documents.get(uri.fsPath) ?? { uri, isDirty: false, isUntitled: false },
  fs: { writeFile: async (uri, bytes) => done.push(["written", uri.fsPath, new TextDecoder().decode(bytes)]) },
};

export const commands = { executeCommand: async (...command) => done.push(["command", ...command]) };

export const tasks = {
  onDidEndTaskProcess: on("ended"),
  async executeTask(task) {
    const { process, args, options } = task.execution;
    done.push(["run", process, ...args, options.cwd]);
    const execution = { task };
    setTimeout(() => fire("ended", { execution, exitCode: answers.code }));
    return execution;
  },
};
