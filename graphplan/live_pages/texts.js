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

  fixed(x, count = 1) {
    const text = x.toFixed(count), half = x * 2 ** (count + 1), tie = Number.isInteger(half) && half % 2;
    return tie && Number(text.at(-1)) % 2 ? (x - Math.sign(x) * 0.25 / 10 ** count).toFixed(count) : text;
  },

  // what Python's format(x, f".{count}g") makes of a number, a power of ten apart
  significant(x, count) {
    const [mantissa, power = "0"] = x.toExponential(count - 1).split("e"), own = Number(mantissa.replace(".", ""));
    if (Number(x.toPrecision(count + 1)) === x) {  // few numbers have so few figures
      const [digits, rest] = Math.abs(x).toExponential(Math.min(100, count + 60)).split("e"), all = digits.replace(".", "");
      if (/^50*$/.test(all.slice(count))) {  // half a unit of the last figure: the even one
        const down = Number(all.slice(0, count));
        return [Math.sign(x) * (down % 2 ? down + 1 : down), Number(rest) - count + 1];
      }
    }
    return [own, Number(power) - count + 1];
  },

  // ---- sums that hold as printed: as graphplan/sheet/words/lengths.py has them

  levels: [[1, 1, 4, 4], [2, 1, 4, 5], [3, 1, 4, 6], [2, 1, 4, 6], [1, 1, 4, 5]],
  asPrinted: 3,  // from this level on a result is what the printed numbers come to

  level(kinds, ...numbers) {
    if (!numbers.every(Number.isFinite)) return 0;
    const form = "+-Σ".includes(kinds[0]) ? kinds[0] : "", own = kinds.slice(form.length), last = own.length - 1;
    if (!"mMd".includes(own[last])) return 4;
    const holds = (_, level) => {
      const told = numbers.map((x, k) => Numbers.rounded(x, own[k], level, k === last));
      const found = Numbers.sum(form, own.slice(0, last), told);
      return Math.abs(found - told[last]) <= 0.499 * 10 ** -Numbers.levels[level][1];
    };
    const found = Numbers.levels.slice(0, Numbers.asPrinted).findIndex(holds);
    return found < 0 ? Numbers.asPrinted : found;
  },

  sum(form, kinds, told) {
    const lengths = [...kinds].map((kind, k) => [told[k], kind]).filter(([, kind]) => "mMd".includes(kind));
    const joined = (value, x, kind) => kind === "g" ? value / x : kind === "a" ? value + x
      : kind === "f" ? value * x : value * x * x;
    let value = 1;
    if (form === "Σ") value = lengths.reduce((sum, [x], k) => k % 2 ? sum + lengths[k - 1][0] * x : sum, 0);
    else for (const [x, kind] of lengths) value = joined(value, x, {m: "f", M: "F", d: "g"}[kind]);
    if (form === "-") value = 1 - value; else if (form === "+") value = 1 + value;
    [...kinds].forEach((kind, k) => { if (!"mMd".includes(kind)) value = joined(value, told[k], kind); });
    return value;
  },

  rounded(x, kind, level, result) {
    const [, own, , figures] = Numbers.levels[level];
    if ("mMd".includes(kind)) return Number(Numbers.fixed(x, result ? own : Numbers.decimalsOf(x, kind, level)));
    return Numbers.inFigures(x, result ? Numbers.resultFigures(x, level) : Numbers.figuresOf(x, figures));
  },

  decimalsOf(x, kind, level) {
    const [count] = Numbers.levels[level], kept = level === Numbers.asPrinted || kind === "d" && level === 4;
    return kept && x && Math.abs(x) < 0.5 * 10 ** -count ? 1 - Numbers.power(x) : count;
  },

  power(x) { return Number(x.toExponential(6).split("e")[1]); },

  resultFigures(x, level) {
    const power = Numbers.power(x);
    return power <= 2 ? Numbers.levels[level][2] : Math.max(4, Math.min(power + 1, 7));
  },

  result(kinds, ...numbers) {
    const level = numbers.pop(), form = "+-Σ".includes(kinds[0]) ? kinds[0] : "", own = kinds.slice(form.length, -1);
    if (level < Numbers.asPrinted) return numbers.at(-1);
    const value = Numbers.sum(form, own, numbers.map((x, k) => k < own.length ? Numbers.rounded(x, own[k], level) : x));
    return Number.isFinite(value) ? value : numbers.at(-1);
  },

  inFigures(x, count) {
    const [own, last] = Numbers.significant(x, count);
    return Number(`${own}e${last}`);
  },

  figuresOf(x, figures) {
    for (let count = figures; count <= 6; count++) {
      if (Math.abs(Numbers.inFigures(x, count) - x) <= 1e-9 * Math.abs(x)) return count;
    }
    return figures;
  },

  // a number of a sum by its kind: r and v are results in mm and in figures
  told(x, kind, level) {
    if (!Number.isFinite(x)) return "–";
    const [, own, , figures] = Numbers.levels[level];
    if ("mMdr".includes(kind)) {
      return Numbers.fixed(x, kind === "r" ? own : Numbers.decimalsOf(x, kind, level)).replace(/^-(0\.0+)$/, "$1").replace("-", "−");
    }
    return Numbers.written(x, kind === "v" ? Numbers.resultFigures(x, level) : Numbers.figuresOf(x, figures));
  },

  // as graphplan.phrases.digits writes a number: at most `count` figures, or with 0 of them in tenths, half of one in hundredths
  written(x, count) {
    if (!Number.isFinite(x)) return "–";
    if (!count) return Numbers.fixed(x, Math.abs(x) * 4 % 2 === 1 ? 2 : 1).replace(/^-(0\.0)$/, "$1").replace("-", "−");
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

const PLACES = /\uE000(\d+):([a-zA-Z]?)(\d+)\uE004|\uE001(\d+)\uE002|\uE003|\uE004/g;

class Template {
  // `text` as texts.py tells it, the decimal sign of its language in `signs`
  constructor(text, signs) {
    this.signs = signs;
    this.parts = [];
    let done = 0;
    for (const found of text.matchAll(PLACES)) {
      if (found.index > done) this.parts.push(text.slice(done, found.index));
      done = found.index + found[0].length;
      this.parts.push(found[1] !== undefined ? {number: Number(found[1]), kind: found[2], count: Number(found[3])}
        : found[4] !== undefined ? {either: Number(found[4])} : {mark: found[0]});
    }
    if (done < text.length) this.parts.push(text.slice(done));
    this.numbered();
  }

  // of each choice, whether only the part that stands second has a number
  numbered() {
    const open = [];
    for (const part of this.parts) {
      if (part.either !== undefined) open.push({choice: part, second: false, has: [false, false]});
      else if (part.mark === "\uE003") open.at(-1).second = true;
      else if (part.mark) {
        const {choice, has} = open.pop();
        choice.later = has[1] && !has[0];
      } else if (part.number !== undefined) for (const one of open) one.has[one.second ? 1 : 0] = true;
    }
  }

  fill(numbers) {
    let told = "";
    const shown = [];  // of each choice that stands open, whether the part that stands here is told
    for (const part of this.parts) {
      if (part.either !== undefined) shown.push(Number.isNaN(numbers[part.either]) ? !part.later : numbers[part.either] > 0);
      else if (part.mark === "\uE003") shown.push(!shown.pop());
      else if (part.mark) shown.pop();
      else if (!shown.includes(false)) told += typeof part === "string" ? part : this.written(part, numbers);
    }
    return told;
  }

  written({number, kind, count}, numbers) {
    const told = kind ? Numbers.told(numbers[number], kind, numbers[count]) : Numbers.written(numbers[number], count);
    return told.replace(/[.,]/g, sign => this.signs[sign] ?? sign);
  }
}
