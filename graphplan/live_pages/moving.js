// ---- moving the mechanism: by its points, by the slider, by a number, by itself

const PACE = 60, TICK = 500, GRIP = 14;  // degrees a second; ms between poses where motion is to be spared; pixels
const BACK = 1e-6;  // of the travel: what is nearer to the given pose is told as that
const ONE_PLACE_MM = 0.5, NEAR_PX = 2;  // points no further apart have one handle; how near a drag comes

class Moving {
  constructor(page) {
    Object.assign(this, {page, running: 0, scale: 1, way: 1, held: null, busy: false, grips: new Map()});
    addEventListener("resize", () => this.measure());
    by("home").addEventListener("click", () => this.home());
    by("drive").addEventListener("input", event => this.go(this.wound(Number(event.target.value)), true));
    by("drive").addEventListener("change", () => this.settle());
    by("travel").addEventListener("change", event => this.typed(event.target.value));
    by("travel").addEventListener("keydown", event => {
      if (event.key === "Enter") this.typed(event.target.value);
      const way = {ArrowUp: 1, ArrowDown: -1}[event.key];
      if (way) { event.preventDefault(); this.go(page.motion.travel + way * this.little); }
    });
    document.addEventListener("keydown", event => {
      if (event.altKey || event.ctrlKey || event.metaKey || /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName)) return;
      const act = {r: () => (this.running ? this.rest() : this.run()), R: () => this.run(), 0: () => this.home(),
        ",": () => this.go(page.motion.travel - this.little), ".": () => this.go(page.motion.travel + this.little)};
      if (!act[event.key]) return;
      event.preventDefault();
      act[event.key]();
    });
  }

  get still() { return this.page.motion.still; }
  get slides() { return Boolean(this.page.motion.data.linkage.drives[0]?.slides); }
  get unit() { return this.slides ? ` ${this.page.data.units[this.page.language].length}` : "°"; }
  get little() { return this.slides ? (this.ends[1] - this.ends[0]) / 200 : 1; }

  // from where to where the slider goes: to the limits, else once around
  get ends() {
    const {linkage} = this.page.motion.data, [from, to] = this.page.motion.limits();
    if (from === null && to === null && !this.slides) return [0, 360];
    return [from ?? linkage.span[0] / linkage.unit, to ?? linkage.span[1] / linkage.unit];
  }

  // the travel of the slider's place, in the turn in which the drive is
  wound(value) {
    if (!this.round) return value;
    const {travel} = this.page.motion, turn = Math.floor(travel / 360);
    return value === 360 && travel === 360 * turn ? travel : value + 360 * turn;  // the end of a turn begins the next
  }

  // ---- the page is told in another language, or drawn in another pose

  spell() {
    const {page, still} = this;
    by("handles").replaceChildren();
    this.points = Object.keys(page.motion.points());
    this.grips = new Map(this.points.map(name => [name, this.grip(name)]));
    for (const id of ["pace", "home", "drive", "travel"]) by(id).disabled = Boolean(still);
    by("unit").textContent = this.unit.trim();
    const word = this.slides ? "travel" : "turn";
    this.bound();
    this.spellDrives();
    document.querySelector("label[for=drive]").textContent = page.say(word);
    by("travel").setAttribute("aria-label", page.say(word));
  }

  // of several drives each has a slider, which moves it alone: once around, or as far as a sliding one is followed
  spellDrives() {
    const {page} = this, {drives, reach} = page.motion.data.linkage;
    this.sliders = drives.length > 1 && !this.still ? drives.map(({link, slides}, k) => {
      const label = document.createElement("label"), input = document.createElement("input"), far = slides ? reach : 180;
      Object.assign(input, {type: "range", step: "any", min: -far, max: far});
      input.addEventListener("input", () => this.turn(k, Number(input.value), true));
      input.addEventListener("change", () => this.settle());
      label.className = "slider";
      label.append(`${page.say(slides ? "travel" : "turn")}: ${link}`, input);
      return [label, input];
    }) : [];
    by("drives").replaceChildren(...this.sliders.map(([label]) => label));
  }

  grip(name) {
    const {page} = this, grip = made("circle", {class: "handle", tabindex: 0, role: "button",
      "aria-label": page.say("handle", name), "data-point": name});
    by("handles").append(grip);
    // a finger on it scrolls no page; browsers heed touch-action on an SVG's own box alone
    grip.addEventListener("touchstart", event => event.preventDefault(), {passive: false});
    grip.addEventListener("pointerdown", event => {
      if (event.button) return;
      event.preventDefault();
      this.rest();
      grip.setPointerCapture(event.pointerId);
      document.activeElement.blur();  // a mouse takes no keys away from the steps
      this.screen = page.svg.getScreenCTM().inverse();
      const [x, y] = page.picture.back(this.spot(event)), [p, q] = page.motion.points()[name];
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
      this.settle();
    });
    grip.addEventListener("keydown", event => {
      const way = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key];
      if (!way || event.altKey || event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      const step = page.motion.data.linkage.reach * (event.shiftKey ? 0.002 : 0.01), [x, y] = page.motion.points()[name];
      this.drag(name, x + way[0] * step, y + way[1] * step);
    });
    return grip;
  }

  // a pointer's place on the picture, in its mm, as that stood when the pointer went down
  spot(event) {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.screen);
    return [at.x, at.y];
  }

  pull() {
    const {name, off} = this.held, [x, y] = this.page.picture.back(this.aim);
    this.pulling = this.aim = undefined;
    this.busy = true;
    this.drag(name, x + off[0], y + off[1], NEAR_PX * this.screen.a / this.page.picture.scale);
    this.busy = false;
  }

  draw() {
    const {travel} = this.page.motion;
    by("drive").setAttribute("aria-valuetext", this.told(travel));
    by("drive").value = this.round ? travel - 360 * Math.floor(travel / 360) : travel;
    by("travel").value = this.number(travel, 5);
    this.page.motion.gone().forEach((gone, k) => {
      if (!this.sliders[k]) return;
      const [, input] = this.sliders[k], {slides} = this.page.motion.data.linkage.drives[k];
      input.value = slides ? gone : gone - 360 * Math.round(gone / 360);
      input.setAttribute("aria-valuetext", `${this.page.number(gone)}${slides ? ` ${this.page.data.units[this.page.language].length}` : "°"}`);
    });
    this.handles();
    clearTimeout(this.bounding);
    if (!this.busy) this.bounding = setTimeout(() => this.bound(), 50);  // where the limits are is sought when it rests
  }

  bound() {
    const {page} = this, {travel} = page.motion, [from, to] = this.ends;
    this.round = !this.slides && page.motion.limits().every(limit => limit === null);
    Object.assign(by("drive"), {min: from, max: to, value: this.round ? travel - 360 * Math.floor(travel / 360) : travel});
    by("range").textContent = this.still ? "" : this.round ? page.say("round")
      : page.say("limits", this.told(from), this.told(to));
  }

  told(travel) { return `${this.number(travel, 4)}${this.unit}`; }

  // a travel as it is told: a hand that comes back leaves no more than rounding
  number(travel, count) {
    const [from, to] = this.ends;
    return this.page.number(Math.abs(travel) < BACK * (to - from) ? 0 : travel, count);
  }

  // grips lie on their points; of points that lie together the one that moves has it
  handles() {
    const {under, linkage} = this.page.motion.data, taken = [];
    const rank = name => (this.held?.name === name ? 0 : name in under ? 2 : name in linkage.owned ? 1 : 3);
    for (const [name, grip] of [...this.grips].sort(([one], [other]) => rank(one) - rank(other))) {
      const [x, y] = this.page.picture.place(name);
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
    const scale = this.scale = this.page.svg.getScreenCTM()?.a || 1;
    for (const grip of this.grips.values()) grip.setAttribute("r", GRIP / scale);
  }

  // ---- by hand

  go(travel, busy = false) {
    this.busy = busy;
    this.page.motion.travel = travel;
    this.page.draw();
    this.busy = false;
  }

  drag(name, x, y, near) {
    this.page.motion.drag(name, x, y, near);
    this.page.draw();
  }

  // one drive to a place of its slider, of all that are the same pose the nearest
  turn(k, value, busy = false) {
    const {motion} = this.page, {slides} = motion.data.linkage.drives[k], gone = motion.gone()[k];
    this.busy = busy;
    motion.turn(k, slides ? value : value + 360 * Math.round((gone - value) / 360));
    this.page.draw();
    this.busy = false;
  }

  home() {
    this.rest();
    this.page.motion.reset();
    this.page.draw();
  }

  // a hand has let go: all words follow
  settle() { this.page.draw(); }

  typed(text) {
    const signs = this.page.data.signs[this.page.language], decimal = signs["."] ?? ".";
    const value = Number(text.replaceAll("−", "-").replace("°", "").replace(decimal, ".").trim());
    if (text.trim() && Number.isFinite(value)) this.go(value); else this.page.draw();
  }

  // ---- by itself

  run() {
    if (this.still || this.running) return;
    if (this.page.motion.stop) this.way = this.nearer(1) ? -1 : 1;
    const pace = this.slides ? (this.ends[1] - this.ends[0]) / 4 : PACE, {motion} = this.page;
    let before = performance.now();
    const tick = now => {
      const time = Math.min(calm.matches ? TICK : 100, Math.max(0, now - before)) / 1000;
      before = now;
      this.go(motion.travel + this.way * pace * Number(by("pace").value) * time, true);
      if (motion.stop || motion.said) { this.way = -this.way; this.rest(); } else this.running = next();
    };
    const next = () => (calm.matches ? setTimeout(() => tick(performance.now()), TICK) : requestAnimationFrame(tick));
    this.running = next();
    this.page.tellPlaying();
  }

  // whether it stands at the limit that lies this way
  nearer(way) {
    const [from, to] = this.page.motion.limits(), {travel} = this.page.motion;
    const near = Math.abs(travel - (to ?? Infinity)) <= Math.abs(travel - (from ?? -Infinity));
    return way > 0 ? near : !near;
  }

  rest() {
    if (!this.running) return;
    cancelAnimationFrame(this.running);
    clearTimeout(this.running);
    this.running = 0;
    this.page.tellPlaying();
    this.page.draw();
  }
}
