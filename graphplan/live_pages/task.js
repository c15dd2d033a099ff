/** The live page of a task: what is given can be dragged or typed, the construction is drawn anew, and the linkage, its
 * numbers and its defects follow. */
const by = id => document.getElementById(id);
const svgElement = (name, look = {}, text = "") => {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(look)) element.setAttribute(key, value);
  element.textContent = text;
  return element;
};
const LETTER_MM = 3.5, ROOM_MM = 14, REACH_MM = 22, ARC_DEGREES = 12, GRIP_MM = 3.2, RUN_MS = 3500, PATH_SAMPLES = 240, MM_PER_PX = 0.29, FARTHEST = 3, OVERRUN_MM = 4;
const WHOLE = ["crank circle", "rocker circle", "inflection circle", "return circle", "arc"];  // roles of circles that are drawn all round
const ABOUT = [45, 135, 225, 315, 0, 180, 90, 270].map(angle => polar(1, radians(angle)));  // where a letter may stand

class TaskPage {
  constructor() {
    this.data = JSON.parse(by("data").textContent);
    const {rocker, lever} = this.data.request;
    const name = {function: rocker ? "rocker" : "slide", stroke: rocker ? "crank-rocker" : lever ? "lever" : "slider-crank"}[this.data.kind] ?? this.data.kind;
    this.kind = new KINDS[name](this.data);
    this.whole = new Set(WHOLE.flatMap(role => this.data.roles[role] ?? []));
    this.language = document.documentElement.lang;
    this.count = Math.max(...this.data.steps.map(({number}) => number));
    Object.assign(this.data, {width: 250, height: 170, size: this.kind.size});
    this.place = 0;
    this.turn = null;  // of OA on its way, while it runs
    this.marked = {};  // where letters stand, so that they do not jump
    this.svg = by("picture");
    for (const [id, go] of Object.entries({first: () => 0, previous: () => this.place - 1, next: () => this.place + 1, last: () => this.count}))
      by(id).addEventListener("click", () => { this.step = go(); });
    by("home").addEventListener("click", () => { this.kind.reset(); this.follow(); this.fit(); });
    by("run").addEventListener("click", () => (this.running ? this.rest() : this.run()));
    by("print").addEventListener("click", () => window.print());
    const choice = by("language");
    for (const [code, {name}] of Object.entries(this.data.languages)) choice.append(new Option(name, code, false, code === this.language));
    choice.parentElement.hidden = choice.options.length < 2;
    choice.addEventListener("change", () => this.speak(choice.value));
    this.listen();
    this.measure();
    this.speak(this.language);
    this.fit();
    window.addEventListener("resize", () => { this.measure(); this.fit(); });
  }

  // as many mm as the screen has, so that letters and handles have one size on each
  measure() {
    const {width, height} = this.svg.getBoundingClientRect();
    if (!width || !height) return;
    Object.assign(this.data, {width: width * MM_PER_PX, height: height * MM_PER_PX});
    for (const svg of [this.svg, by("handles")]) svg.setAttribute("viewBox", `0 0 ${this.data.width} ${this.data.height}`);
  }

  get spoken() { return this.data.languages[this.language]; }

  say(word, ...put) { return this.spoken.words[word].replace(/%(\d?)/g, (_, at) => put[at ? at - 1 : 0]); }

  number(value, count = 5) {
    if (!Number.isFinite(value)) return "–";
    const text = Math.abs(value) < 1e-9 * this.data.size ? "0" : String(Number(value.toPrecision(count)));
    return text.replace("-", "−").replace(".", this.spoken.decimal);
  }

  // ---- what is found

  follow() {
    const given = this.given = this.kind.inputs, numbers = this.data.inputs.map(([name, value]) => given[name] ?? value);
    this.values = TAPE(numbers, true);
    [this.linkage, this.why] = this.kind.found(this.values);
    if (this.linkage) this.asked ??= Object.keys(this.linkage.lengths);
    this.draw();
  }

  get said() {
    if (this.why) return this.say("none", this.say(...this.why.map(word => (typeof word === "number" ? this.number(word) : word))));
    return this.linkage.defects.map(defect => this.say(defect)).join(" ");
  }

