"use strict";

/** Groups of links, closed one after another by Newton's steps: one pose of the linkage. Lengths count in reaches. */
class Linkage {
  constructor(data, steps) {
    this.data = data;
    this.rules = data.rules;
    this.unknowns = 0;
    this.groups = data.groups.map((group) => {
      const inputs = 7 * group.carriers.length + group.arms.length + 3 * group.drives.length + 2 * group.unknowns;
      const made = { ...group, run: steps[group.step], first: this.unknowns, arms: Float64Array.from(group.arms),
                     x: new Float64Array(inputs), y: new Float64Array(2 * group.unknowns + 1 + 7 * group.links.length) };
      this.unknowns += group.unknowns;
      return made;
    });
    this.turns = this.groups.flatMap((group) => Array.from({ length: group.unknowns }, (_, i) => i < group.angles));
  }

  /** Lays the frame's arms to its points, {name: [x, y]}. */
  hold(points) {
    const { origin, reach } = this.data;
    for (const [g, k, way, P, Q, x, y] of this.data.anchors) {
      const at = points[P], ray = Q ? [points[Q][0] - at[0], points[Q][1] - at[1]] : [1, 0];
      const size = Math.hypot(...ray), u = ray[0] / size, v = ray[1] / size;
      const end = [u * x - v * y, u * y + v * x], arms = this.groups[g].arms;
      for (const i of [0, 1]) arms[2 * k + i] = way ? end[i] : (at[i] + end[i] - origin[i]) / reach;
    }
  }

  /** One step of Newton's for a group from a state; fills its y. */
  step(group, lies, drives, rates, state) {
    const x = group.x;
    let n = 0;
    for (const link of group.carriers) for (let i = 0; i < 7; i++) x[n++] = lies[7 * link + i];
    for (const number of group.arms) x[n++] = number;
    for (const [drive, turns, rate] of group.drives) {
      const at = rate * drives[drive];
      x[n++] = turns ? Math.cos(at) : at;
      if (turns) x[n++] = Math.sin(at);
      x[n++] = rate * rates[drive];
    }
    for (let i = 0; i < group.unknowns; i++) {
      x[n++] = i < group.angles ? Math.cos(state[i]) : state[i];
      if (i < group.angles) x[n++] = Math.sin(state[i]);
    }
    group.run(x, group.y);
    return group.y;
  }

  /** Closes a group from a predicted state, and says whether that is to be trusted: the first correction is small
      beside the step that was predicted, each further one beside the one before. */
  settle(group, lies, drives, rates, state, size) {
    const rules = this.rules, n = group.unknowns;
    let allowed = rules.near * size, settled = n === 0;
    for (;;) {
      const y = this.step(group, lies, drives, rates, state);
      let far = 0;
      for (let i = 0; i < n; i++) {
        const change = Math.abs(y[i]) / (i < group.angles ? 1 : Math.max(1, Math.abs(state[i])));
        far = change <= far ? far : change;  // not a number stays
      }
      if (!(far <= allowed) || Math.abs(y[2 * n]) < rules.nothing) return false;
      for (let i = 0; i < n; i++) state[i] -= y[i];
      if (settled || far <= rules.closed * size) return true;
      settled = far <= rules.settled * size;
      allowed = settled ? rules.near * size : rules.shrinking * far;
    }
  }

  /** The knot where the drives are so, their rates being so; or the number of the group that is not to be trusted. */
  closed(drives, rates, predicted, size) {
    const state = Float64Array.from(predicted), rate = new Float64Array(this.unknowns);
    const lies = new Float64Array(7 * this.data.links), determinants = new Float64Array(this.groups.length);
    lies[2] = 1;
    for (const [g, group] of this.groups.entries()) {
      const n = group.unknowns, end = group.first + n;
      if (!this.settle(group, lies, drives, rates, state.subarray(group.first, end), size)) return g;
      rate.set(group.y.subarray(n, 2 * n), group.first);
      determinants[g] = group.y[2 * n];
      group.links.forEach((link, k) => lies.set(group.y.subarray(2 * n + 1 + 7 * k, 2 * n + 8 + 7 * k), 7 * link));
    }
    return { drives, state, rate, determinants, lies };
  }

