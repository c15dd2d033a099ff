// The board: puts its parts together, and lets tests and teachers' own scripts drive it as window.board.

import { Drawing } from "./drawing.js";
import { Inspector } from "./inspector.js";
import { Panels, save } from "./panels.js";
import { ask, store, words as wordsIn } from "./store.js";
import { TOOLS, Tools } from "./tools.js";
import { View } from "./view.js";

const MESSAGE = 7000; // ms for which a message stands
const TURN = 6000; // ms of a turn of the drive when the mechanism runs
const KEPT = "graphplan board"; // under what name the browser keeps the text while a page is loaded anew

const get = (id) => document.getElementById(id);
const words = {};
const view = new View();
const svg = get("drawing");
const drawing = new Drawing(svg, view, words);
const tools = new Tools(svg, view, drawing, words);
const inspector = new Inspector(get("inspector"), tools, words);
let panels, file = "", running = 0;

// ---- words ----

async function speak(language) {
  Object.assign(words, await wordsIn(language));
  store.language = document.documentElement.lang = language;
  for (const element of document.querySelectorAll("[data-word]")) element.textContent = words[element.dataset.word];
  for (const element of document.querySelectorAll("[data-label]")) element.setAttribute("aria-label", words[element.dataset.label]);
  for (const element of document.querySelectorAll("[data-key]")) {
    const { key } = element.dataset;
    element.setAttribute("aria-keyshortcuts", key);
    element.title = `${element.textContent.trim()} (${key.replace("Control", "Ctrl")})`;
  }
}

// ---- what is shown ----

function show() {
  drawing.objects = store.objects;
  drawing.results = store.results;
  drawing.faults = store.faults;
  if (tools.selected && drawing.placeOf(tools.selected.kind, tools.selected.name) === null) tools.selected = drawing.selected = null;
  drawing.draw();
  inspector.show();
  panels?.show();
  get("title").textContent = store.objects.title || "graphplan";
  get("undo").disabled = !store.canUndo;
  get("redo").disabled = !store.canRedo;
  get("save").disabled = false;
  get("motion").hidden = !store.results || !store.objects.drives.length;
  svg.classList.toggle("unreadable", !store.readable);
  showFaults();
  get("hint").textContent = tools.hint;
  for (const button of document.querySelectorAll("#tools button")) button.setAttribute("aria-pressed", button.dataset.tool === tools.tool);
  svg.dataset.tool = tools.tool;
  try {
    sessionStorage.setItem(KEPT + location.port, JSON.stringify({ text: store.text, token: document.documentElement.dataset.base }));
  } catch { /* the browser keeps nothing */ }
}

function showFaults() {
  const list = get("faults").firstElementChild;
  const faults = [...store.faults, ...store.failures.map((text) => ({ text, object: null, line: null, missing: false }))];
  const started = Object.keys(store.objects.points).length > 0 || store.text.trim() !== "";
  get("faults").hidden = !faults.length || !started;
  list.replaceChildren(...faults.map((fault) => {
    const item = document.createElement("li");
    item.className = fault.missing ? "missing" : "fault";
    const told = document.createElement(fault.line || fault.object ? "a" : "span");
    told.textContent = fault.text;
    if (told.localName === "a") {
      told.href = "#scene";
      told.addEventListener("click", (event) => {
        event.preventDefault();
        if (fault.object) tools.select({ kind: fault.object[0], name: fault.object[1] });
        if (fault.line) panels.goTo(fault.line);
      });
    }
    item.append(told);
    return item;
  }));
}

let messageTimer = 0;
function tell(text) {
  const box = get("message");
  box.textContent = text;
  box.hidden = false;
  clearTimeout(messageTimer);
  messageTimer = setTimeout(() => { box.hidden = true; }, MESSAGE);
}

// ---- motion ----

function showPose(place) {
  const { motion } = store;
  if (!motion) return;
  const number = Math.min(Math.round(place), motion.travel.length - 1);
  drawing.pose = number === 0 ? null : Object.fromEntries(Object.entries(motion.points).filter(([, at]) => at[number])
    .map(([name, at]) => [name, at[number]]));
  const [scale, unit] = motion.unit, travel = motion.travel[number] / scale;
  get("travel").value = number;
  get("travelled").textContent = unit === "degrees" ? `${Math.round(travel)}°` : `${Number(travel.toPrecision(3))} ${store.objects.units.length}`;
  drawing.draw();
}

async function run() {
  if (running) return stand();
  if (!(await store.askMotion()) || running) return undefined;
  get("run").setAttribute("aria-pressed", true);
  const count = store.motion.travel.length, begun = performance.now() - (Number(get("travel").value) / count) * TURN;
  const frame = (now) => {
    if (!store.motion) return stand();
    showPose(Math.floor(((now - begun) / TURN) * count) % count);
    running = requestAnimationFrame(frame);
    return undefined;
  };
  running = requestAnimationFrame(frame);
  return undefined;
}

function stand() {
  cancelAnimationFrame(running);
  running = 0;
  get("run").setAttribute("aria-pressed", false);
}

function backToGivenPose() {
  if (store.motion) return;
  stand();
  drawing.pose = null;
  get("travel").value = 0;
  get("travelled").textContent = "0°";
}

// ---- files ----

async function load(text) {
  await tools.take("select");
  tools.select(null);
  const answer = await store.write(text);
  fitWhereNeeded(true);
  return answer;
}

function fitWhereNeeded(always = false) {
  const places = Object.values(store.objects.points).map((point) => point.at);
  if (always || !view.holds(places)) view.fit(places);
  drawing.draw();
}

