/* A point with all its facts. */

const COLUMNS = ["Type", "Access", "Range", "Unit", "Raw range", "Scale", "Default"];
/** Facts that stand as columns above the others. */

const IN_COLUMNS = new Set([...COLUMNS, "Wire address", "Addresses"]);

/** Return the article of a point. @param {PageDevice} device @param {Point} point @param {number} width */
function pointArticle(device, point, width) {
  const [first, ...others] = titlesOf(point.title);
  const heading = element("h2", { id: "point-name", tabIndex: -1 }, point.code ? element("span", { className: "code" }, point.code) : null, point.code ? " " : null, first);
  const about = element("p", { className: "soft" }, element("code", {}, point.name), ...others.flatMap((title) => [" · ", element("bdi", {}, title)]), ` · ${titlesOf(device.groups[point.group]?.[1] ?? "")[0] ?? ""}`, point.variant ? ` · only ${point.variant}` : "");
  const article = element("article", { className: "point" }, heading, about);
  article.append(...[
    factColumns(device, point), addressTable(device, point), errataOf(device, point), noteOf(point),
    element("section", { id: "calculator", hidden: true, ariaLabel: "Calculator" }),
    bitsOf(device, point, width), meaningsOf(device, point), remarksOf(device, point), sharedWord(device, point, width),
    codeOf(device, point), sourceOf(device, point),
  ].filter(Boolean));
  return article;
}

/** @param {Title} title @param {...any} children */
function part(title, ...children) {
  return element("section", {}, element("h3", {}, title), ...children);
}

/** Return a table with heads; rows are texts or elements.
 * @param {string[]} heads @param {any[]} rows @param {string} caption @param {string} [className] */
function tableOf(heads, rows, caption, className = "") {
  const kept = heads.map((_, at) => rows.some((row) => row[at] !== "" && row[at] !== undefined));
  const cells = (/** @type {string} */ name, /** @type {any[]} */ row) => heads.map((_, at) => at).filter((at) => kept[at]).map((at) => {
    const cell = element(name, name === "th" ? { scope: "col" } : {}, row[at] ?? "");
    if (name === "td") cell.dataset.head = heads[at];
    return cell;
  });
  const table = element("table", { className }, element("thead", {}, element("tr", {}, ...cells("th", heads))), element("tbody", {}, ...rows.map((row) => element("tr", {}, ...cells("td", row)))));
  return element("div", { className: "wide", tabIndex: 0, role: "group", ariaLabel: caption }, table);
}

/** @param {Point} point */
function allRows(point) {
  return [...point.rows, ...point.shared.rows].sort((a, b) => a[0] - b[0]);
}

/** Return the facts that stand as columns, each with what the manual leaves open of it.
 * @param {PageDevice} device @param {Point} point */
function factColumns(device, point) {
  const texts = Object.fromEntries(allRows(point).filter((row) => IN_COLUMNS.has(row[1])).map((row) => [row[1], row[2]]));
  texts.Range = point.allowed.range ?? "";
  texts["Raw range"] = point.allowed.raw ?? "";
  texts.Default = point.default;
  const doubts = point.errata.flatMap((at) => device.errata[at].open);
  const open = Object.fromEntries(COLUMNS.map((head) => [head, doubts.filter(([fact]) => capital(fact) === head).map(([, text]) => element("small", { className: "open" }, `open: ${text}`))]));
  const heads = COLUMNS.filter((head) => texts[head] || open[head].length);
  const cells = heads.map((head) => (open[head].length ? element("div", {}, texts[head] ?? "", ...open[head]) : texts[head]));
  return tableOf(heads, [cells], "Type, limits and unit", "facts");
}

/** @param {PageDevice} device @param {Point} point */
function addressTable(device, point) {
  const texts = Object.fromEntries(allRows(point).map((row) => [row[1], row[2]]));
  if (!point.addresses.length) return texts["Wire address"] ? element("p", {}, texts["Wire address"]) : null;
  const at = Math.min(...point.addresses);
  const printed = device.numberings.map((_, place) => {
    const number = point.numbers[place];
    if (!number) return "";
    return Math.floor(point.printed / 2 ** place) % 2 ? String(number) : element("span", {}, `${number} `, element("small", { className: "soft" }, "computed"));
  });
  const where = point.shared.telegram ?? point.shared.space;
  const heads = [point.shared.telegram === undefined ? "Space" : "Telegram", "Address", "Decimal", ...device.numberings.map(capital), "Words"];
  return tableOf(heads, [[where, addressText(point), `${point.shared.base ? "+" : ""}${at}`, ...printed, texts.Addresses ?? ""]], "Addresses", "facts");
}

