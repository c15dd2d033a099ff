// ---- the asked results in sight: a strip of them, their sizes at the vectors, and the graph of one of them over the travel

const SHORT_SHARE = 0.05;  // of the longest vector of a kind: one shorter need not be told where it is not drawn
const KINDS = [["points", "velocity", "v", "speed"], ["slides", "velocity", "v", "speed"], ["points", "acceleration", "a", "acceleration"],
  ["slides", "acceleration", "a", "acceleration"], ["links", "omega", "ω", "turning"], ["links", "alpha", "α", "bending"]];
const GRAPH_EDGES = [52, 12, 20, 16];  // of the graph: left, right, above and below
const ROUNDING = 1e-12;
const CONSTANT = 1e-6;  // of the largest: what changes less over the travel stands still
const ROBUST = 0.9, OVER_ROBUST = 2.5;  // a graph reaches so many times as high as most of its poses are

// the size of a vector or a number, not a number where it is unknown
const sizeOf = value => (Array.isArray(value) ? Math.hypot(...value) : value ?? NaN);

// a vector by its letter; those of orthogonal velocities, whose ends have the letters, by that of the velocity
const nameOf = ({letter, label}) => letter || label.replace("velocity ", "v_").replace("acceleration ", "a_");

const leasts = new WeakMap();  // by results
const rounded = (size, least) => (Math.abs(size) <= least ? 0 : size);

// below what a result of a kind is nothing but rounding: of the largest of its kind, an angular acceleration beside omega squared too
function leastOf(results, kind) {
  if (!leasts.has(results)) {
    const rates = Object.values({...results?.points, ...results?.links}), largest = of => Math.max(0, ...rates.map(own => Math.abs(sizeOf(own[of]) || 0)));
    const [velocity, acceleration, omega, alpha] = ["velocity", "acceleration", "omega", "alpha"].map(largest);
    leasts.set(results, {velocity, acceleration, omega, alpha: Math.max(alpha, omega ** 2)});
  }
  return ROUNDING * leasts.get(results)[kind];
}

// what was asked for, in order: its key, letter and name, what it is measured in, and how results have it
function askedOf(results) {
  const rates = KINDS.flatMap(([part, kind, letter, of]) => Object.entries(results?.[part] ?? {}).filter(([, own]) => kind in own)
    .map(([name]) => ({key: `${part} ${kind} ${name}`, letter, name: name.replace(" along ", "/"), of,
      size: told => (told ? rounded(sizeOf(told[part]?.[name]?.[kind]), leastOf(told, kind)) : NaN)})));
  const balances = [results?.balance ?? []].flat().map((own, i) => {
    const kind = "force" in own ? "force" : "moment";
    return {key: `balance ${i}`, letter: kind === "force" ? "F" : "M", name: own.at || own.link, of: kind, size: told => sizeOf([told?.balance].flat()[i]?.[kind])};
  });
  return [...rates, ...balances];
}

class Asked {
  constructor(page) {
    Object.assign(this, {page, all: [], chosen: "", values: true, next: true, spans: []});
    by("values").addEventListener("click", () => { this.values = !this.values; page.draw(); });
    for (const kind of ["pointerdown", "pointermove"]) by("graph").addEventListener(kind, event => {
      if (!event.buttons || page.motion.still || !this.frame) return;
      event.preventDefault();
      page.moving.rest();
      const {left, width, from, to} = this.frame, x = event.clientX - by("graph").getBoundingClientRect().left;
      const travel = from + (to - from) * Math.min(1, Math.max(0, (x - left) / width));
      page.moving.go(travel + this.periods(page.motion.travel - (from + to) / 2), true);  // where the cursor is, in its period
    });
    by("graph").addEventListener("pointerup", () => page.moving.settle());
    addEventListener("resize", () => this.graph(true));
  }

  spell() {
    this.all = [];
  }

  draw() {
    by("values").setAttribute("aria-pressed", this.values);
    this.graph();
  }

  unit({of}) { return this.page.data.units[this.page.language][of]; }

  // ---- the strip