  // ---- the window

  at([x, y]) {
    const {scale, left, top} = this.view;
    return [scale * (x - left), scale * (top - y)];
  }

  back([u, v]) {
    const {scale, left, top} = this.view;
    return [left + u / scale, top - v / scale];
  }

  get core() {
    const grips = this.kind.handles(this.values, 0).map(({at}) => at), {linkage} = this;
    const found = linkage ? [...linkage.A, ...linkage.B, ...Object.values(linkage.carried).flat()] : [];
    const givens = this.values.slice(0, this.data.givens).filter(value => value.length === 2);
    const near = [...grips, ...found, ...givens].filter(finite);
    if (!linkage || !near.length) return near;
    const size = Math.max(...near.map(at => abs(sub(at, near[0]))));  // a pivot that is very far off is left outside
    return [...near, ...[linkage.O, linkage.C ?? linkage.O].filter(at => abs(sub(at, near[0])) < FARTHEST * size)];
  }

  // the window holds all that must be seen; a hand that moves something keeps it, as long as it does
  fit(needed = true) {
    const {width, height} = this.data, room = [width - 2 * ROOM_MM, height - 2 * ROOM_MM], {core} = this;
    if (!core.length) return;
    const [low, high] = [Math.min, Math.max].map(most => [0, 1].map(axis => most(...core.map(at => at[axis]))));
    const inside = this.view && core.map(at => this.at(at)).every(([u, v]) => 0 < u && u < width && 0 < v && v < height);
    const scale = Math.min(...[0, 1].map(axis => room[axis] / Math.max(high[axis] - low[axis], 1e-9 * this.data.size)));
    if (!needed && inside && scale < 2.5 * this.view.scale) return;
    this.view = {scale, left: (low[0] + high[0] - width / scale) / 2, top: (low[1] + high[1] + height / scale) / 2};
    this.marked = {};
    this.draw();
  }

  // ---- drawing

  draw() {
    if (!this.view || !this.values) return;
    const layers = ["steps", "given", "linkage", "letters"].map(name => svgElement("g", {class: `layer-${name}`}));
    const [steps, given, linkage, letters] = layers;
    this.data.steps.forEach((step, k) => {
      if (step.number > this.place) return;
      const ink = svgElement("g", {class: step.number === this.place && this.place < this.count ? "step made" : "step", "data-step": Math.max(0, step.number)});
      ink.append(...this.stepInk(step, k));
      if (ink.childNodes.length) steps.append(ink);
    });
    given.append(...this.givenInk());
    if (this.linkage && this.place === this.count) linkage.append(...this.linkageInk());
    letters.append(...this.letterInk());
    this.svg.replaceChildren(...layers);
    this.grips();
    this.tell();
  }

  line(points, look) { return svgElement("polyline", {points: points.map(at => this.at(at).map(part => part.toFixed(3)).join(",")).join(" "), ...look}); }

  dot(at, r, look) {
    const [cx, cy] = this.at(at);
    return svgElement("circle", {cx: cx.toFixed(3), cy: cy.toFixed(3), r, ...look});
  }

  *stepInk(step, k) {
    const value = this.values[k];
    if (!finite(value)) return;
    const {width, height} = this.data, on = step.marks.map(mark => this.values[mark]).filter(at => at.length === 2 && finite(at) && this.near(at));
    if (step.kind === "point") {
      if (this.near(value)) yield this.dot(value, 0.5, {class: "mark"});
    } else if (step.kind === "line") {
      const [a, b, c] = value, n = Math.hypot(a, b), u = [b / n, -a / n], foot = [-a * c / (n * n), -b * c / (n * n)];
      const reached = on.map(at => (at[0] - foot[0]) * u[0] + (at[1] - foot[1]) * u[1]);
      const middle = reached.length ? 0 : (sub(this.back([width / 2, height / 2]), foot)[0] * u[0] + sub(this.back([width / 2, height / 2]), foot)[1] * u[1]);
      const over = (reached.length > 1 ? OVERRUN_MM : REACH_MM) / this.view.scale;
      const ends = [Math.min(...reached, ...(reached.length ? [] : [middle])) - over, Math.max(...reached, ...(reached.length ? [] : [middle])) + over];
      yield this.line(ends.map(t => add(foot, times(t, u))), {});
    } else if (step.kind === "circle") {
      const [x, y, square] = value, r = Math.sqrt(square), centre = [x, y];
      if (!(r * this.view.scale < 40 * width)) return;
      if (this.whole.has(k)) yield this.dot(centre, (r * this.view.scale).toFixed(3), {class: "whole"});
      else for (const at of on) {
        const angle = arg(sub(at, centre)), half = Math.min(radians(ARC_DEGREES), 6 / (r * this.view.scale));
        yield this.line([-1, -0.5, 0, 0.5, 1].map(t => add(centre, polar(r, angle + t * half))), {});
      }
    }
  }

