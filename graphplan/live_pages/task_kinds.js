/** Tasks whose given numbers can be moved: by kind the parameters of the construction's steps, the linkage that is read
 * from its marks, why there is none, and what can be dragged. Parameters are called role.place.parameter. */
const along = (name, [x, y]) => ({[`${name}.x`]: x, [`${name}.y`]: y});
const offset = (name, [x, y]) => ({[`${name}.dx`]: x, [`${name}.dy`]: y});
const inclined = (name, unit) => along(`${name}.angle`, unit);
const joined = parts => Object.assign({}, ...parts.flat(Infinity));

// why no circle goes through three points, in words; null where one does
function noCircle(names, points, size, tol) {
  for (const [i, k] of [[0, 1], [0, 2], [1, 2]])
    if (abs(sub(points[i], points[k])) <= tol.same * size) return ["coincide", `${names[i]}, ${names[k]}`];
  const [P, Q, R] = points;
  return Math.abs(div(sub(R, P), sub(Q, P))[1]) * abs(sub(Q, P)) <= tol.line * abs(sub(R, P)) ? ["line", names.join(", ")] : null;
}

// why what is turned back leads to no pin of a link whose line has this angle, in words; null where it does
function noPin(letter, turned, angle, size, tol) {
  if (turned.length > 2) return noCircle([`${letter}_1`, `${letter}_2′`, `${letter}_3′`], turned.slice(0, 3), size, tol);
  const apart = sub(turned[1], turned[0]);
  return abs(apart) <= tol.same * size || Math.abs(div(apart, heading(angle))[0]) <= tol.line * abs(apart) ? ["undrawn"] : null;
}

// the real roots of a polynomial of third degree at most, from the constant on, rising; each bettered by Newton's rule
function realRoots(coefficients) {
  const most = Math.max(...coefficients.map(Math.abs)), terms = [...coefficients];
  while (terms.length > 1 && Math.abs(terms.at(-1)) <= 1e-14 * most) terms.pop();
  const value = z => terms.reduceRight((sum, term) => sum * z + term, 0), n = terms.length - 1;
  const slope = z => terms.reduceRight((sum, term, k) => (k ? sum * z + k * term : sum), 0);
  let roots = [];
  if (n === 1) roots = [-terms[0] / terms[1]];
  if (n === 2) {
    const [c, b, a] = terms, root = Math.sqrt(b * b - 4 * a * c);
    roots = Number.isFinite(root) ? [(-b - root) / (2 * a), (-b + root) / (2 * a)] : [];
  }
  if (n === 3) {
    const [d, c, b, a] = terms, p = (3 * a * c - b * b) / (3 * a * a), q = (2 * b ** 3 - 9 * a * b * c + 27 * a * a * d) / (27 * a ** 3);
    const discriminant = q * q / 4 + p ** 3 / 27;
    if (discriminant > 0) {
      const root = Math.sqrt(discriminant), u = Math.cbrt(-q / 2 - Math.sign(q || 1) * root);
      roots = [u - p / (3 * u || 1)];
    } else {
      const angle = Math.acos(Math.max(-1, Math.min(1, 3 * q / (2 * p) * Math.sqrt(-3 / p)))) / 3;
      roots = [0, 1, 2].map(k => 2 * Math.sqrt(-p / 3) * Math.cos(angle - 2 * Math.PI * k / 3));
    }
    roots = roots.map(root => root - b / (3 * a));
  }
  for (let round = 0; round < 4; round++) roots = roots.map(z => z - (slope(z) ? value(z) / slope(z) : 0));
  return roots.filter(Number.isFinite).sort((one, two) => one - two);
}

// a linear system by elimination with the largest pivot
function solved(rows) {
  const n = rows.length, table = rows.map(row => [...row]);
  for (let k = 0; k < n; k++) {
    const best = table.slice(k).reduce((at, row, i) => (Math.abs(row[k]) > Math.abs(table[at][k]) ? k + i : at), k);
    [table[k], table[best]] = [table[best], table[k]];
    for (let i = 0; i < n; i++) {
      if (i === k) continue;
      const factor = table[i][k] / table[k][k];
      for (let j = k; j <= n; j++) table[i][j] -= factor * table[k][j];
    }
  }
  return table.map((row, k) => row[n] / row[k]);
}

const place = ([m, e], w) => add(m, mul(e, w));

