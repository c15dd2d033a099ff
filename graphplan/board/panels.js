// The tabs beside the drawing: the sheet, its steps in words, the results, and the scene's text.

import { store } from "./store.js";

const TYPING = 1500; // ms in which what is typed is one step of the history

function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

export class Panels {
  #pages = []; // addresses of the pictures that are shown
  #drawn = null;
  #typed = 0;
  #typing = 0;

  constructor(words) {
    this.words = words;
    this.tabs = [...document.querySelectorAll("[role=tab]")];
    this.area = document.getElementById("text");
    for (const tab of this.tabs) {
      tab.addEventListener("click", () => this.open(tab));
      tab.addEventListener("keydown", (event) => this.#key(event));
    }
    this.area.addEventListener("input", () => this.#type());
    document.getElementById("sheet-bar").addEventListener("submit", (event) => this.#send(event.target));
    document.getElementById("sheet-svg").addEventListener("click", (event) => {
      event.preventDefault();
      if (store.sheet) save(store.sheet.pages[0], "sheet.svg", "image/svg+xml");
    });
    this.open(this.tabs[0]);
  }

  open(tab) {
    for (const one of this.tabs) {
      const chosen = one === tab;
      one.setAttribute("aria-selected", chosen);
      one.tabIndex = chosen ? 0 : -1;
      document.getElementById(one.getAttribute("aria-controls")).hidden = !chosen;
    }
    this.current = tab.id.replace("tab-", "");
    store.wantsSheet = this.current === "sheet" || this.current === "steps";
    store.askSheet();
    this.show();
  }

  #key(event) {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    const tab = this.tabs[(this.tabs.indexOf(event.target) + step + this.tabs.length) % this.tabs.length];
    this.open(tab);
    tab.focus();
    event.preventDefault();
    event.stopPropagation();
  }

  #type() {
    const now = Date.now();
    if (now - this.#typed > TYPING) this.#typing += 1;
    this.#typed = now;
    store.write(this.area.value, `typing ${this.#typing}`);
  }

  #send(form) {
    form.elements.text.value = store.text;
    form.elements.language.value = store.language;
  }

  show() {
    if (document.activeElement !== this.area || !store.busy) {
      if (this.area.value !== store.text) this.area.value = store.text;
    }
    if (this.current === "results") this.#showResults();
    if (this.current === "sheet" || this.current === "steps") this.#showSheet();
  }

  goTo(line) { // the text, with this line marked
    this.open(this.tabs.at(-1));
    const lines = this.area.value.split("\n"), start = lines.slice(0, line - 1).join("\n").length + (line > 1 ? 1 : 0);
    this.area.focus();
    this.area.setSelectionRange(start, start + (lines[line - 1]?.length ?? 0));
    this.area.scrollTop = (line - 4) * (this.area.scrollHeight / Math.max(lines.length, 1));
  }

  // ---- sheet and steps ----

  #showSheet() {
    const { sheet } = store, pages = document.getElementById("pages"), steps = document.getElementById("panel-steps");
    const bar = document.getElementById("sheet-bar");
    bar.hidden = !store.results;
    pages.classList.toggle("old", Boolean(sheet) && store.busy);
    if (this.#drawn === sheet && sheet) return;
    this.#drawn = sheet;
    this.#pages.forEach((page) => URL.revokeObjectURL(page));
    this.#pages = (sheet?.pages ?? []).map((page) => URL.createObjectURL(new Blob([page], { type: "image/svg+xml" })));
    if (!sheet) {
      pages.replaceChildren(element("p", { class: "empty" }, this.words.sheet_empty));
      steps.replaceChildren(element("p", { class: "empty" }, this.words.sheet_empty));
      return;
    }
    pages.replaceChildren(...sheet.missing.map((line) => element("p", { class: "note" }, line)),
      ...this.#pages.map((page, i) => element("a", { href: page, target: "_blank" },
        element("img", { src: page, alt: `${this.words.sheet} ${i + 1}` }))));
    steps.replaceChildren(...this.#steps(sheet.steps));
  }

