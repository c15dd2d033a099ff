// The sheet's own picture, drawn anew in any pose: elements stay, and only what changed of them is written.

const SVG = "http://www.w3.org/2000/svg";
const BEHIND = ["plates", "ground", "links"], BEFORE = ["blocks", "drive", "pairs", "letters"];  // layers of the mechanism
const MOVING = [...BEHIND, "motion", ...BEFORE].map(layer => `g.layer-${layer}`);
const fine = number => Math.round(number * 100) / 100;
const made = (name, attributes = {}) => {
  const node = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  return node;
};

// an element that remembers what was written to it
class Element {
  constructor(name, parent, before = null) {
    this.node = parent.insertBefore(made(name), before);
    this.written = {};
  }

  write(attributes) {
    for (const [key, value] of Object.entries(attributes)) {
      if (this.written[key] === value) continue;
      this.written[key] = value;
      if (value === null) this.node.removeAttribute(key); else this.node.setAttribute(key, value);
    }
  }
}

// elements for one item of a kind
class Drawn {
  constructor(tag, sheet, parent, before) {
    Object.assign(this, {tag, sheet});
    this.own = new Element({line: "polyline", shape: "polygon", arc: "path", circle: "circle", arrow: "g"}[tag], parent, before);
    if (tag === "arrow")
      this.parts = ["polyline", "polygon", "polygon"].map(name => new Element(name, this.own.node));
  }

  spots(spots) { return spots.map(([x, y]) => `${fine(x)},${fine(this.sheet.height - y)}`).join(" "); }

  hide() { this.own.write({display: "none"}); }

  write(item, rect) {
    const pen = this.sheet.pens[item.pen], y = spot => fine(this.sheet.height - spot[1]);
    const ends = item.spots ?? (item.at ? [item.at] : [item.start, item.end]);
    if (!ends.every(finite)) return this.hide();
    if (this.tag === "line") this.own.write({points: this.spots(item.spots), ...pen.look, fill: "none", display: null});
    else if (this.tag === "shape") this.own.write({points: this.spots(item.spots), ...pen.look, display: null});
    else if (this.tag === "circle")
      this.own.write({cx: fine(item.at[0]), cy: y(item.at), r: item.r, ...pen.look, display: null});
    else if (this.tag === "arc") this.own.write({d: this.arc(item), ...pen.look, fill: "none", display: null});
    else this.arrow(item, pen, rect);
  }

  arc(item) {
    const p = onArc(item, item.start), q = onArc(item, item.end), y = spot => fine(this.sheet.height - spot[1]);
    let r = Math.round(item.r * 1e4) / 1e4;
    if (Math.abs(item.end - item.start - 180) < 1e-6)  // what is too small for its chord has that for a diameter
      r = Math.round((Math.hypot(fine(p[0]) - fine(q[0]), y(p) - y(q)) / 2 - 1e-4) * 1e4) / 1e4;
    const large = item.end - item.start > 180 + 1e-6 ? 1 : 0;
    return `M ${fine(p[0])} ${y(p)} A ${r} ${r} 0 ${large} 0 ${fine(q[0])} ${y(q)}`;
  }

  // a vector: its shaft ends in its head; where it leaves the panel it breaks off
  arrow({start, end, head, label}, pen, rect) {
    const {SLIM, BARB, WALL, OPEN, WHITE, PAPER, BREAK_HEAD} = this.sheet.measures, high = this.sheet.height;
    this.own.write({class: "vector", "data-from": `${fine(start[0])} ${fine(high - start[1])}`, display: null,
                    "data-to": `${fine(end[0])} ${fine(high - end[1])}`, "data-vector": label || null});
    const inside = segment(grown(rect, 0.02), start, end), [shaft, one, two] = this.parts;
    const show = (part, spots, look) =>
      part.write(spots.length ? {points: this.spots(spots), ...look, display: null} : {display: "none"});
    if (!inside) return this.parts.forEach(part => show(part, []));
    const tip = between(start, end, inside[1]), tail = between(start, end, inside[0]);
    if (inside[1] < 1) head = Math.min(BREAK_HEAD, distance(tail, tip));
    const way = unit(start, end), half = head / SLIM[pen.tip], barb = Math.min(BARB, head / 2);
    const back = (t, u = 0) => off(tip, way, -t, u), neck = pen.tip === OPEN ? barb : head;
    show(shaft, distance(tail, tip) > neck + 0.01 ? [tail, back(neck)] : [], {...pen.look, fill: "none"});
    if (pen.tip === OPEN) {
      for (const [part, side] of [[one, half], [two, -half]])
        show(part, [tip, back(head - barb, side), back(head, side), back(barb)], {fill: pen.colour});
      return;
    }
    const barbs = [tip, back(head, half), back(head, -half)], radius = half * head / (half + Math.hypot(half, head));
    const part = pen.tip === WHITE ? 1 - WALL / radius : 0, middle = back(head - radius);
    show(one, barbs, {fill: pen.colour});
    show(two, part > 0 ? barbs.map(spot => between(middle, spot, part)) : [], {fill: PAPER});
  }
}