// Burmester: the points of the circle-point curve of four positions at u, by rising z
function circlePoints(positions, u) {
  const [m, e] = positions[0], lines = positions.slice(1).map(([n, f]) => {
    const D = sub(n, m), slope = sub(f, e), c = sub(mul(conj(n), f), mul(conj(m), e));
    return [[D[0] + u * slope[0], -slope[1]], [D[1] + u * slope[1], slope[0]], [(abs(n) ** 2 - abs(m) ** 2) / 2 + u * c[0], -c[1]]];
  });
  const product = (a, b) => a.reduce((sum, x, i) => { b.forEach((y, k) => { sum[i + k] = (sum[i + k] ?? 0) + x * y; }); return sum; }, []);
  const less = (a, b) => a.map((x, i) => x - b[i]), [[a, b, k], [p, q, r], [x, y, z]] = lines;
  const parts = [product(a, less(product(q, z), product(r, y))), product(b, less(product(p, z), product(r, x))), product(k, less(product(p, y), product(q, x)))];
  return realRoots(parts[0].map((_, i) => parts[0][i] - parts[1][i] + parts[2][i])).map(root => [u, root]);
}

// the circle point of five positions near w, by Newton's rule; null where it leads to none
function burmesterPoint(positions, w, O, size) {
  for (let round = 0; round < 60; round++) {
    const first = sub(place(positions[0], w), O), e = positions[0][1];
    const rows = positions.slice(1).map(position => {
      const X = sub(place(position, w), O), c = sub(mul(conj(X), position[1]), mul(conj(first), e)), gap = sub(first, X);
      return [c[0], -c[1], gap[0], gap[1], -(abs(X) ** 2 - abs(first) ** 2) / 2];
    });
    const step = solved(rows);
    if (!finite(step) || abs(O) > 1e6 * size) return null;
    [w, O] = [add(w, step.slice(0, 2)), add(O, step.slice(2))];
    if (Math.max(...step.map(Math.abs)) <= 1e-15 * Math.max(size, abs(w), abs(O))) break;
  }
  const radii = positions.map(position => abs(sub(place(position, w), O)));
  return Math.max(...radii) - Math.min(...radii) <= 1e-9 * Math.max(size, abs(O)) ? {w, O} : null;
}

const LEAST_SHARE = 1e-3;  // of the size of a task: a length is not dragged below it
const SUB = (letter, index) => `${letter}<sub>${index}</sub>`;

class TaskKind {
  constructor(data) {
    const {SAME_POINT_TOL: same, COLLINEAR_TOL: line, LENGTH_TOL: length, CHANGE_TOL: change, SENSE_TOL: sense} = data.tolerances;
    Object.assign(this, {data, tol: {same, line, length, change, sense, least: LEAST_SHARE}});
    this.reset();
  }

  // the numbers that steps are given, by step and parameter
  get inputs() {
    return Object.fromEntries(Object.entries(this.parameters()).map(([name, value]) => {
      const [role, k, ...part] = name.split(".");
      return [[this.data.roles[role]?.[k], ...part].join("."), value];
    }));
  }

  // rows of what is given: a label, then paths of numbers, or words
  get fields() { return []; }

  reset() {
    this.request = structuredClone(this.data.request);
    this.started?.();
  }

  get(path) { return path.reduce((inner, key) => inner?.[key], this.request); }

  set(path, value) { path.slice(0, -1).reduce((inner, key) => inner[key], this.request)[path.at(-1)] = value; }

  marks(values, role) { return (this.data.roles[role] ?? []).map(step => values[step]); }

  // what can be dragged: a point of the request, by its path
  free(name, path, about = [0, 0]) { return {name, at: add(this.get(path), about), drag: z => this.set(path, sub(z, about))}; }

  // a line through a point, whose angle can be dragged
  turning(name, about, path, reach) {
    return {name, at: add(about, times(reach, heading(this.get(path)))), drag: z => this.set(path, this.nearTurn(degrees(arg(sub(z, about))), this.get(path)))};
  }

  nearTurn(angle, before) { return before + modulo(angle - before + 180, 360) - 180; }

  // the linkage, and why there is none: [linkage or null, reason or null]
  found(values) {
    const why = this.missing(values);
    if (why) return [null, why];
    const made = new FoundLinkage(this.linkage(values), this.tol);
    const places = [made.O, ...made.A, ...made.B, ...(made.C ? [made.C] : [])];
    if (!places.every(finite)) return [null, ["undrawn"]];
    if (Math.min(...Object.values(made.sides)) <= this.tol.same * this.size) return [null, ["length"]];
    return [made, null];
  }
}

