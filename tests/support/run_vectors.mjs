// Runs the conformance vectors of a device: node run_vectors.mjs <folder of node_modules> <package> <vectors.txt>
import { readFileSync } from "node:fs";
import { join, resolve } from "node:path";

const [folder, name, file] = process.argv.slice(2);
const modules = resolve(folder);
const { runVectors } = await import(join(modules, "fieldscribe-conformance/vectors.js"));
const generated = await import(join(modules, name, "index.js"));
const device = Object.values(generated).find((one) => typeof one === "function" && one.facts);
for (const kind of Object.values(generated)) if (kind?.flags && generated[kind.name] !== kind) throw new Error(`no word is called ${kind.name}`);
const results = await runVectors(device, readFileSync(file, "utf8"));
console.log(JSON.stringify(results, (_, value) => (typeof value === "bigint" ? String(value) : value)));
