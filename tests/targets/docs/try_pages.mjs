// Decodes pasted texts on the pages of devices in a real browser, runs the vectors there, once with a spoiled line, and
// prints as JSON what the pages say.
// Usage: node try_pages.mjs BROWSER NODE_MODULES JOBS_FILE:
// { page: { jobs: [{ text, settings }], typed: [text], spoil: [line, other line] } }
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { opened } from "../../support/browser.mjs";

const [executablePath, modules, listed] = process.argv.slice(2);
const { browser, page, troubles } = await opened(executablePath, modules, { draws: false });
const OFTEN = { polling: 20 };
const found = {};

async function runVectors() {
  await page.locator("text=Run the vectors").evaluate((button) => button.click());
  await page.waitForFunction(() => document.querySelector("#conformance table"), null, OFTEN);
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
    await page.waitForFunction(() => !document.querySelector("#detail .status").textContent.includes("so far"), null, OFTEN);
    shown.push(await page.evaluate(() => ({ status: document.querySelector("#detail .status").textContent, text: document.querySelector(".decoded").innerText, strange: document.querySelectorAll(".decoded img, .decoded script").length })));
  }
  const long = await page.evaluate(async () => {
    const area = document.querySelector(".paste textarea");
    const clipboardData = new DataTransfer();
    clipboardData.setData("text/plain", "00\n".repeat(5000));
    area.dispatchEvent(new ClipboardEvent("paste", { clipboardData, cancelable: true }));
    const said = [area.value.length, area.readOnly];
    while (document.querySelector("#detail .status").textContent.includes("so far")) await new Promise((done) => setTimeout(done, 20));
    said.push(document.querySelector("#detail .status").textContent);
    [...document.querySelectorAll("#detail button")].find((button) => button.textContent === "Clear").click();
    return [...said, area.value.length, area.readOnly];
  });
  await page.goto(`${pathToFileURL(file).href}#device`);
  const ran = [await runVectors()];
  await page.evaluate(([line, other]) => {
    const vectors = document.getElementById("vectors");
    vectors.textContent = vectors.textContent.replace(line, () => other);
  }, spoil);
  ran.push(await runVectors());
  const snippets = await page.evaluate(() => device.points.map((point) => snippetsOf(device, point)));
  found[file] = { decoded: JSON.parse(decoded), shown, long, ran, snippets };
}
console.log(JSON.stringify({ found, troubles }));
await browser.close();
