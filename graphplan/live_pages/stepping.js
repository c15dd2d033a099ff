// ---- through the steps: what is there, what the step reads and what it makes, in words and in the list

const RHYTHM = 1600;
const STEP_KEYS = {ArrowLeft: "previous", ArrowUp: "previous", ArrowRight: "next", ArrowDown: "next", Home: "first",
  End: "end", PageUp: "back", PageDown: "on", " ": "play"};

class Stepping {
  constructor(page) {
    this.page = page;
    this.playing = 0;
    this.acts = {first: () => this.go(0), previous: () => this.go(page.place - 1), next: () => this.go(page.place + 1),
      last: () => this.go(page.place < page.count ? page.count : 0), end: () => this.go(page.count), back: () => this.stage(-1), on: () => this.stage(1), play: () => this.play()};
    for (const [id, act] of Object.entries(this.acts)) by(id)?.addEventListener("click", act);
    by("place").addEventListener("input", event => this.go(Number(event.target.value)));
    document.addEventListener("keydown", event => {
      const act = STEP_KEYS[event.key], on = event.target;
      if (!act || event.altKey || event.ctrlKey || event.metaKey || /^(INPUT|SELECT|TEXTAREA|SUMMARY)$/.test(on.tagName)
        || (on.tagName === "BUTTON" && event.key === " ") || event.defaultPrevented) return;
      event.preventDefault();
      this.acts[act]();
    });
  }

  // the picture and the list are others
  spell() {
    this.halos = this.page.svg.insertBefore(made("g", {id: "halos"}), this.page.picture.start);
  }

  take() {
    this.buttons = [...document.querySelectorAll("button[data-place]")];
    this.wholes = [...document.querySelectorAll(".whole")];
    this.buttons.forEach((button, i) => button.addEventListener("click", () => this.go(i + 1)));
    for (const whole of this.wholes) {
      whole.addEventListener("click", () => this.go(Number(whole.dataset.until)));
      whole.tabIndex = -1;
    }
    by("place").max = this.page.count;
    this.shown = null;
  }

  // the step that is made, and its index
  get step() { return this.page.drawn.steps[this.index] ?? null; }
  get index() { return this.page.place ? this.page.place - 1 + this.page.drawn.givens : -1; }

  show() {
    const {page, step} = this, {place, count, program} = page, shown = `${program} ${place}`;
    if (this.shown !== shown) {
      const read = new Set((step?.reads ?? []).map(one => page.drawn.steps[one].number));
      for (const group of page.svg.querySelectorAll("g.step")) {
        const own = Number(group.dataset.step);
        group.classList.toggle("later", own > place);
        group.classList.toggle("made", own > 0 && own === place && place < count);
        group.classList.toggle("read", own > 0 && read.has(own) && place < count);
      }
      by("results")?.classList.toggle("later", place < count);
      this.tell();
    }
    this.shown = shown;
    page.viewing.show();
    this.halos.replaceChildren();
    if (!step || place === count || !page.values) return;
    for (const one of new Set(step.reads)) this.halo(one, "read");
    this.halo(this.index, "made");
  }

  halo(index, role) {
    const {page} = this, step = page.drawn.steps[index], {sheet} = page.picture;
    const group = step.number ? page.svg.querySelector(`g.step[data-step="${step.number}"]`) : null;
    const ring = made("g", {class: `halo ${role}`, "clip-path": `url(#${sheet.clip}-${step.plan})`});
    const strokes = [...group?.querySelectorAll("polyline, path, circle, polygon") ?? []]
      .filter(stroke => !stroke.closest("[display=none], [transform]"));  // letters are not lit up
    ring.append(...strokes.map(stroke => stroke.cloneNode(true)));
    const spot = this.spot(index), radius = (role === "made" ? 11 : 9) / page.grips.scale;
    if (spot) ring.append(made("circle", {class: "ring", cx: spot[0], cy: spot[1], r: radius}));
    const ends = step.span.map(end => this.spot(end)).filter(Boolean);
    if (ends.length === 2 && !strokes.length)
      ring.append(made("line", {x1: ends[0][0], y1: ends[0][1], x2: ends[1][0], y2: ends[1][1]}));
    this.halos.append(ring);
  }

