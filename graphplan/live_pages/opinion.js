/** The linkage's own opinion of its rates and forces, beside the construction's: velocities by Newton's rates,
    accelerations by their differences, balances by virtual powers.  */
class Opinion {
  constructor(data, linkage) {
    Object.assign(this, data.linkage.opinion, { linkage, tabled: data.linkage.changing, links: data.linkage.links, drives: data.linkage.drives, reach: data.linkage.reach });
    this.origin = data.linkage.origin;
    const speed = (size, drive) => Math.abs(size) / (drive.slides ? this.reach : 1);
    const paces = this.drives.map((drive) => Math.max(speed(drive.rate, drive), Math.sqrt(speed(drive.change, drive))));
    this.moment = 2 ** -11 / Math.max(...paces);
  }

  /** By how much the results differ from it, beside the largest of their kind: {velocity, acceleration, force}; what it
      cannot tell, near a limit, is left out. With friction the efficiency is entered. */
  beside(results, knot, points, guides) {
    const senses = this.drives.map((drive) => this.sense(drive, knot.lies, points, guides));
    this.rates = this.drives.map((drive, k) => senses[k] * drive.rate);
    this.changes = this.drives.map((drive, k) => senses[k] * drive.change);
    const lies = this.linkage.moving(knot, this.rates), changes = this.changing(knot);
    const velocity = (link, place) => this.moves(lies, link, place);
    const sliding = (link, along, place) => less(velocity(link, place), velocity(along, place));
    const along = (slide) => this.ray(slide, lies, points, guides);
    const check = { velocity: this.apart(results, "velocity", "omega", points, {
      moves: velocity, turns: (link) => lies[7 * link + 6], slides: sliding, along, least: this.least(lies) }) };
    if (results.friction) results.friction.efficiency = this.efficiency(results, lies, points);
    if (!changes) return check;
    const acceleration = (link, place) => this.bends(lies, changes, link, place);
    check.acceleration = this.apart(results, "acceleration", "alpha", points, {
      moves: acceleration, turns: (link) => changes[7 * link + 6], along, least: this.least(changes),
      slides: (link, along, place) => {
        const [u, v] = sliding(link, along, place), twice = 2 * lies[7 * along + 6];
        return less(less(acceleration(link, place), acceleration(along, place)), [-twice * v, twice * u]);
      } });
    if (results.balance) check.force = this.unbalanced(results, knot, points, acceleration, changes);
    return check;
  }

  /** From a link's base to a place, in the scene's lengths. */
  lever(lies, link, [x, y]) {
    const { reach, origin } = this;
    return [x - origin[0] - reach * lies[7 * link], y - origin[1] - reach * lies[7 * link + 1]];
  }

  /** The velocity of a place of a link. */
  moves(lies, link, place) {
    const [u, v, w] = lies.subarray(7 * link + 4, 7 * link + 7), [x, y] = this.lever(lies, link, place);
    return [this.reach * u - w * y, this.reach * v + w * x];
  }

  /** The acceleration of a place of a link. */
  bends(lies, changes, link, place) {
    const [u, v, w] = changes.subarray(7 * link + 4, 7 * link + 7), [x, y] = this.lever(lies, link, place);
    const square = lies[7 * link + 6] ** 2;
    return [this.reach * u - w * y - square * x, this.reach * v + w * x - square * y];
  }

  /** The direction of a slide's guide, of length 1. */
  ray({ name, along, direction, through }, lies, points, guides) {
    const [cos, sin] = lies.subarray(7 * along + 2, 7 * along + 4), [x, y] = direction;
    const ray = through ? less(points[through[1]], points[through[0]])
      : guides[name] ?? [cos * x - sin * y, sin * x + cos * y];
    return ray.map((part) => part / Math.hypot(...ray));
  }

  /** 1, or -1 where a drive slides through the points that give its direction, and so the other way along it. */
  sense({ slide }, lies, points, guides) {
    const guided = this.slides.find(({ name, through }) => name === slide && through);
    if (!guided) return 1;
    const [x, y] = this.ray(guided, lies, points, guides), [u, v] = this.ray({ ...guided, through: null }, lies, points, guides);
    return x * u + y * v < 0 ? -1 : 1;
  }

  /** How all links' rates change, by differences over four moments; null where these do not tell. */
  changing(knot) {
    const rate = this.linkage.stated(knot, this.rates);
    const [one, two, three, four] = [-2, -1, 1, 2].map((k) => {
      const time = k * this.moment, rates = this.rates.map((one, i) => one + time * this.changes[i]);
      const drives = knot.drives.map((from, i) => from + time * (this.rates[i] + (time * this.changes[i]) / 2));
      const near = this.linkage.placed(drives, rates, knot.state.map((one, i) => one + time * rate[i]), knot.lies);
      return this.linkage.moving(near, rates);
    });
    let rough = 0, size = 0;
    const found = one.map((_, i) => {
      const short = (three[i] - two[i]) / (2 * this.moment), long = (four[i] - one[i]) / (4 * this.moment);
      if (i % 7 < 4) return 0;
      rough = Math.max(rough, Math.abs(short - long));
      size = Math.max(size, Math.abs(short));
      return (4 * short - long) / 3;
    });
    return rough <= ROUGH * size ? found : null;
  }

