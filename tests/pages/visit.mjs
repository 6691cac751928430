// Visits the pages of a folder in a real browser, from the file system, and prints as JSON what a reader meets.
// Usage: node visit.mjs FOLDER BROWSER NODE_MODULES PAGE_FOR_AXE... -- QUERY...
import { readFileSync, readdirSync } from "node:fs";
import { createRequire } from "node:module";
import { join, relative } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const [folder, executablePath, modules, ...words] = process.argv.slice(2);
const require = createRequire(join(modules, "x.js"));
const axe = readFileSync(join(modules, "axe-core/axe.min.js"), "utf8");
const browser = await require("playwright-core").chromium.launch({
  executablePath, args: ["--no-sandbox", "--disable-gpu", "--disable-background-networking"],
});
const context = await browser.newContext({ permissions: ["clipboard-read", "clipboard-write"] });
const page = await context.newPage();
const seen = { troubles: [], wide: [], axe: {}, searches: {} };
page.on("console", (message) => message.type() === "error" && seen.troubles.push(message.text()));
page.on("pageerror", (error) => seen.troubles.push(String(error)));
page.on("dialog", (dialog) => seen.troubles.push(dialog.message()) && dialog.dismiss());
page.on("request", (request) => request.url().startsWith("file:") || seen.troubles.push(request.url()));

const open = (path) => page.goto(pathToFileURL(join(folder, path)).href);
const here = () => page.evaluate("location.href").then((url) => relative(folder, fileURLToPath(url)) + new URL(url).hash);
const focused = () => page.evaluate("document.activeElement.textContent || document.activeElement.id");
const paper = () => page.evaluate("getComputedStyle(document.body).backgroundColor");

for (const path of readdirSync(folder, { recursive: true }).filter((name) => name.endsWith(".html")).sort()) {
  await open(path);
  for (const width of [360, 1280]) {
    await page.setViewportSize({ width, height: 800 });
    const over = await page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth");
    if (over > 0) seen.wide.push(`${path} at ${width}: ${over}`);
  }
}
for (const path of words.slice(0, words.indexOf("--"))) {
  for (const [colorScheme, width] of [["light", 1280], ["dark", 360]]) {
    await page.emulateMedia({ colorScheme });
    await page.setViewportSize({ width, height: 800 });
    await open(path);
    const found = await page.evaluate(`${axe}; axe.run({ preload: false, resultTypes: ["violations"] })`);
    const nodes = found.violations.flatMap((rule) => rule.nodes.map((node) => `${rule.id}: ${node.html.slice(0, 200)}`));
    if (nodes.length) seen.axe[`${path} ${colorScheme}`] = nodes;
  }
}
for (const query of words.slice(words.indexOf("--") + 1)) {
  await open("index.html");
  await page.keyboard.press("/");
  await page.keyboard.type(query);
  const found = await page.$$eval("#hits li", (items) => items.map((item) => item.textContent));
  await page.keyboard.press("ArrowDown");
  const first = await focused();
  await page.keyboard.press("Escape");
  const cleared = [await page.inputValue("#search"), await page.isHidden("#hits"), await focused()];
  await page.keyboard.type(query);
  if (found.length) {
    await page.keyboard.press("Enter");
    await page.waitForURL(/#/);
  }
  const marked = await page.evaluate("(document.querySelector(':target') ?? document.querySelector('.detail h2, article h2, h2'))?.textContent ?? null");
  seen.searches[query] = { found, first, cleared, at: await here(), marked };
}
await page.emulateMedia({ colorScheme: "light" });
await open("fieldscribe/README.html");
await page.click(".code >> nth=0 >> button");
seen.copied = await page.evaluate("navigator.clipboard.readText()");
seen.papers = [await paper()];
await page.click(".scheme");
seen.papers.push(await paper());
await open("index.html");
seen.papers.push(await paper());
await page.emulateMedia({ media: "print" });
seen.printed = await page.$$eval("header, nav", (parts) => parts.filter((part) => part.offsetHeight > 0).length);
console.log(JSON.stringify(seen));
await browser.close();
