// Visits the pages of a folder in a real browser, from the file system, and prints as JSON what a reader meets.
// Usage: node visit.mjs FOLDER BROWSER NODE_MODULES PAGE_FOR_AXE... -- QUERY...
import { readdirSync } from "node:fs";
import { join, relative } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { axeFinds, opened, wideAt } from "../support/browser.mjs";

const [folder, executablePath, modules, ...words] = process.argv.slice(2);
const { browser, page, troubles } = await opened(executablePath, modules, { permissions: ["clipboard-read", "clipboard-write"] });
const seen = { troubles, wide: [], axe: {}, searches: {} };

const open = (path) => page.goto(pathToFileURL(join(folder, path)).href);
const here = () => page.evaluate("location.href").then((url) => relative(folder, fileURLToPath(url)) + new URL(url).hash);
const focused = () => page.evaluate("document.activeElement.textContent || document.activeElement.id");
const paper = () => page.evaluate("getComputedStyle(document.body).backgroundColor");

for (const path of readdirSync(folder, { recursive: true }).filter((name) => name.endsWith(".html")).sort()) {
  await open(path);
  seen.wide.push(...(await wideAt(page)).map((each) => `${path} at ${each}`));
  const found = words.slice(0, words.indexOf("--")).includes(path) ? await axeFinds(page, modules) : [];
  if (found.length) seen.axe[path] = found;
}
await page.emulateMedia({ colorScheme: "light" });
await page.setViewportSize({ width: 1280, height: 800 });
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
