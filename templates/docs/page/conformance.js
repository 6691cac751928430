/* The vectors of the device, run in the page: what generated code must give, computed from the description alone. */

const RUN_TIME = 30; // milliseconds of work until the page reacts to the reader again

/** The vectors that the page carries; empty if it has none. */
function carriedVectors() {
  return document.getElementById("vectors")?.textContent ?? "";
}

/** Return the part of the page that runs the vectors; null where there are none. */
function conformancePart() {
  if (!carriedVectors()) return null;
  const button = element("button", { type: "button" }, "Run the vectors");
  const status = element("p", { className: "status", role: "status" });
  const results = element("div", { id: "conformance" });
  button.addEventListener("click", async () => {
    button.disabled = true;
    results.replaceChildren();
    const { passed, failed, shown } = await ranVectors((count) => { status.textContent = `${count} vectors so far`; });
    button.disabled = false;
    const kinds = [...new Set([...Object.keys(passed), ...Object.keys(failed)])];
    const wrong = Object.values(failed).reduce((sum, count) => sum + count, 0);
    const good = Object.values(passed).reduce((sum, count) => sum + count, 0);
    status.textContent = wrong ? `${countedText(wrong, "vector")} failed, ${good} passed` : `all ${good} vectors passed`;
    status.classList.toggle("wrong", wrong > 0);
    results.append(tableOf(["Kind", "Passed", "Failed"], kinds.map((kind) => [kind, String(passed[kind] ?? 0), failed[kind] ? String(failed[kind]) : ""]), "Vectors by kind"));
    if (shown.length) results.append(element("ul", {}, ...shown.map((/** @type {any} */ vector) => element("li", { className: "wrong" }, failureText(vector)))));
  });
  const about = "This page carries the conformance vectors of the device, which are computed from the description alone. Its calculator and its decoder use the code that is held against them here.";
  return part("Conformance", element("p", {}, about), button, status, results);
}

/** Run the vectors in slices. @param {(count: number) => void} tell @returns {Promise<any>} */
async function ranVectors(tell) {
  const { Device, runVectors } = generatedCode();
  let [sliced, count] = [performance.now(), 0];
  const pause = () => {
    count += 1;
    if (performance.now() - sliced < RUN_TIME) return undefined;
    tell(count);
    return new Promise((done) => { setTimeout(done); }).then(() => { sliced = performance.now(); });
  };
  return runVectors(Device, carriedVectors(), 20, pause);
}

/** @param {Record<string, any>} vector */
function failureText(vector) {
  const facts = Object.entries(vector).filter(([, value]) => value !== null && value !== "" && !(typeof value === "object" && !Object.keys(value).length));
  return facts.map(([key, value]) => `${key}: ${value instanceof Uint8Array ? hexBytes(value) : typeof value === "object" ? JSON.stringify(value, (_, each) => (typeof each === "bigint" ? String(each) : each)) : value}`).join(", ");
}
