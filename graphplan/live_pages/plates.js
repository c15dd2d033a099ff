// What is drawn of each step in a pose, as sheet/plates/plate.py says: in mm of the page, x to the right and y up.

const POINT = "point", LINE = "line", CIRCLE = "circle";
const MECHANISM = 0;  // the place of its panel
const EDGES = 4;  // mm that what is held in a window keeps off its sides, where it does on the sheet
const AUXILIARY = 1.6, TRACED = 6;  // how many times as small as its vectors let it be a plan may become for auxiliary marks, and for traces

const distance = (p, q) => Math.hypot(q[0] - p[0], q[1] - p[1]);
const between = (p, q, t) => [p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])];
const off = (p, [x, y], t, u = 0) => [p[0] + t * x - u * y, p[1] + t * y + u * x];  // t along, u to the left
const unit = (p, q) => {
  const long = distance(p, q);
  return long > 1e-9 ? [(q[0] - p[0]) / long, (q[1] - p[1]) / long] : [1, 0];
};
const turn = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
const finite = spot => Number.isFinite(spot[0]) && Number.isFinite(spot[1]);
const holds = ([left, low, right, high], [x, y]) => left <= x && x <= right && low <= y && y <= high;
const degrees = radians => radians * 180 / Math.PI;
const onArc = (arc, angle) =>
  [arc.at[0] + arc.r * Math.cos(angle * Math.PI / 180), arc.at[1] + arc.r * Math.sin(angle * Math.PI / 180)];

// the part of a segment inside a rectangle, as two fractions of its length (Liang and Barsky), or null
function segment(rect, p, q) {
  let low = 0, high = 1;
  const dx = q[0] - p[0], dy = q[1] - p[1];
  const steps = [-dx, dx, -dy, dy], rooms = [p[0] - rect[0], rect[2] - p[0], p[1] - rect[1], rect[3] - p[1]];
  for (let side = 0; side < 4; side++) {
    if (steps[side] === 0) {
      if (rooms[side] < 0) return null;
    } else if (steps[side] < 0) low = Math.max(low, rooms[side] / steps[side]);
    else high = Math.min(high, rooms[side] / steps[side]);
  }
  return low < high ? [low, high] : null;  // also where a number is none
}

// how far along a stroke, in its lengths, those of some spots are that lie on its line
function along([p, q], spots) {
  const long = distance(p, q), [x, y] = unit(p, q);
  return spots.map(spot => [spot[0] - p[0], spot[1] - p[1]]).filter(([u, v]) => Math.abs(u * y - v * x) < 0.1)
    .map(([u, v]) => (u * x + v * y) / long);
}

// a plan on its panel: `scale` in mm per unit, and where the plan's origin falls
class View {
  constructor(rect, scale, origin) { Object.assign(this, {rect, scale, origin}); }
  at(spot) { return [this.origin[0] + this.scale * spot[0], this.origin[1] + this.scale * spot[1]]; }
  back(spot) { return [(spot[0] - this.origin[0]) / this.scale, (spot[1] - this.origin[1]) / this.scale]; }
}

// the window of a panel, slid by the least that holds some spots of its plan, the first ones first; the sheet's own is
// kept as long as they keep off its sides as far as they do there
function slid(panel, spots, scale = panel.scale) {
  const view = new View(panel.rect, scale, panel.origin), box = [Infinity, Infinity, -Infinity, -Infinity];
  for (const spot of spots.map(spot => view.at(spot)).filter(finite))
    for (const axis of [0, 1]) {
      const edges = Math.min(panel.free[axis], EDGES) + Math.min(panel.free[axis + 2], EDGES);
      const room = panel.rect[axis + 2] - panel.rect[axis] - edges, low = box[axis], high = box[axis + 2];
      box[axis] = Math.min(low, high < low ? spot[axis] : Math.max(spot[axis], high - room));
      box[axis + 2] = Math.max(high, high < low ? spot[axis] : Math.min(spot[axis], low + room));
    }
  const shift = axis => {
    const low = panel.rect[axis], high = panel.rect[axis + 2];
    const tight = Math.max(0, (panel.free[axis] + panel.free[axis + 2] - (high - low - box[axis + 2] + box[axis])) / 2);
    const way = Math.max(low + panel.free[axis] - tight - box[axis], 0)
      + Math.min(high - panel.free[axis + 2] + tight - box[axis + 2], 0);
    return Math.abs(way) > 1e-6 ? way : 0;
  };
  if (box[0] <= box[2]) view.origin = [panel.origin[0] + shift(0), panel.origin[1] + shift(1)];
  return view;
}