/** @param {PageDevice} device @param {Point} point */
function errataOf(device, point) {
  if (!point.errata.length) return null;
  return element("div", {}, ...point.errata.map((at) => erratumBox(device, device.errata[at])));
}

/** Return an erratum as a box: what was taken; when it is opened, also what is printed, why, and where.
 * @param {PageDevice} device @param {Erratum} erratum @param {boolean} [withPoints] */
function erratumBox(device, erratum, withPoints = false) {
  const open = erratum.open.map(([, text]) => `the manual leaves open ${text}`).join("; ");
  const rows = [["Printed", erratum.printed], ["Taken", erratum.taken], ["Why", erratum.why], ["Open", open], ["Place", placeText(device, erratum.source)]];
  const about = erratum.points.length ? listed(erratum.points.map((name) => pointLink(name))) : [erratum.where];
  if (withPoints) rows.unshift(["About", ...about]);
  else rows.push(["Link", element("a", { href: `#erratum=${encodeURIComponent(erratum.id)}` }, "among all errata")]);
  const summary = element("summary", {}, element("strong", {}, "Erratum "), element("code", {}, erratum.id), ` (${erratum.certainty}): ${withPoints ? erratum.printed : erratum.taken}`);
  return element("details", { className: "erratum", id: withPoints ? `erratum=${erratum.id}` : "", open: withPoints }, summary, factList(rows.filter((row) => row[1])));
}

/** @param {any[]} rows */
function factList(rows) {
  return element("dl", {}, ...rows.flatMap(([label, ...texts]) => [element("dt", {}, label), element("dd", {}, ...texts)]));
}

/** @param {Point} point */
function noteOf(point) {
  const [first, ...others] = titlesOf(point.note);
  return first ? element("p", { className: "note" }, first, ...others.map((text) => element("bdi", { className: "soft block" }, text))) : null;
}

/** Return the flags of a point, or of a word that it shares, drawn and listed.
 * @param {PageDevice} device @param {Point} point @param {number} width */
function bitsOf(device, point, width) {
  if (point.shared.word === undefined) return null;
  const low = point.shared.low ?? 0;
  const flags = device.words[point.shared.word];
  const bits = Math.max(point.shared.isGroup ? 16 : point.shared.width, point.shared.width);
  const fields = flags.map(([at, size, name]) => ({ low: at + low, width: size, name }));
  const rows = [...flags].sort((a, b) => b[0] - a[0]).map(([at, size, name, title, active, values]) => [
    size > 1 ? `${at + low + size - 1}..${at + low}` : String(at + low), element("code", {}, name), titlesOf(title).join(" / "),
    size === 1 ? String(active) : "",
    element("span", { className: "lines" }, values.map(([raw, called, entry]) => `${raw} = ${["zero", "one"].includes(called) ? titlesOf(entry).join(" / ") : `${called} (${titlesOf(entry).join(" / ")})`}`).join("\n")),
  ]);
  return part("Bits", drawBits(bits, withGaps(fields, bits, point.shared.fixed ?? []), width, `Bits of ${point.name}`), tableOf(["Bits", "Name", "Title", "True at", "Means"], rows, "Flags", "facts"));
}

/** Return the drawing of the word that a point shares with others. @param {PageDevice} device @param {Point} point @param {number} width */
function sharedWord(device, point, width) {
  if (!point.shared.isGroup || !point.addresses.length) return null;
  const at = point.addresses[0];
  const others = device.points.filter((other) => other.shared.isGroup && other.addresses[0] === at && other.shared.space === point.shared.space && other.shared.telegram === point.shared.telegram && (other.variant === point.variant || !other.variant));
  const fields = others.map((other) => ({ low: other.shared.low ?? 0, width: other.shared.width, name: other.code ? `${other.code} ${other.name}` : other.name, style: other === point ? "own" : "" }));
  return part("The word that it shares", drawBits(16, withGaps(fields, 16, point.shared.fixed ?? []), width, `Word ${shortAddress(at)}`), element("p", {}, "With ", ...listed(others.filter((other) => other !== point).map((other) => pointLink(other.name)))));
}

