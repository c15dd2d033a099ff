// ---- the window on the sheet: all plans, a large one, or what wheel and fingers make of them

const GLIDE = 300, CLICK_PX = 5, SWIPE_PX = 45;  // ms; how far a click may slip; how far a finger goes to the next plan
const WHEEL = 500, MOST_ZOOM = 12;  // pixels of a wheel that make a window e times as small; how small it may become

class Viewing {
  constructor(page) {
    Object.assign(this, {page, plan: small.matches ? 0 : null, box: null, target: null, gliding: 0, fingers: new Map()});
    by("zoom").addEventListener("click", () => this.enlarge(this.plan === null ? page.stepping.step?.plan ?? 0 : null));
    const {svg} = page;
    for (const one of [svg, by("handles")]) one.addEventListener("wheel", event => {
      event.preventDefault();
      this.scale(Math.exp((event.deltaMode ? 16 : 1) * event.deltaY / WHEEL), this.spot(event));
    }, {passive: false});
    svg.addEventListener("pointerdown", event => {
      if (event.button) return;
      this.fingers.set(event.pointerId, event);
      this.began = this.fingers.size === 1 ? event : null;  // two fingers neither click nor swipe
    });
    addEventListener("pointermove", event => this.moved(event));
    for (const end of ["pointerup", "pointercancel"]) addEventListener(end, event => {
      if (this.fingers.delete(event.pointerId) && this.began && end === "pointerup") this.left(event);
    });
    addEventListener("beforeprint", () => this.frame(page.whole));
    addEventListener("afterprint", () => this.show(true));
  }

  spell() { this.target = null; }

  // a place of the screen on the sheet
  spot({clientX, clientY}) {
    const at = new DOMPoint(clientX, clientY).matrixTransform(this.page.svg.getScreenCTM().inverse());
    return [at.x, at.y];
  }

  // so many times as much of the sheet, about a spot that stands still
  scale(times, [x, y]) {
    const [left, top, wide, high] = this.box, whole = this.page.whole;
    const part = Math.min(Math.max(times, whole[2] / MOST_ZOOM / wide), Math.max(1, whole[2] / wide, whole[3] / high));
    this.frame([x - part * (x - left), y - part * (y - top), part * wide, part * high]);
  }

  moved(event) {
    const before = this.fingers.get(event.pointerId);
    if (!before) return;
    const [from, to] = [before, event].map(one => this.spot(one)), others = [...this.fingers.values()].filter(one => one !== before);
    this.fingers.set(event.pointerId, event);
    if (others.length) {  // two fingers: as far apart as they go
      const still = this.spot(others[0]), far = spot => Math.hypot(spot[0] - still[0], spot[1] - still[1]);
      this.scale(far(from) / Math.max(far(to), 1e-9), still);
    } else if (!(small.matches && this.box === this.target)) {  // on a phone a finger on a whole plan swipes
      const [left, top, wide, high] = this.box;
      this.frame([left + from[0] - to[0], top + from[1] - to[1], wide, high]);
    }
  }

  // a finger or the mouse has left the sheet: a click makes a plan the large one, or all are there again; a swipe goes on
  left(event) {
    const {panels} = this.page.drawn, x = event.clientX - this.began.clientX, y = event.clientY - this.began.clientY;
    if (Math.hypot(x, y) < CLICK_PX) {
      const [u, v] = this.spot(event), plan = panels.findIndex(([left, top, wide, high]) => u >= left && u <= left + wide && v >= top && v <= top + high);
      if (!small.matches && plan >= 0) this.enlarge(this.plan === null ? plan : null);
    } else if (small.matches && this.box === this.target && Math.abs(x) > Math.max(SWIPE_PX, Math.abs(y)))
      this.enlarge((this.plan + (x < 0 ? 1 : -1) + panels.length) % panels.length);
  }

  // makes a plan the large one; null for all of them
  enlarge(plan) {
    this.plan = small.matches ? plan ?? 0 : plan;
    this.show(true);
  }

  // a large plan is that of the step; on a phone it is the mechanism when all is drawn
  follow() {
    const {stepping: {step}, place, count} = this.page;
    if (this.plan !== null && step) this.plan = small.matches && place === count ? 0 : step.plan;
  }

  show(back = false) {
    const {page} = this, target = this.plan === null ? page.drawn.plans : page.drawn.panels[this.plan];
    by("zoom").setAttribute("aria-pressed", this.plan !== null);
    if (String(target) === String(this.target) && !back) return;
    const first = !this.target;
    this.target = target;
    if (first || calm.matches) this.frame(target); else this.glide(target);
  }

  glide(target) {
    const start = this.box, began = performance.now();
    const tick = now => {
      const t = Math.min(1, (now - began) / GLIDE), ease = t * t * (3 - 2 * t);
      this.frame(t < 1 ? start.map((value, i) => value + (target[i] - value) * ease) : target);
      if (t < 1) this.gliding = requestAnimationFrame(tick);
    };
    this.gliding = requestAnimationFrame(tick);
  }

  frame(box) {
    cancelAnimationFrame(this.gliding);
    this.box = box;
    document.body.style.setProperty("--shape", box[2] / box[3]);
    for (const svg of [this.page.svg, by("handles")]) svg.setAttribute("viewBox", box.join(" "));
    this.page.grips.measure();
  }
}
