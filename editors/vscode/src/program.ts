// Where the `btc` program is.
import { execFile } from "node:child_process";
import { homedir } from "node:os";
import { promisify } from "node:util";

/** A path as the setting says it, with `~` and `${workspaceFolder}` filled in. */
export function expanded(setting: string, folder: string | undefined): string {
  const path = setting.trim() === "" ? "btc" : setting.trim();
  const home = path.replace(/^~(?=[/\\]|$)/, () => homedir());
  return home.replaceAll("${workspaceFolder}", () => folder ?? ".");
}

/** Why the program cannot be used, in words for a person; nothing if it can. */
export async function trouble(path: string): Promise<string | undefined> {
  try {
    const { stdout } = await promisify(execFile)(path, ["--version"], { timeout: 10_000 });
    return stdout.startsWith("btc ") ? undefined : `\`${path}\` is not the btc compiler: it calls itself “${stdout.trim()}”.`;
  } catch (why) {
    const { code, message } = why as NodeJS.ErrnoException;
    if (code === "ENOENT") {
      const named = path === "btc" ? "`btc` was not found in `PATH`." : `There is no program \`${path}\`.`;
      return `${named} Install it with \`cargo install --locked --path .\` in its repository, or set \`btc.path\`.`;
    }
    return code === "EACCES" ? `\`${path}\` may not be run.` : `\`${path} --version\` fails: ${message}`;
  }
}
