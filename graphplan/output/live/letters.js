// Where letters stand in a pose: as on the sheet as long as that place is free, else in the best of some rings of
// places around what they name. A letter leaves its place only for one that is clearly better, so that none flickers.

const RINGS = [[0.7, 0], [1.6, 0.8], [2.8, 2], [4.5, 4], [7, 7], [10, 11]], WAYS = 16;  // gaps in mm, their prices
const TROUBLE = 6, BETTER = 4, ROOMY = 0.4, ROUNDS = 3;  // prices; mm free around a place to which a letter goes back

const overlap = (a, b, air) => Math.min(a[2], b[2]) - Math.max(a[0], b[0]) + air > 0
  && Math.min(a[3], b[3]) - Math.max(a[1], b[1]) + air > 0;
const gap = ([left, low, right, high], [x, y]) =>
  Math.hypot(Math.max(left - x, x - right, 0), Math.max(low - y, y - high, 0));
const grown = ([left, low, right, high], air) => [left - air, low - air, right + air, high + air];
const bounds = (spots, air) => [Math.min(...spots.map(spot => spot[0])) - air, Math.min(...spots.map(spot => spot[1])) - air,
  Math.max(...spots.map(spot => spot[0])) + air, Math.max(...spots.map(spot => spot[1])) + air];

// ---- what needs a letter

class Wishes {
  constructor(data, plates) {
    Object.assign(this, {data, plates, rules: data.measures});
    this.stepsOn = data.panels.map((_, panel) => data.steps.map((_, i) => i).filter(i => data.steps[i].panel === panel));
  }

  of(panel, breaks) {
    const found = panel === MECHANISM ? [...this.joints(), ...this.numbers()] : [];
    found.push(...this.marks(panel), ...this.lines(panel, breaks), ...this.vectors(panel));
    const rect = this.plates.views[panel].rect;
    return found.filter(wish => wish.spots.some(spot => finite(spot) && holds(rect, spot))).map(wish => this.sized(wish));
  }

  sized(wish) {
    const {LETTER, TEXT, CAPS, BALLOON} = this.rules, size = wish.minor || wish.balloon ? TEXT : LETTER;
    const box = wish.balloon ? [2 * BALLOON * size, 2 * BALLOON * size] : [wish.wide, size * (CAPS + wish.depth)];
    return Object.assign(wish, {size, box, key: `${wish.step ?? ""}|${wish.label}`});
  }

  // several letters one after another
  joined(letters, between, size) {
    const {ADVANCE} = this.rules, runs = [];
    for (const {runs: own} of letters) {
      for (const [text, level] of [...(runs.length ? [[between, 0]] : []), ...own]) {
        const last = runs[runs.length - 1];
        if (last && last[1] === level) last[0] += text; else runs.push([text, level]);
      }
    }
    const more = [...between].reduce((sum, char) => sum + ADVANCE[char], 0) * size, bold = letters.every(one => one.bold);
    return {runs, bold, depth: Math.max(...letters.map(one => one.depth)),
            wide: letters.reduce((sum, one) => sum + one.wide, more * (letters.length - 1) * (bold ? 1.25 : 1))};
  }

  figures(steps) {
    const text = steps.map(step => this.data.steps[step].number).join(", "), {ADVANCE, TEXT, DEPTH} = this.rules;
    const wide = [...text].reduce((sum, char) => sum + (ADVANCE[char] ?? ADVANCE[0]), 0) * TEXT;
    return {text, runs: [[text, 0]], wide, bold: false, depth: DEPTH, minor: true, pen: this.data.uses.faint};
  }

  // things by where they lie: those that lie together are one
  together(things, place, near) {
    const found = [];
    for (const thing of things) {
      const spot = place(thing), there = found.find(other => distance(other.spot, spot) < near);
      if (there) there.things.push(thing); else found.push({spot, things: [thing]});
    }
    return found;
  }