// a layer or a step: its items in drawing order, and its letters over them
class Group {
  constructor(sheet, attributes, title, panel) {
    Object.assign(this, {sheet, node: made("g", attributes), drawn: [], letters: new Map(), rect: sheet.panels[panel].rect});
    this.node.setAttribute("clip-path", `url(#${sheet.clip}-${panel})`);
    if (title) this.node.appendChild(made("title")).textContent = title;
    this.end = this.node.appendChild(made("g"));  // of letters
  }

  write(items) {
    items.forEach((item, i) => {
      const was = this.drawn[i];
      if (!was || was.tag !== item.tag) {
        this.drawn[i] = new Drawn(item.tag, this.sheet, this.node, was ? was.own.node : this.end);
        was?.own.node.remove();
      }
      this.drawn[i].write(item, this.rect);
    });
    for (const rest of this.drawn.slice(items.length)) rest.hide();
  }

  letter(id, letter) {
    let drawn = this.letters.get(id);
    if (!drawn) this.letters.set(id, drawn = new Lettered(this.sheet, this.end));
    drawn.write(letter);
  }

  // letters that are not there in this pose
  without(ids) {
    for (const [id, drawn] of this.letters) drawn.own.write({display: ids.has(id) ? null : "none"});
  }
}

// a letter with its leader or ring
class Lettered {
  constructor(sheet, parent) {
    Object.assign(this, {sheet, own: new Element("g", parent), text: null, told: null});
  }

  write({wish, box, spot, place}) {
    const {uses, pens, measures, height} = this.sheet, [left, low, right, high] = box;
    if (this.told !== JSON.stringify(wish.runs)) this.spell(wish);
    const base = wish.balloon ? [(left + right) / 2, (low + high) / 2 - wish.size * measures.CAPS / 2]
      : [left, low + wish.size * wish.depth];
    if (wish.balloon && wish.runs.length > 1) base[0] -= wish.wide / 2;
    this.text.write({x: fine(base[0]), y: fine(height - base[1])});
    if (wish.balloon) {
      this.ring ??= new Element("circle", this.own.node, this.text.node);
      this.ring.write({cx: fine((left + right) / 2), cy: fine(height - (low + high) / 2), ...pens[uses.balloon].look,
                       r: Math.round(measures.BALLOON * wish.size * 1e4) / 1e4});
    }
    if (!place[3]) return this.leader?.write({display: "none"});
    this.leader ??= new Element("polyline", this.own.node, this.own.node.firstChild);
    const end = [Math.min(Math.max(spot[0], left), right), Math.min(Math.max(spot[1], low), high)];
    this.leader.write({points: [spot, end].map(([x, y]) => `${fine(x)},${fine(height - y)}`).join(" "), display: null,
                       ...pens[uses.leader].look, fill: "none"});
  }

  // the letters on their levels, each level shifted against the one before
  spell({runs, size, pen, bold, balloon}) {
    const {LOWERED, DROP} = this.sheet.measures, plain = runs.length === 1 && runs[0][1] === 0;
    this.told = JSON.stringify(runs);
    this.text?.node.remove();
    this.text = new Element("text", this.own.node);
    this.text.write({"font-size": fine(size), fill: this.sheet.pens[pen].colour, "font-weight": bold ? "bold" : null,
                     "text-anchor": balloon && runs.length === 1 ? "middle" : null});
    if (plain) this.text.node.textContent = runs[0][0];
    let at = 0;
    for (const [text, level] of plain ? [] : runs) {
      const shift = fine((at - level) * DROP * size), span = made("tspan", {
        ...(shift ? {dy: shift} : {}), ...(level ? {"font-size": fine(LOWERED[size])} : {})});
      this.text.node.appendChild(span).textContent = text;
      at = level;
    }
  }
}

// one construction on the sheet
class Sheet {
  constructor(data) {
    Object.assign(this, data, {clip: `cut-${Sheet.count = (Sheet.count ?? 0) + 1}`, data});
    this.plates = new Plates(data);
    this.mechanism = new DrawnMechanism(data, this.plates);
    this.wishes = Object.assign(new Wishes(data, this.plates), {mechanism: this.mechanism});
    this.lettering = new Letters(data);
    const layer = name => [name, new Group(this, {class: `layer-${name}`}, "", MECHANISM)];
    const numbers = new Map();
    data.steps.forEach((step, i) => numbers.has(step.number) || numbers.set(step.number, i));
    this.groups = new Map([...BEHIND.map(layer), ...[...numbers].sort((p, q) => p[0] - q[0]).map(([number, i]) =>
      [number, new Group(this, {class: "step", "data-step": number}, data.steps[i].title, data.steps[i].panel)]),
      ...BEFORE.map(layer)]);
    this.stepsOf = new Map([...numbers.keys()].map(number =>
      [number, data.steps.map((_, i) => i).filter(i => data.steps[i].number === number)]));
    this.last = data.steps.map((_, i) => data.vectors.filter(vector => vector.of === i));
  }

