// ---- which construction and language is shown; what is taken away; and what scripts may do with the page

class Choosing {
  constructor(page) {
    this.page = page;
    const {variants} = page.data;
    for (const id of ["variant", "language"]) by(id).addEventListener("change", () => this.choose());
    page.few("variant", variants);
    by("copy").addEventListener("click", () => this.copy());
    by("close").addEventListener("click", () => by("scenes").close());
  }

  choose() { return this.page.choose(Number(by("variant").value), by("language").value); }

  spell() {
    const {page} = this, {variants} = page.data;
    by("variant").replaceChildren(...variants.map(({plan, method}, i) =>
      new Option([page.say(plan), method && page.say(method)].filter(Boolean).join(", "), i)));
    by("variant").value = page.variants.indexOf(page.variant);
    by("language").value = page.language;
  }

  async copy() {
    const {page} = this, text = page.motion.toml();
    by("remark").textContent = "";
    try {
      await navigator.clipboard.writeText(text);
      by("remark").textContent = page.say("copied");
    } catch {  // a file of the disk, or a browser that asks first
      by("toml").value = text;
      by("scenes").showModal();
      by("toml").select();
    }
  }
}

const page = new Page();

// the name of a point, which the scene must have
function known(name) {
  const names = Object.keys(page.motion.points());
  if (!names.includes(name)) throw new RangeError(`the scene has no point ${name}, but ${names.join(", ")}`);
  return name;
}

window.graphplan = {
  ready: page.choose(0, page.language).catch(error => {
    by("said").textContent = page.say("old");
    throw error;
  }),
  get travel() { return page.motion.travel; },
  set travel(value) { page.moving.go(Number(value)); },
  limits: () => page.motion.limits(),
  points: () => page.motion.points(),
  results: () => page.motion.results(),
  screen: name => page.screen(page.picture.place(known(name))),
  drag(name, x, y) {
    if (![x, y].every(Number.isFinite)) throw new RangeError(`a point is dragged to two numbers, not to ${x}, ${y}`);
    page.moving.drag(known(name), x, y);
  },
  drives: () => page.motion.gone(),
  turn: (drive, value) => page.moving.turn(Number(drive), Number(value)),
  get steps() { return page.count; },
  get step() { return page.place; },
  set step(value) { page.stepping.go(Number(value)); },
  get said() { return page.said ?? ""; },
};
