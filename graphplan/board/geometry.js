// Distances and outlines on the screen.

export const minus = (a, b) => [a[0] - b[0], a[1] - b[1]];
export const plus = (a, b, times = 1) => [a[0] + times * b[0], a[1] + times * b[1]];
export const length = ([x, y]) => Math.hypot(x, y);
export const distance = (a, b) => length(minus(a, b));
export const unit = (v) => { const size = length(v) || 1; return [v[0] / size, v[1] / size]; };
export const middle = (places) => [0, 1].map((axis) => places.reduce((sum, place) => sum + place[axis], 0) / places.length);
export const cross = (a, b) => a[0] * b[1] - a[1] * b[0];

export function toSegment(place, a, b) {
  const line = minus(b, a), square = line[0] ** 2 + line[1] ** 2;
  if (!square) return distance(place, a);
  const t = Math.min(1, Math.max(0, ((place[0] - a[0]) * line[0] + (place[1] - a[1]) * line[1]) / square));
  return distance(place, plus(a, line, t));
}

export function hull(places) {
  const sorted = [...places].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  if (sorted.length < 3) return sorted;
  const chain = (points) => {
    const kept = [];
    for (const point of points) {
      while (kept.length > 1 && cross(minus(kept.at(-1), kept.at(-2)), minus(point, kept.at(-2))) <= 1e-9) kept.pop();
      kept.push(point);
    }
    kept.pop();
    return kept;
  };
  const round = [...chain(sorted), ...chain(sorted.reverse())];
  return round.length ? round : sorted.slice(0, 1);
}

export function isInside(place, corners) {
  return corners.length > 2 && corners.every((corner, i) => {
    const next = corners[(i + 1) % corners.length];
    return cross(minus(next, corner), minus(place, corner)) >= 0;
  });
}

export function toOutline(place, corners) {
  if (corners.length === 1) return distance(place, corners[0]);
  return Math.min(...corners.map((corner, i) => toSegment(place, corner, corners[(i + 1) % corners.length])));
}