  strip(results) {
    const all = results ? askedOf(results) : this.all, keys = JSON.stringify(all.map(({key}) => key));
    if (keys !== this.keys || this.all.length !== all.length) {
      Object.assign(this, {all, keys});
      if (!all.some(({key}) => key === this.chosen)) this.chosen = all[0]?.key ?? "";
      by("strip").replaceChildren(...all.map(asked => this.button(asked)));
      this.spans = [...by("strip").querySelectorAll("b")];
    }
    this.all.forEach((asked, i) => {
      const told = this.page.number(asked.size(results));
      if (this.spans[i].textContent !== told) this.spans[i].textContent = told;
    });
  }

  button({key, letter, name, ...asked}) {
    const button = document.createElement("button"), low = document.createElement("sub");
    Object.assign(button, {type: "button", title: this.page.say("graph", `${letter}_${name}`)});
    low.textContent = name;
    button.append(letter, low, document.createElement("b"), this.unit(asked));
    button.setAttribute("aria-pressed", key === this.chosen);
    button.addEventListener("click", () => {
      this.next = false;
      this.choose(this.chosen === key ? "" : key);
    });
    return button;
  }

  // ---- sizes at the heads of vectors

  // the size of a vector as it stands at its head; empty where none is wanted or known
  told(label) {
    const size = this.values ? this.size(label, this.page.motion.results()) : NaN;
    return Number.isFinite(size) ? this.page.number(size) : "";
  }

  // what is not known in this pose, or not drawn though it is known
  lacking(results) {
    const {sheet} = this.page.picture, lost = ({ends}) => !ends.every(end => end.every(Number.isFinite));
    return [...this.all.filter(({size}) => !Number.isFinite(size(results))).map(({letter, name}) => `${letter}_${name}`),
      ...sheet.data.vectors.filter(vector => vector.label && lost(vector) && this.size(vector.label, results) > 0).map(nameOf)];
  }

  // the letters of vectors too short to be drawn, though not negligible beside the longest of their kind
  short(results) {
    const kind = ({label}) => label.split(" ")[0], longest = {}, sizes = new Map();
    for (const vector of this.page.picture.sheet.data.vectors.filter(({label}) => label)) {
      sizes.set(vector, this.size(vector.label, results) || 0);
      longest[kind(vector)] = Math.max(longest[kind(vector)] ?? 0, sizes.get(vector));
    }
    return [...sizes].filter(([vector, size]) => !vector.shown && size > SHORT_SHARE * longest[kind(vector)]).map(([vector]) => nameOf(vector));
  }

  // the size of what a vector shows, by its name
  size(label, results) {
    const [kind, name] = label.split(" ");
    if (kind !== "reaction") return sizeOf(results?.points?.[name]?.[kind]);
    const places = ["on", "from"].map(side => one => (one[side] === "frame" ? "0" : one[side]));
    const own = (results?.reactions ?? []).find(one => ["", ","].some(comma => [places, [...places].reverse()]
      .some(([first, last]) => name === `R_${first(one)}${comma}${last(one)}`)));
    return sizeOf(own?.force);
  }

  // ---- the graph

  graph(anew = false) {
    const {page} = this, asked = this.all.find(({key}) => key === this.chosen), hidden = !asked || Boolean(page.motion.still);
    if (by("graph").hasAttribute("hidden") !== hidden) {
      by("graph").toggleAttribute("hidden", hidden);
      page.grips.measure();
    }
    if (hidden) return;
    const poses = page.poses.walked(), key = [this.chosen, poses.length, page.language, page.poses.pins].join();
    if (anew || key !== this.graphed) this.plot(asked, poses);
    this.graphed = key;
    this.cursor(asked);
    if (this.next && poses.length > page.poses.count) this.prefer(asked, poses);
  }

  // as long as nobody chose, what changes over the travel is shown
  prefer(asked, poses) {
    const sizes = poses.map(({results}) => asked.size(results)).filter(Number.isFinite), high = Math.max(...sizes.map(Math.abs));
    const still = !sizes.length || Math.max(...sizes) - Math.min(...sizes) < CONSTANT * high, place = this.all.indexOf(asked) + 1;
    this.next = still && place < this.all.length;
    if (this.next) this.choose(this.all[place].key);
  }

