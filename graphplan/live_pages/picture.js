// The sheet's own picture, drawn anew in any pose: elements stay, and only what changed of them is written.

const SVG = "http://www.w3.org/2000/svg";
const BEHIND = ["machine", "plates", "ground", "wheels", "links"], BEFORE = ["blocks", "drive", "pairs", "letters"];  // the steps
const MOVING = [...BEHIND, "motion", ...BEFORE].map(layer => `g.layer-${layer}`);
const PAUSE = 150;  // ms without another pose, after which letters settle
const fine = number => Math.round(number * 100) / 100;
const made = (name, attributes = {}, text = "") => {
  const node = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text) node.textContent = text;
  return node;
};

// an element that remembers what was written to it
class Element {
  constructor(name, parent, before = null) {
    this.node = parent.insertBefore(made(name), before);
    this.written = {};
    this.pen = null;
  }

  set(key, value) {
    if (this.written[key] === value) return;
    this.written[key] = value;
    if (value === null) this.node.removeAttribute(key); else this.node.setAttribute(key, value);
  }

  // attributes of a pen, which seldom changes
  look(pen, fill) {
    if (this.pen === pen) return;
    for (const key of Object.keys(this.pen?.look ?? {})) this.set(key, null);
    for (const [key, value] of Object.entries(pen.look)) this.set(key, value);
    if (fill) this.set("fill", fill);
    this.pen = pen;
  }

  show(seen) { this.set("display", seen ? null : "none"); }
}

const NODES = {line: "polyline", shape: "polygon", arc: "path", circle: "circle", arrow: "g"};

// elements for one item of a kind
class Drawn {
  constructor(tag, sheet, parent, before) {
    Object.assign(this, {tag, sheet, own: new Element(NODES[tag], parent, before)});
    if (tag !== "arrow") return;
    this.own.set("class", "vector");
    this.parts = ["polyline", "polygon", "polygon"].map(name => new Element(name, this.own.node));
  }

  write(item, rect) {
    const {own, sheet} = this, pen = sheet.pens[item.pen];
    const ends = item.spots ?? (item.at ? [item.at] : [item.start, item.end]);
    own.show(ends.every(finite));
    if (own.written.display) return;
    if (this.tag === "arrow") return this.arrow(item, pen, rect);
    own.look(pen, this.tag === "line" || this.tag === "arc" ? "none" : null);
    if (item.spots) own.set("points", sheet.spots(item.spots));
    else if (this.tag === "arc") own.set("d", this.arc(item));
    else {
      own.set("cx", fine(item.at[0]));
      own.set("cy", fine(sheet.height - item.at[1]));
      own.set("r", item.r);
    }
  }

  arc(item) {
    const [p, q] = [item.start, item.end].map(angle => onArc(item, angle)).map(([x, y]) => [x, this.sheet.height - y]);
    const [x, y, u, v] = [...p, ...q].map(fine), half = Math.abs(item.end - item.start - 180) < 1e-6;
    // of a radius too small for its chord SVG makes a half circle
    const r = Math.round((half ? Math.hypot(x - u, y - v) / 2 - 1e-4 : item.r) * 1e4) / 1e4;
    return `M ${x} ${y} A ${r} ${r} 0 ${item.end - item.start > 180 ? 1 : 0} 0 ${u} ${v}`;
  }

  // a vector: its shaft ends in its head; where it leaves the panel it breaks off
  arrow({start, end, head, label}, pen, rect) {
    const {SLIM, BARB, WALL, OPEN, WHITE, PAPER, BREAK_HEAD} = this.sheet.measures, [shaft, one, two] = this.parts;
    this.own.set("data-from", this.sheet.spots([start]).replace(",", " "));
    this.own.set("data-to", this.sheet.spots([end]).replace(",", " "));
    this.own.set("data-vector", label || null);
    const inside = segment(grown(rect, 0.02), start, end);
    const show = (part, spots, fill) => {
      part.show(spots.length);
      if (!spots.length) return;
      part.set("points", this.sheet.spots(spots));
      if (part === shaft) part.look(pen, "none"); else part.set("fill", fill);
    };
    if (!inside) return this.parts.forEach(part => part.show(false));
    const tip = between(start, end, inside[1]), tail = between(start, end, inside[0]);
    if (inside[1] < 1) head = Math.min(BREAK_HEAD, distance(tail, tip));
    const way = unit(start, end), half = head / SLIM[pen.tip], barb = Math.min(BARB, head / 2);
    const back = (t, u = 0) => off(tip, way, -t, u), neck = pen.tip === OPEN ? barb : head;
    show(shaft, distance(tail, tip) > neck + 0.01 ? [tail, back(neck)] : []);
    if (pen.tip === OPEN) {
      for (const [part, side] of [[one, half], [two, -half]])
        show(part, [tip, back(head - barb, side), back(head, side), back(barb)], pen.colour);
      return;
    }
    const barbs = [tip, back(head, half), back(head, -half)], radius = half * head / (half + Math.hypot(half, head));
    const part = pen.tip === WHITE ? 1 - WALL / radius : 0, middle = back(head - radius);
    show(one, barbs, pen.colour);
    show(two, part > 0 ? barbs.map(spot => between(middle, spot, part)) : [], PAPER);
  }
}