class Guidance extends TaskKind {
  // of five positions A and B are those of the listed points whose centres are O and C
  started() {
    const {data, request} = this, values = TAPE(data.inputs.map(([, value]) => value), true), rows = data.results;
    const nearest = at => rows.reduce((one, two) => (abs(sub(two.centre, at)) < abs(sub(one.centre, at)) ? two : one));
    const chosen = request.positions.length === 5 ? ["O", "C"].map(role => nearest(this.marks(values, role)[0])) : [];
    Object.assign(this, {tracked: chosen.map(({u, z, centre}) => ({w: [u, z], O: centre})), before: structuredClone(request.positions)});
  }

  get fields() {
    const {positions, moving, fixed, turns} = this.request, by = (key, k) => (moving[k].u === undefined ? [0, 1].map(part => [key, k, part]) : [[key, k, "u"]]);
    return [
      ["", "x", "y", "φ"], ...positions.map((_, k) => [SUB("M", k + 1), ...[0, 1, 2].map(part => ["positions", k, part])]),
      ...(moving.length ? [["", "u", moving[0].u === undefined ? "z" : ""]] : []), ...moving.map((_, k) => ["AB"[k], ...by("moving", k)]),
      ...fixed.map((_, k) => ["OC"[k], ["fixed", k, 0], ["fixed", k, 1]]), ...turns.map((_, k) => [`${["OA", "CB"][k]}, °`, ["turns", k]]),
    ];
  }

  get positions() { return this.placed(this.request.positions); }

  placed(rows) { return rows.map(([x, y, angle]) => [[x, y], heading(angle)]); }

  get size() { return Math.max(...this.request.positions.map(([x, y]) => Math.hypot(x, y)), ...(this.points ?? []).filter(Boolean).map(abs), 1e-300); }

  // A and B in the moving plane; null for one that does not exist here
  choose() {
    const {request, positions} = this;
    if (request.fixed.length) return [];
    if (positions.length === 4) return request.moving.map(({u, root}) => circlePoints(positions, u)[root - 1] ?? null);
    if (positions.length < 5) return request.moving;
    return this.track().map(dyad => dyad?.w ?? null);
  }

  // Burmester's two points are followed from where they were, little by little; null where one is lost, or both are one
  track() {
    const {before, request} = this, size = Math.max(...this.positions.map(([m]) => abs(sub(m, this.positions[0][0]))), 1e-300), steps = 32;
    let dyads = this.tracked;
    for (let step = 1; step <= steps; step++) {
      const rows = before.map((row, k) => row.map((value, i) => value + (request.positions[k][i] - value) * step / steps));
      dyads = dyads.map(({w, O}) => burmesterPoint(this.placed(rows), w, O, size));
      if (dyads.includes(null) || abs(sub(dyads[0].w, dyads[1].w)) <= 1e-6 * size) return [null, null];
    }
    Object.assign(this, {tracked: dyads, before: structuredClone(request.positions)});
    return dyads;
  }

  parameters() {
    const {request, positions} = this;
    this.points = this.choose();
    const known = this.points.map(w => w ?? [NaN, NaN]), places = known.map(w => positions.map(position => place(position, w)));
    const poles = ["23", "24"].map(pair => {
      const [[m, e], [n, f]] = [...pair].map(k => positions[k - 1] ?? positions[0]);
      return div(sub(m, n), sub(f, e));
    });
    return joined([
      positions.map(([m, e], k) => ({...along(`M.${k}`, m), ...inclined(`axis.${k}`, e)})),
      known.map((w, i) => positions.map((_, k) => offset(`${"AB"[i]}.${k}`, w))),
      request.fixed.map((at, i) => along(`${"OC"[i]}.0`, at)),
      (request.turns.length ? places : []).map(([start, end], i) =>
        inclined(`base ${"AB"[i]}.0`, mul(times(1 / abs(sub(end, start)), sub(end, start)), heading(90 - request.turns[i] / 2)))),
      positions.length === 4 ? poles.map((w, k) => offset(`pole back.${k}`, w)) : [],
    ]);
  }