  choose(key) {
    this.chosen = key;
    for (const [i, one] of [...by("strip").children].entries()) one.setAttribute("aria-pressed", this.all[i].key === key);
    this.graph(true);
  }

  plot(asked, poses) {
    const {page} = this, wide = by("graph").clientWidth, tall = by("graph").clientHeight, [left, right, above, below] = GRAPH_EDGES;
    const [from, to] = page.poses.range, sizes = poses.map(({results}) => asked.size(results));
    const [low, high] = this.heights(sizes.filter(Number.isFinite));
    this.frame = {left, width: wide - left - right, from, to, low, high, top: above, height: tall - above - below};
    let told = "", pen = "M";
    poses.forEach(({travel}, i) => {
      if (!Number.isFinite(sizes[i])) { pen = "M"; return; }
      const [x, y] = this.at(travel, sizes[i]);
      told += `${pen}${x.toFixed(1)} ${y.toFixed(1)}`;
      pen = "L";
    });
    const text = (x, y, words, anchor) => Object.assign(made("text", {x, y, "text-anchor": anchor}), {textContent: words});
    const bottom = above + this.frame.height, zero = this.at(from, 0)[1], name = `${asked.letter}_${asked.name}`;
    const head = made("text", {x: left + 4, y: 13, "font-weight": "bold"});
    const sub = Object.assign(made("tspan", {dy: 3, "font-size": 9}), {textContent: asked.name});
    head.append(asked.letter, sub, Object.assign(made("tspan", {dy: -3}), {textContent: `, ${this.unit(asked)}`}));
    const clip = made("clipPath", {id: "graph-clip"});
    clip.append(made("rect", {x: left, y: above, width: Math.max(0, this.frame.width), height: Math.max(0, this.frame.height)}));
    this.dot = made("circle", {r: 4});
    this.line = made("line", {class: "cursor", y1: above, y2: bottom});
    by("graph").replaceChildren(clip, made("path", {d: `M${left} ${above}V${bottom}H${wide - right}`}),
      ...(low < 0 && high > 0 ? [made("line", {x1: left, x2: wide - right, y1: zero, y2: zero})] : []),
      made("path", {class: "curve", d: told || "M0 0", "clip-path": "url(#graph-clip)"}), this.line, this.dot, head,
      text(left - 5, above + 9, page.number(high, 3), "end"), text(left - 5, bottom, page.number(low, 3), "end"),
      text(left, tall - 3, page.moving.told(from), "start"), text(wide - right, tall - 3, page.moving.told(to), "end"));
    by("graph").setAttribute("aria-label", page.say("graph", name));
  }

  // from where to where the graph reaches: from nothing, or below it, to a little over most poses
  heights(sizes) {
    const reach = (sign) => {
      const own = sizes.map(size => Math.max(0, sign * size)).sort((p, q) => p - q);
      return Math.min(own.at(-1) ?? 0, OVER_ROBUST * (own[Math.floor(ROBUST * (own.length - 1))] ?? 0) || Infinity);
    };
    const [low, high] = [-reach(-1), reach(1)];
    return low || high ? [low + 0, high] : [0, 1];
  }

  at(travel, size) {
    const {left, width, from, to, low, high, top, height} = this.frame;
    return [left + width * (travel - from) / (to - from || 1), top + height * (1 - (size - low) / (high - low))];
  }

  // the whole periods in a difference of travels; between limits there are none
  periods(difference) {
    const period = this.frame.to - this.frame.from, {round} = this.page.moving, {turns} = this.page.motion.data.linkage;
    return round && turns ? period * Math.round(difference / period) : 0;
  }

  cursor(asked) {
    const {page, frame} = this, {from, to} = frame, travel = page.motion.travel - this.periods(page.motion.travel - (from + to) / 2);
    const size = asked.size(page.motion.results()), [x, y] = this.at(travel, Number.isFinite(size) ? size : 0);
    this.line.setAttribute("x1", x);
    this.line.setAttribute("x2", x);
    this.dot.style.display = Number.isFinite(size) && size >= frame.low && size <= frame.high ? "" : "none";
    this.dot.setAttribute("cx", x);
    this.dot.setAttribute("cy", y);
  }
}
