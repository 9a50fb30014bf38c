// Which tree the preview shows, and when it is drawn anew. It knows neither the editor nor the page.

export interface Position {
  line: number;
  character: number;
}

/** What the server is asked for: the tree at the position, else the tree of that name, else the first. */
export interface Wanted {
  uri: string;
  position?: Position;
  tree?: string;
}

/** What the server answers. */
export interface Picture {
  trees: string[];
  tree?: string;
  svg?: string;
  problem?: string;
}

/** What the page shows. */
export interface Shown {
  uri: string;
  trees: string[];
  tree?: string;
  /** The last picture that could be drawn of the file. */
  svg?: string;
  /** Why there is no newer one. */
  problem?: string;
  /** Whether it shows the tree under the cursor. */
  follows: boolean;
}

/** What the page says. */
export type Said =
  | { kind: "ready" }
  | { kind: "choose"; tree: string }
  | { kind: "follow"; on: boolean }
  | { kind: "save" };

export class Follower {
  private wanted: Wanted | undefined;
  private cursor: { uri: string; position: Position } | undefined;
  private shown: Shown | undefined;
  private follows = true;
  private asking = false;
  private again = false;

  constructor(
    private readonly ask: (wanted: Wanted) => Promise<Picture>,
    private readonly show: (shown: Shown) => void,
  ) {}

  /** What is shown now. */
  get now(): Shown | undefined {
    return this.shown;
  }

  /** Shows a tree of a file; without a name, the one under the cursor or the first. A named one stays. */
  open(uri: string, tree?: string): Promise<void> {
    this.follows = tree === undefined;
    this.wanted = { uri, tree };
    return this.draw();
  }

  /** The cursor has moved, maybe into another file. */
  moved(uri: string, position: Position): Promise<void> {
    this.cursor = { uri, position };
    if (!this.follows) {
      return Promise.resolve();
    }
    if (this.wanted?.uri !== uri) {
      this.wanted = { uri };
    }
    return this.draw();
  }

  /** A program has changed: the one that is shown, or one that it uses. */
  changed(): Promise<void> {
    return this.draw();
  }

  /** Someone has chosen a tree. */
  choose(tree: string): Promise<void> {
    return this.wanted === undefined ? Promise.resolve() : this.open(this.wanted.uri, tree);
  }

  /** Someone wants the tree under the cursor again, or no longer. */
  follow(on: boolean): Promise<void> {
    this.follows = on;
    if (on && this.cursor !== undefined && this.wanted?.uri !== this.cursor.uri) {
      this.wanted = { uri: this.cursor.uri };
    }
    return this.draw();
  }

  /** Asks for the picture and shows it. While an answer is awaited, only the last of further wishes is kept. */
  private async draw(): Promise<void> {
    if (this.wanted === undefined) {
      return;
    }
    this.again = true;
    if (this.asking) {
      return;
    }
    this.asking = true;
    try {
      while (this.again) {
        this.again = false;
        const wanted = this.request(this.wanted);
        const picture = await this.ask(wanted).catch((why: unknown): Picture => ({
          trees: this.shown?.uri === wanted.uri ? this.shown.trees : [],
          tree: wanted.tree,
          problem: why instanceof Error ? why.message : String(why),
        }));
        if (!this.again) {
          this.take(wanted.uri, picture);
        }
      }
    } finally {
      this.asking = false;
    }
  }

  private request({ uri, tree }: Wanted): Wanted {
    const here = this.follows && this.cursor?.uri === uri;
    return here ? { uri, tree, position: this.cursor?.position } : { uri, tree };
  }

  private take(uri: string, picture: Picture): void {
    const { trees, tree, problem } = picture;
    const old = this.shown?.uri === uri ? this.shown.svg : undefined;
    this.wanted = { uri, tree };
    this.shown = { uri, trees, tree, problem, svg: picture.svg ?? old, follows: this.follows };
    this.show(this.shown);
  }
}
