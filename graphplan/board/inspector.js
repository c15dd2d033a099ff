// The fields of the object that is selected: coordinates, lengths, angles, speeds and forces, to be typed.

import { store } from "./store.js";

function element(name, attributes, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

const shown = (value) => String(Number(Number(value).toPrecision(7)));
const read = (text) => Number(text.trim().replace(",", ".").replace("−", "-"));

export class Inspector {
  constructor(form, tools, words) {
    Object.assign(this, { form, tools, words });
    form.addEventListener("submit", (event) => event.preventDefault());
    form.addEventListener("keydown", (event) => { if (event.key === "Escape") this.tools.select(null); });
  }

  show() {
    const { selected } = this.tools, { objects } = store, { form } = this;
    if (form.contains(document.activeElement) && this.shown === this.#key()) return this.#refresh();
    const rows = selected && this.#exists(selected) ? this.#rows(selected, objects) : [];
    this.shown = this.#key();
    form.hidden = !rows.length;
    form.replaceChildren(...rows);
    return undefined;
  }

  #key() { return this.tools.selected ? `${this.tools.selected.kind} ${this.tools.selected.name}` : ""; }

  #exists({ kind, name }) {
    const { points, links, slides, drives, forces } = store.objects;
    return { point: points, link: links, slide: slides, drive: drives, force: forces }[kind]?.[name] !== undefined;
  }

  #refresh() { // while a field is typed in, the others follow
    for (const input of this.form.querySelectorAll("input")) {
      const value = this.values?.[input.name]?.();
      if (input !== document.activeElement && value !== undefined) input.value = value;
    }
  }

  #rows({ kind, name }, objects) {
    this.values = {};
    switch (kind) {
      case "point": return this.#point(name, objects);
      case "link": return this.#link(name, objects);
      case "drive": return this.#drive(name, objects.drives[name]);
      case "force": return this.#force(name, objects.forces[name]);
      case "slide": return this.#slide(name, objects.slides[name]);
      default: return [];
    }
  }

  #head(text, kind, name) {
    const button = element("button", { type: "button", class: "remove", "aria-label": this.words.remove }, "✕");
    button.addEventListener("click", () => this.tools.erase({ kind, name }));
    return element("h2", {}, text, button);
  }

  #field(key, label, value, write, unit = "", text = false) {
    const input = element("input", { name: key, inputmode: text ? "text" : "decimal", autocomplete: "off", size: "8" });
    this.values[key] = value;
    input.value = value();
    input.addEventListener("change", () => {
      const typed = text ? input.value.trim() : read(input.value);
      if (text ? typed : Number.isFinite(typed)) write(typed);
      else input.value = value();
    });
    return element("label", {}, element("span", {}, label), input, unit);
  }

  #check(label, checked, write) {
    const input = element("input", { type: "checkbox" });
    input.checked = checked;
    input.addEventListener("change", () => write(input.checked));
    return element("label", { class: "check" }, input, label);
  }

  #point(name, objects) {
    const { words } = this, point = objects.points[name], unit = objects.units.length;
    const at = () => store.objects.points[name]?.at ?? [0, 0];
    const move = (axis) => (value) => store.edit([{ do: "move", point: name, to: at().with(axis, value) }]);
    const rows = [this.#head(`${words.point} ${name}`, "point", name),
      this.#field("name", words.name, () => name, (to) => this.#rename("point", name, to), "", true),
      this.#field("x", "x", () => shown(at()[0]), move(0), unit),
      this.#field("y", "y", () => shown(at()[1]), move(1), unit),
      this.#check(words.pivot, point.fixed, (fixed) => store.edit([{ do: "fix", point: name, fixed }])),
      this.#check(words.asked, point.asked, (wanted) => store.edit([{ do: "ask", point: name, wanted }]))];
    if (point.how !== "given") rows.push(this.#freeing(name, Object.keys(point.locked)));
    return rows;
  }

  #freeing(name, kept) {
    const button = element("button", { type: "button" }, this.words.free);
    button.addEventListener("click", () => store.edit([{ do: "free", point: name }]));
    return element("p", {}, kept.length ? `${this.words.kept}: ${kept.map((other) => `${other}${name}`).join(", ")} ` : "", button);
  }

  async #rename(kind, old, to) {
    if (to === old) return;
    const answer = await store.edit([{ do: "rename", kind, old, new: to }]);
    this.tools.select({ kind, name: answer.refused ? old : to });
  }

  #link(name, objects) {
    const { words } = this, { points } = objects.links[name], unit = objects.units.length;
    const place = (point) => store.objects.points[point]?.at ?? [NaN, NaN];
    const size = ([a, b]) => () => shown(Math.hypot(place(b)[0] - place(a)[0], place(b)[1] - place(a)[1]));
    const pairs = points.flatMap((a, i) => points.slice(i + 1).map((b) => [a, b])).slice(0, 6);
    const driven = objects.drives.findIndex((drive) => drive.link === name && !drive.slides);
    const rows = [this.#head(`${words.link} ${name}`, "link", name),
      this.#field("name", words.name, () => name, (to) => this.#rename("link", name, to), "", true),
      ...pairs.map((ends) => this.#field(`length ${ends.join(" ")}`, ends.join(""), size(ends),
        (value) => store.edit([{ do: "length", ends, length: value }]), unit))];
    if (driven >= 0) rows.push(...this.#driveFields(driven, objects.drives[driven]));
    if (!objects.links[name].frame) {
      rows.push(this.#field("mass", words.mass, () => shown(store.objects.masses[name] ?? 0),
        (value) => store.edit([{ do: "mass", link: name, mass: value }]), objects.units.mass));
    }
    return rows;
  }

  #drive(number, drive) {
    return [this.#head(`${this.words.drive} ${drive.link}`, "drive", number), ...this.#driveFields(number, drive)];
  }

  #driveFields(number, drive) {
    const { words } = this, { objects } = store;
    const [rate, change] = drive.slides ? ["speed", "acceleration"] : drive.rpm === undefined ? ["omega", "alpha"] : ["rpm", "alpha"];
    const of = () => store.objects.drives[number] ?? drive, { length } = objects.units;
    const units = drive.slides ? [`${length}/s`, `${length}/s²`] : [drive.rpm === undefined ? "rad/s" : "1/min", "rad/s²"];
    const set = (key) => (value) => store.edit([{ do: "value", path: ["drive", number, key], value }]);
    const rows = [this.#field("rate", drive.slides ? "v" : drive.rpm === undefined ? "ω" : "n",
      () => shown(drive.rpm === undefined ? of().rate : of().rpm), set(rate), units[0]),
    this.#field("change", drive.slides ? "a" : "α", () => shown(of().change), set(change), units[1])];
    const points = objects.links[drive.link]?.points ?? [];
    const pivot = points.find((point) => objects.points[point]?.fixed), end = points.find((point) => point !== pivot);
    if (!drive.slides && pivot && end) {
      const place = (point) => store.objects.points[point]?.at ?? [0, 0];
      const angle = () => shown(Math.round(Math.atan2(place(end)[1] - place(pivot)[1], place(end)[0] - place(pivot)[0]) * 18e5 / Math.PI) / 1e4);
      rows.push(this.#field("angle", words.angle, angle, (value) => store.edit([{ do: "angle", ends: [pivot, end], angle: value }]), "°"));
    }
    return rows;
  }

  #force(number, force) {
    const unit = store.objects.units.force, of = () => store.objects.forces[number]?.value ?? force.value ?? [0, 0];
    const set = (axis) => (value) => store.edit([{ do: "value", path: ["forces", number, "value"], value: of().with(axis, value) }]);
    return [this.#head(`${this.words.load} ${force.at}`, "force", number),
      this.#field("x", "F_x", () => shown(of()[0]), set(0), unit), this.#field("y", "F_y", () => shown(of()[1]), set(1), unit)];
  }

  #slide(number, slide) {
    const rows = [this.#head(`${this.words.slide} ${slide.link} – ${slide.along}`, "slide", number)];
    if (!slide.through && slide.direction) {
      const of = () => store.objects.slides[number]?.direction ?? slide.direction;
      const angle = () => shown(Math.round(Math.atan2(of()[1], of()[0]) * 18e5 / Math.PI) / 1e4);
      rows.push(this.#field("angle", this.words.angle, angle,
        (value) => store.edit([{ do: "value", path: ["slides", number, "direction"], value }]), "°"));
    }
    return rows;
  }
}
