/** Complex numbers as pairs, and a linkage that was found: the same numbers as synthesis/linkage.py has. */
const add = (a, b) => [a[0] + b[0], a[1] + b[1]], sub = (a, b) => [a[0] - b[0], a[1] - b[1]];
const mul = (a, b) => [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]], times = (t, a) => [t * a[0], t * a[1]];
const conj = a => [a[0], -a[1]], abs = a => Math.hypot(a[0], a[1]), arg = a => Math.atan2(a[1], a[0]);
const div = (a, b) => times(1 / (b[0] * b[0] + b[1] * b[1]), mul(a, conj(b)));
const polar = (r, angle) => [r * Math.cos(angle), r * Math.sin(angle)];
const degrees = angle => angle * 180 / Math.PI, radians = angle => angle * Math.PI / 180;
const modulo = (a, b) => a - b * Math.floor(a / b);
const finite = a => a.every(Number.isFinite);

// the unit vector at an angle, exact at quarters of a turn
function heading(angle) {
  const quarters = Math.floor(angle / 90);
  return mul(polar(1, radians(angle - 90 * quarters)), [[1, 0], [0, 1], [-1, 0], [0, -1]][modulo(quarters, 4)]);
}

const TYPES = {"O A": "crank-rocker", "O C": "double-crank", "B C": "rocker-crank", "A B": "double-rocker"};

class FoundLinkage {
  // O; A and B at each position; C, or the direction of the guide; further points of AB by their names
  constructor({O, A, B, C = null, guide = null, carried = {}, wholeTurn = false, slotted = false, names = "OABC", driven = 1}, tol) {
    Object.assign(this, {O, A, B, C, guide, carried, wholeTurn, slotted, names, driven, tol});
    const r = abs(sub(A[0], O)), b = abs(sub(B[0], A[0]));
    this.sides = slotted ? {"O A": r, "O C": abs(sub(C, O))}
      : {"O A": r, "A B": b, ...(C ? {"B C": abs(sub(C, B[0])), "O C": abs(sub(C, O))} : {})};
    this.offset = C ? 0 : div(sub(B[0], O), guide)[1];
    this.axis = C ? sub(C, O) : [-guide[1], guide[0]];
    const {"B C": c, "O C": d} = this.sides;
    this.line = C ? [(b * b + c * c - r * r - d * d) / (2 * b * c), r * d / (b * c)] : [this.offset / b, -r / b];
    this.psi = A.map(at => arg(div(sub(at, O), this.axis)));
  }

  get points() {
    const letters = {O: this.O, A: this.A[0], B: this.B[0], ...(this.C ? {C: this.C} : {})};
    const renamed = Object.entries(letters).map(([letter, at]) => [this.names["OABC".indexOf(letter)], at]);
    return Object.fromEntries([...renamed, ...Object.entries(this.carried).map(([name, places]) => [name, places[0]])]);
  }

  get lengths() {
    const named = Object.entries(this.sides).map(([side, size]) => [
      side.split(" ").map(letter => this.names["OABC".indexOf(letter)]).join(" "), size]);
    return Object.fromEntries(this.C ? named : [...named, ["offset", Math.abs(this.offset)]]);
  }

  get grashof() {
    const {"O A": r, "A B": b} = this.sides, e = Math.abs(this.offset);
    if (!this.C) return (Math.abs(b - r) - e) / (b + r + e);
    const [s, p, q, l] = Object.values(this.sides).sort((one, two) => one - two);
    return (p + q - s - l) / (s + p + q + l);
  }

  get shortest() { return Object.entries(this.sides).reduce((one, two) => (two[1] < one[1] ? two : one))[0]; }

  get type() {
    if (this.slotted) return "slotted lever";
    if (!this.C) return "slider-crank";
    if (Math.abs(this.grashof) <= this.tol.change) return "change point";
    return this.grashof > 0 ? TYPES[this.shortest] : "triple-rocker";
  }

  // between which sizes of psi it closes: 0 and pi where OA goes round
  get limits() {
    const [p, q] = this.line, cosines = [(1 - p) / q, (-1 - p) / q].sort((one, two) => one - two).map(value =>
      (Math.abs(this.grashof) <= this.tol.change && Math.abs(Math.abs(value) - 1) <= 4 * this.tol.change ? 2 * Math.sign(value) : value));
    return [cosines[1] >= 1 ? 0 : Math.acos(Math.max(-1, cosines[1])), cosines[0] <= -1 ? Math.PI : Math.acos(Math.min(1, cosines[0]))];
  }

  get rotates() { return this.limits[0] === 0 && this.limits[1] === Math.PI; }