  missing(values) {
    const {positions, request, size, tol} = this, names = letter => [1, 2, 3].map(k => `${letter}_${k}`);
    if (this.points.some(w => w === null)) return [positions.length === 5 ? "five" : "roots"];
    for (const [i, w] of this.points.entries()) {
      const places = positions.map(position => place(position, w));
      if (positions.length === 2 && abs(sub(places[1], places[0])) <= tol.same * size) return ["coincide", names("AB"[i]).slice(0, 2).join(", ")];
      const why = positions.length > 2 && noCircle(names("AB"[i]), places.slice(0, 3), size, tol);
      if (why) return why;
    }
    for (const [i, at] of request.fixed.entries()) {
      const turned = positions.map(([m, e]) => place(positions[0], div(sub(at, m), e)));
      const why = noCircle([`${"OC"[i]}`, `${"OC"[i]}_2′`, `${"OC"[i]}_3′`], turned, size, tol);
      if (why) return why;
    }
    return null;
  }

  linkage(values) {
    const {positions} = this, [[m, e]] = positions, [O, C] = ["O", "C"].map(role => this.marks(values, role)[0]);
    const [A, B] = ["A", "B"].map((role, i) => {
      const w = this.points[i] ?? div(sub(this.marks(values, role)[0], m), e);
      return positions.map(position => place(position, w));
    });
    const long = abs(sub(B[0], A[0]));
    return {O, A, B, C, carried: {M: positions.map(([at]) => at), N: positions.map(position => place(position, [long, 0]))}};
  }

  handles(values, reach) {
    const {request, positions} = this;
    return [
      ...positions.map(([m], k) => ({name: `M_${k + 1}`, at: m, drag: z => { request.positions[k].splice(0, 2, ...z); }})),
      ...positions.map(([m], k) => this.turning(`phi_${k + 1}`, m, ["positions", k, 2], reach)),
      ...request.fixed.map((_, k) => this.free("OC"[k], ["fixed", k])),
      ...(positions.length < 4 ? request.moving : []).map((w, k) => (
        {name: `${"AB"[k]}_1`, at: place(positions[0], w), drag: z => { request.moving[k] = div(sub(z, positions[0][0]), positions[0][1]); }})),
    ];
  }
}

const pairs = (request, letter, path) => [["", "φ", letter], ...request.input.map((_, k) => [String(k + 1), ["input", k], [...path, k]])];

class Rocker extends TaskKind {
  get fields() {
    const {request} = this, {crank, moving} = request;
    return [["", "x", "y"], ["O", ["pivot", 0], ["pivot", 1]], ["C", ["rocker", "pivot", 0], ["rocker", "pivot", 1]],
      ...pairs(request, "ψ", ["rocker", "angles"]), ...(crank ? [["OA", ["crank"]]] : []), ...moving.map((_, k) => ["A: u", ["moving", k, "u"]])];
  }

  get size() { return abs(sub(this.request.rocker.pivot, this.request.pivot)); }

  get crank() {
    const {input, moving, rocker, pivot} = this.request;
    if (this.request.crank) return [this.request.crank, 0];
    const positions = input.map((angle, k) => [this.back(pivot, k), heading(angle - rocker.angles[k] + rocker.angles[0])]);
    return circlePoints(positions, moving[0].u)[moving[0].root - 1] ?? null;
  }

  back(z, k) {
    const {pivot, angles} = this.request.rocker;
    return add(pivot, mul(sub(z, pivot), heading(angles[0] - angles[k])));
  }

  parameters() {
    const {pivot, input, rocker, crank} = this.request, w = this.crank ?? [NaN, NaN];
    return joined([
      along("O.0", pivot), along("C.0", rocker.pivot), crank ? {"crank.0.length": crank} : {},
      input.map((angle, k) => ({...inclined(`input.${k}`, heading(angle)), ...offset(`A.${k}`, w)})),
      rocker.angles.map((angle, k) => inclined(`output.${k}`, heading(angle))),
    ]);
  }

  get pins() { return this.request.input.map(angle => add(this.request.pivot, mul(this.crank, heading(angle)))); }

  missing() {
    if (!this.crank) return ["roots"];
    return noPin("A", this.pins.map((A, k) => this.back(A, k)), this.request.rocker.angles[0], this.size, this.tol);
  }

  linkage(values) {
    const {pivot, rocker} = this.request, [B] = this.marks(values, "B"), C = rocker.pivot;
    return {O: pivot, A: this.pins, B: rocker.angles.map(angle => add(C, mul(sub(B, C), heading(angle - rocker.angles[0])))), C};
  }

