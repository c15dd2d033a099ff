// What the board knows: the scene's text, its objects, faults and results, and the history of the text.
// All changes go through one queue, so that each is made of the text that the one before it left.

const base = document.documentElement.dataset.base;
const PAGE = Math.random().toString(36).slice(2); // which of several open pages asks
const SHEET_DELAY = 250; // ms without another edit before a sheet is asked for
const MAX_HISTORY = 500;

export async function ask(route, data) {
  try {
    const answer = await fetch(`${base}/${route}`, {
      method: "POST",
      headers: data instanceof Blob ? {} : { "Content-Type": "application/json" },
      body: data instanceof Blob ? data : JSON.stringify({ page: PAGE, ...data }),
    });
    const type = answer.headers.get("Content-Type") || "";
    if (type.startsWith("application/json")) return await answer.json();
    return { faults: [`board: ${(await answer.text()).trim()}`] };
  } catch {
    return { faults: ["board: the server does not answer; start graphplan board again"] };
  }
}

export async function words(language) {
  const answer = await fetch(`${base}/words/${language}`);
  return answer.json();
}

export const EMPTY = {
  points: {}, links: {}, slides: [], drives: [], forces: [], masses: {}, gears: [], contacts: [],
  title: "", language: "", units: { length: "mm", force: "N", mass: "kg" },
};

class Store extends EventTarget {
  text = "";
  objects = EMPTY;
  faults = []; // of the text
  failures = []; // of the numbers or the sheet, as texts
  results = null;
  sheet = null;
  motion = null;
  readable = true; // whether the text can be read, so that the mouse can edit it
  language = document.documentElement.lang;
  wantsSheet = true;
  #history = [{ text: "", group: null }];
  #place = 0;
  #queue = [];
  #working = false;
  #asking = 0;
  #expected = 0; // presses that wait until all before them are carried out
  #answered = {}; // the text to which the newest answer of each kind belongs
  #sheetTimer = 0;

  // ---- edits ----

  edit(operations, group = null) {
    const last = this.#queue.at(-1);
    if (group && last?.group === group) { // a drag that goes faster than the answers
      last.operations = operations;
      return last.promise;
    }
    return this.#enqueue({ operations, group });
  }

  write(text, group = null) {
    const last = this.#queue.at(-1);
    if (group && last?.group === group) {
      last.text = text;
      return last.promise;
    }
    return this.#enqueue({ text, group });
  }