  near(at) {
    const [u, v] = this.at(at), {width, height} = this.data;
    return Math.abs(u - width / 2) < 3 * width && Math.abs(v - height / 2) < 3 * height;
  }

  *givenInk() {
    const reach = REACH_MM / 2 / this.view.scale;
    for (const [x, y, angle] of this.kind.request.positions ?? [])
      yield this.line([[x, y], add([x, y], times(reach, heading(angle)))], {class: "plane"});
  }

  *linkageInk() {
    const {linkage} = this, link = (places, look) => this.line(places, {class: look});
    const bars = ({A, B, carried}, look) => [
      link([linkage.O, A], look), ...(linkage.slotted ? [link([linkage.C, add(linkage.C, times(1.25, sub(A, linkage.C)))], look)]
        : [link([A, B], look), ...(linkage.C ? [link([B, linkage.C], look)] : []), ...Object.values(carried).map(at => link([A, at, B], `${look} carried`))])];
    const at = k => ({A: linkage.A[k], B: linkage.B[k], carried: Object.fromEntries(Object.entries(linkage.carried).map(([name, places]) => [name, places[k]]))});
    for (const name of Object.keys(linkage.carried).slice(0, 1)) yield link(this.path(name), "path");
    for (let k = linkage.A.length - 1; k > 0; k--) yield* bars(at(k), "later");
    const pose = this.turn === null ? at(0) : linkage.pose(this.turn) ?? at(0);
    yield* bars(pose, "link");
    if (linkage.guide) {
      const reached = linkage.B.map(B => div(sub(B, linkage.B[0]), linkage.guide)[0]), over = REACH_MM / 2 / this.view.scale;
      yield link([Math.min(...reached) - over, Math.max(...reached) + over].map(t => add(linkage.B[0], times(t, linkage.guide))), "guideway");
      const [u, v] = this.at(pose.B);
      yield svgElement("rect", {x: u - 2.6, y: v - 1.6, width: 5.2, height: 3.2, class: "joint", transform: `rotate(${-degrees(arg(linkage.guide))} ${u} ${v})`});
    }
    for (const pivot of [linkage.O, ...(linkage.C ? [linkage.C] : [])]) {
      const [u, v] = this.at(pivot);
      yield svgElement("path", {d: `M${u} ${v} l-2.4 4 h4.8 z m-4 4 h8`, class: "ground"});
      yield this.dot(pivot, 1, {class: "joint"});
    }
    for (const pin of linkage.slotted ? [pose.A] : [pose.A, pose.B]) yield this.dot(pin, 1, {class: "joint"});
  }

  // the path of a point as far as the linkage goes either way
  path(name) {
    const ways = [1, -1].map(way => {
      const run = [];
      for (let k = 0; k <= PATH_SAMPLES; k++) {
        const pose = this.linkage.pose(way * Math.PI * k / PATH_SAMPLES);
        if (!pose || !finite(pose.carried[name])) break;
        run.push(pose.carried[name]);
      }
      return run;
    });
    return [...ways[1].reverse(), ...ways[0]];
  }