class Plates {
  constructor(data) {
    Object.assign(this, {data, steps: data.steps, rules: data.measures});
    this.pointsOn = data.panels.map((_, panel) => data.steps.map((_, i) => i).filter(i => data.steps[i].panel === panel && data.steps[i].kind === POINT));
    this.vectorsOn = data.panels.map((_, panel) => data.vectors.filter(vector => vector.panel === panel));
  }

  // the marks of a pose on paper: values by step, points by name; `pins` says where the frame's points are, or `home` is the
  // mechanism's window, `held` what a plan should hold besides its marks,
  // and at `rest` the windows go to that
  pose(values, points, {pins, rest, held, home}) {
    const {data, steps} = this;
    this.values = values ?? steps.map(() => [NaN, NaN, NaN]);  // in a singular pose only the mechanism is drawn
    this.places = data.points.map(([name, x, y]) => points[name] ?? [x, y]);
    if (home) this.home = home;
    else if (!this.home || rest && pins !== this.pins) {
      this.home = this.mechanismWindow(this.home);
      this.pins = pins;
    }
    this.views = this.windows(rest, held);
    this.at = steps.map(({kind, panel}, i) =>
      kind === POINT || kind === CIRCLE ? this.views[panel].at(this.values[i]) : null);
    this.spots = this.places.map(place => this.views[MECHANISM].at(place));
    for (const vector of data.vectors) {
      vector.ends = [this.at[vector.start], this.at[vector.end]];
      vector.long = distance(...vector.ends);
      vector.shown = vector.long >= vector.least && finite(vector.ends[0]) && finite(vector.ends[1]);
    }
    this.stretches = steps.map((step, i) => step.kind === LINE ? this.stretch(step, i) : null);
  }

  // the window of the mechanism: as it was laid out, or where pins were moved slid to the mechanism
  mechanismWindow(moved) {
    const panel = this.data.panels[MECHANISM];
    return moved ? slid(panel, this.places) : new View(panel.rect, panel.scale, panel.origin);
  }

  // the windows of all plans: that of the mechanism stands; others are at rest as large as their panels hold at round
  // scales, twins alike; in motion they become no larger
  windows(rest, held) {
    const {panels} = this.data, boxes = panels.map((panel, i) => (i === MECHANISM ? null : this.box(panel, i, rest || !this.views ? held(i) : null)));
    const own = panels.map((panel, i) => (boxes[i] ? this.scaleStep(panel, boxes[i]) : 0));
    const steps = panels.map(({twin}, i) => Math.max(...own.filter((_, k) => k === i || panels[k].twin === twin)));
    const before = rest || !this.views ? null : this.scaleSteps;
    this.scaleSteps = before ? steps.map((step, i) => Math.max(step, before[i])) : steps;
    return panels.map((panel, i) => (i === MECHANISM ? this.home
      : this.window(panel, boxes[i], this.scaleSteps[i], before?.[i] === this.scaleSteps[i] ? this.views[i].origin : null)));
  }

  // the first step of a plan's scales at which a box has room on its panel
  scaleStep({room: [left, low, right, high], scale, scales}, box) {
    const found = scales.findIndex(times => scale * (box[2] - box[0]) <= times * (right - left) && scale * (box[3] - box[1]) <= times * (high - low));
    return found < 0 ? scales.length - 1 : found;
  }

  // the box of what a plan shows: the ends of its vectors, and at rest traces and auxiliary marks that do not make it much smaller
  box(panel, index, held) {
    const ends = panel.core.map(mark => this.values[mark]).filter(finite);
    if (!ends.length) return null;
    let box = bounds(ends, 0);
    if (!held) return box;
    const most = (held.length ? TRACED : AUXILIARY) * panel.scales[this.scaleStep(panel, box)];
    const marks = [...this.pointsOn[index].map(mark => this.values[mark]), ...held].filter(finite);
    const far = ([x, y]) => Math.max(box[0] - x, x - box[2], box[1] - y, y - box[3]);
    for (const mark of marks.filter(mark => far(mark) > 0).sort((p, q) => far(p) - far(q))) {
      const larger = bounds([mark, box.slice(0, 2), box.slice(2)], 0);
      if (panel.scales[this.scaleStep(panel, larger)] <= most) box = larger;
    }
    return box;
  }