// a layer or a step: its items in drawing order, and its letters over them
class Group {
  constructor(sheet, attributes, title, panel) {
    Object.assign(this, {sheet, node: made("g", attributes), rect: sheet.panels[panel].rect});
    Object.assign(this, {drawn: [], letters: new Map()});
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
    for (let i = items.length; i < this.drawn.length; i++) this.drawn[i].own.show(false);
  }

  letter(id, letter) {
    let drawn = this.letters.get(id);
    if (!drawn) this.letters.set(id, drawn = new Lettered(this.sheet, this.end, letter));
    drawn.write(letter);
  }

  // letters that are not there in this pose
  without(ids) {
    for (const [id, drawn] of this.letters) drawn.own.show(ids.has(id));
  }
}

// a letter with its leader or ring
class Lettered {
  constructor(sheet, parent, {wish}) {
    const own = new Element("g", parent), text = new Element("text", own.node);
    Object.assign(this, {sheet, own, text, ring: null, leader: null});
    if (wish.balloon) this.ring = new Element("circle", own.node, text.node);
    if (wish.optional) own.set("class", "size");
  }

  // all of it is shifted as one, which moves no letter against another
  write({wish, box: [left, low, right, high], spot, place}) {
    const {uses, pens, measures, height} = this.sheet, {CAPS, BALLOON} = measures;
    const base = wish.balloon ? [(left + right) / 2, (low + high) / 2 - wish.size * CAPS / 2]
      : [left, low + wish.size * wish.depth];
    if (wish.balloon && wish.runs.length > 1) base[0] -= wish.wide / 2;
    const [x, y] = [fine(base[0]), fine(height - base[1])];
    this.own.set("transform", `translate(${x} ${y})`);
    if (this.spelt !== wish.runs[0][0]) this.spell(wish);
    this.text.set("fill", pens[wish.pen].colour);
    if (this.ring) {
      this.ring.look(pens[uses.balloon]);
      this.ring.set("cx", fine((left + right) / 2 - base[0]));
      this.ring.set("cy", fine(-wish.size * CAPS / 2));
      this.ring.set("r", Math.round(BALLOON * wish.size * 1e4) / 1e4);
    }
    if (place[3]) this.leader ??= new Element("polyline", this.own.node, this.own.node.firstChild);
    this.leader?.show(place[3]);
    if (!place[3]) return;
    const end = [Math.min(Math.max(spot[0], left), right), Math.min(Math.max(spot[1], low), high)];
    this.leader.look(pens[uses.leader], "none");
    this.leader.set("points", [spot, end].map(([u, v]) => `${fine(u - x)},${fine(height - v - y)}`).join(" "));
  }

  // the letters on their levels, each level shifted against the one before
  spell({runs, size, bold, balloon}) {
    const {LOWERED, DROP} = this.sheet.measures, {node} = this.text, plain = runs.length === 1 && runs[0][1] === 0;
    for (const [key, value] of [["x", 0], ["y", 0], ["font-size", fine(size)]]) this.text.set(key, value);
    if (bold) this.text.set("font-weight", "bold");
    if (balloon && runs.length === 1) this.text.set("text-anchor", "middle");
    this.spelt = runs[0][0];
    node.textContent = plain ? runs[0][0] : "";
    let at = 0;
    for (const [text, level] of plain ? [] : runs) {
      const shift = fine((at - level) * DROP * size), span = made("tspan", {
        ...(shift ? {dy: shift} : {}), ...(level ? {"font-size": fine(LOWERED[size])} : {})});
      node.appendChild(span).textContent = text;
      at = level;
    }
  }
}

