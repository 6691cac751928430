/* The search: a plain scan of folded texts, which are folded once when the page opens. */

/** Return the ways in which people write an address and the numbers that manuals print for it. @param {Point} point */
function addressWords(point) {
  const words = [];
  for (const address of point.addresses.length ? [Math.min(...point.addresses), ...point.addresses] : []) {
    const hex = address.toString(16);
    words.push(`${hex}h`, `${hex.padStart(4, "0")}h`, `0x${hex}`, `0x${hex.padStart(4, "0")}`, String(address));
  }
  for (const number of point.numbers) {
    if (!number) continue;
    words.push(folded(String(number)));
    if (number > 99999 && number % 100000 < 10000) words.push(String(Math.floor(number / 100000)) + String(number % 10000).padStart(4, "0"));
  }
  return words;
}

/** Prepare the points of a device, and further places, for `search`. @param {PageDevice} device */
function searchIndex(device) {
  const kinds = device.kinds.map((kind) => folded(wordsOfKind(device, kind).join("\n")));
  const points = device.points.map((point) => {
    const titles = titlesOf(point.title);
    const keys = [point.code, point.name, ...point.was].filter(Boolean).map(folded);
    const title = folded(titles.join("\n"));
    const numbers = ` ${[...new Set(addressWords(point))].join(" ")} `;
    const errata = point.errata.map((at) => device.errata[at].id);
    const rest = [...titlesOf(point.note), point.variant, ...point.rows.map((row) => row[2]), ...errata, ...titlesOf(device.groups[point.group]?.[1] ?? "")];
    return { point, keys, key: keys.join("\n"), title, numbers, rest: folded(rest.join("\n")), kind: point.kind };
  });
  return { kinds, points, places: placesOf().map((place) => ({ ...place, key: folded(place.title), text: folded(place.text) })) };
}

/** @param {PageDevice} device @param {Kind} kind */
function wordsOfKind(device, kind) {
  const words = [kind.type, kind.unit, kind.unitName, kind.space, kind.telegram, ...kind.rows.map((row) => row[2])];
  const named = (/** @type {any[]} */ entry) => [entry[1], ...titlesOf(entry[2]), entry[3] ?? ""];
  if (kind.enum !== undefined) words.push(...device.enums[kind.enum].entries.flatMap(named));
  if (kind.codes !== undefined) words.push(...device.codes[kind.codes].flatMap((code) => [code[0], ...named(code)]));
  if (kind.word !== undefined) {
    for (const [, , name, title, , values] of device.words[kind.word]) words.push(name, ...titlesOf(title), ...values.flatMap(named));
  }
  return words.filter(Boolean);
}

/** Return the points with all words, the nearest first, and the further places.
 * @param {any} index @param {string} query @param {(point: Point) => boolean} isWanted */
function search(index, query, isWanted) {
  const words = queryWords(query);
  const byKind = words.map((word) => index.kinds.map((/** @type {string} */ text) => text.includes(word)));
  const points = nearest(index.points.filter((/** @type {any} */ row) => isWanted(row.point)), words, byKind).map((row) => row.point);
  const places = words.length ? index.places.filter((/** @type {any} */ place) => words.every((word) => place.key.includes(word) || place.text.includes(word))) : [];
  const nearness = (/** @type {any} */ place) => words.filter((word) => !place.key.includes(word)).length;
  return { points, places: places.sort((/** @type {any} */ a, /** @type {any} */ b) => nearness(a) - nearness(b)) };
}

/** Return the words of a query as texts are compared. @param {string} query */
function queryWords(query) {
  return folded(query).split(/\s+/).filter(Boolean);
}

/** Return the rows with all words, the nearest first; `byKind` tells for each word which kinds of rows have it.
 * @param {any[]} rows @param {string[]} words @param {any} byKind */
function nearest(rows, words, byKind) {
  const hits = [];
  for (const row of rows) {
    let rank = 0;
    for (let at = 0; at < words.length; at += 1) {
      const of = rankOf(row, words[at], byKind[at]);
      if (of < 0) { rank = -1; break; }
      rank += of;
    }
    if (rank >= 0) hits.push({ row, rank });
  }
  if (words.length) hits.sort((a, b) => a.rank - b.rank);
  return hits.map((hit) => hit.row);
}

/** @param {any} row @param {string} word @param {any} byKind */
function rankOf(row, word, byKind) {
  const inKey = row.key.indexOf(word);
  if (inKey >= 0 && row.keys.includes(word)) return 0;
  if (row.numbers.includes(` ${word} `)) return 1;
  if (inKey >= 0) return inKey === 0 || startsWord(row.key, inKey) ? 2 : 4;
  const inTitle = row.title.indexOf(word);
  if (inTitle >= 0) return startsWord(row.title, inTitle) ? 3 : 5;
  if (row.numbers.includes(word)) return 6;
  return row.rest.includes(word) || byKind[row.kind] ? 8 : -1;
}
