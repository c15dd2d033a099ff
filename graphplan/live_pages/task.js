/** The live page of a task: what is given can be dragged or typed, the construction is drawn anew, and the linkage, its
 * numbers and its defects follow. */
const REACH_MM = 22, ROOM_MM = 14, RUN_MS = 3500, PATH_SAMPLES = 240, FARTHEST = 3;
const WHOLE = ["crank circle", "rocker circle", "inflection circle", "return circle", "arc"];  // roles of circles that are drawn all round

class TaskPage extends SpokenPage {
  constructor() {
    super();
    const {rocker, lever} = this.data.request;
    const name = {function: rocker ? "rocker" : "slide", stroke: rocker ? "crank-rocker" : lever ? "lever" : "slider-crank"}[this.data.kind] ?? this.data.kind;
    this.kind = new KINDS[name](this.data);
    Object.assign(this, {drawn: this.data.program, program: 0, place: 0, wheels: new Set(WHOLE.flatMap(role => this.data.roles[role] ?? []))});
    this.whole = this.svg.getAttribute("viewBox").split(/[\s,]+/).map(Number);
    this.turn = null;  // of OA on its way, while it runs
    this.home = (({rect, scale, origin}) => new View(rect, scale, origin))(this.data.picture.panels[0]);
    this.stepping = new Stepping(this);
    this.viewing = new Viewing(this);
    this.grips = new Grips(this, {
      where: name => this.handles[name].at, step: fine => (fine ? 0.2 : 1) / this.picture.scale,
      drag: (name, at, pixel) => this.drag(name, ...(pixel ? this.rounded(at) : at)), left: () => this.fit(false),
    });
    by("home").addEventListener("click", () => { this.kind.reset(); this.follow(); this.fit(); });
    by("run").addEventListener("click", () => (this.running ? this.rest() : this.run()));
    by("language").addEventListener("change", event => this.speak(event.target.value));
    addEventListener("resize", () => this.grips.measure());
    this.speak(this.language);
    this.fit();
  }

  get count() { return this.drawn.steps.length - this.drawn.givens; }
  get told() { return this.data.told[this.language]; }
  get playing() { return Boolean(this.running || this.stepping.playing); }

  number(value, count = 5) { return super.number(Math.abs(value) < 1e-9 * this.kind.size ? 0 : value, count); }

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

  at(place) {
    const [x, y] = this.home.at(place);
    return [x, this.data.picture.height - y];
  }

  get core() {
    const grips = this.kind.handles(this.values, 0).map(({at}) => at), {linkage} = this;
    const found = linkage ? [...linkage.A, ...linkage.B, ...Object.values(linkage.carried).flat()] : [];
    const givens = this.values.slice(0, this.drawn.givens).filter(value => value.length === 2);
    const near = [...grips, ...found, ...givens].filter(finite);
    if (!linkage || !near.length) return near;
    const size = Math.max(...near.map(at => abs(sub(at, near[0]))));  // a pivot that is very far off is left outside
    return [...near, ...[linkage.O, linkage.C ?? linkage.O].filter(at => abs(sub(at, near[0])) < FARTHEST * size)];
  }

  // the plan holds all that must be seen; a hand that moves something keeps it, as long as it does
  fit(needed = true) {
    const {rect} = this.data.picture.panels[0], room = [0, 1].map(axis => rect[axis + 2] - rect[axis] - 2 * ROOM_MM), {core} = this;
    if (!core.length) return;
    const [low, high] = [Math.min, Math.max].map(most => [0, 1].map(axis => most(...core.map(at => at[axis]))));
    const inside = core.map(at => this.home.at(at)).every(([x, y]) => rect[0] < x && x < rect[2] && rect[1] < y && y < rect[3]);
    const scale = Math.min(...[0, 1].map(axis => room[axis] / Math.max(high[axis] - low[axis], 1e-9 * this.kind.size)));
    if (needed || !inside || scale >= 2.5 * this.home.scale)
      this.home = new View(rect, scale, [0, 1].map(axis => (rect[axis] + rect[axis + 2] - scale * (low[axis] + high[axis])) / 2));
    this.draw();
  }

  // ---- drawing

