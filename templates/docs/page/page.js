/* The page of a device: it shows what the address after # names, and stores only the reader's choices. */

const device = readDevice();
/** @type {Record<string, any>} */
const state = { query: "", group: "", access: "", type: "", order: "manual", variants: chosenVariants(), language: recalled("language", "") };
/** The parts of the page. @type {any} */
const ui = {};

/** Return the variants that the reader chose before, by axis; those that the device no longer has are left out. */
function chosenVariants() {
  const stored = recalled(`${device.id} variants`, {});
  return Object.fromEntries(Object.entries(device.variants).flatMap(([axis, values]) => (values.includes(stored[axis]) ? [[axis, stored[axis]]] : [])));
}

/** Return the data of the page, its points as objects with what they share. @returns {PageDevice} */
function readDevice() {
  const data = JSON.parse(document.getElementById("data")?.textContent ?? "");
  const usual = { code: "", title: "", group: 0, addresses: [], numbers: [], printed: 0, rows: [], source: [], errata: [], note: "", variant: "", index: "", written: [], default: "", was: [], identifiers: [] };
  data.points = data.points.map((/** @type {any[]} */ row, /** @type {number} */ place) => {
    /** @type {Record<string, any>} */
    const point = { ...usual, place };
    row.forEach((value, at) => { point[data.fields[at]] = value; });
    point.shared = data.kinds[point.kind];
    point.allowed = data.limits[point.limits];
    return point;
  });
  data.byName = new Map(data.points.flatMap((/** @type {Point} */ point) => [...point.was, point.name].map((name) => [name, point])));
  return data;
}

/** Return a title in all its languages, that of the reader first. @param {Title | undefined} title */
function titlesOf(title) {
  if (!title) return [];
  if (typeof title === "string") return [title];
  const at = device.languages.indexOf(state.language);
  return [...new Set(at > 0 && title[at] ? [title[at], ...title] : title)].filter(Boolean);
}

/** Return what a search finds beside points: places with a title, a text and an address after #. */
function placesOf() {
  const places = [];
  for (const erratum of device.errata) places.push({ title: erratum.id, kind: "Erratum", text: [erratum.printed, erratum.taken, erratum.why, ...erratum.open.map(([, text]) => text)].join(" "), hash: `erratum=${erratum.id}` });
  for (const [section, parts] of Object.entries(device.sections)) {
    for (const [heading, table] of parts) {
      const [, ...rows] = table.split("\ue004");
      for (const row of rows) {
        const target = /\ue000=(\w+)\ue001([^\ue002]*)\ue002/.exec(row);
        const texts = row.split("\ue003").map(plain);
        const title = target ? target[2] : texts.slice(0, 2).filter(Boolean).join(" ");
        places.push({ title, kind: heading, text: texts.join(" "), hash: target ? `${target[1]}=${target[2]}` : section });
      }
    }
  }
  for (const [name, title, note = ""] of device.groups) places.push({ title: titlesOf(title)[0] ?? name, kind: "Group", text: [name, ...titlesOf(title), ...titlesOf(note)].join(" "), hash: `group=${name}` });
  return places;
}

/** Return a text of a table without its marks. @param {string} text */
function plain(text) {
  return text.replace(/\ue000[^\ue001]*\ue001([^\ue002]*)\ue002/g, "$1");
}

/** Return a text of a table as nodes: its marks become code and links. @param {string} text */
function marked(text) {
  return text.split(/(\ue000[^\ue002]*\ue002)/).filter(Boolean).map((piece) => {
    const mark = /^\ue000([^\ue001]*)\ue001([^\ue002]*)\ue002$/.exec(piece);
    if (!mark) return piece;
    const code = element("code", {}, mark[2]);
    if (!mark[1]) return code;
    if (mark[1].startsWith("=")) return Object.assign(code, { id: `${mark[1].slice(1)}=${mark[2]}` });
    return element("a", { href: `#${mark[1]}=${encodeURIComponent(mark[2])}` }, code);
  });
}

/** @param {string} text @param {string} caption */
function markedTable(text, caption) {
  const [heads, ...rows] = text.split("\ue004").map((row) => row.split("\ue003"));
  if (!rows.length) return element("p", {}, ...marked(text));
  return tableOf(heads, rows.map((row) => row.map((cell) => element("span", { className: "lines" }, ...marked(cell)))), caption);
}

/** The sections by their addresses, with their names. @type {Record<string, string>} */
const SECTIONS = { points: "Points", decoder: "Decoder", maps: "Maps", bus: "Bus", frames: "Frames", errata: "Errata", device: "Device" };

