// ---- the page: what is shown of which construction, in which pose, in which language

const FARTHEST = 20000;  // mm of paper: marks that lie further off are not drawn, and told with a dash
const WORDS_MS = 120, WORDS_SHARE = 12;  // between two times that words follow a hand; and so many times as long as they take
const by = id => document.getElementById(id);
const calm = matchMedia("(prefers-reduced-motion: reduce)"), small = matchMedia("(max-width: 700px)");

const made = (name, look) => {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(look)) element.setAttribute(key, value);
  return element;
};

async function unpack(number) {
  const bytes = Uint8Array.from(atob(by(`pack-${number}`).textContent), char => char.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return JSON.parse(await new Response(stream).text());
}

// the value of an expression that stands in the page itself, packed
const evaluated = expression => new Function(`"use strict"; return (${expression});`)();

// one value made another: `change` is that other in a list, or the changes of its parts by key or place
function changed(value, change) {
  if (Array.isArray(change)) return change[0];
  const made = Array.isArray(value) ? [...value] : {...value};
  for (const [key, part] of Object.entries(change)) made[key] = changed(made[key], part);
  return made;
}

// one way to draw the scene, unpacked: what moves and draws it, and what is told of it by language
class Variant {
  constructor(pack) {
    Object.assign(this, {motion: pack.motion, programs: pack.programs, pack, spoken: {[pack.language]: pack.own}});
    this.tape = evaluated(`(${pack.tape})`);
    this.outputs = pack.texts.map(text => evaluated(`(${text})`));
  }

  told(language) {
    return this.spoken[language] ??= changed(this.pack.own, this.pack.others[language]);
  }
}

class Page {
  constructor() {
    this.data = JSON.parse(by("data").textContent);
    this.variants = [];
    this.svg = by("picture");
    this.language = document.documentElement.lang;
    this.place = this.hurried = this.writing = 0;
    this.complaint = "";
    this.poses = new Poses(this);
    this.parts = [new Stepping(this), new Moving(this), new Tracing(this), new Choosing(this), new Asked(this), new Viewing(this)];
    [this.stepping, this.moving, this.tracing, this.choosing, this.asked, this.viewing] = this.parts;
    by("run").addEventListener("click", () => this.play());
    for (const [id, root] of [["fold", document.body], ["more", by("controls")]]) by(id).addEventListener("click", () => {
      const pressed = by(id).getAttribute("aria-pressed") !== "true";
      by(id).setAttribute("aria-pressed", pressed);
      root.classList.toggle(id === "fold" ? "folded" : "open", id === "fold" ? !pressed : pressed);
      this.moving.measure();
      this.asked.graph(true);
    });
  }

  get words() { return this.data.words[this.language]; }

  // what is given as %, or %1 and %2, is put into words
  say(word, ...put) {
    return this.words[word].replace(/%(\d?)/g, (_, place) => put[place ? place - 1 : 0]);
  }

  // a number as it is told, in the language's own signs
  number(value, count = 4) {
    return Numbers.written(value, count).replace(/[.,]/g, sign => this.data.signs[this.language][sign] ?? sign);
  }

  // ---- what is chosen

  async choose(number, language) {
    this.variants[number] ??= new Variant(await unpack(number));
    const variant = this.variants[number], other = variant !== this.variant;
    if (other && this.motion) this.motion.draws(variant.motion.programs, variant.tape);
    this.motion ??= new Motion(variant.motion, variant.tape);
    const ended = this.variant && this.place === this.count;
    if (other) this.place = ended ? Infinity : Math.min(this.place, this.last(variant));
    Object.assign(this, {variant, language, told: variant.told(language), program: -1});
    this.templates = this.told.programs.map(({templates}) => Object.entries(templates)
      .map(([part, text]) => [part, new Template(text, this.data.signs[language])]));
    this.spell();
    this.draw();
  }

  last(variant) { return variant.programs[0].steps.length - variant.programs[0].givens; }

  // the page's own words, and the sheet's
  spell() {
    document.documentElement.lang = this.language;
    document.title = document.querySelector("h1").textContent = this.told.title;
    for (const node of document.querySelectorAll("[data-word]")) node.textContent = this.say(node.dataset.word);
    for (const node of document.querySelectorAll("[data-label]")) {
      node.setAttribute("aria-label", this.say(node.dataset.label));
      if (node.title) node.title = this.say(node.dataset.label);
    }
    const sheet = new DOMParser().parseFromString(this.told.svg, "image/svg+xml").documentElement;
    this.svg.replaceChildren(...sheet.childNodes);
    this.svg.setAttribute("aria-label", this.told.title);
    this.whole = sheet.getAttribute("viewBox").split(/[\s,]+/).map(Number);
    this.picture = new Picture(this.svg, {programs: this.told.pictures, captions: this.told.captions});
    for (const part of this.parts) part.spell?.();
    this.tellPlaying();
  }

  // ---- the pose

  get drawn() { return this.variant.programs[this.program]; }
  get count() { return this.drawn.steps.length - this.drawn.givens; }

  // everything as the pose has it, at once; words that a hand does not wait for follow when it rests
  draw() {
    const {motion} = this, values = motion.values(), program = motion.program;
    this.values = values && this.onPaper(values, program);
    this.picture.draw(program, this.values, motion.points(), motion.guides(), {pins: JSON.stringify(motion.fixed), rest: !this.moving.busy, told: label => this.asked.told(label), held: panel => this.tracing.held(panel)});
    this.svg.classList.toggle("undrawn", !values);
    if (program !== this.program) this.take(program);
    this.stepping.show();
    this.asked.strip(motion.results());
    this.write(this.moving.busy);
    this.warn();
    for (const part of [this.moving, this.tracing, this.asked]) part.draw();
  }

  // ---- the button that plays: the mechanism, or what cannot move step by step

  get playing() { return Boolean(this.stepping.playing || this.moving.running); }

  play() {
    if (this.playing) {
      this.stepping.rest();
      this.moving.rest();
    } else if (this.motion.still) this.stepping.play();
    else this.moving.run();
  }

  tellPlaying() {
    const word = this.say(this.playing ? "pause" : "play");
    by("run").firstElementChild.textContent = by("run").title = word;
    by("run").setAttribute("aria-label", word);
    by("run").setAttribute("aria-pressed", this.playing);
  }

  // the marks that can be drawn: none so far off that no paper holds it, but the ends of vectors, whose scales follow them,
  // where these are known: at a limit they grow without bounds
  onPaper(values, program) {
    const {steps, panels} = this.told.pictures[program], ends = new Set(this.motion.stop ? [] : panels.flatMap(({core}) => core));
    return values.map((value, i) => {
      const {scale} = panels[steps[i].panel], [a, b, c] = value;
      const far = {point: () => Math.hypot(a, b), line: () => c / Math.hypot(a, b),
        circle: () => Math.hypot(a, b, Math.sqrt(Math.max(0, c))), opening: () => Math.sqrt(a)}[steps[i].kind]();
      return ends.has(i) || Math.abs(far) * scale < FARTHEST ? value : value.map(() => NaN);
    });
  }

  // another construction is drawn
  take(program) {
    const ended = this.place === Infinity || (this.program >= 0 && this.place === this.count);
    this.program = program;
    this.hurried = -Infinity;  // its words wait for their numbers
    const told = this.told.programs[program];
    for (const id of ["list", "readings", "tables", "forms"]) by(id).innerHTML = told[id];
    const nodes = new Map([...document.querySelectorAll("[data-told]")].map(node => [node.dataset.told, node]));
    this.live = this.templates[program].map(([part, text]) => ({node: nodes.get(part), text, told: null}));
    this.place = ended ? this.count : Math.min(this.place, this.count);
    this.stepping.take();
    this.tracing.take();
  }

  // numbers into the words; while a hand moves the mechanism only now and then
  write(hurried) {
    clearTimeout(this.waiting);
    const now = performance.now();
    const pause = Math.max(WORDS_MS, WORDS_SHARE * this.writing);  // where words are many they come less often
    if (hurried && now - this.hurried < pause) {
      this.waiting = setTimeout(() => this.write(false), pause + 30);
      return;
    }
    this.hurried = now;
    const {windows, sheet} = this.picture, larger = windows.map(({scale}, i) => sheet.panels[i].scale / scale);
    const numbers = this.values ? this.variant.outputs[this.program](this.values, larger, Numbers) : [];
    for (const part of this.live) {
      const told = part.text.fill(numbers);
      if (part.told !== told) part.told = part.node.innerHTML = told;
    }
    this.stepping.speak();
    this.writing = performance.now() - now;
  }

  // what stops the mechanism, or the construction
  warn() {
    const {motion} = this, results = motion.results(), said = this.translated(motion.said || motion.still || "");
    const known = motion.pose.why ? this.translated(motion.pose.why) : "";
    const lacking = results ? [...new Set(this.asked.lacking(results))].join(", ") : "";
    const off = results && Object.values(results.check ?? {}).some(one => one > 1e-5);
    this.said = said || (known ? this.say("undrawn", known) : motion.pose.served ? "" : this.say("formless"))
      || (!results ? this.say("singular") : lacking ? this.say("undrawn", lacking) : off ? this.say("differs") : "");
    if (by("said").textContent !== this.said) by("said").textContent = this.said;
  }

  translated(text) { return this.told.said?.[text] ?? text; }
}