  handles(values, reach) {
    const {pivot, input, rocker, crank} = this.request, u = heading(input[0]);
    return [
      this.free("O", ["pivot"]), this.free("C", ["rocker", "pivot"]),
      ...input.map((_, k) => this.turning(`phi_${k + 1}`, pivot, ["input", k], reach * 1.6)),
      ...rocker.angles.map((_, k) => this.turning(`psi_${k + 1}`, rocker.pivot, ["rocker", "angles", k], reach * 1.6)),
      ...(crank ? [{name: "A_1", at: this.pins[0], drag: z => { this.request.crank = Math.max(this.tol.least * this.size, div(sub(z, pivot), u)[0]); }}] : []),
    ];
  }
}

class Slide extends TaskKind {
  get fields() { return [["", "x", "y"], ["O", ["pivot", 0], ["pivot", 1]], ...pairs(this.request, "s", ["slide", "at"])]; }

  get guide() {
    const {direction} = this.request.slide;
    return times(1 / abs(direction), direction);
  }

  get places() { return this.request.slide.at.map(at => add(this.request.slide.through, times(at, this.guide))); }

  get size() { return Math.max(...this.places.map(at => abs(sub(at, this.request.pivot))), 1e-300); }

  parameters() {
    return joined([along("O.0", this.request.pivot), offset("guide.0", this.guide), this.places.map((at, k) => along(`B.${k}`, at)),
      this.request.input.map((angle, k) => inclined(`input.${k}`, heading(angle)))]);
  }

  missing() {
    const {pivot, input} = this.request;
    const turned = this.places.map((at, k) => add(pivot, mul(sub(at, pivot), heading(input[0] - input[k]))));
    return noPin("B", turned, input[0], this.size, this.tol);
  }

  linkage(values) {
    const {pivot: O, input} = this.request, [A] = this.marks(values, "A");
    return {O, A: input.map(angle => add(O, mul(sub(A, O), heading(angle - input[0])))), B: this.places, guide: this.guide, names: "OAB"};
  }

  handles(values, reach) {
    const {pivot, input, slide} = this.request;
    return [
      this.free("O", ["pivot"]), ...input.map((_, k) => this.turning(`phi_${k + 1}`, pivot, ["input", k], reach * 1.6)),
      ...this.places.map((at, k) => ({name: `B_${k + 1}`, at, drag: z => { slide.at[k] = div(sub(z, slide.through), this.guide)[0]; }})),
    ];
  }
}

// K stands for the angle between the dead positions, where that is not 0
class Stroke extends TaskKind {
  get sliders() { return true; }

  ratio(rows) { return this.request.angle ? [["K", ["ratio"]], ...rows] : rows; }

  handles() { return []; }
}

class SliderCrank extends Stroke {
  get fields() { return this.ratio([["s", ["stroke"]], [{offset: "e", crank: "OA", rod: "AB"}[this.request.given[0]], ["given", 1]]]); }

  get size() { return this.request.stroke; }

  // the offset, and where it is said that there is none the limits of what is given: [offset, reason]
  get eccentricity() {
    const {stroke: s, given: [key, value], angle} = this.request, a = radians(angle);
    const within = (low, high) => (low < value && value < high ? null : ["limits", {offset: "e", crank: "OA", rod: "AB"}[key], low, high]);
    if (angle === 0) return [0, within(s / 2, Infinity)];
    if (key === "offset") {
      const most = s / 2 / Math.tan(a / 2);
      return [value, Math.abs(value) > 0 && Math.abs(value) < most ? null : ["limits", "e", 0, most]];
    }
    const c = 1 + Math.cos(a), d = 1 - Math.cos(a), crank = key === "crank";
    const other = crank ? (s * s - 2 * value * value * c) / (2 * d) : (s * s - 2 * value * value * d) / (2 * c);
    const why = crank ? within(0, s / 2) : within(s / 2, s / (2 * Math.sin(a / 2)));
    return [(crank ? other - value * value : value * value - other) * Math.sin(a) / s, why];
  }