/** @param {string} name */
function sectionArticle(name) {
  const article = element("article", {}, element("h2", { tabIndex: -1 }, SECTIONS[name]));
  const width = Math.max(280, ui.detail.clientWidth - 24);
  if (name === "maps") article.append(...mapParts(width));
  else if (name === "decoder") article.append(...decoderParts());
  else if (name === "errata") article.append(...device.errata.map((erratum) => erratumBox(device, erratum, true)));
  else article.append(...device.sections[name].map(([heading, table]) => (heading ? part(heading, markedTable(table, heading)) : element("p", {}, ...marked(table)))));
  if (name === "device" && typeof globalThis.openCode === "function") article.append(conformancePart() ?? "");
  return article;
}

/** @param {number} width */
function mapParts(width) {
  const spaces = groupedBy(device.points, keyOfSpace);
  const parts = [accessLegend()];
  for (const [name, titles, direction, identifier, roles] of device.messages) {
    if (roles.length) parts.push(part(`Message ${name}`, element("p", { className: "soft" }, `${titlesOf(titles).join(" / ")} · ${direction} · ${identifier}`), drawBytes(roles, width, `Message ${name}`)));
  }
  for (const [key, points] of spaces) {
    const telegram = device.telegrams.find((each) => each[0] === points[0].shared.telegram);
    const drawing = telegram ? drawTelegram(points, telegram[3], width, `Telegram ${telegram[0]}`) : drawMap(points, width, `Map of ${key}`);
    const about = telegram ? `${titlesOf(telegram[1]).join(" / ")} · ${telegram[2]} · ${telegram[3]} words` : `${points.length} points; the list in the order of addresses says the same`;
    parts.push(part(telegram ? `Telegram ${telegram[0]}` : capital(key), element("p", { className: "soft" }, about), drawing));
  }
  return parts;
}

/** @param {Point} point */
function keyOfSpace(point) {
  return point.shared.telegram ?? [point.shared.space, point.shared.base].filter(Boolean).join(", counted from ");
}

/** @param {any[]} items @param {(item: any) => string} keyOf */
function groupedBy(items, keyOf) {
  const groups = new Map();
  for (const item of items) groups.set(keyOf(item), [...(groups.get(keyOf(item)) ?? []), item]);
  return groups;
}

function accessLegend() {
  /** @type {Record<string, string>} */
  const kinds = { r: "read only", rw: "read and write", w: "write only", none: "not over the bus" };
  const used = Object.keys(kinds).filter((access) => device.points.some((point) => point.shared.access === access));
  return element("p", { className: "legend" }, ...used.flatMap((access) => [element("span", { className: `swatch access-${access}` }), ` ${kinds[access]}  `]));
}

/* The list of points. */

/** The number of rows that are laid out at once; more follow when the reader scrolls near their end. */
const CHUNK = 16;
const ahead = new IntersectionObserver((seen) => { if (seen.some((each) => each.isIntersecting)) extendList(ui.listed + CHUNK); }, { rootMargin: "800px" });

/** @param {Point} point */
function isWanted(point) {
  return (!state.group || device.groups[point.group]?.[0] === state.group)
    && (!state.access || point.shared.access === state.access)
    && (!state.type || typeName(point) === state.type)
    && hasVariant(point);
}

/** @param {Point} point */
function hasVariant(point) {
  const [axis, value] = point.variant.split("=");
  return !value || !state.variants[axis] || state.variants[axis] === value;
}

/** @param {Point} point */
function typeName(point) {
  return (point.shared.type ?? "").split(",")[0];
}

/** @typedef {(a: Point, b: Point) => number} Compare */
/** @type {Record<string, [string, Compare | null]>} */
const ORDERS = {
  manual: ["as in the manual", null],
  address: ["by address", (a, b) => keyOfSpace(a).localeCompare(keyOfSpace(b)) || Math.min(...a.addresses) - Math.min(...b.addresses) || (b.shared.low ?? 0) - (a.shared.low ?? 0)],
  name: ["by name", (a, b) => (a.name < b.name ? -1 : 1)],
};

function showList() {
  const found = search(ui.index, state.query, isWanted);
  const compare = ORDERS[state.order][1];
  if (compare && !state.query.trim()) found.points.sort(compare);
  ui.shown = found.points;
  const [points, places] = [found.points.length, found.places.length];
  ui.status.textContent = `${points} of ${device.points.length} points${places ? `, ${places} other place${places > 1 ? "s" : ""}` : ""}`;
  ui.places.replaceChildren(...found.places.slice(0, 12).map((/** @type {any} */ place) => element("li", {}, element("a", { href: `#${encodeHash(place.hash)}` }, place.title), element("span", { className: "soft" }, ` ${place.kind}`))));
  ui.places.hidden = !places;
  ui.rows.replaceChildren();
  ui.listed = 0;
  ui.lastGroup = -1;
  extendList(CHUNK);
  ui.table.hidden = !points;
  ui.nothing.hidden = Boolean(points + places);
}