  // the window of a plan at a step of its scales: what it shows is in the middle, or stays where it was as long as it has room there
  window({rect, room, scale, scales, origin}, box, step, before) {
    const per = scale / scales[step];
    if (!box) return new View(rect, scale, origin);
    return new View(rect, per, [0, 1].map(axis => {
      const [least, most] = [room[axis] - per * box[axis], room[axis + 2] - per * box[axis + 2]];
      return before ? Math.min(Math.max(before[axis], least), most) : (least + most) / 2;
    }));
  }

  rect(index) { return this.views[this.steps[index].panel].rect; }

  // whether a point lies on its panel
  shown(mark) { return this.steps[mark].kind === POINT && holds(this.rect(mark), this.at[mark]); }

  radius(index) {
    return Math.sqrt(Math.max(this.values[index][2], 0)) * this.views[this.steps[index].panel].scale;
  }

  // one mm the way a line runs
  way(index) {
    const [a, b] = this.values[index], size = Math.hypot(a, b) || 1;
    return [b / size, -a / size];
  }

  // every stroke, arc, dot and vector of a step's plan as it lies, in drawing order
  items(index) {
    const step = this.steps[index], found = this.strokes(step, index);
    if (step.kind === CIRCLE) found.push(...this.arcs(step, index));
    if (step.dot && this.shown(index))
      found.push({tag: "circle", pen: step.dot[0], at: this.at[index], r: step.dot[1]});
    return found;
  }

  vector({pen, ends: [start, end], head, long, label}) {
    if (!head) return {tag: "line", pen, spots: [start, end]};
    return {tag: "arrow", pen, start, end, head: Math.min(head, 0.6 * long), label};
  }

  // ---- strokes

  strokes(step, index) {
    return [...this.own(step, index), ...this.breaks(step, index), ...this.similarSides(step, index)];
  }

  own(step, index) {
    const stretch = this.stretches[index];
    if (stretch)
      return this.bare(stretch, step.panel === MECHANISM ? this.linksAlong(stretch) : [], step, index);
    return this.isLaidOff(step, index) ? this.laidOff(step, index) : [];
  }

  // whether a stroke is drawn along which the point is laid off
  isLaidOff({root, panel}, index) {
    return root !== undefined && !this.vectorBetween(panel, this.at[root], this.at[index]);
  }

  // the sides of a triangle that is similar to a link's, where no vector is one
  similarSides(step, index) {
    if (!step.corners) return [];
    const [p, q] = step.corners.map(mark => this.at[mark]), r = this.at[index];
    return [[p, q], [p, r], [q, r]].filter(side => !this.vectorBetween(step.panel, ...side))
      .map(side => this.inside(index, side)).filter(Boolean).map(spots => ({tag: "line", pen: step.side, spots}));
  }

  laidOff(step, index) {
    const ends = [this.at[step.root], this.at[index]], long = distance(...ends), {SHORT, GIVEN_HEAD} = this.rules;
    if (step.given !== null && long > SHORT)
      return [{tag: "arrow", pen: step.given, start: ends[0], end: ends[1], head: Math.min(GIVEN_HEAD, 0.6 * long),
               label: ""}];
    const inside = this.inside(index, ends);
    return inside ? this.bare({ends: inside, pen: step.pen}, [], step, index) : [];
  }

  // whether a vector takes the place of a stroke
  vectorBetween(panel, p, q) {
    return this.vectorsOn[panel].some(({ends: [start, end]}) => Math.max(distance(p, start), distance(q, end)) < 0.05
      || Math.max(distance(p, end), distance(q, start)) < 0.05);
  }

