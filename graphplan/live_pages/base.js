// ---- what all pages have: their words, the button that plays, and handles that a hand takes

const by = id => document.getElementById(id);
const calm = matchMedia("(prefers-reduced-motion: reduce)"), small = matchMedia("(max-width: 700px)");
const GRIP = 14;  // pixels: the radius of a handle, as a finger wants it
const FARTHEST_MM = 20000;  // of paper: marks that lie further off are not drawn, and told with a dash
const ONE_PLACE_MM = 0.5;  // points no further apart have one handle

// the marks of these values that can be drawn: but for those that are `kept` none so far off that no paper holds it
function onPaper(values, steps, scale, kept = new Set()) {
  return values.map((value, i) => {
    const [a, b, c] = value, far = {point: () => Math.hypot(a, b), line: () => c / Math.hypot(a, b),
      circle: () => Math.hypot(a, b, Math.sqrt(Math.max(0, c))), opening: () => Math.sqrt(a)}[steps[i].kind]();
    return kept.has(i) || Math.abs(far) * scale(steps[i]) < FARTHEST_MM ? value : value.map(() => NaN);
  });
}

// a page that speaks languages; of its data it has `languages`, `words` and `signs` by language
class SpokenPage {
  constructor() {
    this.data = JSON.parse(by("data").textContent);
    this.svg = by("picture");
    this.language = document.documentElement.lang;
    by("language").append(...Object.entries(this.data.languages).map(([code, name]) => new Option(name, code, false, code === this.language)));
    by("print").addEventListener("click", () => print());
    this.few("language", this.data.languages);
  }

  // a choice of one is none
  few(id, choices) {
    by(id).hidden = document.querySelector(`label[for=${id}]`).hidden = Object.keys(choices).length < 2;
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

  // the number that somebody has typed; not a number where it is none
  typed(text) {
    const decimal = this.data.signs[this.language]["."] ?? ".";
    return text.trim() ? Number(text.replaceAll("−", "-").replace("°", "").replace(decimal, ".").trim()) : NaN;
  }

  // the page's own words
  spellWords(title) {
    document.documentElement.lang = this.language;
    document.title = document.querySelector("h1").textContent = title;
    this.svg.setAttribute("aria-label", title);
    for (const node of document.querySelectorAll("[data-word]")) node.textContent = this.say(node.dataset.word);
    for (const node of document.querySelectorAll("[data-label]")) {
      node.setAttribute("aria-label", this.say(node.dataset.label));
      if (node.title) node.title = this.say(node.dataset.label);
    }
  }

  tellPlaying() {
    const word = this.say(this.playing ? "pause" : "play");
    by("run").firstElementChild.textContent = by("run").title = word;
    by("run").setAttribute("aria-label", word);
    by("run").setAttribute("aria-pressed", this.playing);
  }

  screen(place) {
    const at = new DOMPoint(...place).matrixTransform(this.svg.getScreenCTM());
    return [at.x, at.y];
  }
}

// the handles of points; `where` says where a point is, `drag` takes it somewhere, `left` is told when a hand lets go, and
// `step` says how far an arrow key moves it
class Grips {
  constructor(page, hand) { Object.assign(this, {page, hand, grips: new Map(), held: null, scale: 1}, hand); }

  // the handles of these points and no others
  take(names) {
    for (const [name, grip] of this.grips) if (!names.includes(name)) { grip.remove(); this.grips.delete(name); }
    for (const name of names) {
      if (!this.grips.has(name)) this.grips.set(name, this.grip(name));
      this.grips.get(name).setAttribute("aria-label", this.page.say("handle", name.replace("_", " ")));
    }
    this.measure();
  }

  grip(name) {
    const {page} = this, grip = made("circle", {class: "handle", tabindex: 0, role: "button", "data-point": name});
    by("handles").append(grip);
    // a finger on it scrolls no page; browsers heed touch-action on an SVG's own box alone
    grip.addEventListener("touchstart", event => event.preventDefault(), {passive: false});
    grip.addEventListener("pointerdown", event => {
      if (event.button) return;
      event.preventDefault();
      page.rest();
      grip.setPointerCapture(event.pointerId);
      document.activeElement.blur();  // a mouse takes no keys away from the steps
      this.screen = page.svg.getScreenCTM().inverse();
      const [x, y] = page.picture.back(this.spot(event)), [p, q] = this.where(name);
      this.held = {name, id: event.pointerId, off: [p - x, q - y]};
      grip.classList.add("held");
    });
    grip.addEventListener("pointermove", event => {
      if (this.held?.id !== event.pointerId) return;
      this.aim = this.spot(event);
      this.pulling ??= requestAnimationFrame(() => this.pull());
    });
    for (const end of ["pointerup", "pointercancel"]) grip.addEventListener(end, event => {
      if (this.held?.id !== event.pointerId) return;
      cancelAnimationFrame(this.pulling);
      if (this.aim) this.pull();
      grip.classList.remove("held");
      this.held = null;
      this.left();
    });
    grip.addEventListener("keydown", event => {
      const way = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key];
      if (!way || event.altKey || event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      const step = this.step(event.shiftKey), [x, y] = this.where(name);
      this.drag(name, [x + way[0] * step, y + way[1] * step]);
      this.left(event);
    });
    return grip;
  }

  // a pointer's place on the picture, in its mm, as that stood when the pointer went down
  spot(event) {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.screen);
    return [at.x, at.y];
  }

  pull() {
    const {name, off} = this.held, [x, y] = this.page.picture.back(this.aim), pixel = this.screen.a / this.page.picture.scale;
    this.pulling = this.aim = undefined;
    this.drag(name, [x + off[0], y + off[1]], pixel);
  }

  // handles lie on their points; of points that lie together the first has it
  put(names, place) {
    const taken = [];
    for (const name of names) {
      const [x, y] = place(name), grip = this.grips.get(name);
      if (![x, y].every(Number.isFinite)) continue;
      grip.setAttribute("cx", x);
      grip.setAttribute("cy", y);
      const covered = taken.some(([u, v]) => Math.hypot(x - u, y - v) < ONE_PLACE_MM);
      grip.style.display = covered ? "none" : "";
      if (!covered) taken.push([x, y]);
    }
  }

  // they are as large as a finger on any screen
  measure() {
    this.scale = this.page.svg.getScreenCTM()?.a || 1;
    for (const grip of this.grips.values()) grip.setAttribute("r", GRIP / this.scale);
  }
}
