// Starts Chromium for the programs that visit pages, and tells what goes wrong on a page.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

const ARGUMENTS = ["--no-sandbox", "--disable-gpu", "--disable-background-networking"];

const OF_WIDTH = ["scrollable-region-focusable", "summary-name", "page-has-heading-one", "bypass", "landmark-one-main"];

/**
 * Opens a browser with one page, and gathers its troubles. Without `draws` nothing is painted, which is most of the work
 * where a page changes often; then what waits for a frame waits for ever, as a click of the mouse does.
 */
export async function opened(executablePath, modules, { draws = true, ...context } = {}) {
  const { chromium } = createRequire(join(modules, "x.js"))("playwright-core");
  const args = draws ? ARGUMENTS : [...ARGUMENTS, "--enable-begin-frame-control"];
  const browser = await chromium.launch({ executablePath, args });
  const page = await (await browser.newContext(context)).newPage();
  const troubles = [];
  page.on("console", (message) => message.type() === "error" && troubles.push(message.text()));
  page.on("pageerror", (error) => troubles.push(String(error)));
  page.on("dialog", (dialog) => { troubles.push(dialog.message()); dialog.dismiss(); });
  page.on("request", (request) => request.url().startsWith("file:") || troubles.push(request.url()));
  return { browser, page, troubles };
}

/** The widths at which the page scrolls sideways, with how far. */
export async function wideAt(page) {
  const wide = [];
  for (const width of [360, 768, 1280]) {
    await page.setViewportSize({ width, height: 800 });
    const over = await page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth");
    if (over > 0) wide.push(`${width}: ${over}`);
  }
  return wide;
}

/** What axe finds, wide in light and then narrow in dark; but contrasts, for which it takes most of its time, are computed. */
export async function axeFinds(page, modules, exclude = []) {
  await page.evaluate(readFileSync(join(modules, "axe-core/axe.min.js"), "utf8"));
  const found = [];
  for (const [colorScheme, width, rules] of [["light", 1280, { rules: { "color-contrast": { enabled: false } } }], ["dark", 360, { runOnly: OF_WIDTH }]]) {
    await page.emulateMedia({ colorScheme });
    await page.setViewportSize({ width, height: 800 });
    const { violations } = await page.evaluate((given) => axe.run(...given), [{ exclude }, { preload: false, resultTypes: ["violations"], ...rules }]);
    found.push(...violations.flatMap(({ id, nodes }) => nodes.map(({ html }) => `${id}: ${html.slice(0, 200)}`)), ...(await page.evaluate(faint)));
  }
  return found;
}

/** The texts and controls whose contrast is less than WCAG asks of small letters. */
function faint() {
  const { Color, getContrast } = axe.commons.color;
  const parsed = (text) => { const color = new Color(); color.parseString(text); return color; };
  const behind = (element) => {
    const color = element ? parsed(getComputedStyle(element).backgroundColor) : new Color(255, 255, 255);
    return color.alpha ? color : behind(element.parentElement);
  };
  const hasText = (element) => [...element.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.data.trim());
  const shown = [...document.body.querySelectorAll(":not(:disabled, option, script)")].filter((each) => each.checkVisibility());
  return shown.filter((each) => (hasText(each) || each.matches("input, select, textarea"))
    && getContrast(behind(each), parsed(getComputedStyle(each)[each.namespaceURI.endsWith("svg") ? "fill" : "color"])) < 4.5)
    .map((each) => `faint: ${each.outerHTML.slice(0, 200)}`);
}