/** Add rows to the list until `count` are there. @param {number} count */
function extendList(count) {
  const grouped = state.order === "manual" && !state.query.trim();
  const rows = [];
  for (const point of ui.shown.slice(ui.listed, count)) {
    if (grouped && point.group !== ui.lastGroup) {
      const [name, title] = device.groups[point.group] ?? [""];
      rows.push(element("tr", { className: "group" }, element("th", { colSpan: 3, scope: "colgroup", id: `group=${name}` }, titlesOf(title)[0] ?? name), element("td", { colSpan: 4 })));
      ui.lastGroup = point.group;
    }
    rows.push(listRow(point));
  }
  ui.listed = Math.min(count, ui.shown.length);
  ui.rows.append(...rows);
  ahead.unobserve(ui.end); // observed again, it reports again if it is still near
  if (ui.listed < ui.shown.length) ahead.observe(ui.end);
}

/** @param {Point} point */
function listRow(point) {
  const { shared } = point;
  const [first = ""] = titlesOf(point.title);
  const link = element("a", { href: `#point=${encodeURIComponent(point.name)}` }, first || point.name);
  const at = point.addresses.length ? Math.min(...point.addresses) : null;
  const name = element("td", { className: "title" }, link, element("span", { className: "name" }, point.name + (point.variant ? ` · ${point.variant}` : "")));
  const address = element("td", { className: "address" }, at === null ? "" : addressText(point), at === null ? null : element("span", { className: "soft" }, ` ${at}`));
  const row = element("tr", {}, element("td", { className: "code" }, point.code), name, address,
    element("td", {}, shared.type ?? ""), element("td", {}, shared.access), element("td", { className: "range" }, point.allowed.range ?? (point.allowed.raw ? `raw ${point.allowed.raw}` : "")), element("td", {}, shared.unit ?? ""));
  row.dataset.point = point.name;
  if (point.name === ui.current) row.setAttribute("aria-current", "true");
  if (!shared.generated) row.className = "documented";
  return row;
}

/* The frame of the page. */

function build() {
  const search_ = element("input", { id: "find", type: "search", autocomplete: "off", spellcheck: false, placeholder: "Name, title, code, address, label, unit …" });
  search_.setAttribute("aria-controls", "list");
  ui.find = search_;
  ui.status = element("p", { className: "status", role: "status" });
  ui.places = element("ul", { className: "places", hidden: true, ariaLabel: "Other places" });
  ui.rows = element("tbody", {});
  ui.table = element("table", { className: "points" }, element("caption", { className: "unseen" }, "Points"), element("thead", {}, element("tr", {}, ...["Code", "Name", "Address", "Type", "R/W", "Range", "Unit"].map((head) => element("th", { scope: "col" }, head)))), ui.rows);
  ui.nothing = element("p", { hidden: true }, "Nothing has all these words. Try fewer words, or clear the filters.");
  ui.end = element("div", {});
  ui.list = element("section", { id: "list", ariaLabel: "List of points" }, ui.status, ui.places, ui.nothing, ui.table, ui.end);
  ui.detail = element("div", { id: "detail", tabIndex: -1 });
  ui.tabs = element("nav", { ariaLabel: "Sections" }, device.index ? element("a", { href: device.index }, "All devices") : null, ...Object.entries(SECTIONS).filter(([name]) => hasSection(name)).map(([name, text]) => element("a", { href: `#${name}` }, text)));
  const filters = element("details", { className: "filters" }, element("summary", {}, "Filters"), element("div", {}, ...filterFields()));
  filters.open = matchMedia("(min-width: 60rem)").matches;
  const header = element("header", {}, element("h1", {}, element("a", { href: "#points" }, device.name), element("span", { className: "soft" }, ` ${titlesOf(device.title)[0] ?? ""}`)),
    element("div", { className: "search", role: "search" }, element("label", { htmlFor: "find" }, "Search ", element("kbd", {}, "/")), search_), schemeButton(), ui.tabs, filters);
  document.body.prepend(element("a", { className: "skip", href: "#detail" }, "Skip to the content"), header, element("main", { className: "split" }, ui.list, ui.detail), element("footer", {}, element("p", {}, device.made), element("p", {}, "A write can move a machine. Hold what matters against the manual of your own device.")));
}