  // letters beside their marks, where most is free; they stay where they are as long as that is nearly as good
  *letterInk() {
    const named = [], taken = [];
    this.data.steps.forEach(({name, kind, number}, k) => {
      if (name.some(([text]) => text) && kind === "point" && number <= this.place && finite(this.values[k])) named.push([name, this.at(this.values[k])]);
    });
    const spots = named.map(([, at]) => at), {width, height} = this.data;
    for (const [runs, [u, v]] of named) {
      if (!(0 <= u && u <= width && 0 <= v && v <= height)) continue;
      const key = runs.map(([text]) => text).join("_"), wide = key.length * LETTER_MM * 0.6;
      const price = ([x, y], k) => {
        const middle = [u + x * (2 + wide / 2), v - y * 3.2];
        const crowd = [...spots.filter(spot => spot[0] !== u || spot[1] !== v), ...taken]
          .reduce((sum, spot) => sum + Math.max(0, 7 - Math.hypot(spot[0] - middle[0], spot[1] - middle[1])), 0);
        return crowd + 0.1 * k - (this.marked[key] === k ? 1 : 0);
      };
      const best = ABOUT.map(price).reduce((at, cost, k, costs) => (cost < costs[at] ? k : at), 0), [x, y] = ABOUT[best];
      this.marked[key] = best;
      taken.push([u + x * (2 + wide / 2), v - y * 3.2]);
      const text = svgElement("text", {x: u + x * (1.4 + wide / 2), y: v - y * 3.2 + LETTER_MM / 3, "font-size": LETTER_MM, "text-anchor": "middle"});
      for (const [part, level] of runs) text.append(svgElement("tspan", level ? {dy: -level * 1.1, "font-size": LETTER_MM * 0.7} : {}, part));
      yield text;
    }
  }

  // ---- by hand

  grips() {
    const held = this.held?.name, handles = this.kind.handles(this.values, REACH_MM / this.view.scale), svg = by("handles");
    this.handles = Object.fromEntries(handles.map(handle => [handle.name, handle]));
    for (const grip of [...svg.childNodes]) if (!(grip.dataset.name in this.handles)) grip.remove();
    const known = Object.fromEntries([...svg.childNodes].map(grip => [grip.dataset.name, grip]));
    for (const {name, at} of handles) {
      const grip = known[name] ?? svgElement("circle", {r: GRIP_MM, class: "handle", tabindex: 0, role: "button", "data-name": name});
      const [u, v] = this.at(at);
      if (Number.isFinite(u + v)) for (const [key, value] of [["cx", u], ["cy", v]]) grip.setAttribute(key, value.toFixed(3));
      grip.setAttribute("aria-label", this.say("handle", name.replace("_", " ")));
      grip.classList.toggle("held", name === held);
      if (!known[name]) svg.append(grip);
    }
  }

  pointer(event) {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(by("handles").getScreenCTM().inverse());
    return this.back([at.x, at.y]);
  }

  // a place that a hand means: no finer than a screen shows
  rounded(value) {
    const grain = 10 ** Math.floor(Math.log10(0.3 / this.view.scale));
    return value.map(part => Number((Math.round(part / grain) * grain).toPrecision(12)));
  }

  listen() {
    const svg = by("handles");
    // a finger on a handle scrolls no page; browsers heed touch-action on an SVG's own box alone
    svg.addEventListener("touchstart", event => { if (event.target.dataset?.name) event.preventDefault(); }, {passive: false});
    svg.addEventListener("pointerdown", event => {
      const name = event.target.dataset?.name;
      if (!name) return;
      this.rest();
      this.held = {name, off: sub(this.handles[name].at, this.pointer(event))};
      svg.setPointerCapture(event.pointerId);
      document.activeElement.blur();  // a mouse takes no keys away from the steps
      event.preventDefault();
    });
    svg.addEventListener("pointermove", event => {
      if (this.held) this.drag(this.held.name, ...this.rounded(add(this.pointer(event), this.held.off)));
    });
    for (const end of ["pointerup", "pointercancel"]) svg.addEventListener(end, () => {
      if (!this.held) return;
      this.held = null;
      this.draw();
      this.fit(false);
    });
    svg.addEventListener("keydown", event => {
      const name = event.target.dataset?.name, way = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key];
      if (!name || !way || event.altKey || event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      this.drag(name, ...add(this.handles[name].at, times((event.shiftKey ? 0.2 : 1) / this.view.scale, way)));
      this.fit(false);
    });
    document.addEventListener("keydown", event => {
      if (event.target.closest("input, select, #handles") || event.altKey || event.ctrlKey || event.metaKey) return;
      const go = {ArrowLeft: this.place - 1, ArrowRight: this.place + 1, Home: 0, End: this.count}[event.key];
      if (go !== undefined) { event.preventDefault(); this.step = go; }
    });
  }

