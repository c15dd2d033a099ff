// Where letters stand in a pose: in the best of some rings of places around what they name. A letter leaves its place
// only for one that is clearly better, so that none flickers; sizes of vectors stand where they cover no letter, or nowhere.

const RINGS = [[0.7, 0], [1.6, 0.8], [2.8, 2], [4.5, 4], [7, 7], [10, 11], [14, 16], [20, 24]], WAYS = 16;  // gaps in mm, their prices
const DIRECTIONS = Array.from({length: WAYS}, (_, way) =>
  [Math.cos(2 * Math.PI * way / WAYS), Math.sin(2 * Math.PI * way / WAYS)]);
const TROUBLE = 6, BETTER = 4;  // prices: of what a letter may cover before it looks elsewhere, and what that must save
const WORDS = 11;  // of a line among obstacles
const ROUNDS = 6, SPOTS = 3;  // so often letters look around at rest; in motion at so many of their spots
const AT_ONCE = 2, WAIT = 20;  // so many letters look in a pose of a motion; one that found nothing lets so many go by

const overlap = (a, b, air) => Math.min(a[2], b[2]) - Math.max(a[0], b[0]) + air > 0
  && Math.min(a[3], b[3]) - Math.max(a[1], b[1]) + air > 0;
const gap = ([left, low, right, high], [x, y]) =>
  Math.hypot(Math.max(left - x, x - right, 0), Math.max(low - y, y - high, 0));
const grown = ([left, low, right, high], air) => [left - air, low - air, right + air, high + air];
const bounds = (spots, air) => {
  const xs = spots.map(spot => spot[0]), ys = spots.map(spot => spot[1]);
  return [Math.min(...xs) - air, Math.min(...ys) - air, Math.max(...xs) + air, Math.max(...ys) + air];
};

// ---- what needs a letter

class Wishes {
  constructor(data, plates) {
    Object.assign(this, {data, plates, rules: data.measures});
    const all = data.steps.map((_, i) => i);
    this.stepsOn = data.panels.map((_, panel) => all.filter(i => data.steps[i].panel === panel));
  }

  of(panel, breaks, numbered) {
    const found = panel === MECHANISM ? [...this.joints(), ...this.numbers()] : [];
    found.push(...this.marks(panel), ...this.lines(panel, breaks), ...this.vectors(panel), ...this.sizes(panel));
    const rect = this.plates.views[panel].rect;
    const shown = found.filter(wish => (numbered || !wish.minor || wish.step === undefined) && wish.spots.some(spot => finite(spot) && holds(rect, spot)));
    return shown.map(wish => this.sized(wish));
  }

  sized(wish) {
    const {LETTER, TEXT, CAPS, BALLOON} = this.rules, size = wish.size ?? (wish.minor || wish.balloon ? TEXT : LETTER);
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
    const more = [...between].reduce((sum, char) => sum + ADVANCE[char], 0) * size;
    const bold = letters.every(one => one.bold);
    return {runs, bold, depth: Math.max(...letters.map(one => one.depth)),
            wide: letters.reduce((sum, one) => sum + one.wide, more * (letters.length - 1) * (bold ? 1.25 : 1))};
  }

  figures(steps) {
    return {...this.set(steps.map(step => this.data.steps[step].number).join(", "), this.rules.TEXT), minor: true, pen: this.data.uses.faint};
  }

  set(text, size) {
    const {ADVANCE, DEPTH} = this.rules, wide = [...text].reduce((sum, char) => sum + (ADVANCE[char] ?? ADVANCE[0]), 0) * size;
    return {text, runs: [[text, 0]], wide, bold: false, depth: DEPTH, size};
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
    return this.data.numbers.map(({label, letter, clear, free, balloon, frame, spots}) => {
      const way = this.mechanism.turned(frame);
      return {...letter, label, clear, free, balloon, minor: true, pen: this.data.uses.letters,
              spots: spots.map(spot => this.mechanism.spot(spot, way))};
    });
  }

  marks(panel) {
    const {data: {steps, uses}, plates, rules} = this, found = [];
    const marks = this.stepsOn[panel].filter(i => (steps[i].number || !this.data.points.length) && steps[i].spoken && plates.shown(i));
    for (const {spot, things} of this.together(marks, i => plates.at[i], rules.TOGETHER)) {
      const joint = panel === MECHANISM && plates.spots.some(other => distance(other, spot) < 1);
      const clear = joint ? rules.RADIUS + 0.4 : 0.6;
      const named = things.filter(i => steps[i].name), bare = things.filter(i => !steps[i].name);
      if (named.length)
        found.push({...this.joined(named.map(i => steps[i].letter), ", ", rules.LETTER), spots: [plates.at[named[0]]], clear, step: named[0],
                    label: named.map(i => steps[i].name).join(","), pen: uses.letters});
      if (bare.length) {
        const told = this.figures(bare);
        found.push({...told, spots: [plates.at[bare[0]]], clear, step: bare[0], label: `point ${told.text}`});
      }
    }
    return found;
  }