  parameters() {
    const {stroke: s, angle, given} = this.request, a = radians(angle), [offsetOfGuide] = this.eccentricity, e = Math.abs(offsetOfGuide);
    const difference = e * s / Math.sin(a), total = (s * s + 2 * difference * Math.cos(a)) / 2;
    const [b, r] = angle === 0 ? [given[1], s / 2] : [Math.sqrt((total + difference) / 2), Math.sqrt((total - difference) / 2)];
    const side = offsetOfGuide >= 0 ? -1 : 1, outer = [Math.sqrt((b + r) ** 2 - e * e), side * e], [key, value] = given;
    const centre = degrees => (side < 0 ? 0.5 : -0.5) / Math.tan(radians(degrees));
    return {...along("B.0", outer), ...along("B.1", sub(outer, [s, 0])), "arc centre.0.ratio": centre(angle),
      "arc centre.1.ratio": centre(angle / 2 + (key === "crank" ? 90 : 0)), "size.0.length": 2 * value,
      "offset.0.length": angle === 0 ? -(b + r) : offsetOfGuide};
  }

  missing() { return this.eccentricity[1]; }

  linkage(values) {
    const [O] = this.marks(values, "O"), shift = role => this.marks(values, role).map(at => sub(at, O));
    return {O: [0, 0], A: shift("A"), B: shift("B"), guide: [1, 0], names: "OAB", wholeTurn: true};
  }
}

class Lever extends Stroke {
  get fields() { return this.ratio([["OC", ["lever"]]]); }

  get size() { return this.request.lever; }

  parameters() {
    const half = this.request.angle / 2;
    return {...along("C.0", [this.request.lever, 0]), ...inclined("lever.0", heading(180 - half)), ...inclined("lever.1", heading(180 + half))};
  }

  missing() { return this.request.angle > 0 ? null : ["undrawn"]; }

  linkage(values) {
    const A = this.marks(values, "A");
    return {O: [0, 0], A, B: A, C: [this.request.lever, 0], wholeTurn: true, slotted: true};
  }

  handles() { return [{name: "C", at: [this.request.lever, 0], drag: ([x]) => { this.request.lever = Math.max(this.tol.least * this.size, x); }}]; }
}

class Cognates extends TaskKind {
  get fields() { return [["", "x", "y"], ...Object.keys(this.request.points).map(name => [name, ["points", name, 0], ["points", name, 1]])]; }

  get size() { return Math.max(...Object.values(this.request.points).map(at => abs(sub(at, this.request.points.O))), 1e-300); }

  parameters() { return joined(Object.entries(this.request.points).map(([name, at]) => along(`${name}.0`, at))); }

  missing() {
    const {A, B, M} = this.request.points;
    for (const [letter, at] of [["A", A], ["B", B]]) if (abs(sub(M, at)) <= this.tol.same * this.size) return ["coincide", `M, ${letter}`];
    return null;
  }

  linkage(values) {
    const {points, heading: guide} = this.request, at = role => points[role] ?? this.marks(values, role)[0];
    const [O, A, B, C] = this.data.names.map(at), turned = guide && mul(guide, div(sub(points.M, points.A), sub(points.B, points.A)));
    return {O, A: [A], B: [B], C, guide: turned && times(1 / abs(turned), turned), names: this.data.names, carried: {M: [points.M]}};
  }

  handles() { return Object.keys(this.request.points).map(name => this.free(name, ["points", name])); }
}

// the arcs on which the crank's pivot lies, by synthesis/stroke.py: in a frame whose C is the origin
class CrankRocker extends Stroke {
  get fields() {
    const ground = this.request.ground === "best" ? [] : [["OC", ["ground"]]];
    return this.ratio([["CB", ["rocker", "length"]], [SUB("ψ", 0), ["rocker", "swing"]], ...ground]);
  }

  get size() { return this.request.rocker.length; }

  // O at a place of an arc, 0 < t < 1; of equal times on the chord produced
  centre(side, t) {
    const {angle, rocker} = this.request, half = radians(rocker.swing / 2), outer = polar(rocker.length, half), [x, high] = outer;
    if (angle === 0) return [x, -high - high * t / (1 - t)];
    const middle = [x + side * high / Math.tan(radians(angle)), 0], start = arg(times(side, sub([x, -high], middle)));
    return add(middle, polar(side * high / Math.sin(radians(angle)), start * (1 - t)));
  }