  draw() {
    const {home} = this, {linkage: {O, A, B, C} = {}} = this.linkage && this.place === this.count ? this : {};
    const lines = O ? [A.flatMap((at, k) => [O, at, B[k], ...(C ? [C, O] : [O])]).filter(finite).map(at => home.at(at))] : [];
    this.picture.draw(0, onPaper(this.values, this.data.picture.steps, () => home.scale), {}, {}, {home, rest: true, lines, told: () => "", held: () => []});
    this.ink.replaceChildren(...this.givenInk(), ...(O ? this.linkageInk() : []));
    this.stepping.show();
    this.handles = Object.fromEntries(this.kind.handles(this.values, REACH_MM / this.picture.scale).map(handle => [handle.name, handle]));
    this.grips.take(Object.keys(this.handles));
    this.grips.put(Object.keys(this.handles), name => this.at(this.handles[name].at));
    this.tell();
  }

  stepped() { this.draw(); }

  line(places, look) { return made("polyline", {points: places.map(at => this.at(at).map(part => part.toFixed(3)).join(",")).join(" "), class: look}); }

  dot(at, r, look) {
    const [cx, cy] = this.at(at);
    return made("circle", {cx: cx.toFixed(3), cy: cy.toFixed(3), r, class: look});
  }

  *givenInk() {
    const {scale} = this.home;
    for (const [x, y, angle] of this.kind.request.positions ?? [])
      yield this.line([[x, y], add([x, y], times(REACH_MM / 2 / scale, heading(angle)))], "plane");
    for (const k of this.wheels) {
      const [x, y, square] = this.values[k], r = Math.sqrt(square) * scale;
      if (this.drawn.steps[k].number <= this.place && r < 40 * this.whole[2]) yield this.dot([x, y], r.toFixed(3), "whole");
    }
  }