/** @param {PageDevice} device @param {Point} point */
function meaningsOf(device, point) {
  const { shared } = point;
  const parts = [];
  if (shared.enum !== undefined) {
    const { entries, closed } = device.enums[shared.enum];
    const rows = entries.map(([raw, name, title = "", quantity = ""]) => [raw, element("code", {}, name), titlesOf(title).join(" / "), quantity]);
    parts.push(part(shared.digits ? `Numbers of each of its ${shared.digits} digits` : "Numbers", tableOf(["Raw", "Name", "Title", "Quantity"], rows, "Numbers")));
    if (shared.access.includes("w") && closed && !shared.digits) parts.at(-1).append(element("p", { className: "soft" }, "Only these may be written."));
  }
  if (shared.codes !== undefined) {
    const rows = device.codes[shared.codes].map(([raw, name, title = "", remarks = ""]) => [raw, element("code", {}, name), titlesOf(title).join(" / "), remarks]);
    parts.push(part("Special codes", tableOf(["Raw", "Name", "Title", "Remarks"], rows, "Special codes")));
  }
  return parts.length ? element("div", {}, ...parts) : null;
}

/** @param {PageDevice} device @param {Point} point */
function remarksOf(device, point) {
  const known = new Set([...(point.shared.links ?? []), ...(point.shared.needs ?? []), ...(point.allowed.needs ?? "").split(", ")].filter(Boolean));
  const rows = allRows(point).filter((row) => !IN_COLUMNS.has(row[1])).map((row) => [row[1], ...withLinks(row[2], known)]);
  if (point.allowed.needs) rows.push(["Limits need", ...withLinks(point.allowed.needs, known)]);
  if (point.was.length) rows.push(["Old names", point.was.join(", ")]);
  return rows.length ? part("Facts", factList(rows)) : null;
}

/** Return a text in which the names of these points are links. @param {string} text @param {Set<string>} names */
function withLinks(text, names) {
  return names.size ? text.split(/(\w+)/).map((word) => (names.has(word) ? pointLink(word) : word)) : [text];
}

/** @param {PageDevice} device @param {Point} point */
function codeOf(device, point) {
  const snippets = snippetsOf(device, point);
  const languages = Object.keys(snippets);
  if (!languages.length) return null;
  const code = element("code", {});
  const box = element("div", { className: "code-box" }, element("pre", { tabIndex: 0, role: "group", ariaLabel: "Code" }, code), copyButton("Copy", () => code.textContent));
  const buttons = languages.map((language) => element("button", { type: "button" }, LANGUAGE_NAMES[language]));
  const choose = (/** @type {number} */ at) => {
    code.textContent = snippets[languages[at]];
    buttons.forEach((button, place) => button.setAttribute("aria-pressed", String(place === at)));
  };
  buttons.forEach((button, at) => button.addEventListener("click", () => { choose(at); remember("code", languages[at]); }));
  choose(Math.max(0, languages.indexOf(recalled("code", "c"))));
  return part("Code", element("div", { className: "choices", role: "group", ariaLabel: "Language of the code" }, ...buttons), box);
}

/** @param {PageDevice} device @param {Point} point */
function sourceOf(device, point) {
  return part("In the manual", element("p", {}, placeText(device, point.source)));
}

/** Return a place in a manual as text. @param {PageDevice} device @param {any} place */
function placeText(device, [document = -1, section = "", page = "", line = 0]) {
  return [device.documents[document] ?? "", section, page && `page ${page}`, line ? `line ${line} of its text` : ""].filter(Boolean).join(", ");
}

/** @param {string} name */
function pointLink(name) {
  return element("a", { href: `#point=${encodeURIComponent(name)}` }, element("code", {}, name));
}

/** Return elements with commas between them. @param {any[]} items */
function listed(items) {
  return items.flatMap((item, at) => (at ? [", ", item] : [item]));
}

/** Return where a point starts: `1028h`, or `+000Eh` if that counts from a base. @param {Point} point */
function addressText(point) {
  return `${point.shared.base ? "+" : ""}${shortAddress(Math.min(...point.addresses))}`;
}

/** @param {number} address */
function shortAddress(address) {
  return `${address.toString(16).toUpperCase().padStart(4, "0")}h`;
}

/** @param {Point} point */
function bitsText(point) {
  const low = point.shared.low ?? 0;
  return point.shared.width === 1 ? `bit ${low}` : `bits ${low + point.shared.width - 1}..${low}`;
}

/** @param {string} text */
function capital(text) {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
