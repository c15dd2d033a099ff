/** The mechanism of a live page: where its drives are, where that puts its points, and what the construction says. */
class Motion {
  constructor(data, tape) {
    this.data = data;
    this.tape = tape;
    this.fixed = { ...data.points };
    this.said = "";
    this._program = 0;
    this.still = data.linkage.still;
    this.linkage = new Linkage(data.linkage, tape.steps);
    this.opinion = new Opinion(data, this.linkage);
    this.changing = new ChangingLoads(data, this.linkage, this.opinion);
    this.way = data.linkage.drives.map((drive) => drive.pace);
    this.reset();
  }

  /** The given pose, with all pins where the scene has them. */
  reset() {
    const { bases, drives, limits, span } = this.data.linkage;
    const lies = Float64Array.from(bases.flatMap(([x, y]) => [x, y, 1, 0, 0, 0, 0]));
    this.fixed = { ...this.data.points };
    this.linkage.hold(this.fixed);
    const knot = this.linkage.placed(drives.map(() => 0), this.way, new Float64Array(this.linkage.unknowns), lies);
    this.start = { ...knot, travel: 0 };
    this.set(new Path(this.linkage, this.start, this.way, this.start, span[1] - span[0]), { knot: this.start });
    this.limited = limits;
  }

  /** A new path along the drives' own way from a knot. */
  leave(knot) {
    const { drives, state, lies } = knot, { way, start, span } = this.path;
    const from = { ...this.linkage.placed(drives, this.way, state, lies), travel: this.data.linkage.sense * (drives[0] ?? 0) };
    this.set(new Path(this.linkage, from, this.way, start, span), { knot: from });
    this.limited = this.still ? this.limited : null;
  }

  /** Another in the same pose, which goes its own ways. */
  copy() {
    const other = new Motion(this.data, this.tape);
    const { first, start, span } = this.path;
    Object.assign(other, { fixed: { ...this.fixed }, start: this.start, limited: this.limited, _program: this._program });
    other.linkage.hold(other.fixed);
    other.set(new Path(other.linkage, first, this.way, start, span), { knot: this.knot });
    return other;
  }

  /** Draws by other programs with their tapes, in the same pose. */
  draws(programs, tape) {
    this.data = { ...this.data, programs };
    this.tape = { ...this.tape, drawn: tape.drawn, rules: tape.rules };
    this.posed = null;
    this._program = 0;
  }

  /** Takes a knot of a path as the pose; a knot with a part is at a limit. */
  set(path, found) {
    this.path = path;
    this.knot = found.knot;
    this.stop = found.part === undefined ? null : found;
    this.said = this.stop ? this.data.linkage.groups[found.part].stops[found.change ? 1 : 0] : "";
    this.posed = null;
  }

  get travel() {
    return this.knot.travel / this.data.linkage.unit;
  }

  set travel(value) {
    const goal = value * this.data.linkage.unit;
    if (this.still) this.said = this.still;
    else if (Number.isFinite(goal)) this.set(this.path, this.path.to(goal));
  }

  /** How far the first drive goes back and on, from the given pose; null where nothing stops it within a turn. */
  limits() {
    this.limited ??= this.searched();
    return this.limited.map((limit) => limit && limit.travel / this.data.linkage.unit);
  }

  /** The limits of the path, within a span each way. */
  searched() {
    const { first, start, span } = this.path, path = new Path(this.linkage, first, this.way, start, span);
    return this.data.linkage.span.map((end) => {
      const found = path.to(first.travel + end);
      return found.part === undefined ? null : { travel: found.travel, slack: found.slack };
    });
  }

  /** Where all points are, {name: [x, y]}. */
  points() {
    const found = { ...this.fixed };
    const lies = this.knot.lies;
    for (const name of Object.keys(this.data.linkage.owned)) found[name] = this.at(name, lies);
    for (const [name, at] of Object.entries(this.data.under)) found[name] = found[at];
    for (const contact of this.data.touching) if (!contact.else) found[contact.at] = this.touching(contact, found);
    return found;
  }