/** Keep the content below the header in sight, however tall the header is. */
function followHeader() {
  const header = /** @type {HTMLElement} */ (document.querySelector("header"));
  const measure = () => document.documentElement.style.setProperty("--top", `${header.offsetHeight}px`);
  new ResizeObserver(measure).observe(header);
}

/** @param {string} name */
function hasSection(name) {
  if (name === "points" || name === "maps") return true;
  if (name === "decoder") return typeof globalThis.openCode === "function";
  return name === "errata" ? device.errata.length > 0 : device.sections[name].length > 0;
}

function filterFields() {
  const types = [...new Set(device.points.map(typeName))].filter(Boolean).sort();
  const accesses = [...new Set(device.points.map((point) => point.shared.access))].sort();
  const fields = [
    ui.group = choice("Group", "group", device.groups.map(([name, title]) => [name, titlesOf(title)[0] ?? name])),
    choice("Access", "access", accesses.map((access) => [access, access])),
    choice("Type", "type", types.map((type) => [type, type])),
    choice("Order", "order", Object.entries(ORDERS).map(([name, [text]]) => [name, text]), false),
  ];
  for (const [axis, values] of Object.entries(device.variants)) {
    fields.push(choiceField(capital(axis.replaceAll("_", " ")), values.map((value) => [value, value]), state.variants[axis] ?? "", (value) => {
      state.variants = { ...state.variants, [axis]: value };
      remember(`${device.id} variants`, state.variants);
    }));
  }
  if (device.languages.length > 1) {
    const field = choiceField("Language", device.languages.map((code) => [code, code]), state.language, (value) => {
      state.language = value;
      remember("language", value);
      show();
    }, "all, English first");
    setTimeout(() => nameLanguages([...field.querySelectorAll("option")])); // browsers look up names slowly
    fields.push(field);
  }
  return fields;
}

/** @param {HTMLOptionElement[]} options */
function nameLanguages(options) {
  const names = new Intl.DisplayNames("en", { type: "language" });
  for (const option of options) if (option.value) option.text = names.of(option.value) ?? option.value;
}

/** @param {string} text @param {string} key @param {string[][]} options @param {boolean} [all] */
function choice(text, key, options, all = true) {
  return choiceField(text, options, state[key], (value) => { state[key] = value; }, all ? "all" : "");
}

/** @param {string} text @param {string[][]} options @param {any} value @param {(value: string) => void} change @param {any} [all] */
function choiceField(text, options, value, change, all = "all") {
  const select = element("select", {}, ...(all ? [element("option", { value: "" }, all)] : []), ...options.map(([of, shown]) => element("option", { value: of }, shown)));
  select.value = value;
  select.addEventListener("change", () => { change(select.value); showList(); });
  return element("label", {}, `${text} `, select);
}

/** @param {string} hash */
function encodeHash(hash) {
  const [kind, ...name] = hash.split("=");
  return name.length ? `${kind}=${encodeURIComponent(name.join("="))}` : kind;
}

/** Show what the address after # names: a point, a section, or a place in one. */
function show() {
  let [kind, ...rest] = location.hash.slice(1).split("=");
  let name = rest.length ? rest.join("=") : kind;
  try { name = decodeURIComponent(name); } catch { /* shown as it is */ }
  if (!rest.length && device.byName.has(name)) kind = "point";
  const point = kind === "point" ? device.byName.get(name) : undefined;
  const section = new Map([["erratum", "errata"], ["frame", "frames"]]).get(kind) ?? (Object.keys(SECTIONS).includes(kind) ? kind : kind === "group" || kind === "point" || !kind ? "points" : holderOf(`${kind}=${name}`));
  ui.current = point?.name;
  const isList = section === "points" && !point;
  document.body.dataset.view = isList ? "list" : "detail";
  for (const tab of ui.tabs.children) {
    if (tab.hash === `#${section}`) tab.setAttribute("aria-current", "page"); else tab.removeAttribute("aria-current");
  }
  for (const row of ui.rows.querySelectorAll("[aria-current]")) row.removeAttribute("aria-current");
  if (point) markRow(point);
  ui.detail.replaceChildren(...(isList ? [] : [point ? withNeighbours(point) : sectionArticle(section)]));
  if (point) fillCalculator(document.getElementById("calculator"), point);
  document.title = point ? `${point.code || point.name} · ${device.name}` : device.name;
  if (kind === "group") showGroup(name);
  else if (kind === "point" && !point) ui.status.textContent = `There is no point ${name.slice(0, 99)}: ${ui.status.textContent}`;
  else if (!isList) {
    const place = document.getElementById(`${kind}=${name}`);
    if (place) place.scrollIntoView({ block: "center" });
    else scrollTo(0, 0);
    place?.classList.add("found");
    if (place instanceof HTMLDetailsElement) place.open = true;
  }
}