  #steps({ entries, stages, structure }) {
    const parts = [element("p", { class: "note" }, structure.join("; "))];
    let stage, list;
    for (const entry of entries) {
      if (entry.stage !== stage || !list) {
        stage = entry.stage;
        const about = stages[stage];
        if (about) {
          parts.push(element("h3", {}, ...lettered(capital(about.title))));
          if (about.equation) parts.push(element("p", { class: "equation" }, ...lettered(about.equation)));
          if (about.law) parts.push(element("p", { class: "law" }, ...lettered(capital(about.law))));
        }
        parts.push(list = element("ol"));
      }
      const [first, last] = [entry.steps[0], entry.steps.at(-1)];
      list.append(element("li", {}, element("b", {}, first === last ? `${first}` : `${first}–${last}`), element("span", {}, ...lettered(entry.sentence))));
    }
    return parts;
  }

  // ---- results ----

  #showResults() {
    const panel = document.getElementById("panel-results"), { results, words } = { results: store.results, words: this.words };
    if (!results) {
      panel.replaceChildren(element("p", { class: "empty" }, words.results_empty));
      return;
    }
    const { length, force } = results.units, parts = [];
    const vector = (value) => (value ? [size(value), ...value.map(figure)] : ["–", "–", "–"]);
    const points = Object.entries(results.points ?? {}).filter(([, of]) => of);
    for (const [kind, unit] of [["velocity", `${length}/s`], ["acceleration", `${length}/s²`]]) {
      const rows = points.filter(([, of]) => of[kind]).map(([name, of]) => [name, ...vector(of[kind])]);
      if (rows.length) parts.push(table(`${words[kind]}, ${unit}`, ["", words.size, "x", "y"], rows, kind));
    }
    const links = Object.entries(results.links ?? {}).filter(([, of]) => of);
    if (links.length) {
      parts.push(table(words.rates, ["", "ω, rad/s", "α, rad/s²"], links.map(([name, of]) => [name, figure(of.omega), figure(of.alpha)])));
    }
    const slides = Object.entries(results.slides ?? {}).filter(([, of]) => of);
    if (slides.length) {
      parts.push(table(words.sliding, ["", `v, ${length}/s`, `a, ${length}/s²`],
        slides.map(([name, of]) => [name, figure(of.velocity), figure(of.acceleration)])));
    }
    const reactions = results.reactions ?? [];
    if (reactions.length) {
      parts.push(table(`${words.reactions}, ${force}`, ["", words.size, "x", "y"], reactions.map((one) => [
        one.at ? `${one.on ?? ""} ${one.at}` : one.slide ?? one.gear ?? one.contact ?? one.strand ?? "", ...vector(one.force)])));
    }
    const balances = [results.balance ?? []].flat().filter(Boolean);
    if (balances.length) {
      parts.push(table(words.balance, ["", "", ""], balances.map((one) => [one.link ?? one.on ?? "",
        one.moment !== undefined ? figure(one.moment) : figure(one.force ? Math.hypot(...[one.force].flat()) : null),
        one.moment !== undefined ? `${force}·m` : force])));
    }
    const others = Object.entries(results.poles ?? {});
    if (others.length) parts.push(table(words.poles, ["", "x", "y"], others.map(([name, at]) => [name, ...(at?.at ?? at ?? [null, null]).map?.(figure) ?? []])));
    const gap = Math.max(...Object.values(results.check ?? {}).map(Number), 0);
    parts.push(element("p", { class: "note" }, `${words.checked} ${gap.toExponential(1)}`));
    panel.replaceChildren(...parts);
  }
}

const capital = (text) => (/^[A-Za-z]_|^[α-ω]/.test(text) ? text : text.slice(0, 1).toUpperCase() + text.slice(1));

function lettered(text) { // indices below and above the line
  return text.split(/([_^][A-Za-z0-9]+(?:\(\d+\))?)/).map((part, i) => {
    if (i % 2 === 0) return part;
    return element(part[0] === "_" ? "sub" : "sup", {}, part.slice(1));
  });
}

function figure(value) {
  if (value === null || value === undefined || !Number.isFinite(Number(value))) return "–";
  const number = Number(value);
  if (number === 0) return "0";
  const text = Math.abs(number) >= 1e7 || Math.abs(number) < 1e-4 ? number.toExponential(4) : String(Number(number.toPrecision(5)));
  return text.replace("-", "−");
}

const size = (value) => figure(Math.hypot(...[value].flat().map(Number)));

function table(caption, heads, rows, kind = "") {
  return element("table", kind ? { class: kind } : {}, element("caption", {}, caption),
    element("thead", {}, element("tr", {}, ...heads.map((head) => (head ? element("th", { scope: "col" }, head) : element("td"))))),
    element("tbody", {}, ...rows.map(([name, ...cells]) => element("tr", {}, element("th", { scope: "row" }, name),
      ...cells.map((cell) => element("td", {}, cell))))));
}

export function save(content, name, type) {
  const address = URL.createObjectURL(new Blob([content], { type }));
  const link = element("a", { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
