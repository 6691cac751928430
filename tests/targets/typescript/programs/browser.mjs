// Runs the vectors of devices in a browser: as modules, or joined into one classic script.
// Usage: node browser.mjs BROWSER NODE_MODULES FOLDER_OF_PACKAGES PACKAGE=VECTORS=FORM,FORM...
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, normalize } from "node:path";

const [executablePath, tools, packages, ...devices] = process.argv.slice(2);
const { chromium } = createRequire(join(tools, "x.js"))("playwright-core");
const browser = await chromium.launch({
  executablePath,
  args: ["--no-sandbox", "--disable-gpu", "--disable-background-networking"],
});
const HOST = "http://device.test/";
const IMPORT = /^(?:import|export \*)[^;]*?from "([^"]+)";\n/gm;

/** Where a module lies that another one imports. */
function located(from, specifier) {
  if (specifier.startsWith(".")) return normalize(join(dirname(from), specifier));
  const [name, part = "index"] = specifier.split("/");
  return join(name, `${part}.js`);
}

/** The modules that one needs, itself last, without what makes them modules. */
function joined(file, seen = new Set()) {
  if (seen.has(file)) return "";
  seen.add(file);
  const text = readFileSync(join(packages, file), "utf8");
  const before = [...text.matchAll(IMPORT)].map(([, specifier]) => joined(located(file, specifier), seen));
  return [...before, text.replace(IMPORT, "").replace(/^export /gm, "")].join("\n");
}

/** One script in one scope, with the device in a scope of its own: its points may have names of the runtime. */
function classic(name) {
  const seen = new Set();
  const runner = joined("fieldscribe-conformance/vectors.js", seen);
  const runtime = ["index", "modbus", "uss", "can"]
    .map((one) => joined(`fieldscribe-runtime/${one}.js`, seen))
    .join("\n");
  const device = joined(`${name}/index.js`, seen);
  const [, kind] = /^class (\w+) extends \w+Device \{/m.exec(device);
  return `"use strict";\n${runner}\n${runtime}\nwindow.device = (() => {\n${device}\nreturn ${kind};\n})();\nwindow.run = runVectors;\n`;
}

const MODULES = `
  import * as all from "${HOST}NAME/index.js";
  import { runVectors } from "${HOST}fieldscribe-conformance/vectors.js";
  window.device = Object.values(all).find((one) => typeof one === "function" && one.facts);
  window.run = runVectors;`;

const results = {};
for (const pair of devices) {
  const [name, file, forms] = pair.split("=");
  for (const form of forms.split(",")) {
    const page = await browser.newPage();
    const troubles = [];
    page.on("pageerror", (error) => troubles.push(String(error)));
    await page.route(`${HOST}**`, (route) => {
      const path = new URL(route.request().url()).pathname;
      if (path === "/")
        return route.fulfill({ contentType: "text/html", body: "<!doctype html><title>vectors</title>" });
      const imports = /(from ")(fieldscribe-runtime[^"]*)"/g;
      const body = readFileSync(join(packages, path), "utf8").replace(
        imports,
        (_, before, specifier) => `${before}${HOST}${located("", specifier)}"`,
      );
      return route.fulfill({ contentType: "text/javascript", body });
    });
    await page.goto(HOST);
    const content = form === "classic" ? classic(name) : MODULES.replace("NAME", name);
    await page.addScriptTag({ content, ...(form === "classic" ? {} : { type: "module" }) });
    try {
      await page.waitForFunction("window.run && window.device", undefined, { timeout: 10_000 });
      const found = await page.evaluate(
        `run(device, ${JSON.stringify(readFileSync(file, "utf8"))}).then(({ passed, failed, shown }) => ({ passed, failed, shown: shown.map(String) }))`,
      );
      results[`${name} ${form}`] = found;
    } catch (error) {
      results[`${name} ${form}`] = { passed: {}, failed: { loaded: 1 }, shown: [String(error), ...troubles] };
    }
    await page.close();
  }
}
await browser.close();
console.log(JSON.stringify(results));