  // from the first mark on a line to the last and a little beyond, as far as the panel goes
  stretch(step, index) {
    const way = this.way(index), far = mark => this.at[mark][0] * way[0] + this.at[mark][1] * way[1];
    const marks = step.marks.filter(mark => finite(this.at[mark])).sort((p, q) => far(p) - far(q) || p - q);
    if (!marks.length) return null;
    const start = marks[0], end = marks[marks.length - 1], p = this.at[start], q = this.at[end];
    const long = distance(p, q), close = long < this.rules.CLOSE;
    const beyond = close && step.beyond ? this.rules.ALONE : step.beyond, run = close ? way : unit(p, q);
    const ends = this.inside(index, [off(p, run, -beyond), off(p, run, long + beyond)]);
    return ends && {ends, start, end, pen: step.pen};
  }

  inside(index, [p, q]) {
    const part = distance(p, q) > 0 ? segment(this.rect(index), p, q) : null;
    return part && part.map(t => between(p, q, t));
  }

  // the arrows where a line, or a stroke laid off, leaves the panel, each to the mark outside of it
  breaks(step, index) {
    const stretch = this.stretches[index] ?? this.laidOffInside(step, index);
    if (!stretch) return [];
    const {ends: [p, q], start, end} = stretch, part = Math.min(this.rules.BREAK / distance(p, q), 1);
    return [[start, 0], [end, 1]].filter(([mark]) => !this.shown(mark)).map(([to, t]) => (
      {tag: "arrow", pen: this.data.uses.break, start: between(p, q, Math.abs(t - part)), end: between(p, q, t),
       head: this.rules.BREAK_HEAD, label: "", to}));
  }

  laidOffInside(step, index) {
    if (step.given !== null || !this.isLaidOff(step, index)) return null;
    const ends = this.inside(index, [this.at[step.root], this.at[index]]);
    return ends && {ends, start: step.root, end: index};
  }

  // what is left of a stroke where no link and no force lies along it
  bare({ends, pen}, links, step, index) {
    const [p, q] = ends, long = distance(p, q), found = [];
    const parts = [...links, ...this.forcesAlong(ends, long, step, index)].sort((s, t) => s[0] - t[0] || s[1] - t[1]);
    let done = 0;
    for (const [low, high] of [...parts, [1, 1]]) {
      if ((low - done) * long > this.rules.SHORT_STROKE)
        found.push({tag: "line", pen, spots: [between(p, q, done), between(p, q, low)]});
      done = Math.max(done, high);
    }
    return found;
  }

  linksAlong({ends}) {
    const found = [];
    for (const link of this.data.links) {
      const hit = along(ends, link.map(point => this.spots[point]));
      if (hit.length > 1 && (hit.length === link.length || link.length === 3))
        found.push([Math.min(...hit), Math.max(...hit)]);
    }
    return found;
  }

  forcesAlong(ends, long, step, index) {
    const found = [];
    if (long <= this.rules.SHORT_STROKE) return found;
    for (const force of this.vectorsOn[step.panel])
      if (force.force && force.shown && force.end < index) {
        const hit = along(ends, force.ends);
        if (hit.length === 2 && Math.max(...hit) > 0 && Math.min(...hit) < 1)
          found.push([Math.max(Math.min(...hit), 0), Math.min(Math.max(...hit), 1)]);
      }
    return found;
  }

  // ---- arcs

  arcs(step, index) {
    const r = this.radius(index), at = this.at[index], {STRIKE, FLATTEST, WIDEST} = this.rules;
    const [on, pen] = step.whole ?? [undefined, this.data.uses.arc];
    const marks = r > 1e-6 ? step.marks.filter(mark => finite(this.at[mark])) : [], end = step.diameter;
    const arc = (mark, before, after) => {
      const middle = degrees(Math.atan2(this.at[mark][1] - at[1], this.at[mark][0] - at[0]));
      return {tag: "arc", pen, at, r, start: middle - before, end: middle + after};
    };
    if (on !== undefined) return [arc(on, 180, 0), arc(on, 0, 180)];
    if (marks.length && end !== undefined) {
      const left = turn(at, this.at[end], this.at[marks[0]]) >= 0, half = arc(end, left ? 0 : 180, left ? 180 : 0);
      const angles = Array.from({length: 46}, (_, i) => half.start + 4 * i);
      if (angles.every(angle => holds(this.rect(index), onArc(half, angle)))) return [half];
    }
    const wide = Math.min(WIDEST, Math.max(FLATTEST, degrees(STRIKE / r)));
    return marks.map(mark => arc(mark, wide, wide));
  }
}