  drag(name, x, y) {
    this.turn = null;
    this.handles[name].drag([x, y]);
    this.follow();
  }

  // ---- by itself: through the positions and back

  run() {
    const {linkage} = this, last = linkage && (linkage.wholeTurn ? 2 * Math.PI : (linkage.travel && linkage.turns.at(-1)));
    if (!last) return;
    this.step = this.count;
    const start = performance.now();
    const tick = now => {
      const part = (now - start) / RUN_MS;
      this.turn = linkage.wholeTurn ? last * part : last * (1 - Math.cos(Math.PI * part)) / 2;
      if (part >= 2) return this.rest();
      this.draw();
      this.running = requestAnimationFrame(tick);
    };
    this.running = requestAnimationFrame(tick);
    this.tell();
  }

  rest() {
    cancelAnimationFrame(this.running);
    this.running = 0;
    this.turn = null;
    this.draw();
  }

  get step() { return this.place; }

  set step(place) {
    this.place = Math.max(0, Math.min(this.count, place));
    this.draw();
    by("list").querySelector("[aria-current]")?.scrollIntoView({block: "nearest"});
  }

  // ---- words

  speak(language) {
    this.language = document.documentElement.lang = language;
    document.title = document.querySelector("h1").textContent = this.spoken.title;
    for (const node of document.querySelectorAll("[data-word]")) node.textContent = this.say(node.dataset.word);
    for (const node of document.querySelectorAll("[data-label]")) node.setAttribute("aria-label", this.say(node.dataset.label));
    this.svg.setAttribute("aria-label", this.spoken.title);
    by("list").innerHTML = this.spoken.stages.map(([title, law, steps]) => `<li><h4>${title}</h4>${law && `<p>${law}</p>`}</li>${steps.map(([number, words]) =>
      `<li><button type="button" data-place="${number}"><b>${number}</b> <span>${this.following(number, words)}</span></button></li>`).join("")}`).join("");
    for (const button of by("list").querySelectorAll("[data-place]")) button.addEventListener("click", () => { this.step = Number(button.dataset.place); });
    this.fields();
    this.follow();
  }

  // a sentence in whose place of an angle that is given there is a mark for what it will be
  following(number, words) {
    const angle = `${number + this.data.givens - 1}.angle`, given = Object.fromEntries(this.data.inputs), text = this.number(this.angle(angle, given), 6);
    return `${angle}.x` in given && words.includes(text) ? words.replace(text, `<span data-input="${angle}"></span>`) : words;
  }

  angle(name, given) { return degrees(Math.atan2(given[`${name}.y`], given[`${name}.x`])); }

  // what is given, as numbers that can be typed
  fields() {
    this.inputs = [];
    const table = by("fields");
    table.replaceChildren(...this.kind.fields.map(([label, ...cells]) => {
      const row = document.createElement("tr"), head = document.createElement("th");
      head.innerHTML = label;
      row.append(head, ...cells.map(path => {
        const cell = document.createElement("td");
        if (typeof path === "string") cell.innerHTML = path;
        else cell.append(...this.field(path, label));
        return cell;
      }));
      return row;
    }));
  }

  *field(path, label) {
    const put = text => {
      const value = Number(String(text).replace("−", "-").replace(",", "."));
      if (String(text).trim() && Number.isFinite(value)) this.put(path, value);
      this.fit(false);
      this.draw();
    };
    const input = document.createElement("input");
    Object.assign(input, {type: "text", inputMode: "decimal", autocomplete: "off"});
    input.setAttribute("aria-label", `${label.replace(/<[^>]*>/g, "")} ${path.at(-1)}`);
    input.addEventListener("change", () => put(input.value));
    this.inputs.push([path, input]);
    yield input;
    if (!this.kind.sliders) return;
    const slider = document.createElement("input"), [low, high] = this.range(path);
    Object.assign(slider, {type: "range", min: low, max: high, step: (high - low) / 400, value: this.value(path)});
    slider.setAttribute("aria-label", label.replace(/<[^>]*>/g, ""));
    slider.addEventListener("input", () => this.put(path, Number(Number(slider.value).toPrecision(4))));
    slider.addEventListener("change", () => this.fit(false));
    this.inputs.push([path, slider]);
    yield slider;
  }