  /** The knot at a state that closes it; where that is singular, the links as they lie in `lies`. */
  placed(drives, rates, state, lies) {
    const knot = this.closed(drives, rates, state, Infinity);
    if (knot.state) return knot;
    const determinants = Float64Array.from(this.groups, (_, g) => (g === knot ? 0 : 1));
    return { drives, state: Float64Array.from(state), rate: new Float64Array(this.unknowns), lies, determinants };
  }

  /** The state after one step of Newton's, not guarded: the tangent, wherever the drives or the frame have gone. */
  tangent(knot, drives) {
    const state = Float64Array.from(knot.state), still = drives.map(() => 0), lies = Float64Array.from(knot.lies);
    for (const group of this.groups) {
      const n = group.unknowns;
      const y = this.step(group, lies, drives, still, state.subarray(group.first, group.first + n));
      for (let i = 0; i < n; i++) state[group.first + i] -= y[i];
      group.links.forEach((link, k) => lies.set(y.subarray(2 * n + 1 + 7 * k, 2 * n + 8 + 7 * k), 7 * link));
    }
    return state;
  }

  /** How all links lie and move at a knot where the drives have these rates. */
  moving(knot, rates) {
    const lies = Float64Array.from(knot.lies);
    for (const group of this.groups) {
      const n = group.unknowns;
      const y = this.step(group, lies, knot.drives, rates, knot.state.subarray(group.first, group.first + n));
      group.links.forEach((link, k) => lies.set(y.subarray(2 * n + 1 + 7 * k, 2 * n + 8 + 7 * k), 7 * link));
    }
    return lies;
  }

  /** The largest change of an unknown, beside the state where that is a displacement of more than a reach. */
  change(one, two) {
    let most = 0;
    for (let i = 0; i < this.unknowns; i++) {
      const change = Math.abs(one[i] - two[i]) / (this.turns[i] ? 1 : Math.max(1, Math.abs(two[i])));
      most = change <= most ? most : change;
    }
    return most;
  }
}

/** The knots of a linkage along one way of its drives, from the first of them; `way` are the drives' travels for a unit
    of travel, `start` the knot whose branch it is. Knots know their `travel`. */
class Path {
  constructor(linkage, knot, way, start, span) {
    const { rules, data } = linkage;
    Object.assign(this, { linkage, way, start, rules, origin: knot.drives, knots: [knot], stops: [null, null] });
    this.zero = knot.travel;
    const paces = way.map((pace, k) => [Math.abs(pace), data.drives[k].slides]).filter(([pace]) => pace);
    this.pace = Math.max(0, ...paces.map(([pace, slides]) => (slides ? pace / data.reach : pace)));
    this.longest = rules.longest * Math.min(...paces.map(([pace, slides]) => (slides ? span / (2 * Math.PI) : 1) / pace));
    this.finest = rules.finest * this.longest;
  }

  drives(travel) {
    return this.origin.map((from, k) => from + this.way[k] * (travel - this.zero));
  }

  /** The knot at a travel; else why not: the limit before it, with the knot there. */
  to(travel) {
    const knots = this.knots, found = knots.findIndex((knot) => knot.travel >= travel);
    if (found >= 0 && knots[found].travel === travel) return { knot: knots[found] };
    if (found > 0) {
      const first = Math.max(0, Math.min(found - this.rules.beside / 2, knots.length - this.rules.beside));
      const around = knots.slice(first, first + this.rules.beside);
      const size = this.size(knots[found].travel - knots[found - 1].travel, knots[found].state, knots[found - 1].state);
      const knot = this.closed(travel, ahead(around, travel), size);
      if (knot) return { knot };
    }
    const up = found < 0 || (found > 0 && 2 * travel > knots[found].travel + knots[found - 1].travel);
    const near = found < 0 ? knots.length - 1 : up ? found : Math.max(0, found - 1);
    return this.walk(near, travel);
  }

