// ---- paths of points over the motion, of the ends of vectors, which from one pole are hodographs, and of poles: centrodes

const COLOURS = ["#c2410c", "#0b63b0", "#15803d", "#7e22ce", "#a16207", "#be185d", "#0f766e", "#4d4d4d"];
const POSES = 180, MOST_POSES = 1080, MOST_TURNS = 12;  // of a turn, in all, and how many turns are looked through
const AT_ONCE_MS = 8, PAUSE_MS = 4;  // how long poses are looked for between two frames

// words with what follows a low line set below
function lettered(words) {
  const found = document.createElement("span");
  for (const part of words.split(/(_\S+)/)) {
    const low = document.createElement("sub");
    low.textContent = part.slice(1);
    found.append(part[0] === "_" ? low : part);
  }
  return found;
}

// poses over the whole travel, found a little at a time; they hold as long as the pins stand, and of several
// drives as long as these keep pace
class Poses {
  constructor(page) { Object.assign(this, {page, found: [], pins: ""}); }

  // those that are known; where these have moved they are found anew, as soon as no hand moves them
  walked() {
    const {page} = this, {motion, moving} = page, pins = JSON.stringify([motion.fixed, motion.path.first.drives, page.variants.indexOf(page.variant)]);
    if (pins === this.pins) return this.found;
    clearTimeout(this.walking);
    Object.assign(this, {pins: page.grips.held ? "" : pins, found: []});
    if (page.grips.held) return this.found;
    // once around, with gears until all is back, or from limit to limit
    const [from, end] = moving.ends, turns = moving.round ? Math.min(motion.data.linkage.turns || MOST_TURNS, MOST_TURNS) : 1, other = motion.copy();
    Object.assign(this, {other, range: [from, from + turns * (end - from)], count: Math.min(MOST_POSES, turns * POSES)});
    this.walk(pins);
    return this.found;
  }

  walk(pins) {
    if (pins !== this.pins) return;
    const {other, count, range: [from, to], found, page} = this, began = performance.now();
    while (found.length <= count && (!found.length || performance.now() - began < AT_ONCE_MS)) {
      other.travel = from + (to - from) * found.length / count;
      found.push({travel: other.travel, points: other.points(), results: other.results(), program: other.program, values: other.values(), knot: other.knot});
    }
    if (found.length <= count) this.walking = setTimeout(() => this.walk(pins), PAUSE_MS);
    if (found.length === 1) return;
    page.tracing.draw();
    page.asked.graph();
  }
}

class Tracing {
  constructor(page) {
    const {curves, centrodes} = page.data, keys = [...curves.map(name => `path ${name}`), ...centrodes.map(pair => `pole ${pair}`)];
    Object.assign(this, {page, chosen: new Set(keys)});
  }

  // what may be traced: the points that move, the vectors that are drawn, and the poles that are no pins
  take() {
    const {page} = this, {linkage} = page.motion.data, box = by("paths");
    box.replaceChildren();
    by("curves").hidden = Boolean(page.motion.still);
    if (page.motion.still) return;
    const shared = new Set(page.motion.data.shared.map(([one]) => one));
    const paths = Object.keys(linkage.owned).filter(name => !shared.has(name));
    this.all = [...paths.map(name => ({key: `path ${name}`, words: page.say("path", name), point: name, panel: 0})),
      ...page.drawn.vectors.filter(({name}) => name).map(({name, end, start, panel}) => ({key: name, end, start, panel,
        words: page.say(page.drawn.turned ? "ends" : "hodograph", name)})),
      ...page.motion.data.rolling.map(([link, on]) => ({key: `pole ${link} ${on}`, pair: [link, on], panel: 0,
        words: page.say("centrodes", on === "frame" ? link : `${link} / ${on}`)}))];
    this.all.forEach((one, i) => {
      const label = document.createElement("label"), input = document.createElement("input"), line = document.createElement("i");
      one.colour = COLOURS[i % COLOURS.length];
      Object.assign(input, {type: "checkbox", checked: this.chosen.has(one.key)});
      input.addEventListener("change", () => {
        if (input.checked) this.chosen.add(one.key); else this.chosen.delete(one.key);
        this.draw();
      });
      line.style.borderColor = one.colour;
      label.append(input, line, lettered(one.words));
      box.append(label);
    });
    this.drawn = null;
  }