// one construction on the sheet
class Sheet {
  constructor(data) {
    Object.assign(this, data, {turn: 0, clip: `cut-${Sheet.count = (Sheet.count ?? 0) + 1}`, data});
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

  // spots as SVG has them
  spots(spots) {
    let text = "";
    for (const [x, y] of spots) text += `${text && " "}${fine(x)},${fine(this.height - y)}`;
    return text;
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

  draw(values, points, guides, {told, lines = [], ...pins}) {
    const {plates} = this, breaks = new Map(), first = !this.drawn;
    this.wishes.told = told;
    plates.pose(values, points, pins);
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
    for (const spots of lines) obstacles[MECHANISM].add({tag: "line", pen: this.data.uses.bar, spots});
    this.steps.forEach((step, i) => plates.shown(i) && obstacles[step.panel].marks.push(plates.at[i]));
    obstacles[MECHANISM].marks.push(...plates.spots);
    this.drawn = [breaks, obstacles];
    this.write(first, first || pins.rest);
    return first;
  }

  // the letters: at rest all look for the best places; in motion steps have no numbers
  write(rest, numbered = rest) {
    const [breaks, obstacles] = this.drawn;
    const there = new Map([...this.groups.keys()].map(key => [key, new Set()]));
    this.letters = this.panels.map((_, panel) => this.lettering.placed(panel, this.wishes.of(panel, breaks, numbered), obstacles[panel],
      {rest, look: rest || panel === this.turn}));
    this.turn = (this.turn + 1) % this.panels.length;  // in motion letters look for places panel by panel
    for (const letters of this.letters)
      for (const letter of letters) {
        const key = letter.wish.step === undefined ? "letters" : this.steps[letter.wish.step].number;
        there.get(key).add(letter.id);
        this.groups.get(key).letter(letter.id, letter);
      }
    for (const [key, group] of this.groups) group.without(there.get(key));
  }
}

// The picture in an inline SVG of the sheet; `data` has `programs`, each as picture.py tells it.
class Picture {
  constructor(svg, data) {
    Object.assign(this, {svg, data, sheets: [], sheet: null, traces: new Map()});
    const moving = svg.querySelectorAll(["g.step", ...MOVING].join());
    this.defs = svg.insertBefore(made("defs"), svg.firstChild);
    this.start = svg.insertBefore(document.createComment("what moves"), [...moving].pop()?.nextSibling ?? null);
    for (const node of moving) node.remove();
  }

  // draws a pose: the marks' values by index, points and guides by name; `pins` as for the plates, the sizes of
  // vectors `told`, and `lines` that letters should not cover besides
  draw(program, values, points, guides, pins) {
    const sheet = this.sheets[program] ??= this.opened(program);
    if (sheet !== this.sheet) {
      for (const node of this.sheet?.nodes ?? []) node.remove();
      if (this.sheet) {
        sheet.lettering.follow(this.sheet.lettering);
        Object.assign(sheet.plates, (({home, pins, views, scaleSteps}) => ({home, pins, views, scaleSteps}))(this.sheet.plates));
      }
      this.start.after(...sheet.nodes);
      this.sheet = sheet;
    }
    clearTimeout(this.pause);
    if (!sheet.draw(values, points, guides, pins)) this.pause = setTimeout(() => this.settle(), PAUSE);
    this.caption(sheet.plates.scaleSteps);
  }

  // the captions of the plans at these steps of their scales
  caption(steps) {
    const told = this.data.captions.map((own, i) => own[steps[i]]).join("");
    if (told === this.captioned) return;
    this.captioned = told;
    this.svg.querySelector("g.layer-text").innerHTML = told;
  }

  // lets all letters look for the best places, as they do when a motion stops
  settle() { this.sheet.write(true); }

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

  // mm of the mechanism plan for a length of the scene
  get scale() { return this.sheet.plates.views[MECHANISM].scale; }

  // the coordinates of the scene at a spot of the mechanism plan, mm from the upper left corner
  back([x, y]) { return this.sheet.plates.views[MECHANISM].back([x, this.sheet.height - y]); }
}