  /** Walks from one of the knots. */
  walk(near, goal) {
    const { rules, knots } = this, start = knots[near], sense = Math.sign(goal - start.travel);
    const stop = this.stops[sense > 0 ? 1 : 0];
    if (stop && sense * (goal - stop.knot.travel) > 0) return stop;
    const recent = [start];
    let step = sense * rules.first * this.longest, last = start;
    while (last.travel !== goal) {
      const left = goal - last.travel;
      if (Math.abs(left) <= Math.abs(step) + this.finest) step = left;
      const travel = step === left ? goal : last.travel + step;
      const predicted = ahead(recent.slice(-rules.back), travel);
      const size = this.size(travel - last.travel, predicted, last.state);
      const knot = this.closed(travel, predicted, size);
      if (!knot) {
        step /= 2;
        if (Math.abs(step) >= this.finest) continue;
        const found = this.stopped(recent, sense * rules.across * this.longest);
        this.stops[sense > 0 ? 1 : 0] = found;
        return found;
      }
      const missed = this.linkage.change(knot.state, predicted) / size;
      if (missed <= rules.easy && 2 * Math.abs(step) <= this.longest) step *= 2;
      else if (missed > rules.hard) step /= 2;
      recent.push(knot);
      last = knot;
      this.keep(knot);
    }
    return { knot: last };
  }

  /** Where it stops: at a limit position, or at the change point through which the motion leads straight. */
  stopped(recent, step) {
    const last = recent[recent.length - 1], parts = this.linkage.groups.map((_, k) => k);
    const left = (k) => Math.abs(last.determinants[k] / (recent.length > 1 ? this.start.determinants[k] : 1));
    const before = recent.findLast((knot) => Math.abs(last.travel - knot.travel) >= Math.abs(step)) ?? recent[0];
    const travel = last.travel + step, predicted = ahead([before], travel);
    const size = this.size(travel - before.travel, predicted, before.state);
    const beyond = this.linkage.closed(this.drives(travel), this.way, predicted, size);
    const crossed = beyond.state ? parts.filter((k) => beyond.determinants[k] / before.determinants[k] <= 0) : [];
    if (!crossed.length) {
      const part = parts.reduce((least, k) => (left(k) < left(least) ? k : least), 0);
      return { knot: last, travel: last.travel, part, change: false, slack: this.rules.slack * this.finest };
    }
    const ratio = (k) => beyond.determinants[k] / before.determinants[k];
    const part = crossed.reduce((most, k) => (ratio(k) > ratio(most) ? k : most));
    const there = before.travel + (travel - before.travel) / (1 - ratio(part));
    return { knot: last, travel: there, part, change: true, slack: this.rules.across * Math.abs(step) };
  }

  /** The knot at a travel, on the branch; none where that is not certain. */
  closed(travel, predicted, size) {
    const knot = this.linkage.closed(this.drives(travel), this.way, predicted, size);
    if (!knot.state) return null;
    for (const [g, determinant] of knot.determinants.entries()) {
      if (!(determinant / this.start.determinants[g] >= this.rules.singular)) return null;
    }
    knot.travel = travel;
    return knot;
  }

  size(travel, one, two) {
    return Math.min(1, Math.max(this.linkage.change(one, two), this.pace * Math.abs(travel)));
  }

  keep(knot) {
    const place = this.knots.findIndex((other) => other.travel > knot.travel);
    if (place < 0) this.knots.push(knot);
    else this.knots.splice(place, 0, knot);
  }
}

/** The state at a travel on the curve through these knots with their rates (Hermite, in Lagrange's form). */
function ahead(knots, travel) {
  const state = new Float64Array(knots[0].state.length);
  for (const knot of knots) {
    const away = travel - knot.travel;
    let weight = 1, slope = 0;
    for (const other of knots) {
      if (other === knot) continue;
      weight *= (travel - other.travel) / (knot.travel - other.travel);
      slope += 2 / (knot.travel - other.travel);
    }
    weight *= weight;
    for (let i = 0; i < state.length; i++) {
      state[i] += weight * ((1 - slope * away) * knot.state[i] + away * knot.rate[i]);
    }
  }
  return state;
}

/** The mechanism of a live page: where its drives are, where that puts its points, and what the construction says. */
class Motion {
  constructor(data, tape) {
    this.data = data;
    this.tape = tape;
    this.fixed = structuredClone(data.points);
    this.said = "";
    this._program = 0;
    if (data.linkage.still) {
      this.still = data.linkage.still;
      return;
    }
    this.linkage = new Linkage(data.linkage, tape.steps);
    this.linkage.hold(this.fixed);
    this.limited = data.linkage.limits;
    const drives = data.linkage.drives.map(() => 0), way = data.linkage.drives.map((drive) => drive.pace);
    const lies = Float64Array.from(data.linkage.bases.flatMap(([x, y]) => [x, y, 1, 0, 0, 0, 0]));
    this.start = { ...this.linkage.placed(drives, way, new Float64Array(this.linkage.unknowns), lies), travel: 0 };
    this.way = way;
    this.set(new Path(this.linkage, this.start, way, this.start, this.span), { knot: this.start });
  }