  sines(joint) {
    return this.A.map((A, k) => {
      const crank = sub(A, this.O), rod = sub(this.B[k], A);
      const rocker = this.C ? sub(this.B[k], this.C) : [-this.guide[1], this.guide[0]];
      const [u, v] = {O: [crank, this.axis], A: [crank, rod], B: [rod, rocker], C: [rocker, this.axis]}[joint];
      const ratio = div(v, u);
      return ratio[1] / abs(ratio);
    });
  }

  changes(joint) {
    if (joint === "C" && !this.C) return false;
    const sines = this.sines(joint);
    return sines.some(sine => sine > this.tol.sense) && sines.some(sine => sine < -this.tol.sense);
  }

  get defects() {
    if (this.slotted) return [];
    const found = this.changes("B") ? ["branch"] : [];
    if (this.grashof > this.tol.change && [..."OABC"].some(joint => !this.shortest.includes(joint) && this.changes(joint))) found.push("circuit");
    return !found.length && this.A.length > 2 && !this.turns ? ["order"] : found;
  }

  // how far OA has turned at each position going one way; null where no way comes to them in order
  get turns() {
    const {psi} = this, [low, high] = this.limits;
    if (psi.length === 1) return [0];
    const onRange = angle => (low > 0 && high === Math.PI ? modulo(angle, 2 * Math.PI) : angle);
    const courses = this.rotates
      ? [psi.map(angle => modulo(angle - psi[0], 2 * Math.PI)), psi.map(angle => -modulo(psi[0] - angle, 2 * Math.PI))]
      : [psi.map(angle => onRange(angle) - onRange(psi[0]))];
    return courses.filter(course => course.slice(1).every((turn, k) => Math.abs(turn) > Math.abs(course[k]) && turn > 0 === course[1] > 0))
      .reduce((one, two) => (one && Math.abs(one.at(-1)) <= Math.abs(two.at(-1)) ? one : two), null);
  }

  get travel() {
    if (this.slotted) return [0, Math.abs(degrees(arg(div(sub(this.A[1], this.O), sub(this.A[0], this.O)))))];
    return this.defects.length || !this.turns ? null : this.turns.map(turn => degrees(Math.abs(turn)));
  }

  get transmission() {
    if (this.slotted) return {least: 90, at: 0};
    const free = !this.defects.length && this.turns, sense = free && this.turns.at(-1) < 0 ? -1 : 1;
    const tried = free ? [0, ...this.turns] : [0, ...this.psi.map(angle => angle - this.psi[0])];
    if (free) {
      const last = this.wholeTurn ? Math.sign(this.turns.at(-1)) * 2 * Math.PI : this.turns.at(-1);
      for (const psi of [0, Math.PI]) {
        const turn = modulo(psi - this.psi[0], 2 * Math.PI);
        tried.push(...[turn, turn - 2 * Math.PI].filter(course => course * sense >= 0 && course * sense <= Math.abs(last)));
      }
    }
    const [p, q] = this.line, angles = tried.map(turn =>
      [degrees(Math.acos(Math.min(1, Math.abs(p + q * Math.cos(this.psi[0] + turn))))), turn]);
    const [least, turn] = angles.reduce((one, two) => (two[0] < one[0] || (two[0] === one[0] && Math.abs(two[1]) < Math.abs(one[1])) ? two : one));
    return {least, at: degrees(free ? Math.abs(turn) : turn)};
  }

  // A, B and what AB carries after a turn of OA, on the side on which B is in the first position; null where it does not close
  pose(turn) {
    const A = add(this.O, mul(sub(this.A[0], this.O), polar(1, turn))), B = this.slotted ? A : this.second(A);
    if (!B) return null;
    const frame = div(sub(B, A), sub(this.B[0], this.A[0]));
    const carried = Object.fromEntries(Object.entries(this.carried).map(([name, [at]]) =>
      [name, add(A, mul(frame, sub(at, this.A[0])))]));
    return {A, B, carried};
  }

  second(A) {
    const b = this.sides["A B"], [A0, B0] = [this.A[0], this.B[0]];
    if (!this.C) {
      const off = div(sub(A, B0), this.guide)[1], along = b * b - off * off;
      const sense = Math.sign(div(sub(B0, A0), this.guide)[0]) || 1;
      return along < 0 ? null : add(A, mul(this.guide, [sense * Math.sqrt(along), -off]));
    }
    const c = this.sides["B C"], d = sub(this.C, A), x = (b * b - c * c + abs(d) ** 2) / (2 * abs(d));
    const side = Math.sign(div(sub(B0, A0), sub(this.C, A0))[1]) || 1;
    return Math.abs(x) > b * (1 + 1e-12) ? null : add(A, mul(times(1 / abs(d), d), [x, side * Math.sqrt(Math.max(0, b * b - x * x))]));
  }

  // as a solution of graphplan synthesize
  get results() {
    return {points: this.points, lengths: this.lengths, type: this.type, travel: this.travel, defects: this.defects, transmission: this.transmission};
  }
}
