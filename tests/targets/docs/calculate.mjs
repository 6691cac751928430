// Types into the calculators of a device's page in a real browser, and prints as JSON what the other fields say then.
// Usage: node calculate.mjs PAGE BROWSER NODE_MODULES STEPS_FILE: [{ point, needs, field, text, unit }, ...]
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [file, executablePath, modules, steps] = process.argv.slice(2);
const require = createRequire(join(modules, "x.js"));
const browser = await require("playwright-core").chromium.launch({
  executablePath, args: ["--no-sandbox", "--disable-gpu", "--disable-background-networking"],
});
const page = await browser.newPage();
const troubles = [];
page.on("pageerror", (error) => troubles.push(String(error)));
page.on("console", (message) => message.type() === "error" && troubles.push(message.text()));
await page.goto(pathToFileURL(file).href);
const said = await page.evaluate(async (all) => {
  const said = [];
  const settled = () => new Promise((done) => setTimeout(done));
  for (const { point, needs = {}, field, text, bits = [] } of all) {
    if (location.hash !== `#point=${point}`) { location.hash = `#point=${point}`; await settled(); }
    const place = document.getElementById("calculator");
    const labelled = (name) => [...place.querySelectorAll("label")].find((label) => label.textContent.startsWith(name))?.querySelector("input, select");
    const type = (input, value) => { input.value = value; input.dispatchEvent(new Event("input")); };
    for (const [name, raw] of Object.entries(needs)) {
      type([...place.querySelectorAll("label")].find((label) => label.textContent.includes(`raw number of ${name}`)).querySelector("input"), raw);
    }
    if (field) type(labelled(field), text);
    for (const bit of bits) place.querySelector(`[data-bit="${bit}"]`).click();
    await settled();
    const frames = Object.fromEntries([...place.querySelectorAll(".frame")].map((row) => [row.firstChild.textContent, row.querySelector("code, input").textContent || row.querySelector("input")?.value]));
    const status = place.querySelector(".calculated");
    said.push({ value: labelled("Value").value, raw: labelled("Raw").value, words: labelled("Word").value, status: status.textContent, wrong: status.classList.contains("wrong"), frames });
  }
  return said;
}, JSON.parse(readFileSync(steps, "utf8")));
console.log(JSON.stringify({ said, troubles }));
await browser.close();