/** @param {Point} point */
function markRow(point) {
  const at = ui.shown.indexOf(point);
  if (at >= ui.listed) extendList(at + CHUNK);
  const row = ui.rows.querySelector(`[data-point="${CSS.escape(point.name)}"]`);
  row?.setAttribute("aria-current", "true");
  const below = row ? row.offsetTop - ui.list.scrollTop : 0;
  if (row && ui.list.clientHeight && (below < 0 || below > ui.list.clientHeight - row.offsetHeight)) ui.list.scrollTop = row.offsetTop - ui.list.clientHeight / 3;
}

/** List a group alone, as if the reader had chosen it. @param {string} name */
function showGroup(name) {
  const isKnown = device.groups.some(([each]) => each === name);
  state.query = ui.find.value = "";
  state.group = ui.group.querySelector("select").value = isKnown ? name : "";
  showList();
  scrollTo(0, 0);
}

/** Return the section whose tables have the target of a link. @param {string} hash */
function holderOf(hash) {
  const [kind, name] = hash.split("=");
  const mark = `\ue000=${kind}\ue001${name}\ue002`;
  return Object.keys(device.sections).find((section) => device.sections[section].some(([, table]) => table.includes(mark))) ?? (kind === "telegram" || kind === "message" || kind === "map" ? "maps" : "points");
}

/** @param {Point} point */
function withNeighbours(point) {
  const article = pointArticle(device, point, Math.max(280, Math.min(ui.detail.clientWidth - 24, 900)));
  const at = ui.shown.indexOf(point);
  const [before, after] = [ui.shown[at - 1], at < 0 ? undefined : ui.shown[at + 1]];
  const step = (/** @type {Point | undefined} */ other, /** @type {string} */ text) => (other ? element("a", { href: `#point=${encodeURIComponent(other.name)}`, title: other.name }, text) : element("span", { className: "soft" }, text));
  article.prepend(element("p", { className: "steps" }, element("a", { href: "#points" }, "All points"), step(before, "← Previous"), step(after, "Next →"), copyButton("Copy link", () => location.href)));
  return article;
}

/** @param {KeyboardEvent} event */
function keys(event) {
  const links = [...(ui.table.hidden ? ui.places : ui.rows).querySelectorAll("a")];
  const at = links.indexOf(document.activeElement);
  const isInput = document.activeElement === ui.find;
  const isTyping = /^(INPUT|SELECT|TEXTAREA)$/.test(document.activeElement?.tagName ?? "");
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.key === "/" && (!isTyping || (isInput && !ui.find.value))) { ui.find.focus(); ui.find.select(); }
  else if (event.key === "Escape" && isInput && ui.find.value) { ui.find.value = ""; typed(); }
  else if (event.key === "Escape" && !isInput && (at >= 0 || !isTyping)) ui.find.focus();
  else if (event.key === "Enter" && isInput) links[0]?.click();
  else if (event.key === "ArrowDown" && (isInput || at >= 0)) links[at + 1]?.focus();
  else if (event.key === "ArrowUp" && at >= 0) (links[at - 1] ?? ui.find).focus();
  else return;
  event.preventDefault();
}

function typed() {
  state.query = ui.find.value;
  if (document.body.dataset.view === "detail" && !isWide()) location.hash = "#points";
  showList();
}

function isWide() {
  return matchMedia("(min-width: 60rem)").matches;
}

function start() {
  build();
  followHeader();
  ui.index = searchIndex(device);
  showList();
  show();
  ui.find.addEventListener("input", typed);
  addEventListener("hashchange", () => { show(); if (ui.detail.firstChild && !ui.list.contains(document.activeElement)) ui.detail.querySelector("h2")?.focus({ preventScroll: true }); });
  addEventListener("keydown", keys);
  addEventListener("beforeprint", () => {
    extendList(ui.shown.length);
    for (const box of document.querySelectorAll("details")) box.open = true;
  });
  ui.detail.addEventListener("click", (/** @type {any} */ event) => {
    const name = event.target.closest?.("[data-point]")?.dataset.point;
    if (name) location.hash = `#point=${encodeURIComponent(name)}`;
  });
}

start();