  /** Where two profiles touch: between their centres, or off one as a straight profile turns. */
  touching({ centre, other, share, off, on }, points) {
    const [x, y] = points[centre], k = other ? 0 : 7 * this.data.linkage.links[on];
    if (other) return [x + share * (points[other][0] - x), y + share * (points[other][1] - y)];
    const [cos, sin] = this.knot.lies.subarray(k + 2, k + 4);
    return [x + cos * off[0] - sin * off[1], y + sin * off[0] + cos * off[1]];
  }

  /** Where a moving point is when the links lie so. */
  at(name, lies) {
    const { owned, origin, reach } = this.data.linkage, [link, x, y] = owned[name];
    const [a, b, cos, sin] = lies.subarray(7 * link, 7 * link + 4);
    return [origin[0] + reach * a + cos * x - sin * y, origin[1] + reach * b + sin * x + cos * y];
  }

  /** How a moving point moves when the links lie and move so. */
  rate(name, lies) {
    const { owned, reach } = this.data.linkage, [link, x, y] = owned[name];
    const [, , cos, sin, u, v, w] = lies.subarray(7 * link, 7 * link + 7);
    return [reach * u - w * (sin * x + cos * y), reach * v + w * (cos * x - sin * y)];
  }

  /** The pole of a link on another at a knot: where it is, where that is on each of them (from its base, as it was given),
      and which way the link turns on the other; null where they turn alike. */
  pole(link, on, { lies }) {
    const { links, reach, origin } = this.data.linkage, [one, other] = [link, on].map((name) => 7 * links[name]);
    const [a, b, , , u, v, w] = lies.subarray(one, one + 7), [c, d, , , s, t, q] = lies.subarray(other, other + 7);
    const turning = w - q, x = a - (v - t - q * (a - c)) / turning, y = b + (u - s + q * (b - d)) / turning;
    if (!Number.isFinite(x) || !Number.isFinite(y)) return null;
    const back = (k) => {
      const [e, f, cos, sin] = lies.subarray(k, k + 4);
      return [cos * (x - e) + sin * (y - f), cos * (y - f) - sin * (x - e)];
    };
    return { at: [origin[0] + reach * x, origin[1] + reach * y], on: [back(one), back(other)], sense: Math.sign(turning) };
  }

  /** Where a place on a link (from its base, as it was given, in reaches) is when the links lie so. */
  placed(link, [x, y], lies) {
    const { links, reach, origin } = this.data.linkage, k = 7 * links[link], [a, b, cos, sin] = lies.subarray(k, k + 4);
    return [origin[0] + reach * (a + cos * x - sin * y), origin[1] + reach * (b + sin * x + cos * y)];
  }

  /** The directions of the guides that ride on links, {slide: [x, y]}. */
  guides() {
    const found = {};
    for (const [name, link] of Object.entries(this.data.linkage.guided)) {
      const [cos, sin] = this.knot.lies.subarray(7 * link + 2, 7 * link + 4), [x, y] = this.data.guides[name];
      found[name] = [cos * x - sin * y, sin * x + cos * y];
    }
    return found;
  }

  /** How links have turned from the given pose, {link: [cosine, sine]}. */
  turns() {
    const { links } = this.data.linkage, { lies } = this.knot;
    return Object.fromEntries(Object.entries(links).map(([name, k]) => [name, [lies[7 * k + 2], lies[7 * k + 3]]]));
  }

  /** The program that is drawn in this pose: the one before as long as it serves, else the first that does. */
  get program() {
    return this.pose.program;
  }

  /** The values of the marks of the program that is drawn, or null. */
  values() {
    return this.pose.values;
  }

  /** What `solve` prints of this pose; null in it, or all of it, is what is not known there. */
  results() {
    return this.pose.results;
  }

  /** The numbers of this pose. */
  get pose() {
    this.posed ??= this.drawn();
    return this.posed;
  }

