"use strict";

/* What all pages of Fieldscribe share: making elements, folding text for a search, copying, light and dark. */

const ASCII = /^[\0-\x7f]*$/;

/** Return text as a search compares it: small letters without marks. @param {string} text */
function folded(text) {
  return ASCII.test(text) ? text.toLowerCase() : text.toLowerCase().normalize("NFD").replace(/\p{M}/gu, "");
}

/** Return an element with these properties and children; texts become text nodes, never markup.
 * @param {string} name @param {any} facts @param {...any} children */
function element(name, facts, ...children) {
  const made = Object.assign(document.createElement(name), facts);
  made.append(...children.filter((child) => child !== null && child !== ""));
  return made;
}

/** Return what is stored under a key, or `usual` if the browser stores nothing. @param {string} key @param {any} usual */
function recalled(key, usual) {
  try { return JSON.parse(localStorage.getItem(`fieldscribe ${key}`) ?? "null") ?? usual; } catch { return usual; }
}

/** Store a choice of the reader; without storage it is lost when the page closes. @param {string} key @param {any} value */
function remember(key, value) {
  try { localStorage.setItem(`fieldscribe ${key}`, JSON.stringify(value)); } catch { /* a browser may refuse to store */ }
}

/** Return true if a word starts at this place of a text. @param {string} text @param {number} at */
function startsWord(text, at) {
  return at === 0 || !/[\p{L}\p{N}]/u.test(text[at - 1]);
}

/** Return a button that switches between light and dark. */
function schemeButton() {
  const root = document.documentElement;
  const stored = recalled("scheme", "");
  if (stored === "light" || stored === "dark") root.dataset.scheme = stored;
  const isDark = () => (root.dataset.scheme ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light")) === "dark";
  const button = element("button", { type: "button", className: "scheme" });
  const show = () => { button.textContent = isDark() ? "Light" : "Dark"; };
  button.addEventListener("click", () => {
    root.dataset.scheme = isDark() ? "light" : "dark";
    remember("scheme", root.dataset.scheme);
    show();
  });
  show();
  return button;
}

/** Return a button that copies the text that a function returns; null where the browser cannot copy.
 * @param {string} label @param {() => string} textOf */
function copyButton(label, textOf) {
  const button = element("button", { type: "button", className: "copy" }, label);
  button.addEventListener("click", async () => {
    try { await navigator.clipboard.writeText(textOf()); } catch { copyBySelection(textOf()); }
    button.textContent = "Copied";
    setTimeout(() => { button.textContent = label; }, 1500);
  });
  return button;
}

/** @param {string} text */
function copyBySelection(text) {
  const box = element("textarea", { value: text });
  document.body.append(box);
  box.select();
  document.execCommand("copy");
  box.remove();
}