  // where a point of a step lies on the picture
  spot(index) {
    const {sheet} = this.page.picture, at = sheet.steps[index].kind === "point" ? sheet.plates.at[index] : null;
    return at && at.every(Number.isFinite) ? [at[0], sheet.height - at[1]] : null;
  }

  // ---- the words

  // the sentence of the step, as the list has it
  speak() {
    const {page, step} = this, {place, count, words} = page, button = this.buttons[place - 1];
    const set = (id, told) => { if (by(id).innerHTML !== told) by(id).innerHTML = told; };
    set("sentence", step ? `${words.step} ${place}/${count}. ${button.lastElementChild.innerHTML}` : words.begin);
    set("whole", this.whole?.innerHTML.replace(/ data-told="\d+"/g, "") ?? "");
  }

  tell() {
    const {page, step, buttons} = this, {place, count} = page, button = buttons[place - 1];
    const whole = this.whole = button && this.wholes.find(one => one.parentElement.contains(button));
    const stage = button?.closest(".stage");
    by("stage").innerHTML = [...stage?.children ?? []].filter(one => one.tagName !== "OL")
      .map(one => (one.tagName === "H4" ? `<p><b>${one.innerHTML}</b></p>` : one.outerHTML)).join("");
    this.speak();
    const names = page.told.programs[page.program].names;
    for (const [id, marks] of [["reads", step ? [...new Set(step.reads)] : []], ["makes", step ? [this.index] : []]]) {
      by(id).hidden = !marks.length;
      by(id).lastElementChild.innerHTML = marks.map(mark => names[mark]).join(", ");
    }
    buttons.forEach((one, i) => {
      one.tabIndex = i === Math.max(0, place - 1) ? 0 : -1;  // Tab goes past the others, arrows go through them
      if (one === button) one.setAttribute("aria-current", "step"); else one.removeAttribute("aria-current");
    });
    for (const one of this.wholes) one.classList.toggle("partly", one === whole);
    if (button && this.reached !== place && this.reached !== undefined && !page.moving?.busy) this.reveal(button);
    this.reached = place;
    by("place").value = place;
    by("place").setAttribute("aria-valuetext", `${place}/${count}`);
    by("at").textContent = `${place}/${count}`;
    by("first").disabled = by("previous").disabled = place === 0;
    by("next").disabled = place === count;
    by("last").setAttribute("aria-pressed", place === count);
  }

  reveal(button) {
    const list = button.closest("nav"), box = list.getBoundingClientRect(), own = button.getBoundingClientRect();
    if (own.top < box.top || own.bottom > box.bottom)
      list.scrollTop += own.top - box.top - (box.height - own.height) / 2;
  }

  // ---- the controls

  go(to) {
    const {page} = this;
    page.place = Math.max(0, Math.min(page.count, Math.round(to)));
    if (page.place === page.count) this.rest();
    page.viewing.follow();
    this.show();
    page.stepped?.();
  }

  play() {
    if (this.playing) return this.rest();
    if (this.page.place === this.page.count) this.go(0);
    this.playing = setInterval(() => this.go(this.page.place + 1), RHYTHM);
    this.page.tellPlaying();
  }

  rest() {
    clearInterval(this.playing);
    this.playing = 0;
    this.page.tellPlaying();
  }

  // the first step of the next stage, or of the one before
  stage(way) {
    const {place, count} = this.page, of = at => this.buttons[at - 1]?.closest(".stage") ?? null;
    let to = Math.max(0, Math.min(count, place + way));
    while (to > 0 && to < count && (of(to) === of(place) || of(to - 1) === of(to))) to += way;
    this.go(to);
  }
}
