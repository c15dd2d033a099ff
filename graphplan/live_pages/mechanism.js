// The picture of the mechanism in a pose: symbols ride on their links or stand at their points, guides of the frame
// stand still and reach as far as their blocks go.

class DrawnMechanism {
  constructor(data, plates) {
    Object.assign(this, {data, plates, rules: data.measures});
    this.given = data.points.map(([, x, y]) => [x, y]);
  }

  // every item with its layer, from the ground up; guides are directions by the names of sliding pairs
  items(guides) {
    const {data, plates} = this;
    this.ways = data.slides.map(slide => this.way(slide, guides, plates.places));
    const found = data.parts.flatMap(part => part.items ? this.figure(part) : this.bar(part));
    const pairs = data.pairs.map(point => plates.spots[point]), {NEAR, RADIUS} = this.rules, done = [];
    for (const spot of [...pairs, ...plates.spots])
      if (done.every(other => distance(spot, other) > NEAR)) {
        const pair = done.push(spot) <= pairs.length && pairs.includes(spot);
        if (holds(plates.views[MECHANISM].rect, spot))
          found.push({layer: "pairs", tag: "circle", pen: pair ? data.uses.pair : data.uses.tracer, at: spot,
                      r: pair ? RADIUS : RADIUS / 2});
      }
    return found;
  }

  // the direction of a guide
  way({name, through, direction}, guides, places) {
    return unit([0, 0], through ? unit(places[through[0]], places[through[1]]) : guides[name] ?? direction);
  }

  // how a frame has turned since the given pose: cosine and sine
  turned(frame) {
    if (!frame) return [1, 0];
    const ends = places => unit(places[frame.points[0]], places[frame.points[1]]);
    const slide = frame.points ? null : this.data.slides[frame.slide];
    const [x, y] = slide ? this.way(slide, {}, this.given) : ends(this.given);
    const [u, v] = slide ? this.ways[frame.slide] : ends(this.plates.places);
    return [x * u + y * v, x * v - y * u];
  }

  spot([point, x, y], way) { return off(this.plates.spots[point], way, x, y); }

  figure({items, frame}) {
    const way = this.turned(frame), angle = degrees(Math.atan2(way[1], way[0]));
    return items.map(({layer, pen, spots, closed, arc}) => {
      const places = spots.map(spot => this.spot(spot, way));
      if (arc) return {layer, pen, tag: "arc", at: places[0], r: arc[0], start: arc[1] + angle, end: arc[2] + angle};
      return {layer, pen, tag: closed ? "shape" : "line", spots: places};
    });
  }

  bar(part) {
    return part.spring ? this.spring(part) : part.ground === undefined ? this.rail(part) : this.guide(part);
  }

  // a spring: its coils lie as close as its ends let them
  spring({spring, coils}) {
    const {SPRING_END, SPRING_WIDTH} = this.rules, [start, end] = spring.map(point => this.plates.spots[point]);
    const way = unit(start, end), long = distance(start, end), step = long * (1 - 2 * SPRING_END) / (2 * coils);
    const zigzag = Array.from({length: 2 * coils + 1}, (_, k) =>
      off(start, way, long * SPRING_END + k * step, k % 2 ? SPRING_WIDTH * (k % 4 === 1 ? 1 : -1) : 0));
    return [{layer: "machine", tag: "line", pen: this.data.uses.machine, spots: [start, ...zigzag, end]}];
  }

  // a fixed guide: as it stands on the sheet, and on to where its block is
  guide({ground, block, side}) {
    const {GUIDE, HIGH, HATCH, PITCH} = this.rules, {uses} = this.data, way = this.ways[ground];
    const at = this.plates.spots[block], given = this.plates.views[MECHANISM].at(this.given[block]);
    const t = (at[0] - given[0]) * way[0] + (at[1] - given[1]) * way[1], middle = off(at, way, -t);
    const low = Math.min(0, t) - GUIDE, high = Math.max(0, t) + GUIDE;
    const pitch = 2 * GUIDE / Math.floor(2 * GUIDE / PITCH);
    const line = (pen, p, q) => ({layer: "ground", tag: "line", pen, spots: [p, q]});
    const found = [line(uses.ground, off(middle, way, low, side * HIGH), off(middle, way, high, side * HIGH))];
    for (let i = Math.ceil((low + GUIDE) / pitch - 0.75 - 1e-9); (i + 0.75) * pitch < high + GUIDE; i++) {
      const root = off(middle, way, (i + 0.75) * pitch - GUIDE, side * HIGH);
      found.push(line(uses.hatch, root, off(root, way, -0.6 * HATCH, side * 0.8 * HATCH)));
    }
    return [...found, line(uses.produced, off(middle, way, low), off(middle, way, high))];
  }

  // the part of a moving link that guides: through the block and a little beyond, tied to the link's point
  rail({rail, block, end}) {
    const {RAIL, NEAR} = this.rules, {uses} = this.data, way = this.ways[rail];
    const at = this.plates.spots[block], tie = this.plates.spots[end];
    const t = (tie[0] - at[0]) * way[0] + (tie[1] - at[1]) * way[1], foot = off(at, way, t);
    const bars = [[off(at, way, Math.min(-RAIL, t)), off(at, way, Math.max(RAIL, t))]];
    if (distance(foot, tie) > NEAR) bars.push([foot, tie]);
    return bars.flatMap(spots => [uses.bar, uses.hollow].map(pen => ({layer: "links", tag: "line", pen, spots})));
  }
}
