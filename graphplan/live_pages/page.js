// ---- the page: what is shown of which construction, in which pose, in which language

const WORDS_MS = 200, WORDS_SHARE = 30;  // between two times that words follow a hand; and so many times as long as they take
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

class Page extends SpokenPage {
  constructor() {
    super();
    this.variants = [];
    this.place = this.hurried = this.writing = 0;
    this.complaint = "";
    this.poses = new Poses(this);
    addEventListener("resize", () => this.grips.measure());
    this.parts = [new Stepping(this), new Moving(this), new Tracing(this), new Choosing(this), new Asked(this), new Viewing(this)];
    [this.stepping, this.moving, this.tracing, this.choosing, this.asked, this.viewing] = this.parts;
    by("run").addEventListener("click", () => this.play());
    for (const [id, root] of [["fold", document.body], ["more", by("controls")]]) by(id).addEventListener("click", () => {
      const pressed = by(id).getAttribute("aria-pressed") !== "true";
      by(id).setAttribute("aria-pressed", pressed);
      root.classList.toggle(id === "fold" ? "folded" : "open", id === "fold" ? !pressed : pressed);
      this.grips.measure();
      this.asked.graph(true);
    });
  }

  // ---- what is chosen

  async choose(number, language) {
    this.variants[number] ??= new Variant(await unpack(number));
    const variant = this.variants[number], other = variant !== this.variant;
    if (other && this.motion) this.motion.draws(variant.motion.programs, variant.tape);
    this.motion ??= new Motion(variant.motion, variant.tape);
    const ended = this.variant && this.place === this.count;
    if (other) this.place = ended ? Infinity : Math.min(this.place, variant.programs[0].steps.length - variant.programs[0].givens);
    Object.assign(this, {variant, language, told: variant.told(language), program: -1});
    this.templates = this.told.programs.map(({templates}) => Object.entries(templates)
      .map(([part, text]) => [part, new Template(text, this.data.signs[language])]));
    this.spell();
    this.draw();
  }

  // the page's own words, and the sheet's
  spell() {
    this.spellWords(this.told.title);
    const sheet = new DOMParser().parseFromString(this.told.svg, "image/svg+xml").documentElement;
    this.svg.replaceChildren(...sheet.childNodes);
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
    if (this.playing) this.rest();
    else if (this.motion.still) this.stepping.play();
    else this.moving.run();
  }

  rest() {
    this.stepping.rest();
    this.moving.rest();
  }

  // the marks that can be drawn, and the ends of vectors, whose scales follow them, where these are known: at a limit they
  // grow without bounds
  onPaper(values, program) {
    const {steps, panels} = this.told.pictures[program], ends = new Set(this.motion.stop ? [] : panels.flatMap(({core}) => core));
    return onPaper(values, steps, ({panel}) => panels[panel].scale, ends);
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
    const short = results ? [...new Set(this.asked.short(results))].join(", ") : "";
    this.said = said || (known ? this.say("undrawn", known) : motion.pose.served ? "" : this.say("formless"))
      || (!results ? this.say("singular") : lacking ? this.say("undrawn", lacking) : off ? this.say("differs") : short ? this.say("short", short) : "");
    if (by("said").textContent !== this.said) by("said").textContent = this.said;
  }

  translated(text) { return this.told.said?.[text] ?? text; }
}
