// The tools: what a press, a drag and a release on the drawing mean, by mouse, pen, finger and keys.

import { distance, plus } from "./geometry.js";
import { make } from "./drawing.js";
import { store } from "./store.js";

const CLICK = 5; // pixels that a pointer may move in a click
const ALIGNED = 0.07; // radians: a slide's direction so near to an axis is along it
const FORCE_PER_LENGTH = 1; // units of force that a length of the drag stands for
export const TOOLS = ["select", "point", "link", "pivot", "slide", "drive", "ask", "load", "erase"];

export class Tools extends EventTarget {
  tool = "select";
  chain = []; // points of a link that is being drawn
  sliding = null; // the point whose slide waits for its direction
  loaded = null; // the point whose force is being drawn
  selected = null;
  pointers = new Map();
  #press = null;
  #drags = 0;
  #waiting = [];
  #working = null;

  constructor(svg, view, drawing, words) {
    super();
    Object.assign(this, { svg, view, drawing, words });
    svg.addEventListener("pointerdown", (event) => {
      svg.focus({ preventScroll: true });
      svg.setPointerCapture?.(event.pointerId);
      if (event.button === 1) event.preventDefault();
      this.#inOrder(this.#pressOf(event), (press) => this.#down(press));
    });
    svg.addEventListener("pointermove", (event) => this.#inOrder(this.#pressOf(event), (press) => this.#move(press), "move"));
    svg.addEventListener("pointerup", (event) => this.#inOrder(this.#pressOf(event), (press) => this.#up(press)));
    svg.addEventListener("pointercancel", (event) => this.#inOrder(this.#pressOf(event), (press) => this.#cancel(press)));
    svg.addEventListener("pointerleave", () => this.#inOrder(null, () => this.#show(null)));
    svg.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    svg.addEventListener("contextmenu", (event) => event.preventDefault());
    svg.addEventListener("focusin", (event) => this.#focus(event));
    svg.addEventListener("focusout", () => { if (!drawing.refocusing) this.#hideCursor(); });
    svg.addEventListener("mousedown", (event) => event.preventDefault()); // a press takes no object's focus
  }

  take(tool) {
    return this.later(() => {
      this.tool = tool;
      this.#forget();
      this.#changed();
    });
  }

  // ---- one thing after another: what is pressed means what was there when all earlier presses were carried out ----

  later(action) { return this.#inOrder(null, action); }

  #inOrder(press, action, kind = "") {
    const last = this.#waiting.at(-1);
    if (kind && last?.kind === kind && last.press.pointerId === press.pointerId) last.press = press;
    else this.#waiting.push({ press, action, kind });
    return this.#working ??= this.#work();
  }

  async #work() {
    store.expect(1);
    while (this.#waiting.length) {
      if (store.editing) await store.edited();
      const { press, action } = this.#waiting.shift();
      try {
        await action(press);
      } catch (error) {
        console.error(error);
      }
    }
    this.#working = null;
    store.expect(-1);
  }

  #pressOf({ pointerId, pointerType, button, clientX, clientY }) {
    const box = this.svg.getBoundingClientRect();
    return { pointerId, pointerType, button, place: [clientX - box.left, clientY - box.top] };
  }

  #forget() {
    this.chain = [];
    this.sliding = this.loaded = null;
    this.drawing.preview = [];
  }

  select(object) {
    this.selected = this.drawing.selected = object;
    this.#changed();
  }

  #changed() { this.dispatchEvent(new Event("change")); }

  get isLinking() { return this.chain.length > 0 || this.#working !== null; }

  get hint() {
    const { words } = this;
    if (this.tool === "link" && this.chain.length) return `${this.chain.join(" ")} … ${words.hint_link_end}`;
    if (this.sliding) return words.hint_slide_to;
    return words[`hint_${this.tool}`] ?? "";
  }

  // ---- pointers ----

  #down(event) {
    const { place } = event;
    this.pointers.set(event.pointerId, place);
    this.#hideCursor();
    if (this.pointers.size === 2) return this.#pinch();
    const pans = event.button === 1 || event.button === 2;
    const object = pans ? null : this.drawing.objectAt(place, event.pointerType);
    this.#press = { id: event.pointerId, place, last: place, moved: false, pans, object, kind: event.pointerType };
    if (event.button !== 0 && !pans) this.#press = null;
    if (this.tool === "load" && object?.kind === "point") this.loaded = object.name;
    if (this.tool === "select" && !pans) {
      this.select(object);
      if (object?.kind === "point") this.#press.drag = `drag ${this.#drags += 1}`;
      else this.#press.pans = !object;
    }
    return undefined;
  }

  #pinch() {
    const [a, b] = [...this.pointers.values()];
    this.#press = null;
    this.loaded = null;
    this.pinch = { apart: distance(a, b), middle: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2] };
  }

  #move(event) {
    const { place } = event, press = this.#press;
    if (this.pointers.has(event.pointerId)) this.pointers.set(event.pointerId, place);
    if (this.pinch && this.pointers.size === 2) {
      const [a, b] = [...this.pointers.values()], middle = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
      const apart = distance(a, b);
      this.view.pan(middle[0] - this.pinch.middle[0], middle[1] - this.pinch.middle[1]);
      this.view.zoom(apart / (this.pinch.apart || 1), middle);
      this.pinch = { apart, middle };
      return this.drawing.draw();
    }
    if (press && press.id === event.pointerId) {
      if (distance(place, press.place) > CLICK) press.moved = true;
      if (press.pans && press.moved) {
        this.view.pan(place[0] - press.last[0], place[1] - press.last[1]);
        press.last = place;
        return this.drawing.draw();
      }
      if (press.drag && press.moved) return this.#dragPoint(press.object.name, place, press.drag);
    }
    return this.#show(place);
  }

  #dragPoint(name, place, group) {
    const to = this.view.round(this.view.toScene(place)), point = this.drawing.objects.points[name];
    if (!point) return undefined;
    this.#readout(to);
    return store.edit([{ do: "move", point: name, to }], group);
  }

