// The programs of the repository.
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

export const repository = fileURLToPath(new URL("../../../..", import.meta.url));

/** The programs in folders of the repository, by path. */
export function programs(...folders) {
  const found = folders.flatMap((folder) => {
    const entries = readdirSync(join(repository, folder), { recursive: true, encoding: "utf8" });
    return entries.filter((entry) => entry.endsWith(".bt")).map((entry) => join(folder, entry)).sort();
  });
  return found.map((path) => ({ path, text: readFileSync(join(repository, path), "utf8") }));
}