  lines(panel, breaks) {
    const {data: {steps, uses}, plates, rules} = this, found = [], told = [];
    for (const i of this.stepsOn[panel]) {
      const stretch = plates.stretches[i], step = steps[i];
      if (stretch) {
        const spots = rules.ALONG.map(t => between(...stretch.ends, t)), own = {spots, clear: 0.5, step: i, free: true};
        if (step.name) found.push({...step.letter, ...own, label: step.name, pen: uses.letters});
        else if (step.spoken) found.push({...this.figures([i]), ...own, label: `line ${step.number}`});
      }
      for (const {start, end, to} of breaks.get(i) ?? []) {
        const near = between(start, end, 0.5);
        if (told.some(([mark, spot]) => mark === to && distance(near, spot) < rules.SAME_BREAK)) continue;
        told.push([to, near]);
        found.push({...steps[to].to, spots: [near], clear: 0.6, minor: true, step: i,
                    label: `to ${steps[to].text} ${i}`, pen: uses.faint});
      }
    }
    return found;
  }

  vectors(panel) {
    const {plates, rules} = this, spans = [], found = [];
    const same = ([p, q], [s, t]) => distance(p, s) < rules.TOGETHER && distance(q, t) < rules.TOGETHER;
    for (const vector of plates.vectorsOn[panel].filter(one => one.shown)) {
      const span = spans.find(one => same(one.ends, vector.ends));
      if (span) span.vectors.push(vector); else spans.push({ends: vector.ends, vectors: [vector]});
    }
    for (const {ends, vectors} of spans) {
      const answered = spans.some(one => same(one.ends, [ends[1], ends[0]]));
      const told = vectors.filter(({letter}, i) => letter && vectors.findIndex(other => other.letter === letter) === i);
      const [first] = told;
      if (told.length)
        found.push({...this.joined(told.map(one => one.runs), ", ", rules.LETTER), pen: first.pen, clear: 0.7,
                    spots: (answered ? rules.NEAR_HEAD : rules.MIDDLE).map(t => between(...ends, t)),
                    step: first.of, label: told.map(one => one.letter).join(" "), free: true});
    }
    return found;
  }

  // the sizes of vectors at their heads, as long as these are drawn
  sizes(panel) {
    const shown = this.plates.vectorsOn[panel].filter(one => one.shown && one.label && this.told(one.label));
    return shown.map(({label, ends, pen, of}) => ({...this.set(this.told(label), this.rules.LETTER), spots: [ends[1], between(...ends, 0.6)],
      clear: 0.9, step: of, label: `size ${label}`, pen, free: true, optional: true}));
  }
}

// ---- what letters should not cover

class Obstacles {
  constructor(data) { Object.assign(this, {rules: data.measures, pens: data.pens, waiting: [], lines: [], boxes: [], marks: []}); }

  // items wait until a letter asks for them: in most poses of a motion none does
  add(item) { this.waiting.push(item); }

  settle() {
    for (const item of this.waiting.splice(0)) this.enter(item);
  }

  enter(item) {
    const {width} = this.pens[item.pen], price = 1 + 5 * width, {MIN_SURFACE_MM} = this.rules;
    if (item.tag === "line") for (let i = 1; i < item.spots.length; i++)
      this.line(item.spots[i - 1], item.spots[i], width > MIN_SURFACE_MM ? 5 * width : price, width > MIN_SURFACE_MM ? width / 2 : 0);
    else if (item.tag === "arc") {
      const parts = Math.max(1, Math.ceil((item.end - item.start) / 12)), step = (item.end - item.start) / parts;
      for (let i = 0; i < parts; i++)
        this.line(onArc(item, item.start + i * step), onArc(item, item.start + (i + 1) * step), price, 0);
    } else if (item.tag === "arrow") {
      this.line(item.start, item.end, price, 0);
      const way = unit(item.start, item.end), half = item.head / 6, back = side => off(item.end, way, -item.head, side);
      this.boxes.push([...bounds([item.end, back(half), back(-half)], 0), 4]);
    } else if (item.tag === "circle") this.boxes.push([...bounds([item.at], item.r + 0.2), 5]);
    else if (item.layer !== "plates") this.boxes.push([...bounds(item.spots, 0), 3]);
  }

