// Types into the calculators on the pages of devices in a real browser, and prints as JSON what the fields say then.
// Usage: node calculate.mjs BROWSER NODE_MODULES STEPS_FILE: { page: [{ point, anew, needs, field, text, bits, clicks, then }, ...] }
// where `clicks` are bits of the drawing, and `then` has what is typed at last, by the beginnings of labels; or { decode, known } instead.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { opened } from "../../support/browser.mjs";

const [executablePath, modules, steps] = process.argv.slice(2);
const { browser, page, troubles } = await opened(executablePath, modules, { draws: false });
const said = {};
for (const [file, all] of Object.entries(JSON.parse(readFileSync(steps, "utf8")))) {
  await page.goto(pathToFileURL(file).href);
  said[file] = await page.evaluate(async (typed) => {
    const found = [];
    const settled = () => new Promise((done) => setTimeout(done));
    for (const { point, anew, needs = {}, field, text, bits = [], clicks = [], then = {}, decode, known } of typed) {
      if (decode) {
        found.push([...decodedFrames(decode, newDecoder({ known }))].flatMap((frame) => frame.items.map((item) => `${item.name}${item.text}`)));
        continue;
      }
      if (anew) { location.hash = ""; await settled(); }
      if (location.hash !== `#point=${point}`) { location.hash = `#point=${point}`; await settled(); }
      const place = document.getElementById("calculator");
      const labelled = (name) => [...place.querySelectorAll("label")].find((label) => label.textContent.startsWith(name))?.querySelector("input, select");
      const type = (input, value) => { input.value = value; input.dispatchEvent(new Event("input")); };
      for (const [name, raw] of Object.entries(needs)) {
        type([...place.querySelectorAll("label")].find((label) => label.textContent.includes(`raw number of ${name}`)).querySelector("input"), raw);
      }
      if (field) type(labelled(field), text);
      for (const [label, last] of Object.entries(then)) type(labelled(label), last);
      for (const bit of clicks) document.querySelector(`#detail .clickable[data-bit="${bit}"]`).dispatchEvent(new MouseEvent("click"));
      for (const bit of bits) place.querySelector(`[data-bit="${bit}"]`).click();
      await settled();
      const frames = Object.fromEntries([...place.querySelectorAll(".frame")].map((row) => [row.firstChild.textContent, row.querySelector("code, input").textContent || row.querySelector("input")?.value]));
      const drawn = [...document.querySelectorAll("#detail .set")].map((bit) => Number(bit.dataset.bit)).sort((one, other) => one - other);
      const status = place.querySelector(".calculated");
      found.push({ value: labelled("Value").value, raw: labelled("Raw").value, words: labelled("Word").value, status: status.textContent, address: listRow(device.byName.get(point)).querySelector(".address").textContent, wrong: status.classList.contains("wrong"), frames, drawn });
    }
    return found;
  }, all);
}
console.log(JSON.stringify({ said, troubles }));
await browser.close();
