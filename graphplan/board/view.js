// Where the drawing's places are on the screen: its middle and its scale, the steps of its grid.

const LEAST = 1e-4, MOST = 1e5; // pixels a length
const START = 400; // lengths that are seen on each side of the origin of an empty board
const ROUNDED = 0.8; // pixels: places are rounded to the smallest round step that is not less
const GRID = 16; // pixels between lines of the grid, at least

export function roundStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((count) => count * power).find((step) => step >= least * (1 - 1e-9));
}

export class View {
  scale = 1;
  centre = [0, 0];
  size = [800, 600];
  snaps = false; // to the lines of the grid

  resize(width, height) {
    const first = this.fresh === undefined;
    this.size = [Math.max(width, 1), Math.max(height, 1)];
    if (first) {
      this.fresh = true;
      this.scale = Math.min(...this.size) / 2 / START;
    }
  }

  toScreen([x, y]) {
    return [this.size[0] / 2 + (x - this.centre[0]) * this.scale, this.size[1] / 2 - (y - this.centre[1]) * this.scale];
  }

  toScene([x, y]) {
    return [this.centre[0] + (x - this.size[0] / 2) / this.scale, this.centre[1] - (y - this.size[1] / 2) / this.scale];
  }

  get step() { return this.snaps ? this.gridStep : roundStep(ROUNDED / this.scale); }

  get gridStep() { return roundStep(GRID / this.scale); }

  round(place) {
    const { step } = this;
    const decimals = Math.max(0, -Math.floor(Math.log10(step)) + 1);
    return place.map((value) => Number((Math.round(value / step) * step).toFixed(Math.min(decimals, 12))) + 0);
  }

  pan(dx, dy) {
    this.centre = [this.centre[0] - dx / this.scale, this.centre[1] + dy / this.scale];
  }

  zoom(factor, at) {
    const about = at ?? [this.size[0] / 2, this.size[1] / 2];
    const [x, y] = this.toScene(about);
    this.scale = Math.min(MOST, Math.max(LEAST, this.scale * factor));
    const [x1, y1] = this.toScene(about);
    this.centre = [this.centre[0] + x - x1, this.centre[1] + y - y1];
  }

  fit(places) {
    if (!places.length) {
      this.centre = [0, 0];
      this.scale = Math.min(...this.size) / 2 / START;
      return;
    }
    const [low, high] = [Math.min, Math.max].map((least) => [0, 1].map((axis) => least(...places.map((p) => p[axis]))));
    this.centre = [0, 1].map((axis) => (low[axis] + high[axis]) / 2);
    const room = [Math.max(this.size[0] - 140, 60), Math.max(this.size[1] - 190, 60)];
    const needed = [0, 1].map((axis) => room[axis] / Math.max(high[axis] - low[axis], 1e-9));
    const scale = Math.min(...needed);
    this.scale = scale > MOST ? 1 : Math.max(LEAST, scale);
  }

  holds(places) { // whether all places are on the screen
    return places.every((place) => this.toScreen(place).every((value, axis) => value > 20 && value < this.size[axis] - 20));
  }
}