  // the crank-rocker with O there, O being the origin and C on the x-axis; null where it is none
  mechanism(side, t) {
    const {rocker} = this.request, O = this.centre(side, t), half = radians(rocker.swing / 2), c = rocker.length;
    const ends = [polar(c, half), polar(c, -half)], [far, near] = ends.map(end => abs(sub(end, O)));
    const r = (far - near) / 2, b = (far + near) / 2;
    if (!(r > this.tol.length * c && b > r && abs(O) > this.tol.length * c)) return null;
    let B = ends.map(end => mul(sub(end, O), times(-abs(O), div([1, 0], O))));
    if (B[0][1] < 0) B = B.map(conj);
    const A = [times(r / abs(B[0]), B[0]), times(-r / abs(B[1]), B[1])], C = [abs(O), 0];
    const linkage = new FoundLinkage({O: [0, 0], A, B, C, wholeTurn: true}, this.tol);
    return linkage.type === "crank-rocker" && !linkage.defects.length ? linkage : null;
  }

  solve() {
    const {angle, ground} = this.request, sides = angle === 0 ? [1] : [1, -1], n = 720;
    const made = sides.flatMap(side => (ground === "best" ? [this.best(side, n)] : this.atGround(side, n))).filter(Boolean);
    const sorted = made.sort((one, two) => two.transmission.least - one.transmission.least);
    this.exists = sorted.length > 0;
    if (ground === "best") return sorted[0] ?? null;
    this.branch ??= this.branchOf(sorted[this.data.chosen]);  // crossings are drawn on the sides on which they are at first
    return sorted.find(linkage => this.branchOf(linkage) === this.branch) ?? null;
  }

  // on which side of the chord O lies, and of the line from the arc's centre to C
  branchOf({B: [outer, inner], C}) {
    const chord = sub(outer, inner), left = div(times(-1, inner), chord)[1] > 0;
    const F = add(times(0.5, add(outer, inner)), mul(chord, [0, (left ? 0.5 : -0.5) / Math.tan(radians(this.request.angle))]));
    return `${left} ${div(times(-1, F), sub(C, F))[1] > 0}`;
  }

  best(side, n) {
    let places = Array.from({length: n + 1}, (_, k) => 1 / n + (1 - 2 / n) * k / n), best = null;
    for (let round = 0; round < 9; round++) {
      const made = places.map(t => this.mechanism(side, t)), sizes = made.map(linkage => linkage?.transmission.least ?? 0);
      const k = sizes.reduce((at, size, i) => (size > sizes[at] ? i : at), 0);
      best = made[k];
      if (!best) return null;
      const low = places[Math.max(k - 1, 0)], high = places[Math.min(k + 1, places.length - 1)];
      places = Array.from({length: 41}, (_, i) => low + (high - low) * i / 40);
    }
    return best;
  }

  atGround(side, n) {
    const off = t => abs(this.centre(side, t)) - this.request.ground, found = [];
    for (let k = 1; k < n - 1; k++) {
      let [low, high] = [k / n, (k + 1) / n];
      if (off(low) * off(high) > 0) continue;
      for (let round = 0; round < 80; round++) {
        const middle = (low + high) / 2;
        if ((off(middle) > 0) === (off(low) > 0)) low = middle; else high = middle;
      }
      found.push(this.mechanism(side, (low + high) / 2));
    }
    return found;
  }

  parameters() {
    const {angle, rocker} = this.request, linkage = this.solved = this.solve();
    if (!linkage) return {};
    const {B, C} = linkage, first = degrees(arg(sub(B[0], C)));
    const swing = Math.sign(div(sub(B[1], C), sub(B[0], C))[1]) * rocker.swing, left = div(times(-1, B[1]), sub(B[0], B[1]))[1] > 0;
    return {...along("C.0", C), "rocker length.0.length": rocker.length, "ground length.0.length": abs(C), ...inclined("rocker ray.0", heading(first)),
      ...inclined("rocker ray.1", heading(first + swing)), "arc centre.0.ratio": (left ? 0.5 : -0.5) / Math.tan(radians(angle))};
  }

  missing() { return this.solved ? null : [this.exists ? "undrawn" : "crank"]; }

  linkage(values) {
    const [O] = this.marks(values, "O"), [A, B] = ["A", "B"].map(role => this.marks(values, role));
    return abs(O) <= 1e-6 * this.size ? {O, A, B, C: this.solved.C, wholeTurn: true} : {...this.solved, O: [NaN, NaN]};
  }
}

const KINDS = {guidance: Guidance, rocker: Rocker, slide: Slide, "slider-crank": SliderCrank, lever: Lever, "crank-rocker": CrankRocker,
  cognates: Cognates};
