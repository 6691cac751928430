"use strict";

/* The pages of Fieldscribe and the index of devices: search, copying of code, light and dark. */

const MOST_HITS = 50;

/** Return text as a search compares it: small letters without marks. */
function folded(text) {
  return text.toLowerCase().normalize("NFD").replace(/\p{M}/gu, "");
}

function element(name, text, facts = {}) {
  const made = Object.assign(document.createElement(name), facts);
  made.textContent = text;
  return made;
}

/** Return the rows with all words, the nearest first: title before text, whole words before parts of words. */
function searched(rows, query) {
  const words = folded(query).split(/\s+/).filter(Boolean);
  if (!words.length) return [];
  const hits = [];
  for (const row of rows) {
    let rank = 0;
    for (const word of words) {
      const inTitle = row.key.indexOf(word);
      if (inTitle >= 0) rank += row.key === word ? 0 : startsWord(row.key, inTitle) ? 1 : 2;
      else if (row.near.includes(word)) rank += 3;
      else if (row.text.includes(word)) rank += 4;
      else { rank = -1; break; }
    }
    if (rank >= 0) hits.push({ row, rank });
  }
  return hits.sort((a, b) => a.rank - b.rank).map((hit) => hit.row);
}

function startsWord(text, at) {
  return at === 0 || !/[\p{L}\p{N}]/u.test(text[at - 1]);
}

/** Return the words around the first match, which is marked. */
function excerpt(row, query) {
  const word = folded(query).split(/\s+/).find((each) => each && row.text.includes(each)) ?? "";
  const at = word ? row.text.indexOf(word) : 0;
  const start = at < 40 ? 0 : row.words.lastIndexOf(" ", at - 30) + 1;
  const rest = row.words.slice(at + word.length);
  const made = element("small", (start ? "… " : "") + row.words.slice(start, at));
  if (word) made.append(element("mark", row.words.slice(at, at + word.length)));
  made.append(rest.slice(0, 90) + (rest.length > 90 ? " …" : ""));
  return made;
}

/** Start a page; `places` are [path, name, [anchor, title, words, heading above][]]. */
function startPages(places) {
  const top = document.documentElement.dataset.top + "/";
  const rows = places.flatMap(([path, place, inside]) => inside.map(([anchor, title, words, above]) => ({
    href: top + path + (anchor && "#" + anchor), title, place: above ? `${place}: ${above}` : place, words,
    key: folded(title), text: folded(words), near: folded(place + " " + above),
  })));
  startSearch(rows);
  startScheme();
  if (navigator.clipboard) document.querySelectorAll(".code").forEach(addCopy);
  if (matchMedia("(max-width: 48rem)").matches) document.querySelector(".columns nav details").open = false;
}

function startSearch(rows) {
  const [input, hits] = [document.getElementById("page-find"), document.getElementById("page-hits")];
  const [status, list] = [hits.querySelector("p"), hits.querySelector("ol")];
  document.getElementById("page-search").hidden = false;
  function show() {
    const found = searched(rows, input.value);
    hits.hidden = !input.value.trim();
    status.textContent = found.length > MOST_HITS ? `${found.length} places, the nearest ${MOST_HITS}` : found.length === 1 ? "1 place" : `${found.length} places`;
    list.replaceChildren(...found.slice(0, MOST_HITS).map((row) => {
      const item = element("li", "");
      item.append(element("a", row.title, { href: row.href }), element("span", " " + row.place), excerpt(row, input.value));
      return item;
    }));
  }
  input.addEventListener("input", show);
  list.addEventListener("click", () => { hits.hidden = true; });
  document.addEventListener("keydown", (event) => {
    const links = [...list.querySelectorAll("a")];
    const at = links.indexOf(document.activeElement);
    const isInside = document.activeElement === input || at >= 0;
    if (event.key === "/" && !isInside && !event.ctrlKey && !event.metaKey) input.focus();
    else if (event.key === "Escape" && isInside) { input.value = ""; show(); input.focus(); }
    else if (event.key === "Enter" && document.activeElement === input) links[0]?.click();
    else if (event.key === "ArrowDown" && isInside) links[at + 1]?.focus();
    else if (event.key === "ArrowUp" && at >= 0) (links[at - 1] ?? input).focus();
    else return;
    event.preventDefault();
  });
  show();
}

function startScheme() {
  const [button, root] = [document.getElementById("page-scheme"), document.documentElement];
  const isDark = () => (root.dataset.scheme ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light")) === "dark";
  const show = () => { button.textContent = isDark() ? "Light" : "Dark"; };
  try { if (localStorage.getItem("scheme")) root.dataset.scheme = localStorage.getItem("scheme"); } catch { /* a browser may refuse to store */ }
  button.addEventListener("click", () => {
    root.dataset.scheme = isDark() ? "light" : "dark";
    try { localStorage.setItem("scheme", root.dataset.scheme); } catch { /* then the choice ends with the page */ }
    show();
  });
  button.hidden = false;
  show();
}

function addCopy(box) {
  const button = element("button", "Copy", { type: "button", className: "copy" });
  button.addEventListener("click", async () => {
    await navigator.clipboard.writeText(box.querySelector("code").textContent);
    button.textContent = "Copied";
    setTimeout(() => { button.textContent = "Copy"; }, 1500);
  });
  box.append(button);
}