  joints() {
    const {data, plates, rules} = this, names = data.points.map(([name]) => name);
    return this.together(names.map((_, i) => i), i => plates.spots[i], rules.NEAR).map(({spot, things}) => ({
      ...this.joined(things.map(i => data.joints[i]), " ≡ ", rules.LETTER), label: things.map(i => names[i]).join(","),
      spots: [spot], clear: rules.RADIUS + 0.3, pen: data.uses.letters}));
  }

  numbers() {
    return this.data.numbers.map(({label, letter, clear, free, frame, spots}) => {
      const way = this.mechanism.turned(frame);
      return {...letter, label, clear, free, balloon: true, pen: this.data.uses.letters,
              spots: spots.map(spot => this.mechanism.spot(spot, way))};
    });
  }

  marks(panel) {
    const {data: {steps, uses}, plates, rules} = this, found = [];
    const marks = this.stepsOn[panel].filter(i => steps[i].number && steps[i].spoken && plates.shown(i));
    for (const {spot, things} of this.together(marks, i => plates.at[i], rules.TOGETHER)) {
      const joint = panel === MECHANISM && plates.spots.some(other => distance(other, spot) < 1);
      const clear = joint ? rules.RADIUS + 0.4 : 0.6, spots = [spot];
      const named = things.filter(i => steps[i].name), bare = things.filter(i => !steps[i].name);
      if (named.length)
        found.push({...this.joined(named.map(i => steps[i].letter), ", ", rules.LETTER), spots, clear, step: named[0],
                    label: named.map(i => steps[i].name).join(","), pen: uses.letters});
      if (bare.length) {
        const told = this.figures(bare);
        found.push({...told, spots, clear, step: bare[0], label: `point ${told.text}`});
      }
    }
    return found;
  }

  lines(panel, breaks) {
    const {data: {steps, uses}, plates, rules} = this, found = [];
    for (const i of this.stepsOn[panel]) {
      const stretch = plates.stretches[i], step = steps[i];
      if (!stretch) continue;
      const spots = rules.ALONG.map(t => between(...stretch.ends, t)), own = {spots, clear: 0.5, step: i, free: true};
      if (step.name) found.push({...step.letter, ...own, label: step.name, pen: uses.letters});
      else if (step.spoken) found.push({...this.figures([i]), ...own, label: `line ${step.number}`});
      for (const {start, end, to} of breaks.get(i) ?? [])
        found.push({...steps[to].to, spots: [between(start, end, 0.5)], clear: 0.6, minor: true, step: i,
                    label: `to ${steps[to].text} ${i}`, pen: uses.faint});
    }
    return found;
  }

  vectors(panel) {
    const {data: {steps}, plates, rules} = this, spans = [], found = [];
    const same = ([p, q], [s, t]) => distance(p, s) < rules.TOGETHER && distance(q, t) < rules.TOGETHER;
    for (const vector of plates.vectorsOn[panel].filter(one => one.shown)) {
      const span = spans.find(one => same(one.ends, vector.ends));
      if (span) span.vectors.push(vector); else spans.push({ends: vector.ends, vectors: [vector]});
    }
    for (const {ends, vectors} of spans) {
      const first = vectors[0], name = steps[first.end].name, answered = spans.some(one => same(one.ends, [ends[1], ends[0]]));
      const told = vectors.filter(({letter}, i) => letter && letter !== name
        && vectors.findIndex(other => other.letter === letter) === i);
      if (told.length)
        found.push({...this.joined(told.map(one => one.runs), ", ", rules.LETTER), pen: first.pen, clear: 0.7, free: true,
                    spots: (answered ? rules.NEAR_HEAD : rules.MIDDLE).map(t => between(...ends, t)), step: first.of,
                    label: told.map(one => one.letter).join(" ")});
    }
    return found;
  }
}

// ---- what letters should not cover

class Obstacles {
  constructor(data) { Object.assign(this, {rules: data.measures, pens: data.pens, lines: [], boxes: [], marks: []}); }