  /** What is next to nothing of the fastest that links move, or of how that changes. */
  least(rates) {
    return LITTLE * this.reach * rates.reduce((most, rate, i) => (i % 7 > 3 && Math.abs(rate) > most ? Math.abs(rate) : most), 0);
  }

  /** The largest difference of results of a kind, beside the largest of them; turnings count at the reach. */
  apart(results, kind, turning, points, own) {
    let gap = 0, size = own.least;
    const enter = ([x, y], [u, v]) => {
      gap = Math.max(gap, Math.hypot(x - u, y - v));
      size = Math.max(size, Math.hypot(u, v));
    };
    const { reach } = this;
    for (const [name, link] of Object.entries(this.points)) {
      const said = results.points[name]?.[kind];
      if (said) enter(said, own.moves(link, points[name]));
    }
    for (const [name, link] of Object.entries(this.links)) {
      const said = results.links[name]?.[turning];
      if (Number.isFinite(said)) enter([reach * said, 0], [reach * own.turns(link), 0]);
    }
    for (const slide of this.slides) {
      const said = results.slides[slide.name]?.[kind];
      if (!said) continue;
      const [x, y] = own.along(slide), [u, v] = own.slides(slide.link, slide.along, points[slide.at]), rate = u * x + v * y;
      enter(said, [rate * x, rate * y]);
    }
    return size ? gap / size : gap;
  }

  /** By how much the virtual powers of loads, inertia and balances do not vanish, beside the largest of them. */
  unbalanced(results, knot, points, acceleration, changes) {
    let worst = 0;
    for (const k of this.rates.keys()) {
      const lies = this.linkage.moving(knot, this.rates.map((_, i) => (i === k ? 1 : 0)));
      const loads = [...this.loads(points, acceleration, changes), ...this.balanced(results.without_friction ?? results)];
      const terms = this.powers(loads, lies, points), least = this.least(lies);
      const sizes = loads.map(({ force, moment }) => (force ? Math.hypot(...force) : Math.abs(moment) / this.reach) * least);
      const size = Math.max(...terms.map(Math.abs), ...sizes);
      if (size) worst = Math.max(worst, Math.abs(terms.reduce((sum, term) => sum + term, 0)) / size);
    }
    return worst;
  }

  /** The power of each load, the links moving so. */
  powers(loads, lies, points) {
    return loads.map(({ link, at, force, moment }) => {
      const [u, v] = at ? this.moves(lies, link, points[at]) : [0, 0];
      return at ? force[0] * u + force[1] * v : moment * lies[7 * link + 6];
    });
  }

  /** All loads, with weight and inertia: forces at points, moments in force times length. */
  *loads(points, acceleration, changes) {
    yield* this.acting;
    for (const { name, link, at, force } of this.tabled) {
      const value = this.changed[name];
      yield force ? { link, at, force: value } : { link, moment: this.metre * value };
    }
    for (const { link, mass, inertia, at, weight } of this.masses) {
      const [x, y] = acceleration(link, points[at]);
      yield { link, at, force: [weight[0] - mass * x, weight[1] - mass * y] };
      yield { link, moment: -inertia * changes[7 * link + 6] };
    }
  }

  /** Balances as results tell them, as loads. */
  balanced({ balance }) {
    return [balance].flat().map(({ moment, force, link, at }) => ({
      link: this.links[link], at: force ? at : "", force, moment: moment * this.metre }));
  }

  /** The efficiency: of the balances' powers without friction and with it. */
  efficiency(results, lies, points) {
    const [smooth, rough] = [results.without_friction, results].map((told) => this.powers(this.balanced(told), lies, points)
      .reduce((sum, power) => sum + power, 0));
    if (smooth === 0 && rough === 0) return null;
    if (Math.abs(smooth) <= IDLE * Math.abs(rough)) return 0;
    return smooth > 0 ? smooth / rough : rough / smooth;
  }
}

const IDLE = 1e-12;  // of the power with friction: without it there is nothing but rounding
const LITTLE = 2 ** -20;  // of what is large: beside less nothing is compared
const ROUGH = 2 ** -10;  // by how much two differences may differ, of the largest

function less(one, two) {
  return [one[0] - two[0], one[1] - two[1]];
}