  get nodes() { return [...this.groups.values()].map(group => group.node); }

  // what the panels are cut off with
  get clips() {
    return this.panels.map(({rect: [left, low, right, high]}, i) => {
      const clip = made("clipPath", {id: `${this.clip}-${i}`});
      clip.appendChild(made("rect", {x: left, y: this.height - high, width: right - left, height: high - low}));
      return clip;
    });
  }

  // whether points lie as they are given
  home(points) {
    const reach = Math.max(...this.data.points.map(([, x, y]) => Math.hypot(x, y)), 1e-9);
    return this.data.points.every(([name, x, y]) => !points[name] || distance(points[name], [x, y]) < 1e-9 * reach);
  }

  draw(values, points, guides, views) {
    const {plates} = this, breaks = new Map(), home = this.home(points);
    plates.pose(values, points, views);
    const obstacles = this.panels.map(() => new Obstacles(this.data)), layers = new Map();
    for (const item of this.mechanism.items(guides)) {
      layers.set(item.layer, [...layers.get(item.layer) ?? [], item]);
      obstacles[MECHANISM].add(item);
    }
    for (const name of [...BEHIND, ...BEFORE]) this.groups.get(name).write(layers.get(name) ?? []);
    for (const [number, steps] of this.stepsOf) {
      const items = [];
      for (const i of steps) {
        const own = plates.items(i), arrows = own.filter(item => item.to !== undefined);
        if (arrows.length) breaks.set(i, arrows);
        own.push(...this.last[i].filter(vector => vector.shown).map(vector => plates.vector(vector)));
        for (const item of own) obstacles[this.steps[i].panel].add(item);
        items.push(...own);
      }
      this.groups.get(number).write(items);
    }
    this.steps.forEach((step, i) => plates.shown(i) && obstacles[step.panel].marks.push(plates.at[i]));
    obstacles[MECHANISM].marks.push(...plates.spots);
    this.write(breaks, obstacles, home);
  }

  write(breaks, obstacles, home) {
    const there = new Map([...this.groups.keys()].map(key => [key, new Set()]));
    this.panels.forEach((_, panel) => {
      const wishes = this.wishes.of(panel, breaks);
      for (const letter of this.lettering.placed(panel, wishes, obstacles[panel], home)) {
        const key = letter.wish.step === undefined ? "letters" : this.steps[letter.wish.step].number;
        there.get(key).add(letter.id);
        this.groups.get(key).letter(letter.id, letter);
      }
    });
    for (const [key, group] of this.groups) group.without(there.get(key));
  }
}

// The picture in an inline SVG of the sheet; `data` has `programs`, each as picture.py tells it.
class Picture {
  constructor(svg, data) {
    Object.assign(this, {svg, data, sheets: [], sheet: null, traces: new Map()});
    const moving = svg.querySelectorAll(["g.step", ...MOVING].join());
    this.defs = svg.insertBefore(made("defs"), svg.firstChild);
    this.place_ = svg.insertBefore(document.createComment("what moves"), moving[moving.length - 1]?.nextSibling ?? null);
    for (const node of moving) node.remove();
  }

  // draws a pose: the marks' values by index, points and guides by name
  draw(program, values, points, guides = {}) {
    const sheet = this.sheets[program] ??= this.opened(program);
    if (sheet !== this.sheet) {
      for (const node of this.sheet?.nodes ?? []) node.remove();
      this.place_.after(...sheet.nodes);
      this.sheet = sheet;
    }
    sheet.draw(values, points, guides);
    return {slid: sheet.plates.views.map((view, i) => distance(view.origin, sheet.panels[i].origin) > 0)};
  }

  opened(program) {
    const sheet = new Sheet(this.data.programs[program]);
    this.defs.append(...sheet.clips);
    return sheet;
  }

  // where a point of the mechanism, or a mark by its name, lies: mm from the upper left corner
  place(name) {
    const {data, plates, height} = this.sheet, point = data.points.findIndex(one => one[0] === name);
    const [x, y] = point < 0 ? plates.at[data.steps.findIndex(step => step.name === name)] : plates.spots[point];
    return [x, height - y];
  }

  // the window of each panel: its scale in mm per unit, and where its plan's origin falls, y up
  get windows() { return this.sheet.plates.views; }

  // the coordinates of the scene at a spot of the mechanism plan, mm from the upper left corner
  back([x, y]) { return this.sheet.plates.views[MECHANISM].back([x, this.sheet.height - y]); }
}
