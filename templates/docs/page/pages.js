/* The index of devices and our own pages: one search over all of them, copying of code, light and dark. */

const MOST_HITS = 50;
const SHOWN = 90;

/** Start a page; `places` are [path, name, [anchor, title, words, heading above][]]. The words of a point are numbers.
 * @param {[string, string, [string, string, string, string][]][]} places */
function startPages(places) {
  const top = document.documentElement.dataset.top;
  const rows = places.flatMap(([path, name, inside]) => inside.map(([anchor, title, words, above]) => {
    const [place, key] = [above ? `${name}: ${above}` : name, folded(title)];
    const [numbers, rest] = path.includes("/") ? ["", folded(words)] : [` ${folded(words)} `, ""];
    return { href: `${top}/${path}${anchor && "#"}${anchor}`, name: title, place, words, key, keys: [key, ...key.split(/[\s:]+/)], title: folded(place), numbers, rest, kind: 0 };
  }));
  const header = /** @type {HTMLElement} */ (document.querySelector("header"));
  startSearch(header, rows);
  header.append(schemeButton());
  for (const box of document.querySelectorAll(".code")) box.append(copyButton("Copy", () => box.querySelector("code")?.textContent ?? ""));
  if (matchMedia("(max-width: 48rem)").matches) document.querySelector(".columns details")?.removeAttribute("open");
}

/** @param {HTMLElement} header @param {any[]} rows */
function startSearch(header, rows) {
  const input = element("input", { type: "search", id: "search", placeholder: "Search: press /", ariaLabel: "Search", autocomplete: "off", spellcheck: false });
  const [status, list] = [element("p", { className: "soft", role: "status" }), element("ol", {})];
  const hits = element("section", { id: "hits", ariaLabel: "Found", hidden: true }, status, list);
  function show() {
    const words = queryWords(input.value);
    const found = words.length ? nearest(rows, words, words.map(() => [false])) : [];
    hits.hidden = !words.length;
    status.textContent = `${found.length} ${found.length === 1 ? "place" : "places"}${found.length > MOST_HITS ? `, the nearest ${MOST_HITS} of them here` : ""}`;
    list.replaceChildren(...found.slice(0, MOST_HITS).map((row) => element("li", {}, element("a", { href: row.href }, row.name), " ", element("span", { className: "soft" }, row.place === row.name ? "" : row.place), excerpt(row.words, words))));
  }
  input.addEventListener("input", show);
  list.addEventListener("click", () => { hits.hidden = true; });
  addEventListener("keydown", (event) => {
    const links = [...list.querySelectorAll("a")];
    const at = links.indexOf(document.activeElement);
    const isInside = document.activeElement === input || at >= 0;
    if (event.ctrlKey || event.metaKey || event.altKey || (event.key !== "/" && !isInside)) return;
    if (event.key === "/" && !isInside) input.focus();
    else if (event.key === "Escape") { input.value = ""; show(); input.focus(); }
    else if (event.key === "Enter" && at < 0) links[0]?.click();
    else if (event.key === "ArrowDown") links[at + 1]?.focus();
    else if (event.key === "ArrowUp" && at >= 0) (links[at - 1] ?? input).focus();
    else return;
    event.preventDefault();
  });
  header.append(element("search", {}, input));
  header.after(hits);
}

/** Return the text around the first of these words in it, with that word marked. @param {string} text @param {string[]} words */
function excerpt(text, words) {
  const small = text.toLowerCase();
  const word = words.find((each) => small.includes(each)) ?? "";
  const at = small.indexOf(word);
  const start = at < SHOWN / 2 ? 0 : text.lastIndexOf(" ", at - SHOWN / 3) + 1;
  const rest = text.slice(at + word.length);
  return element("small", {}, (start ? "… " : "") + text.slice(start, at), element("mark", {}, text.slice(at, at + word.length)), rest.slice(0, SHOWN) + (rest.length > SHOWN ? " …" : ""));
}