  line([x, y], [u, v], price, half) {
    if (!Number.isFinite(x + y + u + v)) return;
    this.lines.push(Math.min(x, u) - half, Math.min(y, v) - half, Math.max(x, u) + half, Math.max(y, v) + half,
                    x, y, u, v, price, half, Math.hypot(u - x, v - y));  // its bounds first: most lines are far away
  }

  // the same, as far as they meet a box
  near(box) {
    this.settle();
    const found = new Obstacles({measures: this.rules, pens: this.pens}), {lines} = this;
    const [left, low, right, high] = box;
    for (let i = 0; i < lines.length; i += WORDS)
      if (lines[i] < right && lines[i + 1] < high && lines[i + 2] > left && lines[i + 3] > low)
        for (let word = i; word < i + WORDS; word++) found.lines.push(lines[word]);
    found.boxes = this.boxes.filter(other => overlap(other, box, 0));
    found.marks = this.marks.filter(mark => holds(box, mark));
    return found;
  }

  // what it costs to cover them with a box that stands for a spot
  price(box, spot, led) {
    if (this.waiting.length) this.settle();
    const {FAULT, MISTAKEN_TIMES, AIR} = this.rules, cell = grown(box, AIR), [left, low, right, high] = cell, {lines} = this;
    let cost = 0, faults = 0;
    for (let i = 0; i < lines.length; i += WORDS)
      if (lines[i] < right && lines[i + 1] < high && lines[i + 2] > left && lines[i + 3] > low) {
        const p = [lines[i + 4], lines[i + 5]], q = [lines[i + 6], lines[i + 7]], half = lines[i + 9];
        const part = segment(half ? grown(cell, half) : cell, p, q);
        if (!part) continue;
        cost += lines[i + 8] * ((part[1] - part[0]) * lines[i + 10] + this.rules.TOUCH);
        if (!(faults & 1) && segment(half ? grown(box, half) : box, p, q)) faults |= 1;
      }
    for (const other of this.boxes)
      if (other[0] < right && other[1] < high && other[2] > left && other[3] > low) {
        const wide = Math.min(other[2], right) - Math.max(other[0], left);
        cost += other[4] * (wide * (Math.min(other[3], high) - Math.max(other[1], low)) + this.rules.TOUCH);
        if (overlap(other, box, 0)) faults |= 2;
      }
    const [more, mistaken] = this.mistaken(box, spot, led);
    return cost + more + FAULT * ((faults & 1) + (faults >> 1) + MISTAKEN_TIMES * mistaken);
  }

  // what it costs to stand nearer to other marks than to the own one, and whether it is much nearer
  mistaken(box, spot, led) {
    const {BESIDE, STRANGER} = this.rules, near = led ? 0 : gap(box, spot) + BESIDE;
    const around = grown(box, near);
    let cost = 0, mistaken = false;
    for (const mark of this.marks) {
      if (!holds(around, mark)) continue;
      const far = gap(box, mark);
      if (far >= near || distance(mark, spot) <= BESIDE) continue;
      cost += STRANGER;
      mistaken ||= far < near - BESIDE;
    }
    return [cost, mistaken];
  }
}

// ---- where they stand

const named = id => id.replace(/\|\d+\|(?!point |line |to )/, "||");  // by what is written: steps differ, names do not

class Letters {
  constructor(data) {
    Object.assign(this, {data, rules: data.measures});
    for (const own of ["standing", "before", "waits"]) this[own] = new Map();
  }

  // letters of another construction that is drawn no more leave their places to those of the same names
  follow(letters) {
    this.standing.clear();
    this.before = new Map([...letters.standing].map(([id, place]) => [named(id), place]));
  }

  // the letters of a panel that have a place: at which of its spots, how far off, and its box.
  // In motion few letters look for better places at a time, and those that found none wait; at rest all do.
  placed(panel, wishes, obstacles, {rest, look = true}) {
    const {name, rect} = this.data.panels[panel];
    const letters = wishes.map(wish => {
      const id = `${name}|${wish.key}`;
      return this.stood({wish, id}, this.standing.get(id) ?? this.before.get(named(id)) ?? null, rect);
    });
    for (const letter of letters) if (!letter.box) this.moved(letter, letters, obstacles, rect, SPOTS);
    if (look) for (let round = 0; round < (rest ? ROUNDS : 1); round++)
      if (!this.improved(letters, obstacles, rest, rect)) break;
    for (const letter of letters) if (letter.place) this.standing.set(letter.id, letter.place);
    for (const letter of letters) if (letter.wish.optional && letter.box && this.clash(letter, letter.box, letters)) letter.box = null;
    return letters.filter(letter => letter.box);
  }

