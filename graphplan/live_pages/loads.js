/** The loads that change: each table read where the first drive, or its slide, stands and moves, straight between its
    rows. At a jump, and at the end of a stroke, a load is that into which the motion goes on.  */
class ChangingLoads {
  constructor(data, linkage, opinion) {
    Object.assign(this, { tables: data.linkage.changing, drives: data.linkage.drives, unit: data.linkage.unit, forward: data.linkage.sense, linkage, opinion });
    const [first] = this.drives;
    this.onward = first && !first.rate && first.change < 0 ? -1 : 1;  // whether it moves as its travel counts
  }

  /** What each load is at a knot, {name: [x, y]} or of a moment {name: number}. */
  at(knot, points, guides) {
    const found = {};
    for (const table of this.tables) {
      const value = this.value(table, knot, points, guides);
      const { name, force, direction, through } = table;
      const way = through ? less(points[through[1]], points[through[0]]) : direction;
      found[name] = force ? way.map((part) => (value * part) / Math.hypot(...way)) : value;
    }
    return found;
  }

  value(table, knot, points, guides) {
    const { over, slide, rate } = table;
    if (over === "speed") return this.read(table, slide ? Math.abs(rate) * this.speed(slide, knot, points, guides) : Math.abs(rate), 1);
    if (over === "distance") return this.read(table, Math.hypot(...less(points[table.span[1]], points[table.span[0]])), 1);
    if (!slide) return this.read(table, this.home(table, (this.forward * knot.drives[0]) / this.unit), 1);
    const lies = this.linkage.moving(knot, this.rates()), [x, y] = this.opinion.ray(slide, lies, points, guides);
    const [u, v] = slide.origin ? less(points[slide.at], points[slide.origin]) : points[slide.at];
    return this.read(table, u * x + v * y, this.stroke(slide, knot, points, guides) || Number(Object.keys(table.strokes)[0]));
  }

  /** The rates of the drives as they move on. */
  rates() {
    return this.drives.map(({ pace }) => this.onward * pace);
  }

  /** How a slide's position changes with the first drive's travel. */
  speed(slide, knot, points, guides, sense = 1) {
    const lies = this.linkage.moving(knot, this.drives.map(({ pace }) => sense * pace));
    const [x, y] = this.opinion.ray(slide, lies, points, guides), at = points[slide.at];
    const [u, v] = less(this.opinion.moves(lies, slide.link, at), this.opinion.moves(lies, slide.along, at));
    return u * x + v * y;
  }

  /** The sense in which a slide moves, or at a dead point begins to. */
  stroke(slide, knot, points, guides) {
    const reach = this.drives[0].slides ? 1 : this.opinion.reach, speed = this.speed(slide, knot, points, guides, this.onward);
    if (Math.abs(speed) > STANDING * reach) return Math.sign(speed);
    const step = AHEAD * (this.drives[0].slides ? this.opinion.reach : 1), rates = this.rates(), rate = this.linkage.stated(knot, rates);
    const drives = knot.drives.map((from, i) => from + step * rates[i]), state = knot.state.map((one, i) => one + step * rate[i]);
    return Math.sign(this.speed(slide, this.linkage.placed(drives, rates, state, knot.lies), points, guides, this.onward));
  }

  /** Where a travel lies in the first period of a table. */
  home({ strokes, period, slack }, place) {
    return period ? place - Math.floor((place - strokes[1][0][0] + slack) / period) * period : place;
  }

  /** The value at a place that changes in a sense. */
  read({ powers, strokes, slack }, place, sense) {
    if (powers) return powers.reduce((sum, c, k) => sum + c * [1, place, place * Math.abs(place)][k], 0);
    const rows = strokes[sense], last = rows.length - 1, at = sense * place;
    const next = rows.findIndex(([row]) => sense * row > at + slack);
    if (next < 1) return rows[next < 0 ? last : 0][1];
    const [[p, one], [q, other]] = [rows[next - 1], rows[next]];
    return one + Math.min(Math.max((place - p) / (q - p), 0), 1) * (other - one);
  }
}

const STANDING = 1e-9;  // of the reach: a slower slide is at a dead point
const AHEAD = 1e-4;  // radians, or reaches: how far ahead it is then seen to move