  drawn() {
    const points = this.points(), guides = this.guides(), programs = this.data.programs;
    const way = (name) => (([x, y]) => [x / Math.hypot(x, y), y / Math.hypot(x, y)])(guides[name] ?? this.data.guides[name]);
    const torn = this.torn(this.data.shared, points)
      || this.data.guiding.find(([P, Q]) => apart(points[P], points[Q]) <= ROUNDED * this.data.linkage.reach)?.[2]
      || this.data.lined.find(([one, other]) => apart(way(one), way(other)) > ROUNDED)?.[2];
    if (torn) return { program: this._program, served: false, values: null, why: torn, results: null };
    const loads = this.changing.at(this.knot, points, guides);
    this.opinion.changed = loads;
    const found = programs.map(() => null), ruled = {};
    const tried = (k) => (found[k] ??= this.tried(k, points, guides, loads, ruled));
    const serves = (k) => tried(k).apart <= this.data.same * (k < this._program ? 1 / 64 : 1);
    let program = programs.findIndex((_, k) => k <= this._program && serves(k));
    if (program < 0) program = programs.findIndex((_, k) => serves(k));
    const served = program >= 0;
    if (served) this._program = program;
    const { rules, why, ...own } = tried(this._program);
    const drawn = { program: this._program, loads, served, why: served ? "" : why };
    if (!served && this.torn(programs[this._program].relied, points)) return { ...drawn, values: null, results: null };
    const { values, results } = served ? { values: own.values, results: rules.results } : this.asFar(this._program, points, guides, loads);
    return { ...drawn, values, results: rules && !this.stop ? this.checked(results, points, guides) : this.known(results) };
  }

  /** What is known of results: of links that a limit position stops nothing is, and what is no number is null. */
  known(results) {
    const stopped = this.stop ? this.stopped() : new Set(), { owned, links } = this.data.linkage;
    const number = (value) => (typeof value === "number" ? (Number.isFinite(value) ? value : null)
      : Array.isArray(value) ? (value.every((one) => typeof one === "string" || Number.isFinite(one)) ? value : value.some(isTable) ? value.map(number) : null)
      : isTable(value) ? table(value, number) : value);
    const none = (value) => (typeof value === "number" ? null : Array.isArray(value) ? (value.some(isTable) ? value.map(none) : null)
      : isTable(value) ? table(value, none) : value);
    const of = { points: (name) => stopped.has(owned[name]?.[0]), links: (name) => stopped.has(links[name]),
      slides: (name) => name.split(" along ").some((link) => stopped.has(links[link])) };
    const found = table(results, (part, kind) => (stopped.size && !of[kind] ? none(part)
      : of[kind] ? table(part, (value, name) => (of[kind](name) ? none(value) : number(value))) : number(part)));
    const { method, steps } = this.data.programs[this._program];
    return { ...found, method, check: {}, arithmetic: "floats", steps };
  }

  /** The links, by number, whose rates are not known at the limit where it stands. */
  stopped() {
    const found = new Set();
    this.linkage.groups.forEach((group, k) => {
      if (k === this.stop.part || group.carriers.some((link) => found.has(link))) for (const link of group.links) found.add(link);
    });
    return found;
  }

  /** The marks and results of a program in a pose in which not all can be drawn, as far as it goes; what is wanted, where
      the rules have it. */
  asFar(k, points, guides, loads) {
    const { rules, wanted } = this.data.programs[k], x = this.inputs(k, points, guides, loads);
    const values = this.tape.drawn[k](x, true), found = this.tape.rules[rules](x, true);
    for (const [i, mark] of wanted.entries()) if (found.points[i].every(Number.isFinite)) values[mark] = found.points[i];
    return { values, results: found.results };
  }

  inputs(k, points, guides, loads) {
    const { points: names, guides: ways, loads: changing } = this.data.programs[k];
    return [...names.flatMap((name) => points[name]), ...ways.flatMap((name) => guides[name] ?? this.data.guides[name]),
      ...changing.flatMap((name) => loads[name])];
  }

  /** Why nothing holds of what relies on some points to coincide, where two of them lie apart; else nothing. */
  torn(pairs, points) {
    return pairs.find(([one, other]) => apart(points[one], points[other]) > ROUNDED * this.data.linkage.reach)?.[2] ?? "";
  }

  /** Results with how they were found, and by how much the linkage's own opinion differs. */
  checked(results, points, guides) {
    const { method, steps } = this.data.programs[this._program];
    const check = this.still ? {} : this.opinion.beside(results, this.knot, points, guides);
    return { ...results, method, check, arithmetic: "floats", steps };
  }