async function take(given) {
  if (!given) return;
  if (given.name.toLowerCase().endsWith(".toml")) return void load(await given.text());
  const answer = await ask(`import/${encodeURIComponent(given.name)}`, given);
  if (answer.text === undefined) return void tell(answer.faults.join("\n"));
  await load(answer.text);
  if (answer.remarks.length) tell(answer.remarks.join("\n"));
}

async function saveFile() {
  await store.settled();
  if (!file) return download();
  const answer = await ask("save", { text: store.text });
  tell(answer.faults.join("\n") || `${words.saved}: ${answer.file}`);
  return undefined;
}

function download() {
  save(store.text, (file.split(/[\\/]/).pop() || "scene.toml"), "application/toml");
}

// ---- keys and buttons ----

function isTyping(target) { return target.matches?.("input:not([type=range], [type=checkbox]), textarea, select"); }

function onKey(event) {
  const control = event.ctrlKey || event.metaKey, key = event.key.toLowerCase();
  if (control && key === "s") return event.preventDefault(), void saveFile();
  if (control && key === "o") return event.preventDefault(), get("file").click();
  if (isTyping(event.target)) return undefined;
  if (control && key === "z") return event.preventDefault(), tools.later(() => (event.shiftKey ? store.redo() : store.undo()));
  if (control && key === "y") return event.preventDefault(), tools.later(() => store.redo());
  if (control || event.altKey) return undefined;
  if (event.key === "Enter" && tools.isLinking) return event.preventDefault(), tools.key(event);
  const inDrawing = svg.contains(event.target) || event.target === document.body;
  if ((inDrawing || event.key === "Escape") && tools.key(event)) return event.preventDefault();
  const button = [...document.querySelectorAll("[data-key]")].find((one) => one.dataset.key.toLowerCase() === key);
  if (button && !button.disabled && !button.closest("[hidden]")) return event.preventDefault(), button.click();
  return undefined;
}

function connect() {
  document.addEventListener("keydown", onKey);
  for (const button of document.querySelectorAll("#tools button")) {
    button.addEventListener("click", () => tools.take(button.dataset.tool));
  }
  get("tools").addEventListener("keydown", (event) => {
    const step = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    const buttons = [...get("tools").children];
    buttons[(buttons.indexOf(document.activeElement) + step + buttons.length) % buttons.length].focus();
    event.preventDefault();
  });
  const actions = {
    undo: () => tools.later(() => store.undo()), redo: () => tools.later(() => store.redo()), open: () => get("file").click(), save: saveFile, run,
    fit: () => fitWhereNeeded(true), "zoom-in": () => zoom(1.25), "zoom-out": () => zoom(0.8),
  };
  for (const [id, action] of Object.entries(actions)) get(id).addEventListener("click", action);
  const toggles = { grid: () => { view.snaps = !view.snaps; return view.snaps; },
                    vectors: () => { drawing.showsVectors = !drawing.showsVectors; return drawing.showsVectors; } };
  for (const [id, toggle] of Object.entries(toggles)) {
    get(id).addEventListener("click", () => {
      get(id).setAttribute("aria-pressed", toggle());
      drawing.draw();
    });
  }
  get("download").addEventListener("click", (event) => {
    event.preventDefault();
    download();
  });
  get("file").addEventListener("change", (event) => {
    take(event.target.files[0]);
    event.target.value = "";
  });
  get("scenes").addEventListener("change", async (event) => {
    const answer = await ask("open", { scene: event.target.value });
    event.target.value = "";
    if (answer.text === undefined) tell(answer.faults.join("\n"));
    else await load(answer.text);
  });
  document.addEventListener("dragover", (event) => event.preventDefault());
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    take(event.dataTransfer?.files[0]);
  });
  get("travel").addEventListener("input", async (event) => {
    const place = Number(event.target.value);
    stand();
    if (await store.askMotion()) showPose(place);
  });
  store.addEventListener("change", () => {
    backToGivenPose();
    const { language } = store.objects;
    if (language && language !== store.language) speak(language).then(show);
    show();
  });
  store.addEventListener("tell", (event) => tell(event.detail));
  tools.addEventListener("change", show);
  tools.addEventListener("place", ({ detail }) => { get("place").textContent = detail ? detail.join("; ") : ""; });
  new ResizeObserver(() => {
    view.resize(svg.clientWidth, svg.clientHeight);
    drawing.draw();
  }).observe(svg);
}

function zoom(factor) {
  view.zoom(factor);
  drawing.draw();
}

// ---- the beginning ----

async function begin() {
  view.resize(svg.clientWidth, svg.clientHeight);
  await speak(document.documentElement.lang);
  panels = new Panels(words);
  const known = await ask("open", {});
  file = known.file ?? "";
  for (const name of known.scenes ?? []) get("scenes").append(new Option(name, name));
  connect();
  let kept = null;
  try {
    kept = JSON.parse(sessionStorage.getItem(KEPT + location.port));
  } catch { /* nothing is kept */ }
  await store.begin(known.text ?? "");
  if (kept && kept.token === document.documentElement.dataset.base && kept.text !== known.text) await store.write(kept.text);
  fitWhereNeeded(true);
  if (!store.text) await tools.take("point"); // an empty board waits for the first
  show();
}

window.board = {
  ready: begin(),
  scene: () => store.text,
  load: async (text) => { await load(text); },
  screen: (place) => {
    const box = svg.getBoundingClientRect(), [x, y] = view.toScreen(place);
    return [box.left + x, box.top + y];
  },
  results: () => store.resultsNow(),
  faults: () => store.allFaults(),
  settled: () => store.settled(),
};
