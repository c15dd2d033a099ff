// ---- moving the mechanism: by its points, by the slider, by a number, by itself

const PACE = 60, TICK = 500;  // degrees a second; ms between poses where motion is to be spared
const BACK = 1e-6;  // of the travel: what is nearer to the given pose is told as that
const NEAR_PX = 2;  // how near a drag comes

class Moving {
  constructor(page) {
    Object.assign(this, {page, running: 0, way: 1, busy: false});
    page.grips = new Grips(page, {
      where: name => page.motion.points()[name], step: fine => page.motion.data.linkage.reach * (fine ? 0.002 : 0.01),
      drag: (name, at, pixel) => {
        this.busy = Boolean(pixel);
        this.drag(name, ...at, pixel && NEAR_PX * pixel);
        this.busy = false;
      },
      left: keyed => keyed || this.settle(),
    });
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
    page.grips.take(Object.keys(page.motion.points()));
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

  // of points that lie together the one that moves has the handle
  handles() {
    const {grips, picture, motion: {data: {under, linkage}}} = this.page;
    const rank = name => (grips.held?.name === name ? 0 : name in under ? 2 : name in linkage.owned ? 1 : 3);
    grips.put([...grips.grips.keys()].sort((one, other) => rank(one) - rank(other)), name => picture.place(name));
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
    const value = this.page.typed(text);
    if (Number.isFinite(value)) this.go(value); else this.page.draw();
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