  /** One program in this pose: the values of its marks, what the rules say, and by how much they differ; `ruled` keeps
      what rules said for others. */
  tried(k, points, guides, loads, ruled) {
    const { wanted, asked, relied, rules: place } = this.data.programs[k];
    const torn = this.torn(relied, points);
    if (torn) return { values: null, rules: null, why: torn, apart: Infinity };
    const x = this.inputs(k, points, guides, loads);
    const rules = (ruled[place] ??= this.tape.rules[place](x)), values = this.tape.drawn[k](x);
    if (typeof rules === "number") return { values: null, rules: null, why: asked.rules[rules], apart: Infinity };
    if (typeof values === "number") return { values: null, rules, why: asked.drawn[values], apart: Infinity };
    let most = 0, size = 0;
    for (const [i, mark] of wanted.entries()) {
      const gap = apart(values[mark], rules.points[i]);
      most = gap <= most ? most : gap;
      size = Math.max(size, Math.hypot(...rules.points[i]));
    }
    return { values, rules, why: "", apart: most === 0 ? 0 : most / size };
  }

  // ---- drags ----------------------------------------------------------------------------------------------------

  /** Takes a point as near to a place as it comes: a moving one by the drives, from where it is if that is `near` to the
      nearest place of all; a pin of the frame with the frame. */
  drag(name, x, y, near = NEAR * this.data.linkage.reach) {
    const { under, linkage } = this.data;
    const at = under[name] ?? name;
    if (!(at in linkage.owned)) this.shift(at, [x, y]);
    else if (this.still) this.said = this.still;
    else this.pull(at, [x, y], near);
  }

  /** Turns the drives until a moving point is as near to a place as it comes. */
  pull(name, goal, near) {
    const away = ({ knot }) => Math.hypot(...less(goal, this.at(name, knot.lies)));
    let found = this.approach({ ...this.stop, knot: this.knot, path: this.path }, name, goal);
    if (this.way.length === 1 && away(found) > near) {
      const poses = this.swept(), best = poses.reduce((least, pose) => (away(pose) < away(least) ? pose : least), poses[0]);
      const { travel } = found.knot, round = poses.period * Math.round((travel - best.knot.travel) / (poses.period || 1));
      const there = this.approach({ ...this.path.to(best.knot.travel + round), path: this.path }, name, goal);
      if (away(there) < away(found) - near) found = there;
    }
    this.go(found);
  }

  /** Goes where the drives have led; on another path than before the drives' own way begins anew there. */
  go(found) {
    if (found.path === this.path) this.set(found.path, found);
    else {
      this.leave(found.knot);
      if (found.part !== undefined) this.set(this.path, { ...found, knot: this.knot });
    }
  }

  /** How far each drive has gone from the given pose, in its own sense: degrees, or lengths. */
  gone() {
    return this.knot.drives.map((from, k) => from / this.unit(k));
  }

  /** A degree, or a length, of a drive in its own sense. */
  unit(k) {
    const { drives, sense } = this.data.linkage, { slides, rate } = drives[k];
    return (k ? Math.sign(rate) || 1 : sense) * (slides ? 1 : Math.PI / 180);
  }

  /** Moves one drive alone so far from the given pose, or to its limit. */
  turn(k, value) {
    const { drives, reach } = this.data.linkage, far = (value - this.gone()[k]) * this.unit(k);
    if (this.still) this.said = this.still;
    else if (far) this.go(this.along({ knot: this.knot, path: this.path }, drives.map(({ slides }, i) => (i !== k ? 0 : slides ? far / reach : far))));
  }

  /** Poses over the whole travel, with the travel after which all is back, or 0; they stand as long as the pins do. */
  swept() {
    const { first, start, span } = this.path, { turns, drives, span: far } = this.data.linkage, turn = 2 * Math.PI;
    const about = turns ? 0 : turn * (Math.round(this.knot.travel / turn) - MOST_TURNS / 2);  // where nothing comes back
    const pins = JSON.stringify([this.fixed, about]);
    if (this.sweep?.pins === pins) return this.sweep;
    const path = new Path(this.linkage, first, this.way, start, span), ends = (this.limited ??= this.searched());
    const round = ends.every((end) => end === null) && !drives[0].slides;
    const whole = turns || MOST_TURNS;
    const from = round ? about : ends[0]?.travel ?? far[0], to = round ? about + turn * whole : ends[1]?.travel ?? far[1];
    const count = POSES * (round ? Math.min(whole, MOST_TURNS) : 1);
    const poses = Array.from({ length: count + 1 }, (_, k) => path.to(from + ((to - from) * k) / count));
    return (this.sweep = Object.assign(poses, { pins, period: round && turns ? to - from : 0 }));
  }

