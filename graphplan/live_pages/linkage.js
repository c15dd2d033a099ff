/** Groups of links, closed one after another by Newton's steps: one pose of the linkage. Lengths count in reaches. */
class Linkage {
  constructor(data, steps) {
    this.data = data;
    this.rules = data.rules;
    this.unknowns = 0;
    this.width = data.counted ? 8 : 7;  // of how a link lies for the tapes, with how far it has turned in all
    this.groups = data.groups.map((group) => {
      const inputs = 8 * group.carriers.length + group.arms.length + 4 * group.drives.length + 3 * group.unknowns;
      const made = { ...group, run: steps[group.step], first: this.unknowns, arms: Float64Array.from(group.arms),
                     x: new Float64Array(inputs), y: new Float64Array(2 * group.unknowns + 1 + this.width * group.links.length) };
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

  /** One step of Newton's for a group from the state of all; fills its y. */
  step(group, lies, drives, rates, state) {
    const { x, first } = group, { counted } = this.data;
    let n = 0;
    const angle = (at) => {
      x[n++] = Math.cos(at);
      x[n++] = Math.sin(at);
      if (counted) x[n++] = at;
    };
    for (const link of group.carriers) {
      for (let i = 0; i < 7; i++) x[n++] = lies[7 * link + i];
      if (counted) x[n++] = this.angle(link, drives, state);
    }
    for (const number of group.arms) x[n++] = number;
    for (const [drive, turns, rate] of group.drives) {
      const at = rate * drives[drive];
      if (turns) angle(at);
      else x[n++] = at;
      x[n++] = rate * rates[drive];
    }
    for (let i = 0; i < group.unknowns; i++) {
      if (i < group.angles) angle(state[first + i]);
      else x[n++] = state[first + i];
    }
    group.run(x, group.y);
    return group.y;
  }

  /** How far a link has turned in all, where the drives and the state are so. */
  angle(link, drives, state) {
    let found = 0;
    for (let at = link; at; at = this.data.counted[at].on) {
      const { unknown, drive, rate } = this.data.counted[at];
      found += (unknown < 0 ? 0 : state[unknown]) + (drive < 0 ? 0 : rate * drives[drive]);
    }
    return found;
  }

  /** Closes a group from a predicted state, and says whether that is to be trusted: the first correction is small
      beside the step that was predicted, each further one beside the one before. */
  settle(group, lies, drives, rates, state, size) {
    const rules = this.rules, n = group.unknowns, { first } = group;
    let allowed = rules.near * size, settled = n === 0;
    for (;;) {
      const y = this.step(group, lies, drives, rates, state);
      let far = 0;
      for (let i = 0; i < n; i++) {
        const change = Math.abs(y[i]) / (i < group.angles ? 1 : Math.max(1, Math.abs(state[first + i])));
        far = change <= far ? far : change;  // not a number stays
      }
      if (!(far <= allowed) || Math.abs(y[2 * n]) < rules.nothing) return false;
      for (let i = 0; i < n; i++) state[first + i] -= y[i];
      if (settled || far <= rules.closed * size) return true;
      settled = far <= rules.settled * size;
      allowed = settled ? rules.near * size : rules.shrinking * far;
    }
  }

  /** The knot where the drives are so, their rates being so; or the number of the group that is not to be trusted. */
  closed(drives, rates, predicted, size) {
    const state = Float64Array.from(predicted), rate = new Float64Array(this.unknowns);
    const lies = new Float64Array(7 * this.data.bases.length), determinants = new Float64Array(this.groups.length);
    lies[2] = 1;
    for (const [g, group] of this.groups.entries()) {
      const n = group.unknowns;
      if (!this.settle(group, lies, drives, rates, state, size)) return g;
      rate.set(group.y.subarray(n, 2 * n), group.first);
      determinants[g] = group.y[2 * n];
      this.lay(group, lies);
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
    const state = Float64Array.from(knot.state);
    this.stepped(knot, drives, drives.map(() => 0), (i, correction) => (state[i] -= correction));
    return state;
  }

  /** How all links lie and move at a knot where the drives have these rates. */
  moving(knot, rates) {
    return this.stepped(knot, knot.drives, rates, () => {});
  }

  /** How the unknowns change at a knot where the drives have these rates. */
  stated(knot, rates) {
    const found = new Float64Array(this.unknowns);
    this.stepped(knot, knot.drives, rates, (i, _, rate) => (found[i] = rate));
    return found;
  }

  /** How all links lie after one step of Newton's in each group; tells each unknown's correction and rate. */
  stepped(knot, drives, rates, tell) {
    const lies = Float64Array.from(knot.lies), state = Float64Array.from(knot.state);
    for (const group of this.groups) {
      const { first, unknowns } = group;
      const y = this.step(group, lies, drives, rates, state);
      for (let i = 0; i < unknowns; i++) {
        tell(first + i, y[i], y[unknowns + i]);
        state[first + i] -= y[i];  // gears on its links turn with it
      }
      this.lay(group, lies);
    }
    return lies;
  }

  /** Enters how the links of a group lie, as its last step has it. */
  lay(group, lies) {
    const from = 2 * group.unknowns + 1, { width } = this;
    group.links.forEach((link, k) => lies.set(group.y.subarray(from + width * k, from + width * k + 7), 7 * link));
  }

  /** The first group that has left the branch of another knot, or is too near to where another meets it; or -1. */
  strayed(knot, start) {
    return this.groups.findIndex((_, g) => !(knot.determinants[g] / start.determinants[g] >= this.rules.singular));
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
    Object.assign(this, { linkage, way, start, span, rules, first: knot, knots: [knot], stops: [null, null] });
    const paces = way.map((pace, k) => [Math.abs(pace), data.drives[k].slides]).filter(([pace]) => pace);
    this.pace = Math.max(0, ...paces.map(([pace, slides]) => (slides ? pace / data.reach : pace)));
    const turn = (slides) => (slides ? span : 2 * Math.PI);
    this.longest = rules.longest * Math.min(...paces.map(([pace, slides]) => turn(slides) / pace));
    this.finest = rules.finest * this.longest;
  }

  drives(travel) {
    return this.first.drives.map((from, k) => from + this.way[k] * (travel - this.first.travel));
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
      const size = this.size(step === left ? Math.max(Math.abs(left), rules.short * this.longest) : step, predicted, last.state);
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
    if (!knot.state || this.linkage.strayed(knot, this.start) >= 0) return null;
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
    if (this.knots.length > MANY) this.knots.splice(2 * place > MANY || place < 0 ? 0 : MANY, 1);  // many turns later
  }
}

const MANY = 1000;  // knots that are kept

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
