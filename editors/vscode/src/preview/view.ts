// Runs in the preview's page: shows what the extension sends, and says what is clicked.
import type { Said, Shown } from "./follow";

declare function acquireVsCodeApi(): {
  postMessage(said: Said): void;
  getState(): { uri?: string } | undefined;
  setState(state: Pick<Shown, "uri" | "tree" | "follows">): void;
};

const editor = acquireVsCodeApi();

function element<E extends Element>(id: string, type: new () => E): E {
  const found = document.getElementById(id);
  if (!(found instanceof type)) {
    throw new Error(`the page has no ${id}`);
  }
  return found;
}

const trees = element("trees", HTMLSelectElement);
const follow = element("follow", HTMLInputElement);
const problem = element("problem", HTMLElement);
const picture = element("picture", HTMLElement);
const save = element("save", HTMLButtonElement);

/** How large the picture is; nothing if it fits the panel. */
let zoom: number | undefined;
/** The size in which the picture was drawn. */
let drawn = { width: 0, height: 0 };

function show(shown: Shown): void {
  const { uri, tree, follows } = shown;
  editor.setState({ uri, tree, follows });
  trees.replaceChildren(...shown.trees.map((name) => new Option(name, name, false, name === tree)));
  trees.hidden = shown.trees.length === 0;
  follow.checked = follows;
  problem.hidden = shown.problem === undefined;
  problem.textContent = shown.problem ?? "";
  picture.classList.toggle("old", shown.problem !== undefined);
  save.disabled = shown.svg === undefined;
  const parsed = shown.svg === undefined ? undefined : new DOMParser().parseFromString(shown.svg, "image/svg+xml");
  const root = parsed?.documentElement;
  if (root instanceof SVGSVGElement) {
    drawn = { width: root.width.baseVal.value, height: root.height.baseVal.value };
    picture.replaceChildren(document.importNode(root, true));
  } else {
    picture.replaceChildren();
  }
  scheme();
  size();
}

/** The picture follows the system between light and dark; here it has to follow the editor's theme. */
function scheme(): void {
  const { classList } = document.body;
  const dark = classList.contains("vscode-dark") || (classList.contains("vscode-high-contrast") && !classList.contains("vscode-high-contrast-light"));
  for (const style of picture.querySelectorAll("style")) {
    for (const rule of style.sheet?.cssRules ?? []) {
      if (rule instanceof CSSMediaRule) {
        rule.media.mediaText = dark ? "all" : "not all";
      }
    }
  }
}

function size(): void {
  const svg = picture.querySelector("svg");
  if (svg === null) {
    return;
  }
  const fits = Math.min(1, picture.clientWidth / drawn.width, picture.clientHeight / drawn.height);
  const scale = zoom ?? fits;
  svg.setAttribute("width", String(drawn.width * scale));
  svg.setAttribute("height", String(drawn.height * scale));
}

function scaled(by: number): void {
  const width = picture.querySelector("svg")?.width.baseVal.value;
  if (width !== undefined && drawn.width > 0) {
    zoom = Math.min(8, Math.max(0.1, (width / drawn.width) * by));
    size();
  }
}

trees.addEventListener("change", () => editor.postMessage({ kind: "choose", tree: trees.value }));
follow.addEventListener("change", () => editor.postMessage({ kind: "follow", on: follow.checked }));
save.addEventListener("click", () => editor.postMessage({ kind: "save" }));
element("in", HTMLButtonElement).addEventListener("click", () => scaled(1.25));
element("out", HTMLButtonElement).addEventListener("click", () => scaled(0.8));
element("fit", HTMLButtonElement).addEventListener("click", () => {
  zoom = undefined;
  size();
});
window.addEventListener("resize", size);
window.addEventListener("message", ({ data }: MessageEvent<Shown>) => show(data));
new MutationObserver(scheme).observe(document.body, { attributes: true, attributeFilter: ["class"] });
editor.postMessage({ kind: "ready" });