  undo() { return this.#enqueue({ step: -1 }); }
  redo() { return this.#enqueue({ step: 1 }); }

  get canUndo() { return this.#place > 0; }
  get canRedo() { return this.#place < this.#history.length - 1; }

  #enqueue(task) {
    task.promise = new Promise((resolve) => { task.resolve = resolve; });
    this.#queue.push(task);
    if (!this.#working) this.#work();
    return task.promise;
  }

  async #work() {
    this.#working = true;
    while (this.#queue.length) {
      const task = this.#queue.shift();
      task.resolve(await this.#carryOut(task));
    }
    this.#working = false;
    this.#changed();
  }

  async #carryOut(task) {
    let text = task.text ?? this.text;
    if (task.step) {
      const place = this.#place + task.step;
      if (place < 0 || place >= this.#history.length) return { made: [], faults: this.faults };
      this.#place = place;
      text = this.#history[place].text;
    }
    const answer = await ask("edit", { text, operations: task.operations ?? [] });
    if (answer.text === undefined) { // neither read nor edited
      this.failures = answer.faults;
      if (task.text !== undefined || task.step) this.#take(text, this.objects, answer.faults.map(asFault), false, task);
      return answer;
    }
    if (answer.refused) this.#tell(answer.refused);
    this.#take(answer.text, answer.objects, answer.faults, answer.objects !== null, task);
    return answer;
  }

  #take(text, objects, faults, readable, task) {
    const changed = text !== this.text;
    this.text = text;
    this.objects = objects ?? this.objects;
    this.faults = faults;
    this.readable = readable;
    if (changed && !task.step) this.#remember(text, task.group);
    if (changed || !this.results) {
      this.failures = [];
      if (changed) this.motion = null;
      if (faults.length || !this.hasMechanism) this.results = this.sheet = null;
      else {
        this.#askNumbers();
        this.askSheet();
      }
    }
    this.#changed();
  }

  get hasMechanism() { return Object.keys(this.objects.links).length > 0; }

  #remember(text, group) {
    if (group && this.#history[this.#place].group === group) {
      this.#history[this.#place].text = text;
      this.#history.length = this.#place + 1;
      return;
    }
    this.#history.length = this.#place + 1;
    this.#history.push({ text, group });
    if (this.#history.length > MAX_HISTORY) this.#history.shift();
    this.#place = this.#history.length - 1;
  }

  begin(text) { // what the board opens with cannot be undone
    this.#history = [{ text: "", group: null }];
    this.#place = 0;
    return this.write(text).then((answer) => {
      this.#history = [{ text: this.text, group: null }];
      this.#place = 0;
      this.#changed();
      return answer;
    });
  }

  // ---- answers ----

  async #ask(kind, data) {
    const { text } = this;
    this.#asking += 1;
    const answer = await ask(kind, { text, language: this.language, ...data });
    this.#asking -= 1;
    const wanted = !answer.superseded && (text === this.text || this.#working);
    if (wanted) this.#answered[kind] = text;
    return wanted ? answer : null;
  }

  async #askNumbers() {
    const answer = await this.#ask("numbers");
    if (answer && !this.faults.length) {
      this.results = answer.results ?? null;
      this.failures = answer.faults;
      this.dispatchEvent(new Event("numbers"));
    }
    this.#changed();
  }

  askSheet() {
    clearTimeout(this.#sheetTimer);
    this.#sheetTimer = 0;
    if (!this.wantsSheet || this.#answered.sheet === this.text && this.sheet) return;
    if (this.faults.length || !this.readable || !this.hasMechanism) return;
    this.#sheetTimer = setTimeout(async () => {
      this.#sheetTimer = 0;
      const answer = await this.#ask("sheet");
      if (answer) {
        this.sheet = answer.pages && !this.faults.length ? answer : null;
        if (!answer.pages) this.failures = [...new Set([...this.failures, ...answer.faults])];
        this.dispatchEvent(new Event("sheet"));
      }
      this.#changed();
    }, SHEET_DELAY);
  }

  async askMotion() {
    if (this.motion || this.faults.length) return this.motion;
    const answer = await this.#ask("motion");
    if (answer?.points) this.motion = answer;
    else if (answer) this.#tell(answer.faults.join("\n"));
    this.#changed();
    return this.motion;
  }

  // ---- what is told ----

  get editing() { return this.#working; }

  async edited() {
    while (this.#working) await this.#progress();
  }

  expect(count) { // of what is about to edit
    this.#expected += count;
    if (!this.#expected) this.dispatchEvent(new Event("progress"));
  }

  get busy() { return this.#expected > 0 || this.#working || this.#asking > 0 || this.#sheetTimer > 0; }

  async settled() {
    while (this.busy) await this.#progress();
  }

  allFaults() { return [...this.faults.map((fault) => fault.text), ...this.failures]; }

  resultsNow() { return this.#answered.numbers === this.text ? this.results : null; }

  #tell(text) { this.dispatchEvent(new CustomEvent("tell", { detail: text })); }

  tell(text) { this.#tell(text); }

  #changed() {
    this.dispatchEvent(new Event("change"));
    this.dispatchEvent(new Event("progress"));
  }

  #progress() { return new Promise((resolve) => { this.addEventListener("progress", resolve, { once: true }); }); }
}

function asFault(text) { return { text, object: null, line: null, missing: false }; }

export const store = new Store();