  add(item) {
    const {width} = this.pens[item.pen], price = 1 + 5 * width, {THICK} = this.rules;
    if (item.tag === "line") for (let i = 1; i < item.spots.length; i++)
      this.line(item.spots[i - 1], item.spots[i], width > THICK ? 5 * width : price, width > THICK ? width / 2 : 0);
    else if (item.tag === "arc") {
      const parts = Math.max(1, Math.ceil((item.end - item.start) / 12)), step = (item.end - item.start) / parts;
      for (let i = 0; i < parts; i++)
        this.line(onArc(item, item.start + i * step), onArc(item, item.start + (i + 1) * step), price, 0);
    } else if (item.tag === "arrow") {
      this.line(item.start, item.end, price, 0);
      const way = unit(item.start, item.end), half = item.head / 6;
      this.boxes.push([...bounds([item.end, off(item.end, way, -item.head, half), off(item.end, way, -item.head, -half)], 0), 4]);
    } else if (item.tag === "circle") this.boxes.push([...bounds([item.at], item.r + 0.2), 5]);
    else if (item.layer !== "plates") this.boxes.push([...bounds(item.spots, 0), 3]);
  }

  line(p, q, price, half) {
    if (finite(p) && finite(q)) this.lines.push([p, q, price, half, bounds([p, q], half), distance(p, q)]);
  }

  // the same, as far as they meet a box
  near(box) {
    const found = new Obstacles({measures: this.rules, pens: this.pens});
    found.lines = this.lines.filter(line => overlap(line[4], box, 0));
    found.boxes = this.boxes.filter(other => overlap(other, box, 0));
    found.marks = this.marks.filter(mark => holds(box, mark));
    return found;
  }

  // what it costs to cover them with a box that stands for a spot
  price(box, spot, led, air = this.rules.AIR) {
    const {FAULT, TOUCH, BESIDE, MISTAKEN, STRANGER} = this.rules, cell = grown(box, air);
    let cost = 0, through = false, hidden = false, mistaken = false;
    for (const [p, q, rate, half, bound, long] of this.lines) {
      if (!overlap(bound, cell, 0)) continue;
      const part = segment(half ? grown(cell, half) : cell, p, q);
      if (!part) continue;
      cost += rate * ((part[1] - part[0]) * long + TOUCH);
      through ||= segment(half ? grown(box, half) : air > this.rules.AIR ? cell : box, p, q) !== null;
    }
    for (const other of this.boxes)
      if (overlap(other, cell, 0)) {
        const wide = Math.min(other[2], cell[2]) - Math.max(other[0], cell[0]);
        cost += other[4] * (wide * (Math.min(other[3], cell[3]) - Math.max(other[1], cell[1])) + TOUCH);
        hidden ||= overlap(other, box, 0);
      }
    const near = led ? 0 : gap(box, spot) + BESIDE;
    for (const mark of this.marks) {
      const far = gap(box, mark);
      if (far >= near || distance(mark, spot) <= BESIDE) continue;
      cost += STRANGER;
      mistaken ||= far < near - BESIDE - MISTAKEN;
    }
    return cost + FAULT * (through + hidden + mistaken);
  }
}

// ---- where they stand

class Letters {
  constructor(data) {
    Object.assign(this, {data, rules: data.measures, standing: new Map(), usual: new Map()});
  }

  // the place of every letter of a panel: at which of its spots, how far off, and its box
  placed(panel, wishes, obstacles, home) {
    const {name, rect} = this.data.panels[panel], sheet = key => this.data.places[`${name}|${key}`];
    const letters = wishes.map(wish => {
      const id = `${name}|${wish.key}`, place = home ? sheet(wish.key) : this.standing.get(id) ?? sheet(wish.key);
      return this.stood({wish, id, sheet: sheet(wish.key)}, place ?? null, rect);
    });
    for (const letter of letters) if (!letter.box) this.moved(letter, letters, obstacles, rect);
    if (home) for (const letter of letters) this.usual.set(letter.id, obstacles.price(letter.box, letter.spot, letter.place[3]));
    else for (let round = 0; round < ROUNDS; round++)
      if (!letters.filter(letter => this.improved(letter, letters, obstacles, rect)).length) break;
    for (const letter of letters) this.standing.set(letter.id, letter.place);
    return letters;
  }

