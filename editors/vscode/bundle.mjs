// Puts what the editor loads into `dist`: the extension, the script of the preview's page, and the licences of what is in them.
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { build } from "esbuild";

const shared = { bundle: true, minify: true, target: "es2022", metafile: true, logLevel: "warning" };
const extension = await build({ ...shared, entryPoints: ["src/extension.ts"], outdir: "dist", platform: "node", format: "cjs", external: ["vscode"] });
const page = await build({ ...shared, entryPoints: { page: "src/preview/view.ts" }, outdir: "dist", platform: "browser", format: "iife" });

const inputs = [extension, page].flatMap(({ metafile }) => Object.keys(metafile.inputs));
const packages = new Set(inputs.flatMap((path) => path.match(/^.*node_modules\/(?:@[^/]+\/)?[^/]+/) ?? []));
const licences = [...packages].sort().map((folder) => {
  const file = readdirSync(folder).find((name) => /^licen[cs]e/i.test(name));
  if (file === undefined) {
    throw new Error(`${folder} says nothing of its licence`);
  }
  const { name, version } = JSON.parse(readFileSync(`${folder}/package.json`, "utf8"));
  return `${name} ${version}\n\n${readFileSync(`${folder}/${file}`, "utf8").trim()}\n`;
});
writeFileSync("dist/licences.txt", licences.join("\n----\n\n"));
