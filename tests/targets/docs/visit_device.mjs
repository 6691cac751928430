// Visits the page of a device in a real browser, from the file system, and prints as JSON what a reader meets.
// Usage: node visit_device.mjs PAGE BROWSER NODE_MODULES {"queries": [], "hashes": []}
import { pathToFileURL } from "node:url";
import { axeFinds, opened, wideAt } from "../../support/browser.mjs";

const [file, executablePath, modules, wanted] = process.argv.slice(2);
const { queries, hashes } = JSON.parse(wanted);
const STRANGE = ["#__proto__", "#constructor", "#%", "#point=%", "#point=__proto__", "#erratum=toString", `#${"A".repeat(99999)}`];
const { browser, page, troubles } = await opened(executablePath, modules);
const seen = { troubles, wide: [], axe: {}, searches: {}, papers: [], shown: {} };

async function open(hash = "") {
  await page.goto("about:blank");
  await page.goto(pathToFileURL(file).href + hash);
}
const titles = () => page.$$eval("#list tbody a", (links) => links.map((link) => link.closest("tr").dataset.point));

for (const hash of hashes) {
  await open(hash);
  seen.wide.push(...(await wideAt(page)).map((each) => `${hash} at ${each}`));
  seen.shown[hash] = await page.evaluate("ui.current");
  const found = await axeFinds(page, modules, hash ? ["#list"] : []); // which is the same in each view
  if (found.length) seen.axe[hash] = found;
}
await page.emulateMedia({ colorScheme: "light" });
await page.setViewportSize({ width: 1280, height: 800 });
for (const query of queries) {
  await open();
  await page.keyboard.press("/");
  await page.keyboard.type(query);
  const places = await page.$$eval(".places a", (links) => links.map((link) => link.textContent));
  const points = await titles();
  await page.keyboard.press("Enter");
  seen.searches[query] = { points, places, at: decodeURIComponent(await page.evaluate("location.hash")) };
}
await open();
seen.narrowest = Infinity;
for (let width = 600; width <= 1300; width += 50) {
  await page.setViewportSize({ width, height: 800 });
  seen.narrowest = Math.min(seen.narrowest, await page.$eval("#list td.title", (cell) => cell.clientWidth));
}
await page.setViewportSize({ width: 1280, height: 800 });
const all = (await titles()).length;
await page.selectOption("label:has-text('Access') select", "r");
seen.filtered = [all, await page.$$eval("#list tbody tr[data-point] td:nth-child(5)", (cells) => [...new Set(cells.map((cell) => cell.textContent))])];
const axis = page.locator("label:has-text('Voltage class') select");
if (await axis.count()) {
  await axis.selectOption("400V");
  await open();
  const stored = await page.evaluate("Object.keys(localStorage).find((key) => key.endsWith(' variants'))");
  seen.variant = [await axis.inputValue(), (await page.$$eval("#list tbody tr", (rows) => rows.map((row) => row.textContent))).filter((text) => text.includes("200V")).length];
  await page.evaluate(([key]) => localStorage.setItem(key, '{"voltage_class":"gone"}'), [stored]);
  await open();
  seen.gone = [await axis.inputValue(), await page.textContent(".status")];
}
await page.keyboard.press("/");
await page.keyboard.type("zzyzx");
seen.nothing = await page.textContent(".status");
seen.group = await page.evaluate(async () => {
  const [, [name]] = device.groups;
  location.hash = `group=${name}`;
  await new Promise((done) => addEventListener("hashchange", () => setTimeout(done), { once: true }));
  return [ui.find.value, ui.shown.length, device.points.filter((point) => device.groups[point.group][0] === name).length];
});
await page.keyboard.type("zzyzx");
await page.keyboard.press("Escape");
seen.cleared = await page.inputValue("#find");
seen.scrolled = await page.waitForFunction(() => {
  scrollTo(0, document.body.scrollHeight);
  return document.querySelectorAll("#list tr[data-point]").length === parseInt(document.querySelector(".status").textContent);
}).then(() => true, String);
await page.focus("#list tr:last-child a");
await page.keyboard.press("Enter");
await page.waitForSelector("[data-view=detail] #list tr[aria-current]");
const isBeside = () => page.$eval("#list [aria-current]", (row) => {
  const [{ top, bottom }, list] = [row.getBoundingClientRect(), row.closest("#list").getBoundingClientRect()];
  return top >= list.top && bottom <= list.bottom;
});
seen.beside = [await isBeside()];
await open(await page.evaluate("location.hash"));
seen.beside.push(await isBeside());
await open();
await page.keyboard.type("/base_freq");
seen.typed = [await page.inputValue("#find")];
await page.keyboard.press("ArrowDown");
seen.typed.push(await page.evaluate("document.activeElement.closest('tr')?.dataset.point"));
for (const hash of STRANGE) await open(hash);
await open("#point=motor_voltage");
seen.doubts = await page.$$eval(".facts .open", (all) => all.map((each) => each.closest("td").textContent));
await open("#point=gone");
seen.unknown = await page.textContent(".status");
seen.ranges = await page.evaluate(() => Object.fromEntries(device.points.map((point) => [point.name, listRow(point).querySelector(".range").textContent])));
const paper = () => page.evaluate("getComputedStyle(document.body).backgroundColor");
seen.papers.push(await paper());
await page.click(".scheme");
seen.papers.push(await paper());
await open();
seen.papers.push(await paper());
await page.emulateMedia({ media: "print" });
seen.printed = [await page.isVisible("header"), await page.isVisible("#list")];
await open("#point=base_frequency");
const errata = page.locator(".erratum dl");
seen.printed.push((await errata.count()) > 0 && (await errata.first().isVisible()));
await open();
seen.elements = await page.$$eval("body img, body iframe, script", (made) => made.length);
console.log(JSON.stringify(seen));
await browser.close();