  // a letter at a place; nowhere, where its spot is not on the panel or the place is not
  stood(letter, place, rect) {
    const spot = place && letter.wish.spots[place[0]], [wide, high] = letter.wish.box;
    const box = spot && [spot[0] + place[1], spot[1] + place[2], spot[0] + place[1] + wide, spot[1] + place[2] + high];
    const there = box && holds(rect, spot) && holds(grown(rect, 0.01), box) && holds(grown(rect, 0.01), [box[2], box[3]]);
    return Object.assign(letter, there ? {place, spot, box} : {place: null, spot: null, box: null});
  }

  clash(letter, box, letters, air = 0) {
    let cost = 0;
    for (const other of letters)
      if (other !== letter && other.box && overlap(other.box, box, this.rules.AIR + air))
        cost += this.rules.CLASH * (1 + Math.max(0, Math.min(other.box[2], box[2]) - Math.max(other.box[0], box[0]))
          * Math.max(0, Math.min(other.box[3], box[3]) - Math.max(other.box[1], box[1])));
    return cost;
  }

  improved(letter, letters, obstacles, rect) {
    const own = letter.sheet, usual = this.usual.get(letter.id) ?? 0;
    if (own && letter.place !== own) {
      const there = this.stood({wish: letter.wish}, own, rect);
      if (there.box && obstacles.price(there.box, there.spot, own[3], this.rules.AIR + ROOMY) <= usual + TROUBLE / 2
          && !this.clash(letter, there.box, letters, ROOMY)) {
        this.stood(letter, own, rect);
        return true;
      }
    }
    const cost = obstacles.price(letter.box, letter.spot, letter.place[3]) + this.clash(letter, letter.box, letters);
    return cost > TROUBLE + (letter.place === own ? usual : 0) && this.moved(letter, letters, obstacles, rect, cost);
  }

  // whether a letter went to a place that is clearly better than where it stands
  moved(letter, letters, obstacles, rect, cost = Infinity) {
    const {wish} = letter, reach = RINGS[RINGS.length - 1][0] + wish.clear + Math.max(...wish.box) + 2;
    let best = null, least = cost - BETTER;
    wish.spots.forEach((spot, at) => {
      if (!finite(spot) || !holds(rect, spot)) return;
      const near = obstacles.near(grown([...spot, ...spot], reach));
      for (const [ring, price] of RINGS) {
        const led = ring > this.rules.LED, paid = price + (wish.free ? 0.05 * at + (led ? this.rules.LEADER : 0) : 0);
        for (let way = 0; way < WAYS; way++) {
          const first = paid + this.rules.TASTE * ((way + 14) % 16);
          if (first >= least) continue;
          const place = [at, ...this.offset(wish, ring, way), led], {box} = this.stood({wish}, place, rect);
          if (!box) continue;
          const clash = first + this.clash(letter, box, letters), all = clash < least ? clash + near.price(box, spot, led) : clash;
          if (all < least) [best, least] = [place, all];
        }
      }
    });
    if (best) this.stood(letter, best, rect);
    else if (!letter.box) this.pushed(letter, rect);
    return best !== null;
  }

  // from a spot to the lower left corner of a letter so far off it
  offset({clear, box: [wide, high]}, ring, way) {
    const x = Math.cos(2 * Math.PI * way / WAYS), y = Math.sin(2 * Math.PI * way / WAYS), most = Math.max(Math.abs(x), Math.abs(y));
    return [(clear + ring) * x + (x / most - 1) * wide / 2, (clear + ring) * y + (y / most - 1) * high / 2];
  }

  // as near to its spot as the panel allows
  pushed(letter, rect) {
    const at = letter.wish.spots.findIndex(spot => finite(spot) && holds(rect, spot)), [x, y] = letter.wish.spots[at];
    const [wide, high] = letter.wish.box, left = Math.min(Math.max(x, rect[0]), rect[2] - wide);
    const low = Math.min(Math.max(y, rect[1]), rect[3] - high);
    Object.assign(letter, {place: [at, left - x, low - y, false], spot: [x, y], box: [left, low, left + wide, low + high]});
  }
}