  /** Downhill from a pose with its path: Newton's steps, damped where they lead uphill (Levenberg). */
  approach(from, name, goal) {
    const way = (knot) => less(goal, this.at(name, knot.lies));
    let found = from, left = way(from.knot), damping = 1e-9;
    const tried = (change) => {
      const next = this.along(found, change), gap = way(next.knot);
      if (!(Math.hypot(...gap) < Math.hypot(...left))) return false;
      [found, left] = [next, gap];
      return true;
    };
    for (let round = 0; round < ROUNDS && damping < STIFF; round++) {
      const change = downhill(this.columns(name, found.knot), this.bends(name, found.knot), left, damping, found.path.rules);
      if (Math.max(...change.map(Math.abs)) < found.path.rules.finest) {
        if (!this.nudges().some(tried)) break;  // at a dead point either way may lead there
      } else damping = tried(change) ? Math.max(1e-9, damping / 4) : 8 * Math.max(1e-3, damping);
    }
    return found;
  }

  /** How a point moves by each drive: for a radian, or a reach of a sliding one. */
  columns(name, knot) {
    return this.way.map((_, k) => this.rate(name, this.linkage.moving(knot, this.alone(k))));
  }

  /** One drive's turn by a radian, or a reach of a sliding one. */
  alone(k) {
    const { drives, reach } = this.data.linkage;
    return drives.map((drive, i) => (i !== k ? 0 : drive.slides ? reach : 1));
  }

  /** How these columns change by each drive, by small differences. */
  bends(name, knot) {
    return this.way.map((_, k) => {
      const one = this.alone(k), rate = this.linkage.stated(knot, one);
      const [back, on] = [-NEARBY, NEARBY].map((turn) => {
        const drives = knot.drives.map((from, i) => from + turn * one[i]);
        const state = knot.state.map((from, i) => from + turn * rate[i]);
        return this.columns(name, this.linkage.placed(drives, one, state, knot.lies));
      });
      return on.map(([x, y], i) => [(x - back[i][0]) / (2 * NEARBY), (y - back[i][1]) / (2 * NEARBY)]);
    });
  }

  /** Small turns of each drive, either way. */
  nudges() {
    const size = this.linkage.rules.first * this.linkage.rules.longest;
    return this.way.flatMap((_, k) => [size, -size].map((turn) => this.way.map((_, i) => (i === k ? turn : 0))));
  }

  /** From a knot with its path, where the drives lead that turn so far (a sliding one in reaches), or to the limit. */
  along({ knot, path }, change) {
    const { drives, reach } = this.data.linkage, way = change.map((turn, k) => turn * (drives[k].slides ? reach : 1));
    if (way.length === 1) return { ...path.to(knot.travel + this.data.linkage.sense * way[0]), path };
    const from = { ...this.linkage.placed(knot.drives, way, knot.state, knot.lies), travel: 0 };
    const other = new Path(this.linkage, from, way, path.start, path.span);
    return { ...other.to(1), path: other };
  }

  /** Moves a pin of the frame towards a place as far as the linkage follows, the drives standing still. */
  shift(name, goal) {
    const data = this.data.linkage, shared = Object.fromEntries(this.data.shared), serves = (pin) => shared[pin] ?? pin;
    if (data.locked || data.held[name]) {
      this.said = data.locked || data.held[name];
      return;
    }
    const pins = Object.keys(this.fixed).filter((pin) => serves(pin) === serves(name)), from = this.fixed[name];
    const far = Math.hypot(goal[0] - from[0], goal[1] - from[1]) / data.reach;
    let knot = this.knot, done = 0, step = 1, part;
    while (done < 1 && step > this.linkage.rules.finest) {
      step = Math.min(step, 1 - done);
      const at = from.map((start, i) => start + (goal[i] - start) * (done + step));
      const next = this.held({ ...this.fixed, ...Object.fromEntries(pins.map((pin) => [pin, at])) }, knot, far * step);
      if (next.state) {
        [knot, done, step] = [next, done + step, 2 * step];
        for (const pin of pins) this.fixed[pin] = at;
      } else [part, step] = [next, step / 2];
    }
    this.linkage.hold(this.fixed);
    this.leave(knot);
    if (done < 1) this.set(this.path, { knot: this.knot, part, change: false });
  }