  *linkageInk() {
    const {linkage} = this, over = REACH_MM / 2 / this.home.scale;
    const bars = ({A, B, carried}, look) => [
      this.line([linkage.O, A], look), ...(linkage.slotted ? [this.line([linkage.C, add(linkage.C, times(1.25, sub(A, linkage.C)))], look)]
        : [this.line([A, B], look), ...(linkage.C ? [this.line([B, linkage.C], look)] : []), ...Object.values(carried).map(at => this.line([A, at, B], `${look} carried`))])];
    const at = k => ({A: linkage.A[k], B: linkage.B[k], carried: Object.fromEntries(Object.entries(linkage.carried).map(([name, places]) => [name, places[k]]))});
    for (const name of Object.keys(linkage.carried).slice(0, 1)) yield this.line(this.path(name), "path");
    for (let k = linkage.A.length - 1; k > 0; k--) yield* bars(at(k), "other");
    const pose = this.turn === null ? at(0) : linkage.pose(this.turn) ?? at(0);
    yield* bars(pose, "link");
    if (linkage.guide) {
      const reached = linkage.B.map(B => div(sub(B, linkage.B[0]), linkage.guide)[0]);
      yield this.line([Math.min(...reached) - over, Math.max(...reached) + over].map(t => add(linkage.B[0], times(t, linkage.guide))), "guideway");
      const [u, v] = this.at(pose.B);
      yield made("rect", {x: u - 2.6, y: v - 1.6, width: 5.2, height: 3.2, class: "joint", transform: `rotate(${-degrees(arg(linkage.guide))} ${u} ${v})`});
    }
    for (const pivot of [linkage.O, ...(linkage.C ? [linkage.C] : [])]) {
      const [u, v] = this.at(pivot);
      yield made("path", {d: `M${u} ${v} l-2.4 4 h4.8 z m-4 4 h8`});
      yield this.dot(pivot, 1, "joint");
    }
    for (const pin of linkage.slotted ? [pose.A] : [pose.A, pose.B]) yield this.dot(pin, 1, "joint");
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

  // ---- by hand

  // a place that a hand means: no finer than a screen shows
  rounded(value) {
    const grain = 10 ** Math.floor(Math.log10(0.3 / this.home.scale));
    return value.map(part => Number((Math.round(part / grain) * grain).toPrecision(12)));
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
    this.stepping.go(this.count);
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
    Object.assign(this, {running: 0, turn: null});
    this.draw();
  }

  // ---- words

  speak(language) {
    this.language = by("language").value = language;
    this.spellWords(this.told.title);
    const steps = this.data.picture.steps.map((step, i) => ({...step, ...this.told.steps[i]}));
    this.picture = new Picture(this.svg, {programs: [{...this.data.picture, steps}], captions: [[""]]});
    by("list").innerHTML = this.told.stages.map(([title, law, own]) => `<li class="stage"><h4>${title}</h4>${law && `<p>${law}</p>`}<ol>${own.map(([number, words]) =>
      `<li><button type="button" data-place="${number}"><b>${number}</b> <span>${this.following(number, words)}</span></button></li>`).join("")}</ol></li>`).join("");
    this.ink = made("g", {id: "linkage"});
    this.svg.querySelector("#linkage")?.remove();
    this.svg.insertBefore(this.ink, this.picture.start);
    this.fields();
    this.stepping.take();
    this.stepping.spell();
    this.viewing.spell();
    this.follow();
  }

  // a sentence in whose place of an angle that is given there is a mark for what it will be
  following(number, words) {
    const angle = `${number + this.drawn.givens - 1}.angle`, given = Object.fromEntries(this.data.inputs), text = this.number(this.angle(angle, given), 6);
    return `${angle}.x` in given && words.includes(text) ? words.replace(text, `<span data-input="${angle}"></span>`) : words;
  }

  angle(name, given) { return degrees(Math.atan2(given[`${name}.y`], given[`${name}.x`])); }

  // what is given, as numbers that can be typed
  fields() {
    this.inputs = [];
    by("fields").replaceChildren(...this.kind.fields.map(([label, ...cells]) => {
      const row = document.createElement("tr"), head = document.createElement("th");
      head.innerHTML = label;
      row.append(head, ...cells.map(path => {
        const cell = document.createElement("td");
        if (typeof path === "string") cell.innerHTML = path;
        else cell.append(...this.field(path, label.replace(/<[^>]*>/g, "")));
        return cell;
      }));
      return row;
    }));
  }

  *field(path, label) {
    const input = document.createElement("input");
    Object.assign(input, {type: "text", inputMode: "decimal", autocomplete: "off"});
    input.setAttribute("aria-label", `${label} ${path.at(-1)}`);
    input.addEventListener("change", () => {
      const value = this.typed(input.value);
      if (Number.isFinite(value)) this.put(path, value);
      this.fit(false);
    });
    this.inputs.push([path, input]);
    yield input;
    if (!this.kind.sliders) return;
    const slider = document.createElement("input"), [low, high] = this.range(path);
    Object.assign(slider, {type: "range", min: low, max: high, step: (high - low) / 400, value: this.value(path)});
    slider.setAttribute("aria-label", label);
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
    if (this.running) this.rest();
    if (path[0] === "ratio") { if (value > 1) this.kind.request.angle = 180 * (value - 1) / (value + 1); }
    else if (path.length > 1 || path[0] === "at" || value > 0) this.kind.set(path, value);
    this.follow();
  }

  tell() {
    const told = this.said.replaceAll("<", "&lt;").replace(/_(\d)/g, "<sub>$1</sub>");
    if (by("said").innerHTML !== told) by("said").innerHTML = told;
    for (const [path, input] of this.inputs) if (document.activeElement !== input) input.value = input.type === "range" ? this.value(path) : this.number(this.value(path), 7);
    by("found").innerHTML = this.results.map(([name, value]) => `<tr><th>${name}</th><td>${value}</td></tr>`).join("");
    for (const node of by("list").querySelectorAll("[data-input]")) node.textContent = this.number(this.angle(node.dataset.input, {...Object.fromEntries(this.data.inputs), ...this.given}), 5);
    this.stepping.speak();
    this.tellPlaying();
    by("run").disabled = !(this.linkage && (this.linkage.wholeTurn || (this.linkage.travel && this.linkage.A.length > 1)));
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
  screen: name => page.screen(page.at(page.handles[name].at)),
  steps: page.count,
  get step() { return page.place; },
  set step(place) { page.stepping.go(place); },
  get said() { return page.said; },
};