  get span() {
    const [from, to] = this.data.linkage.span;
    return to - from;
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
    return this.still ? 0 : this.knot.travel / this.data.linkage.unit;
  }

  set travel(value) {
    if (this.still) {
      this.said = this.still;
      return;
    }
    const goal = value * this.data.linkage.unit;
    if (Number.isFinite(goal)) this.set(this.path, this.path.to(goal));
  }

  /** How far the first drive goes back and on, from the given pose; null where nothing stops it within a turn. */
  limits() {
    if (this.still) return [0, 0];
    this.limited ??= this.searched();
    return this.limited.map((limit) => limit && limit.travel / this.data.linkage.unit);
  }

  /** The limits of the path, within a span each way. */
  searched() {
    const path = new Path(this.linkage, this.path.knots[0], this.way, this.start, this.span);
    return this.data.linkage.span.map((end) => {
      const found = path.to(path.zero + end);
      return found.part === undefined ? null : { travel: found.travel, slack: found.slack };
    });
  }

  /** Where all points are, {name: [x, y]}. */
  points() {
    const found = { ...this.fixed };
    if (this.still) return found;
    const lies = this.knot.lies;
    for (const name of Object.keys(this.data.linkage.owned)) found[name] = this.at(name, lies);
    for (const [name, at] of Object.entries(this.data.under)) found[name] = found[at];
    return found;
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

  /** The directions of the guides that ride on links, {slide: [x, y]}. */
  guides() {
    const found = {};
    for (const [name, link] of Object.entries(this.data.linkage.guided ?? {})) {
      const [cos, sin] = this.knot.lies.subarray(7 * link + 2, 7 * link + 4), [x, y] = this.data.guides[name];
      found[name] = [cos * x - sin * y, sin * x + cos * y];
    }
    return found;
  }

  /** The program that is drawn in this pose: the one before as long as it serves, else the first that does. */
  get program() {
    return this.pose.program;
  }

  /** The values of the marks of the program that is drawn, or null. */
  values() {
    return this.pose.values;
  }

  /** What `solve` prints of this pose, or null where it is singular. */
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
    const found = programs.map(() => null);
    const tried = (k) => (found[k] ??= this.tried(k, points, guides));
    const serves = (k) => tried(k).apart <= this.data.same * (k < this._program ? 1 / 64 : 1);
    let program = programs.findIndex((_, k) => k <= this._program && serves(k));
    if (program < 0) program = programs.findIndex((_, k) => serves(k));
    const { values, rules, why } = tried(Math.max(0, program));
    if (program >= 0) this._program = program;
    const singular = this.stop || !rules;
    return { program: this._program, values: program < 0 ? null : values, why: program < 0 ? why : "",
             results: singular ? null : this.told(rules.results) };
  }

  /** One program in this pose: the values of its marks, what the rules say, and by how much they differ. */
  tried(k, points, guides) {
    const { points: names, guides: ways, wanted, asked } = this.data.programs[k];
    const x = [...names.flatMap((name) => points[name]), ...ways.flatMap((name) => guides[name] ?? this.data.guides[name])];
    const rules = this.tape.rules[k](x), values = this.tape.drawn[k](x);
    if (typeof rules === "number") return { values: null, rules: null, why: asked.rules[rules], apart: Infinity };
    if (typeof values === "number") return { values: null, rules, why: asked.drawn[values], apart: Infinity };
    let apart = 0, size = 0;
    for (const [i, mark] of wanted.entries()) {
      const [px, py] = values[mark], [qx, qy] = rules.points[i], gap = Math.hypot(px - qx, py - qy);
      apart = gap <= apart ? apart : gap;
      size = Math.max(size, Math.hypot(qx, qy));
    }
    return { values, rules, why: "", apart: apart === 0 ? 0 : apart / size };
  }

  told(results) {
    return results;
  }
}

if (typeof module !== "undefined") module.exports = { Motion };