  /** The knot when the frame's points have gone a little, or the group that cannot be followed there. */
  held(points, knot, far) {
    const { linkage } = this, { start, rules } = this.path;
    linkage.hold(points);
    const predicted = linkage.tangent(knot, knot.drives), size = Math.max(linkage.change(predicted, knot.state), far);
    const next = linkage.closed(knot.drives, this.way, predicted, size < rules.longest ? size : 0);
    if (!next.state) return next;
    const part = linkage.strayed(next, start);
    return part < 0 ? next : part;
  }

  // ---- as a scene -----------------------------------------------------------------------------------------------

  /** What of the scene is otherwise in this pose: all points, and the directions of guides that are given as vectors. */
  scene() {
    return { points: this.points(), guides: this.guides() };
  }

  /** This pose as a scene of its own, a TOML text. */
  toml() {
    const { points, guides } = this.scene(), scene = structuredClone(this.data.scene);
    delete scene.vary;
    scene.points = Object.fromEntries(this.data.placed.map((name) => [name, points[name]]));
    for (const slide of [scene.slides ?? []].flat()) slide.direction = guides[`${slide.link} along ${slide.along}`] ?? slide.direction;
    this.data.touching.forEach((contact, k) => {
      if (contact.else) [[scene.contacts].flat()[k].at, scene.points[contact.else]] = [contact.else, this.touching(contact, points)];
    });
    this.data.linkage.ways.forEach(([name, table, place, side]) => {
      const pair = [scene[table]].flat()[place], way = guides[name];
      if (way && side === null) pair.direction = way;
      else if (way) pair.centres[side] = way;
    });
    for (const load of [scene.forces ?? [], scene.moments ?? []].flat()) {
      if (load.over === "travel") load.values = load.values.map(([place, value]) => [place - this.travel, value]);
    }
    this.data.lines.forEach((line, k) => {
      if (line) [scene.balance].flat()[k].direction = line;
    });
    return written(scene);
  }
}

const ROUNDED = 1e-9;  // of the reach: points that lie no further apart lie in one place
const NEAR = 2 ** -8;  // of the reach: a place no further off is near
const POSES = 240, MOST_TURNS = 8;  // of a turn, or of the travel between limits; and turns that are looked through
const NEARBY = 2 ** -14;  // radians
const ROUNDS = 100, STIFF = 1e12;  // of a pull: how many steps at most, and how stiff it becomes before it gives up

const isTable = (value) => value !== null && typeof value === "object" && !Array.isArray(value);

/** A table whose entries are others, made of them and their names. */
function table(entries, change) {
  return Object.fromEntries(Object.entries(entries).map(([name, value]) => [name, change(value, name)]));
}

/** How far two places lie apart. */
function apart([x, y], [u, v]) {
  return Math.hypot(x - u, y - v);
}

/** The turns of the drives that take a point nearer by so much, none longer than the longest: a damped step of Newton's,
    from how it moves by each drive, and how that bends. */
function downhill(columns, bends, [x, y], damping, { longest }) {
  const n = columns.length, far = Math.hypot(x, y);
  const sizes = columns.map(([u, v], i) => u * u + v * v + Math.max(...bends[i].map((bend) => Math.hypot(...bend))) * far);
  const size = Math.max(...sizes) || 1, rows = columns.map(([u, v], i) => [
    ...columns.map(([a, b], k) => u * a + v * b - bends[i][k][0] * x - bends[i][k][1] * y + (i === k ? damping * size : 0)),
    u * x + v * y]);
  for (let i = 0; i < n; i++) {
    for (let k = i + 1; k < n; k++) {
      const part = rows[k][i] / rows[i][i];
      for (let j = i; j <= n; j++) rows[k][j] -= part * rows[i][j];
    }
  }
  const found = new Array(n).fill(0);
  for (let i = n - 1; i >= 0; i--) {
    found[i] = (rows[i][n] - rows[i].reduce((sum, a, j) => (j > i && j < n ? sum + a * found[j] : sum), 0)) / rows[i][i];
  }
  const most = Math.max(...found.map(Math.abs));
  return most > longest ? found.map((turn) => (turn * longest) / most) : found.map((turn) => (turn === turn ? turn : 0));
}
