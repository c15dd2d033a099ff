// Draws the scene's objects as symbols of the textbook, in pixels, and finds what lies at a place.

import { distance, hull, isInside, length, middle, minus, plus, toOutline, toSegment, unit } from "./geometry.js";

const SVG = "http://www.w3.org/2000/svg";
const COLOURS = 6; // of links, as the style sheet has them
const VECTOR = 85; // pixels of the longest vector of a kind
const FORCE = 90; // pixels of the longest force
const BLOCK = [15, 9]; // half the length and the width of a sliding block
const SHORT = 64; // letters of a fault beside its object, at most
const REACH = { mouse: 9, touch: 22, pen: 12 }; // pixels around a point that belong to it

export function make(name, attributes = {}, ...children) {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) if (value !== null) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

const path = (places, closed = false) =>
  places.map(([x, y], i) => `${i ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("") + (closed ? "Z" : "");

export class Drawing {
  constructor(svg, view, words) {
    this.svg = svg;
    this.view = view;
    this.words = words;
    this.objects = null;
    this.pose = null; // places of points in another pose of the motion, by name
    this.selected = null;
    this.results = null;
    this.showsVectors = true;
    this.faults = [];
    this.preview = [];
    this.cursor = null;
    this.layers = Object.fromEntries(["grid", "ghost", "links", "vectors", "points", "faults", "preview"].map((name) => {
      const layer = make("g", { class: `layer-${name}` });
      svg.append(layer);
      return [name, layer];
    }));
  }

  at(point) { // on the screen
    const place = this.pose?.[point] ?? this.objects.points[point]?.at;
    return place ? this.view.toScreen(place) : null;
  }

  places(points) { return points.map((point) => this.at(point)).filter(Boolean); }

  // ---- what is drawn ----

  draw() {
    if (!this.objects) return;
    const focused = document.activeElement?.dataset?.object;
    this.#grid();
    const drawn = { ghost: [], links: [], vectors: [], points: [], faults: [], preview: this.preview };
    const names = Object.keys(this.objects.links).filter((name) => !this.objects.links[name].frame);
    names.forEach((name, i) => drawn.links.push(this.#link(name, i % COLOURS)));
    this.objects.gears.forEach((gear, i) => drawn.links.push(...this.#gear(gear, i)));
    this.objects.slides.forEach((slide, i) => drawn.links.push(this.#slide(slide, i)));
    this.objects.drives.forEach((drive, i) => drawn.vectors.push(this.#drive(drive, i)));
    this.objects.forces.forEach((force, i) => drawn.vectors.push(this.#force(force, i)));
    if (this.showsVectors && this.results && !this.pose) drawn.vectors.push(...this.#vectors());
    for (const name of Object.keys(this.objects.points)) drawn.points.push(this.#point(name));
    drawn.faults.push(...this.#faultMarks());
    if (this.cursor) drawn.preview = [...drawn.preview, this.#crosshair()];
    for (const [name, elements] of Object.entries(drawn)) this.layers[name].replaceChildren(...elements.filter(Boolean));
    if (focused) { // the elements are new
      this.refocusing = true;
      this.svg.querySelector(`[data-object="${CSS.escape(focused)}"]`)?.focus({ preventScroll: true });
      this.refocusing = false;
    }
  }

  #grid() {
    const { view } = this, step = view.gridStep, lines = { fine: "", coarse: "", axis: "" };
    const [low, high] = [view.toScene([0, view.size[1]]), view.toScene([view.size[0], 0])];
    for (const axis of [0, 1]) {
      for (let count = Math.ceil(low[axis] / step); count * step <= high[axis]; count += 1) {
        const place = view.toScreen([count * step, count * step])[axis].toFixed(1);
        const kind = count === 0 ? "axis" : count % 5 === 0 ? "coarse" : "fine";
        lines[kind] += axis ? `M0 ${place}H${view.size[0]}` : `M${place} 0V${view.size[1]}`;
      }
    }
    this.layers.grid.replaceChildren(...Object.entries(lines).map(([kind, d]) => make("path", { class: kind, d })));
  }

  #object(kind, name, label, ...children) {
    const chosen = this.selected?.kind === kind && this.selected?.name === name;
    return make("g", { class: `object ${kind}${chosen ? " selected" : ""}`, "data-object": `${kind} ${name}`,
                       role: "img", "aria-label": label, tabindex: "0" }, ...children.filter(Boolean));
  }

  #link(name, colour) {
    const corners = this.outline(name);
    if (!corners.length) return null;
    const d = path(corners, corners.length > 2);
    const shape = corners.length === 1
      ? make("circle", { class: "single", cx: corners[0][0], cy: corners[0][1], r: 9 })
      : make("path", { class: corners.length > 2 ? "plate" : "bar", d });
    const place = this.#linkNamePlace(corners);
    const label = make("text", { class: "link-name", x: place[0], y: place[1] }, name);
    return this.#coloured(this.#object("link", name, `${this.words.link} ${name}`, shape, label), colour);
  }

  #coloured(element, colour) {
    element.classList.add(`colour-${colour}`);
    return element;
  }

  #linkNamePlace(corners) {
    if (corners.length === 1) return plus(corners[0], [-15, 18]);
    if (corners.length > 2) return middle(corners);
    const way = unit(minus(corners[1], corners[0])), side = way[0] < 0 ? [way[1], -way[0]] : [-way[1], way[0]];
    return plus(middle(corners), side, -12);
  }

  outline(name) { return hull(this.places(this.objects.links[name]?.points ?? [])); }

  #point(name) {
    const place = this.at(name), point = this.objects.points[name];
    if (!place) return null;
    const [x, y] = place, joints = this.linksAt(name).length + (point.fixed ? 1 : 0);
    const marks = [];
    if (point.fixed && joints > 0) {
      marks.push(make("path", { class: "pivot", d: `M${x} ${y}l-9 15h18Z` }),
        make("path", { class: "hatch", d: `M${x - 13} ${y + 15}h26m-22 0l-4 5m10 -5l-4 5m10 -5l-4 5m10 -5l-4 5` }));
    }
    marks.push(make("circle", { class: joints > 1 ? "joint" : "mark", cx: x, cy: y, r: joints > 1 ? 5 : 3.5 }));
    if (point.asked) marks.push(make("circle", { class: "asked", cx: x, cy: y, r: 10 }));
    const twins = Object.keys(this.objects.points).filter((other) => distance(this.at(other), place) < 4).indexOf(name);
    marks.push(make("text", { class: "point-name", x: x + 9, y: y - 9 + 27 * twins }, name));
    const kinds = [point.fixed ? this.words.pivot : "", point.asked ? this.words.asked : ""].filter(Boolean);
    return this.#object("point", name, [`${this.words.point} ${name}`, ...kinds].join(", "), ...marks);
  }

  direction(slide) { // of the guide, on the screen
    const ends = slide.through ? this.places(slide.through) : [];
    if (ends.length === 2 && distance(...ends) > 1e-9) return unit(minus(ends[1], ends[0]));
    return slide.direction ? unit([slide.direction[0], -slide.direction[1]]) : [1, 0];
  }

  #slide(slide, number) {
    const place = this.at(slide.at);
    if (!place) return null;
    const [x, y] = place, way = this.direction(slide), angle = Math.atan2(way[1], way[0]) * 180 / Math.PI;
    const [a, b] = BLOCK, marks = [make("rect", { class: "block", x: -a, y: -b, width: 2 * a, height: 2 * b, rx: 2 })];
    if (this.objects.links[slide.along]?.frame ?? slide.along === "frame") {
      marks.unshift(make("path", { class: "hatch", d: `M-46 ${b}h92` +
        Array.from({ length: 8 }, (_, i) => `M${-38 + 11 * i} ${b}l-5 5`).join("") }));
    } else marks.unshift(make("path", { class: "guide", d: "M-60 0h120" }));
    const label = `${this.words.slide} ${slide.link} – ${slide.along}`;
    return this.#object("slide", number, label, make("g", { transform: `translate(${x} ${y}) rotate(${angle})` }, ...marks));
  }

  drivePlace(drive) { // where its arrow stands: the pivot of the driven link, and its radius
    const link = this.objects.links[drive.link];
    if (!link) return null;
    const pivots = link.points.filter((point) => this.objects.points[point]?.fixed);
    const shared = this.objects.links[drive.on]?.points.filter((point) => link.points.includes(point)) ?? [];
    const [pivot] = [...shared, ...pivots, ...link.points];
    return this.at(pivot);
  }

  #drive(drive, number) {
    const place = this.drivePlace(drive);
    if (!place) return null;
    const [x, y] = place, label = `${this.words.drive} ${drive.link}`;
    if (drive.slides) {
      const slide = this.objects.slides.find((one) => one.link === drive.link && one.along === drive.on);
      const at = slide ? this.at(slide.at) : place, way = slide ? this.direction(slide) : [1, 0];
      const sign = drive.rate < 0 ? -1 : 1, start = plus(at ?? place, [way[1] * 22, -way[0] * 22]);
      return this.#object("drive", number, label, this.arrow(plus(start, way, -22 * sign), plus(start, way, 22 * sign), "driving"));
    }
    const r = 24, sign = drive.rate < 0 ? -1 : 1, end = [x - r * 0.64 * sign, y - r * 0.77], start = [x + r * 0.94 * sign, y + r * 0.34];
    const d = `M${start.join(" ")}A${r} ${r} 0 0 ${sign > 0 ? 0 : 1} ${end.join(" ")}`;
    const head = this.#head(end, unit([-0.77 * sign, 0.64]), 10);
    const rate = `${drive.rpm ?? drive.rate} ${drive.rpm !== undefined ? "rpm" : "rad/s"}`;
    return this.#object("drive", number, `${label}, ${rate}`, make("path", { class: "driving", d }), make("path", { class: "driving head", d: head }));
  }

  #head(tip, way, size) {
    const back = plus(tip, way, -size), side = [-way[1] * size * 0.38, way[0] * size * 0.38];
    return path([tip, plus(back, side), plus(back, side, -1)], true);
  }

  arrow(from, to, kind) {
    const way = unit(minus(to, from)), size = Math.min(10, distance(from, to));
    return make("g", { class: kind }, make("path", { d: path([from, plus(to, way, -size * 0.7)]) }),
      make("path", { class: "head", d: this.#head(to, way, size) }));
  }

  forceScale() { // pixels a unit of force
    const sizes = this.objects.forces.map((force) => length(force.value ?? [0, 0]));
    return FORCE / Math.max(...sizes, 1e-12);
  }

  #force(force, number) {
    const place = this.at(force.at);
    if (!place || !force.value) return null;
    const scale = this.forceScale(), tip = plus(place, [force.value[0], -force.value[1]], scale);
    const size = Number(length(force.value).toPrecision(4));
    const text = make("text", { class: "size", x: tip[0] + 6, y: tip[1] - 4 }, `${size} ${this.objects.units.force}`);
    return this.#object("force", number, `${this.words.load} ${force.at}`, this.arrow(place, tip, "loading"), text);
  }

  #vectors() {
    const points = Object.entries(this.results.points ?? {}), arrows = [];
    for (const kind of ["acceleration", "velocity"]) {
      const known = points.filter(([name, of]) => of?.[kind] && this.at(name));
      const most = Math.max(...known.map(([, of]) => length(of[kind])), 0);
      if (!most) continue;
      for (const [name, of] of known) {
        const place = this.at(name), tip = plus(place, [of[kind][0], -of[kind][1]], VECTOR / most);
        if (distance(place, tip) > 3) arrows.push(this.arrow(place, tip, kind));
      }
    }
    return arrows;
  }

  #faultMarks() {
    const marks = [], places = new Map();
    for (const fault of this.faults) {
      const place = fault.object && this.placeOf(...fault.object);
      if (!place) continue;
      const key = place.map(Math.round).join(" "), count = places.get(key) ?? 0;
      places.set(key, count + 1);
      if (count > 2) continue;
      const [x, y] = plus(place, [16, 24 + 18 * count]), text = fault.text.slice(fault.text.indexOf(":") + 2);
      const short = text.length > SHORT ? `${text.slice(0, SHORT - 1)}…` : text, turns = x > this.view.size[0] - short.length * 6.5;
      const label = make("text", { x: turns ? x - 9 : x + 9, y, "text-anchor": turns ? "end" : "start" }, short);
      marks.push(make("g", { class: fault.missing ? "missing" : "fault" }, make("circle", { cx: x, cy: y - 4, r: 4 }), label,
        make("title", {}, fault.text)));
    }
    return marks;
  }

  #crosshair() {
    const [x, y] = this.view.toScreen(this.cursor);
    return make("path", { class: "crosshair", d: `M${x - 12} ${y}h24M${x} ${y - 12}v24` });
  }

  // ---- where objects are ----

  placeOf(kind, name) {
    const { slides, drives, forces, contacts, gears } = this.objects;
    switch (kind) {
      case "point": return this.at(name);
      case "link": {
        const corners = this.outline(name);
        return corners.length ? middle(corners) : null;
      }
      case "slide": return slides[name] ? this.at(slides[name].at) : null;
      case "drive": return drives[name] ? this.drivePlace(drives[name]) : null;
      case "force": return forces[name] ? this.at(forces[name].at) : null;
      case "contact": return contacts[name] ? this.at(contacts[name].at) : null;
      case "gear": return gears[name] ? this.at(gears[name].centres[0]) : null;
      default: return null;
    }
  }

  linksAt(point) {
    return Object.entries(this.objects.links).filter(([, link]) => !link.frame && link.points.includes(point))
      .map(([name]) => name);
  }

  pointAt(place, pointer = "mouse", reach = REACH[pointer] ?? REACH.mouse) {
    const near = Object.keys(this.objects.points).map((name) => [distance(this.at(name), place), name])
      .filter(([gap]) => gap <= reach);
    near.sort((a, b) => a[0] - b[0] || Number(b[1] === this.selected?.name) - Number(a[1] === this.selected?.name));
    return near[0]?.[1] ?? null;
  }

  linkAt(place, pointer = "mouse", without = []) {
    const reach = (REACH[pointer] ?? REACH.mouse) * 0.9;
    const near = [];
    for (const [name, link] of Object.entries(this.objects.links)) {
      const corners = this.outline(name);
      if (link.frame || without.includes(name) || !corners.length) continue;
      const gap = toOutline(place, corners) - (corners.length === 1 ? BLOCK[1] : 0);
      if (gap <= reach) near.push([Math.max(gap, 0), corners.length > 2 ? 1 : 0, name]);
      else if (isInside(place, corners)) near.push([reach, 2, name]);
    }
    near.sort((a, b) => a[0] - b[0] || a[1] - b[1]);
    return near[0]?.[2] ?? null;
  }

  objectAt(place, pointer = "mouse") {
    const point = this.pointAt(place, pointer);
    if (point !== null) return { kind: "point", name: point };
    const reach = REACH[pointer] ?? REACH.mouse;
    for (const [i, force] of this.objects.forces.entries()) {
      const start = this.at(force.at);
      if (!start || !force.value) continue;
      const tip = plus(start, [force.value[0], -force.value[1]], this.forceScale());
      if (toSegment(place, start, tip) < reach) return { kind: "force", name: i };
    }
    for (const [i, drive] of this.objects.drives.entries()) {
      const centre = drive.slides ? null : this.drivePlace(drive);
      if (centre && Math.abs(distance(place, centre) - 24) < 6 && place[1] < centre[1] + 10) return { kind: "drive", name: i };
    }
    for (const [i, slide] of this.objects.slides.entries()) {
      const centre = this.at(slide.at);
      if (!centre) continue;
      const way = this.direction(slide), off = minus(place, centre);
      const along = off[0] * way[0] + off[1] * way[1], across = off[1] * way[0] - off[0] * way[1];
      if (Math.abs(along) < BLOCK[0] && Math.abs(across) < BLOCK[1]) return { kind: "slide", name: i };
    }
    const link = this.linkAt(place, pointer);
    return link === null ? null : { kind: "link", name: link };
  }

  #gear(gear, number) {
    const radii = gear.radii ?? [];
    return gear.centres.map((centre, i) => {
      const place = this.at(centre);
      if (!place || !radii[i]) return null;
      return this.#object("gear", number, `${gear.links.join(" – ")}`,
        make("circle", { class: "pitch", cx: place[0], cy: place[1], r: radii[i] * this.view.scale }));
    });
  }
}