  #up(event) {
    const { place } = event, press = this.#press;
    this.pointers.delete(event.pointerId);
    if (this.pinch) {
      if (!this.pointers.size) this.pinch = null;
      return undefined;
    }
    if (!press || press.id !== event.pointerId) return undefined;
    this.#press = null;
    if (press.pans && press.moved) return undefined;
    if (this.loaded !== null) return this.#endLoad(place);
    if (this.tool !== "select") return press.pans ? undefined : this.click(press.place, press.kind);
    return press.drag && press.moved ? this.#dragPoint(press.object.name, place, press.drag) : undefined;
  }

  #cancel(event) {
    this.pointers.delete(event.pointerId);
    if (!this.pointers.size) this.pinch = null;
    this.#press = this.loaded = null;
    this.#show(null);
  }

  #wheel(event) {
    event.preventDefault();
    const size = event.deltaMode === 1 ? 16 : 1;
    this.view.zoom(Math.exp(-event.deltaY * size * (event.ctrlKey ? 0.01 : 0.0015)), this.#pressOf(event).place);
    this.drawing.draw();
  }

  // ---- what a click does ----

  click(place, pointer = "mouse") {
    if (!store.readable) {
      store.tell(this.words.unreadable);
      return undefined;
    }
    const point = this.drawing.pointAt(place, pointer), to = this.view.round(this.view.toScene(place));
    const selected = this.drawing.objectAt(place, pointer);
    switch (this.tool) {
      case "select": return this.select(selected);
      case "point": return this.#clickPoint(place, to);
      case "link": return this.#clickLink(point, to);
      case "pivot": return this.#clickPivot(point, to);
      case "slide": return this.#clickSlide(point, place, to, pointer);
      case "drive": return this.#clickDrive(point, place, pointer);
      case "ask": return point === null ? undefined : store.edit([{ do: "ask", point, wanted: true }]);
      case "erase": return selected ? this.erase(selected) : undefined;
      default: return undefined;
    }
  }

  #clickPoint(place, to) {
    const there = this.drawing.pointAt(place, "mouse", 4);
    if (there !== null) return this.select({ kind: "point", name: there });
    return store.edit([{ do: "point", at: to }]).then(({ made }) => {
      if (made?.length) this.select({ kind: "point", name: made[0] });
    });
  }

  async #clickLink(point, to) {
    let name = point;
    if (name === null) name = (await store.edit([{ do: "point", at: to }])).made?.[0];
    if (name === undefined || this.tool !== "link") return;
    if (this.chain.at(-1) === name) return void this.finishLink();
    if (!this.chain.includes(name)) this.chain.push(name);
    this.#show(null);
    this.#changed();
  }

  finishLink() {
    const points = this.chain;
    this.#forget();
    this.#changed();
    if (!points.length) return undefined;
    return store.edit([{ do: "link", points }]).then(({ made }) => {
      if (made?.length) this.select({ kind: "link", name: made[0] });
    });
  }

  async #clickPivot(point, to) {
    const name = point ?? (await store.edit([{ do: "point", at: to }])).made?.[0];
    if (name !== undefined) await store.edit([{ do: "fix", point: name }]);
  }

  #clickSlide(point, place, to, pointer) {
    if (this.sliding === null) {
      this.sliding = point;
      this.#show(null);
      return this.#changed();
    }
    const at = this.sliding, own = this.drawing.linksAt(at);
    const guide = this.drawing.linkAt(place, pointer, own), start = this.drawing.objects.points[at]?.at;
    this.#forget();
    this.#changed();
    if (!start) return undefined;
    if (guide !== null && point === null) return store.edit([{ do: "slide", point: at, along: guide }]);
    const end = point === null ? to : this.drawing.objects.points[point].at;
    const way = this.#aligned([end[0] - start[0], end[1] - start[1]]);
    if (!way) {
      this.sliding = at; // clicked twice at the same place: the direction is still wanted
      return this.#changed();
    }
    if (guide !== null && this.drawing.linksAt(point).includes(guide) && !this.drawing.objects.points[point].fixed) {
      return store.edit([{ do: "slide", point: at, along: guide }]);
    }
    return store.edit([{ do: "slide", point: at, direction: way }]);
  }

  #aligned([x, y]) {
    if (!x && !y) return null;
    if (Math.abs(y) < Math.abs(x) * ALIGNED) return [Math.sign(x), 0];
    if (Math.abs(x) < Math.abs(y) * ALIGNED) return [0, Math.sign(y)];
    return [x, y];
  }

  #clickDrive(point, place, pointer) {
    const driven = this.drawing.objects.drives.map((drive) => drive.link);
    const fixed = (link) => this.drawing.objects.links[link].points.some((name) => this.drawing.objects.points[name]?.fixed);
    const choices = point === null ? [] : this.drawing.linksAt(point).sort((a, b) =>
      Number(fixed(b)) - Number(fixed(a)) || Number(driven.includes(a)) - Number(driven.includes(b)));
    const link = choices[0] ?? this.drawing.linkAt(place, pointer);
    if (link === null || link === undefined) return undefined;
    return store.edit([{ do: "drive", link }]).then(() => {
      const name = store.objects.drives.findIndex((drive) => drive.link === link);
      if (name >= 0) this.select({ kind: "drive", name });
    });
  }

  #endLoad(place) {
    const point = this.loaded, start = this.drawing.objects.points[point]?.at;
    this.loaded = null;
    this.drawing.preview = [];
    if (!start || distance(this.drawing.at(point), place) <= CLICK) return this.drawing.draw();
    const to = this.view.round(this.view.toScene(place));
    const value = [0, 1].map((axis) => Number(((to[axis] - start[axis]) * FORCE_PER_LENGTH).toPrecision(12)));
    return store.edit([{ do: "load", point, value }]);
  }

  erase(object) {
    this.select(null);
    return store.edit([{ do: "erase", kind: object.kind, name: object.name }]);
  }

  // ---- what is seen while the mouse moves ----

  #readout(place) {
    this.dispatchEvent(new CustomEvent("place", { detail: place }));
  }

  #show(place) {
    const { drawing } = this, preview = [];
    const to = place && this.view.toScreen(this.view.round(this.view.toScene(place)));
    this.#readout(place && this.view.round(this.view.toScene(place)));
    const chain = drawing.places(this.chain);
    if (chain.length) {
      const ends = to ? [...chain, to] : chain;
      preview.push(make("path", { class: "rubber", d: ends.map(([x, y], i) => `${i ? "L" : "M"}${x} ${y}`).join("") }));
      for (const [x, y] of chain) preview.push(make("circle", { class: "chosen", cx: x, cy: y, r: 9 }));
    }
    const start = drawing.at(this.sliding ?? this.loaded ?? "");
    if (start && to) {
      preview.push(this.loaded !== null ? drawing.arrow(start, to, "loading rubber") :
        make("path", { class: "rubber", d: `M${start[0]} ${start[1]}L${to[0]} ${to[1]}` }));
    }
    if (start && this.sliding) preview.push(make("circle", { class: "chosen", cx: start[0], cy: start[1], r: 9 }));
    if (place && this.tool !== "select" && !this.pointers.size) {
      const point = this.tool === "point" ? null : drawing.pointAt(place), near = point && drawing.at(point);
      const [x, y] = near ?? to;
      if (near || ["point", "link", "pivot"].includes(this.tool)) {
        preview.push(make("circle", { class: near ? "chosen" : "ghost", cx: x, cy: y, r: near ? 9 : 4 }));
      }
    }
    drawing.preview = preview;
    drawing.draw();
  }

  // ---- keys ----

  #focus(event) {
    const [kind, ...name] = (event.target.dataset?.object ?? "").split(" ");
    if (!kind || this.drawing.refocusing) return;
    const object = { kind, name: kind === "point" || kind === "link" ? name.join(" ") : Number(name[0]) };
    const place = this.drawing.placeOf(kind, object.name);
    if (place) this.drawing.cursor = this.view.toScene(place);
    if (this.tool === "select") this.select(object);
    this.drawing.draw();
  }

  #hideCursor() { this.drawing.cursor = null; }

  key(event) { // whether the key was one of the drawing's
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const way = arrows[event.key];
    if (way) return this.later(() => this.#arrow(way, event.shiftKey)), true;
    if (event.key === " " && this.drawing.cursor) return this.later(() => this.#pressAtCursor()), true;
    if (event.key === "Enter") return this.later(() => (this.chain.length ? this.finishLink() : this.#pressAtCursor())), true;
    if (event.key === "Escape") return this.later(() => this.#escape()), true;
    if (["Delete", "Backspace"].includes(event.key)) return this.later(() => this.selected && this.erase(this.selected)), true;
    return false;
  }

  #arrow(way, fast) {
    const step = (this.view.snaps ? this.view.gridStep : this.view.step) * (fast ? 10 : 1);
    if (this.tool === "select" && this.selected?.kind === "point") return this.#nudge(way, step);
    const at = this.drawing.cursor ?? this.view.centre;
    this.drawing.cursor = this.view.round(plus(at, way, this.view.gridStep * (fast ? 5 : 1)));
    return this.#show(this.view.toScreen(this.drawing.cursor));
  }

  #escape() {
    if (this.chain.length || this.sliding || this.loaded) this.#forget();
    else this.select(null);
    this.#changed();
    this.drawing.draw();
  }

  #pressAtCursor() {
    if (!this.drawing.cursor) return undefined;
    const place = this.view.toScreen(this.drawing.cursor);
    if (this.tool !== "load") return this.click(place);
    if (this.loaded !== null) return this.#endLoad(place);
    this.loaded = this.drawing.pointAt(place);
    return undefined;
  }

  #nudge(way, step) {
    const { name } = this.selected, from = this.drawing.objects.points[name]?.at;
    return from && store.edit([{ do: "move", point: name, to: this.view.round(plus(from, way, step)) }], `nudge ${name}`);
  }
}
