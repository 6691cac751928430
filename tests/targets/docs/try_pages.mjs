// Decodes pasted texts on the pages of devices in a real browser, runs the vectors there, once with a spoiled line, and
// prints as JSON what the pages say.
// Usage: node try_pages.mjs BROWSER NODE_MODULES JOBS_FILE:
// { page: { jobs: [{ text, settings }], typed: [text], spoil: [line, other line] } }
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [executablePath, modules, listed] = process.argv.slice(2);
const require = createRequire(join(modules, "x.js"));
const browser = await require("playwright-core").chromium.launch({
  executablePath, args: ["--no-sandbox", "--disable-gpu", "--disable-background-networking"],
});
const page = await browser.newPage();
const troubles = [];
page.on("pageerror", (error) => troubles.push(String(error)));
page.on("console", (message) => message.type() === "error" && troubles.push(message.text()));
page.on("dialog", (dialog) => { troubles.push(dialog.message()); dialog.dismiss(); });
const found = {};

async function runVectors() {
  await page.click("text=Run the vectors");
  await page.waitForSelector("#conformance table");
  return page.evaluate(() => {
    const part = document.getElementById("conformance");
    const cells = (row) => [...row.querySelectorAll("td")].map((cell) => cell.textContent);
    return { status: part.previousSibling.textContent, rows: [...part.querySelectorAll("tbody tr")].map(cells), failures: [...part.querySelectorAll("li")].map((each) => each.textContent) };
  });
}

for (const [file, { jobs, typed, spoil }] of Object.entries(JSON.parse(readFileSync(listed, "utf8")))) {
  await page.goto(`${pathToFileURL(file).href}#decoder`);
  const decoded = await page.evaluate((all) => {
    const decoders = new Map();
    const heard = all.map(({ text, settings }) => {
      const key = JSON.stringify(settings);
      if (!decoders.has(key)) decoders.set(key, newDecoder(settings));
      decoders.get(key).forget();
      return [...decodedFrames(text, decoders.get(key))];
    });
    return JSON.stringify(heard, (_, value) => (typeof value === "bigint" ? String(value) : value));
  }, jobs);
  const shown = [];
  for (const text of typed) {
    await page.evaluate((pasted) => {
      const area = document.querySelector(".paste textarea");
      area.value = pasted;
      area.dispatchEvent(new Event("input"));
    }, text);
    await page.waitForFunction(() => !document.querySelector("#detail .status").textContent.includes("so far"));
    shown.push(await page.evaluate(() => ({ status: document.querySelector("#detail .status").textContent, text: document.querySelector(".heard").innerText, strange: document.querySelectorAll(".heard img, .heard script").length })));
  }
  await page.goto(`${pathToFileURL(file).href}#device`);
  const ran = [await runVectors()];
  await page.evaluate(([line, other]) => {
    const vectors = document.getElementById("vectors");
    vectors.textContent = vectors.textContent.replace(line, () => other);
  }, spoil);
  ran.push(await runVectors());
  const snippets = await page.evaluate(() => device.points.map((point) => snippetsOf(device, point)));
  found[file] = { decoded: JSON.parse(decoded), shown, ran, snippets };
}
console.log(JSON.stringify({ found, troubles }));
await browser.close();
