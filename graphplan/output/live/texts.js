// ---- texts whose numbers follow the pose: the templates of texts.py, filled in

const Numbers = {
  // the length of a vector, as exact as a double is: what rounding takes from the sum is worked out and given back
  hypot(x, y) {
    const size = Math.sqrt(x * x + y * y);
    if (!(size > 1e-140 && size < 1e140)) return Math.hypot(x, y);
    const split = a => { const c = 134217729 * a, high = c - (c - a); return [high, a - high]; };
    const square = a => { const [h, l] = split(a), s = a * a; return [s, ((h * h - s) + 2 * h * l) + l * l]; };
    const [a, lessA] = square(x), [b, lessB] = square(y), [c, lessC] = square(size);
    return size + (((Math.max(a, b) - c) + Math.min(a, b)) + ((lessA + lessB) - lessC)) / (2 * size);
  },

  // what Python's round(x, 1) gives: of two tenths that are as near the even one
  tenths(x) { return Number.isFinite(x) ? Number(Numbers.fixed(x)) : x; },

  fixed(x) {
    const text = x.toFixed(1), tie = Number.isInteger(4 * x) && !Number.isInteger(2 * x);  // k + 1/4 or k + 3/4
    return tie && Number(text.at(-1)) % 2 ? (x - Math.sign(x) * 0.0625).toFixed(1) : text;
  },

  // what Python's format(x, f".{count}g") makes of a number, a power of ten apart
  significant(x, count) {
    const [mantissa, power = "0"] = x.toExponential(count - 1).split("e");
    const [digits, rest] = Math.abs(x).toExponential(Math.min(100, count + 60)).split("e");
    const all = digits.replace(".", ""), tie = /^50*$/.test(all.slice(count)) && rest !== undefined;
    let own = Number(mantissa.replace(".", ""));
    if (tie) {  // half a unit of the last figure: the even one
      const down = Number(all.slice(0, count)), even = down % 2 ? down + 1 : down;
      own = Math.sign(x) * even;
      return [own, Number(rest) - count + 1];
    }
    return [own, Number(power) - count + 1];
  },

  // as graphplan.phrases.digits writes a number: at most `count` figures, or with 0 of them in tenths
  written(x, count) {
    if (!Number.isFinite(x)) return "–";
    if (!count) return Numbers.fixed(x).replace(/^-(0\.0)$/, "$1").replace("-", "−");
    if (x === 0) return "0";
    const [own, last] = Numbers.significant(x, count), sign = own < 0 ? "−" : "";
    let figures = String(Math.abs(own)), first = last + figures.length - 1;
    if (first < -4 || first >= Math.max(count, 7)) {
      figures = figures.replace(/0+$/, "");
      const power = String(first).replace("-", "⁻").replace(/\d/g, digit => "⁰¹²³⁴⁵⁶⁷⁸⁹"[digit]);
      return `${sign}${figures[0]}${figures.length > 1 ? "." + figures.slice(1) : ""}·10${power}`;
    }
    if (last >= 0) return sign + figures + "0".repeat(last);
    figures = figures.padStart(1 - last, "0");
    const text = `${figures.slice(0, last)}.${figures.slice(last)}`.replace(/\.?0+$/, "");
    return sign + text;
  },
};

const PLACES = /\uE000(\d+):(\d+)\uE004|\uE001(\d+)\uE002|\uE003|\uE004/g;

class Template {
  // `text` as texts.py tells it, the decimal sign of its language in `signs`
  constructor(text, signs) {
    this.signs = signs;
    this.parts = [];
    let done = 0;
    for (const found of text.matchAll(PLACES)) {
      if (found.index > done) this.parts.push(text.slice(done, found.index));
      done = found.index + found[0].length;
      this.parts.push(found[1] !== undefined ? {number: Number(found[1]), count: Number(found[2])}
        : found[3] !== undefined ? {either: Number(found[3])} : {mark: found[0]});
    }
    if (done < text.length) this.parts.push(text.slice(done));
  }

  fill(numbers) {
    let told = "";
    const shown = [];  // of each choice that stands open, whether the part that stands here is told
    for (const part of this.parts) {
      if (part.either !== undefined) shown.push(numbers[part.either] > 0);
      else if (part.mark === "\uE003") shown.push(!shown.pop());
      else if (part.mark) shown.pop();
      else if (!shown.includes(false)) told += typeof part === "string" ? part : this.written(part, numbers);
    }
    return told;
  }

  written({number, count}, numbers) {
    return Numbers.written(numbers[number], count).replace(/[.,]/g, sign => this.signs[sign] ?? sign);
  }
}