  range(path) {
    const value = this.value(path);
    return path[0] === "ratio" ? [1.01, Math.max(2, value)] : path.at(-1) === "swing" ? [5, 175] : [Math.min(0.1 * value, 2 * value), Math.max(0.1 * value, 2 * value)];
  }

  // K stands for the angle between the dead positions
  value(path) {
    if (path[0] !== "ratio") return this.kind.get(path);
    const {angle} = this.kind.request;
    return (180 + angle) / (180 - angle);
  }

  put(path, value) {
    this.rest();
    if (path[0] === "ratio") { if (value > 1) this.kind.request.angle = 180 * (value - 1) / (value + 1); }
    else if (path.length > 1 || path[0] === "at" || value > 0) this.kind.set(path, value);
    this.follow();
  }

  tell() {
    const told = this.said.replaceAll("<", "&lt;").replace(/_(\d)/g, "<sub>$1</sub>");
    if (by("said").innerHTML !== told) by("said").innerHTML = told;
    for (const [path, input] of this.inputs) if (document.activeElement !== input) input.value = input.type === "range" ? this.value(path) : this.number(this.value(path), 7);
    by("found").innerHTML = this.results.map(([name, value]) => `<tr><th>${name}</th><td>${value}</td></tr>`).join("");
    for (const node of document.querySelectorAll("[data-input]")) node.textContent = this.number(this.angle(node.dataset.input, {...Object.fromEntries(this.data.inputs), ...this.given}), 5);
    for (const button of by("list").querySelectorAll("[data-place]")) button.toggleAttribute("aria-current", Number(button.dataset.place) === this.place && this.place < this.count);
    by("run").textContent = this.say(this.running ? "pause" : "play");
    by("run").disabled = !(this.linkage && (this.linkage.wholeTurn || (this.linkage.travel && this.linkage.A.length > 1)));
    for (const [id, ended] of [["first", this.place === 0], ["previous", this.place === 0], ["next", this.place === this.count], ["last", this.place === this.count]]) by(id).disabled = ended;
  }

  // what is told of the linkage; dashes where there is none
  get results() {
    const {linkage} = this, {length} = this.data, rows = [];
    const names = linkage ? Object.entries(linkage.lengths) : (this.asked ?? []).map(name => [name, NaN]);
    for (const [name, size] of names) rows.push([name === "offset" ? "e" : name.replace(" ", ""), linkage ? `${this.number(size)} ${length}` : "–"]);
    const travel = linkage?.travel?.slice(1) ?? [];
    rows.push([this.say("type"), linkage ? this.say(linkage.type) : "–"]);
    if (this.kind.data.kind !== "cognates") rows.push([this.say("travel"), travel.map(turn => `${this.number(turn)}°`).join(", ") || "–"]);
    rows.push([this.say("transmission"), linkage ? `${this.number(linkage.transmission.least, 4)}° (${this.number(linkage.transmission.at, 4)}°)` : "–"]);
    return rows;
  }
}

const page = new TaskPage();
window.graphplan = {
  ready: Promise.resolve(),
  given: () => structuredClone(page.kind.request),
  fields: () => page.kind.fields,
  points: () => Object.fromEntries(Object.entries(page.handles).map(([name, {at}]) => [name, at])),
  drag: (name, x, y) => page.drag(name, x, y),
  set: (path, value) => page.put(path, value),
  results: () => page.linkage?.results ?? null,
  reset: () => { page.kind.reset(); page.follow(); },
  screen: name => {
    const [x, y] = page.at(page.handles[name].at), at = new DOMPoint(x, y).matrixTransform(by("handles").getScreenCTM());
    return [at.x, at.y];
  },
  steps: page.count,
  get step() { return page.step; },
  set step(place) { page.step = place; },
  get said() { return page.said; },
};
