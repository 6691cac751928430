// Visits the pages in a folder with a real browser and prints what a reader meets, as JSON.
// Usage: node visit.mjs FOLDER BROWSER NODE_MODULES
import { readFileSync, readdirSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, executablePath, modules] = process.argv.slice(2);
const require = createRequire(join(modules, "x.js"));
const { chromium } = require("playwright-core");
const axe = readFileSync(join(modules, "axe-core/axe.min.js"), "utf8");

const browser = await chromium.launch({ executablePath, args: ["--no-sandbox", "--disable-gpu"] });
const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
const page = await context.newPage();
const troubles = [];
page.on("console", (message) => message.type() === "error" && troubles.push(message.text()));
page.on("pageerror", (error) => troubles.push(String(error)));
page.on("request", (request) => request.url().startsWith("file:") || troubles.push(request.url()));
const open = (path) => page.goto(pathToFileURL(join(folder, path)).href);
const hits = () => page.$$eval("#page-hits a", (links) => links.map((link) => [link.textContent, link.href]));

async function search(words) {
  await page.keyboard.press("/");
  await page.fill("#page-find", words);
  return hits();
}

async function findings(scheme) {
  await page.emulateMedia({ colorScheme: scheme });
  const found = await page.evaluate(`${axe}; axe.run()`);
  return found.violations.flatMap((rule) => rule.nodes.map((node) => `${rule.id} ${node.html.slice(0, 120)}`));
}

const seen = { searches: {}, axe: {}, wide: [], dead: [] };
const files = readdirSync(folder, { recursive: true }).filter((path) => path.endsWith(".html")).sort();
for (const path of files) {
  await open(path);
  for (const width of [360, 1280]) {
    await page.setViewportSize({ width, height: 800 });
    const over = await page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth");
    if (over > 0) seen.wide.push(`${path} at ${width}: ${over}`);
  }
}
for (const path of process.argv.slice(5)) {
  await open(path);
  for (const scheme of ["light", "dark"]) {
    for (const width of [360, 1280]) {
      await page.setViewportSize({ width, height: 800 });
      const found = await findings(scheme);
      if (found.length) seen.axe[`${path} ${scheme} ${width}`] = found;
    }
  }
}
await open("index.html");
for (const words of ["with_units_xyz", "bit_offset", "rounds"]) seen.searches[words] = (await search(words)).slice(0, 3);
console.log(JSON.stringify({ ...seen, troubles }));
await browser.close();