  spell() {
    this.layer = this.page.svg.insertBefore(made("g", {id: "traces"}), this.page.picture.start);
    Object.assign(this, {drawn: null, dots: []});
    this.layer.addEventListener("pointerdown", event => {
      event.stopPropagation();
      event.target.setPointerCapture(event.pointerId);
      this.page.moving.rest();
      this.lead(event);
    });
    this.layer.addEventListener("pointermove", event => event.buttons && this.lead(event));
    this.layer.addEventListener("pointerup", () => this.page.moving.settle());
  }

  draw() {
    if (!this.all || !this.chosen.size && !this.layer.hasChildNodes()) return;
    const found = this.found = this.page.poses.walked(), {program} = this.page;
    const windows = this.page.picture.windows, shown = this.all.filter(one => this.chosen.has(one.key));
    const rolling = shown.some(one => one.pair) && [...this.page.motion.knot.lies];
    const key = JSON.stringify([[...this.chosen], windows.map(one => [one.origin, one.scale]), rolling, program, found.length, this.page.poses.pins]);
    if (this.drawn !== key) {
      this.dots = shown.map(one => [one, made("circle", {fill: one.colour, "clip-path": `url(#${this.page.picture.sheet.clip}-${one.panel})`})]);
      this.layer.replaceChildren(...shown.flatMap(one => this.paths(one).map(path => this.path(one, path, windows[one.panel]))), ...this.dots.map(([, dot]) => dot));
    }
    this.drawn = key;
    this.cursor();
  }

  // where each trace is in this pose
  cursor() {
    const {motion, values, grips, picture: {windows, sheet}} = this.page, points = motion.points();
    for (const [{point, end, pair, panel}, dot] of this.dots) {
      const place = pair ? motion.pole(...pair, motion.knot)?.at : point ? points[point] : values?.[end], [x, y] = windows[panel].at(place ?? [NaN, NaN]);
      dot.style.display = Number.isFinite(x + y) ? "" : "none";
      if (Number.isFinite(x + y)) for (const [key, value] of Object.entries({cx: x, cy: sheet.height - y, r: 4 / grips.scale})) dot.setAttribute(key, value);
    }
  }

  // a hand on a trace leads the mechanism to the pose whose place is nearest
  lead(event) {
    const {viewing, moving, picture: {sheet}} = this.page, [x, y] = viewing.spot(event), {places} = event.target, near = {far: Infinity};
    (places ?? []).forEach((place, i) => {
      const far = place ? Math.hypot(place[0] - x, sheet.height - place[1] - y) : Infinity;
      if (far < near.far) Object.assign(near, {far, travel: this.found[i].travel});
    });
    if (near.far < Infinity) moving.go(near.travel, true);
  }

  // what of a plan's traces should be on it: the ends of vectors over the travel
  held(panel) {
    const ends = (this.all ?? []).filter(one => one.panel === panel && one.end !== undefined && this.chosen.has(one.key)).map(({end}) => end);
    return ends.length ? this.page.poses.walked().filter(({program}) => program === this.page.program).flatMap(({values}) => ends.map(end => values?.[end] ?? [NaN, NaN])) : [];
  }

  // the places of what is traced, one path or two, and what each is called; none where there is none
  paths({point, end, pair}) {
    if (!pair) return [{name: point ?? end, places: this.found.map(({points, values, program}) => (point ? points[point] : program === this.page.program ? values?.[end] : null))}];
    const {motion} = this.page, {lies} = motion.knot, poles = this.found.map(({knot}) => motion.pole(...pair, knot));
    const whole = poles.map((pole, i) => pole && (!poles[i - 1] || pole.sense === poles[i - 1].sense
      || Math.hypot(...pole.at.map((x, k) => x - poles[i - 1].at[k])) < motion.data.linkage.reach));  // not through infinity
    return [["fixed", pair[1]], ["moving", pair[0]]].map(([kind, link], k) => ({
      name: `${kind} centrode ${pair.join(" ")}`, kind,
      places: poles.map((pole, i) => whole[i] && motion.placed(link, pole.on[1 - k], lies))}));
  }

  path({panel, colour}, {name, places, kind = ""}, view) {
    const {sheet} = this.page.picture;
    const spots = places.map(place => (place && place.every(Number.isFinite) ? view.at(place) : null));
    let told = "", pen = "M";
    for (const spot of spots) {
      if (!spot) { pen = "M"; continue; }
      const [x, y] = spot;
      told += `${pen}${x.toFixed(2)} ${(sheet.height - y).toFixed(2)}`;
      pen = "L";
    }
    return Object.assign(made("path", {d: told || "M0 0", stroke: colour, "clip-path": `url(#${sheet.clip}-${panel})`,
      class: kind, "data-trace": name}), {places: spots});
  }
}