  // a letter at a place; nowhere, where its spot or the place is not on the panel
  stood(letter, place, rect) {
    const spot = place && letter.wish.spots[place[0]], box = spot && this.boxed(letter.wish, spot, place, rect);
    return Object.assign(letter, box && holds(rect, spot) ? {place, spot, box} : {place: null, spot: null, box: null});
  }

  boxed({box: [wide, high]}, [x, y], [, dx, dy], rect) {
    const left = x + dx, low = y + dy, right = left + wide, top = low + high;
    return left >= rect[0] - 0.01 && low >= rect[1] - 0.01 && right <= rect[2] + 0.01 && top <= rect[3] + 0.01
      ? [left, low, right, top] : null;
  }

  covered({box, spot, place}, obstacles) { return obstacles.price(box, spot, place[3]); }

  clash(letter, box, letters) {
    let cost = 0;
    for (const other of letters)
      if (other !== letter && other.box && overlap(other.box, box, this.rules.AIR))
        cost += this.rules.CLASH * (1 + Math.max(0, Math.min(other.box[2], box[2]) - Math.max(other.box[0], box[0]))
          * Math.max(0, Math.min(other.box[3], box[3]) - Math.max(other.box[1], box[1])));
    return cost;
  }

  // how many letters went off what they cover, the worst first
  improved(letters, obstacles, rest, rect) {
    const costs = new Map(letters.map(letter => [letter, letter.box ? this.covered(letter, obstacles) + this.clash(letter, letter.box, letters) : Infinity]));
    const troubled = letters.filter(letter => costs.get(letter) > TROUBLE)
      .sort((p, q) => costs.get(q) - costs.get(p)).filter(letter => rest || this.patient(letter));
    return troubled.slice(0, rest ? Infinity : AT_ONCE).filter(letter => {
      const better = this.moved(letter, letters, obstacles, rect, rest ? Infinity : SPOTS, costs.get(letter));
      if (!better) this.waits.set(letter.id, WAIT);
      return better;
    }).length;
  }

  // whether a letter has waited since it found no better place
  patient({id}) {
    const left = this.waits.get(id) ?? 0;
    if (left) this.waits.set(id, left - 1);
    return !left;
  }

  // whether a letter went to a place that is clearly better than where it stands
  moved(letter, letters, obstacles, rect, most, cost = Infinity) {
    const {wish} = letter, reach = RINGS[RINGS.length - 1][0] + wish.clear + Math.max(...wish.box) + 2;
    let best = null, least = cost - BETTER;
    for (const at of this.tried(letter, rect).slice(0, most)) {
      const spot = wish.spots[at], area = grown([...spot, ...spot], reach), near = obstacles.near(area);
      const others = letters.filter(other => other !== letter && other.box && overlap(other.box, area, 0));
      for (const [ring, price] of RINGS) {
        const led = ring > this.rules.LED;
        const paid = price + (wish.free ? 0.05 * at + (led ? this.rules.LEADER : 0) : 0);
        if (paid >= least) break;
        for (let way = 0; way < WAYS; way++) {
          const place = [at, ...this.offset(wish, ring, way), led], box = this.boxed(wish, spot, place, rect);
          let all = paid + this.rules.TASTE * ((way + 14) % 16);
          if (!box || all >= least) continue;
          const clash = this.clash(letter, box, others);
          all += clash && wish.optional ? Infinity : clash;
          if (all < least) all += near.price(box, spot, led);
          if (all < least) [best, least] = [place, all];
        }
      }
    }
    if (best) this.stood(letter, best, rect);
    else if (!letter.box && !wish.optional) this.pushed(letter, rect);
    return best !== null;
  }

  // of the spots of a letter where it stands, and the first ones
  tried({wish, place}, rect) {
    const there = wish.spots.map((_, at) => at).filter(at => finite(wish.spots[at]) && holds(rect, wish.spots[at]));
    return [...new Set([...(place && there.includes(place[0]) ? [place[0]] : []), ...there])];
  }

  // from a spot to the lower left corner of a letter so far off it
  offset({clear, box: [wide, high]}, ring, way) {
    const [x, y] = DIRECTIONS[way], most = Math.max(Math.abs(x), Math.abs(y)), far = clear + ring;
    return [far * x + (x / most - 1) * wide / 2, far * y + (y / most - 1) * high / 2];
  }

  // as near to its spot as the panel allows
  pushed(letter, rect) {
    const at = this.tried(letter, rect)[0], [x, y] = letter.wish.spots[at], [wide, high] = letter.wish.box;
    const left = Math.min(Math.max(x, rect[0]), rect[2] - wide), low = Math.min(Math.max(y, rect[1]), rect[3] - high);
    const place = [at, left - x, low - y, false];
    Object.assign(letter, {place, spot: [x, y], box: [left, low, left + wide, low + high]});
  }
}
