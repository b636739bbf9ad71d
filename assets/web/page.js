// The page around the worker: sizes, keys, pointer, files, words.
"use strict";

const NAMED = ["ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight", "PageUp", "PageDown", "Home", "Tab", "BackTab", "Enter", "Escape", "Backspace", "F1"];
const FIRST_NAMED = 0x110000;
const SCAN = /\.(npy|csv|txt|x3p|sur)$/i; // measured surfaces
const MOST_SCAN = 64 << 20;
const MOST_TEXT = 256 << 10;

const at = (id) => document.getElementById(id);
const screen_ = at("screen");
const painter = new Painter(screen_);
const state = { firstLifeMs: null, spoken: "", steps: 0, seconds: 0, bytes: 0, nodes: 129, link: "", caption: "", broken: null, refused: null };
let worker = null;
let isInstead = false;
let isHeld = false;

function module_() {
  const inline = at("module");
  if (!inline) return fetch("asperity.wasm.gz").then((answer) => answer.arrayBuffer());
  return Promise.resolve(Uint8Array.from(atob(inline.textContent.trim()), (c) => c.charCodeAt(0)).buffer);
}

function newWorker() {
  const inline = at("worker");
  if (!inline) return new Worker("worker.js");
  return new Worker(URL.createObjectURL(new Blob([inline.textContent], { type: "text/javascript" })));
}

// The address's key=value pairs, one a line.
function link() {
  const decoded = (text) => { try { return decodeURIComponent(text); } catch { return text; } };
  const pairs = location.hash.slice(1).split("&").filter(Boolean);
  return pairs.map((pair) => decoded(pair).replace(/[\r\n]/g, " ")).join("\n");
}

function size() {
  const room = at("room").getBoundingClientRect();
  return painter.fit(room.width, room.height, window.devicePixelRatio || 1);
}

function tell(words, isBad) {
  const box = at("told");
  box.textContent = words;
  box.hidden = !words;
  box.className = isBad ? "bad" : "";
}

// A key or a click: what was told has been read.
function heed() {
  if (!state.broken) tell("");
}

function hear(event) {
  const m = event.data;
  if (m.loaded) open();
  if (m.resized) painter.begin(m.resized);
  if (m.opened) {
    painter.begin(m.opened);
    // What opens in the place of a refused link leaves its reason on the page.
    if (isInstead) isInstead = false;
    else {
      state.refused = null;
      heed();
    }
  }
  if (m.refused) {
    state.refused = m.refused;
    tell(painter.columns ? m.refused : `${m.refused}\nShown instead: the scene that this page begins with.`, true);
    if (!painter.columns) { isInstead = true; history.replaceState(null, "", "#"); open(); }
  }
  if (m.broken) {
    state.broken = m.broken;
    tell(`A programming error ended the explorer: ${m.broken}. Reload the page to start again.`, true);
  }
  if (m.cells) {
    painter.cells(m.cells);
    if (m.curves) painter.curves(m.curves);
    if (m.picture) painter.picture(m.picture);
    painter.paintPlots();
    worker.postMessage({ kind: "painted" });
    if (!m.goesOn) {
      at("ended").hidden = false;
      at("again").focus();
    }
  }
  if (m.spoken !== undefined) {
    news(m);
    teach(m.caption);
  }
  if (m.file) {
    const end = m.file.indexOf("\n");
    save(m.file.slice(0, end), m.file.slice(end + 1));
  }
  if (m.save) save(...m.save);
}

function news(m) {
  if (state.firstLifeMs === null && m.spoken.startsWith("Relative life")) state.firstLifeMs = performance.now();
  state.bytes = m.bytes;
  const frames = (m.steps - state.steps) / (m.seconds - state.seconds);
  const nodes = Number(/nodes=(\d+)/.exec(m.link)?.[1] ?? 129);
  if (m.seconds - state.seconds > 2 || m.seconds < state.seconds) {
    Object.assign(state, { steps: m.steps, seconds: m.seconds, frames });
    if (frames > 0) at("speed").textContent = `${nodes} × ${nodes} nodes, ${frames.toFixed(0)} frames/s here`;
    at("text").textContent = painter.text();
  }
  // Buttons and words follow the screen.
  const paper = painter.paper([0, 0]);
  at("room").style.background = paper;
  document.documentElement.classList.toggle("light", Number.parseInt(paper.slice(1), 16) > 0x7fffff);
  // What is spoken waits for the end of a change.
  if (m.spoken !== state.spoken && (!at("spoken").textContent || m.spoken.includes("settled"))) at("spoken").textContent = m.spoken;
  state.spoken = m.spoken;
  Object.assign(state, { nodes, link: m.link });
  const hash = `#${m.link}`;
  if (location.hash !== hash && !/lesson=/.test(location.hash)) {
    try { history.replaceState(null, "", hash); } catch { /* some places keep their address */ }
  }
}

// What a lesson or the scene says, in the page's own letters; its answers as buttons.
function teach(caption) {
  // Nothing moves under a finger that turns a knob.
  if (caption === state.caption || isHeld) return;
  state.caption = caption;
  const [who, title, words, figures, ...answers] = caption.split("\n");
  at("lesson").hidden = !caption;
  at("lesson").className = who;
  // What is told is heard once; its numbers go on changing.
  const say = (id, text) => { if (at(id).textContent !== (text ?? "")) at(id).textContent = text ?? ""; };
  say("title", title);
  say("said", words);
  say("figures", figures);
  const old = [...at("answers").children].map((button) => button.textContent);
  const texts = answers.map((answer, k) => `${k + 1} ${answer}`);
  if (old.join("\n") === texts.join("\n")) return;
  at("answers").replaceChildren(...texts.map((text, k) => {
    const button = document.createElement("button");
    button.textContent = text;
    button.addEventListener("click", () => { press(String(k + 1), 0); screen_.focus(); });
    return button;
  }));
}

function open() {
  worker.postMessage({ kind: "open", link: link(), screen: size() });
  at("ended").hidden = true;
}

function save(name, text) {
  download(name, new Blob([text], { type: "text/plain" }));
}

function download(name, blob) {
  const a = document.createElement("a");
  a.href = URL.createObjectURL(blob);
  a.download = name;
  a.click();
  setTimeout(() => URL.revokeObjectURL(a.href), 10000);
}

function key(event) {
  if (event.metaKey || (event.ctrlKey && !/^[czCZ]$/.test(event.key))) return;
  if (event.key === "F6") { at("table").focus(); event.preventDefault(); return; }
  let name = event.key === "Tab" && event.shiftKey ? "BackTab" : event.key;
  press(name, (event.shiftKey ? 1 : 0) | (event.ctrlKey ? 2 : 0) | (event.altKey ? 4 : 0)) && event.preventDefault();
}

// Whether the explorer takes such a key at all.
function press(name, held) {
  const place = NAMED.indexOf(name);
  const letters = [...name];
  if (place < 0 && letters.length !== 1) return false;
  const code = place < 0 ? letters[0].codePointAt(0) : FIRST_NAMED + place;
  if (held === 2 && /^[zq]$/i.test(name)) return true;
  heed();
  worker.postMessage({ kind: "key", code, held });
  return true;
}

function point(act, event) {
  const box = screen_.getBoundingClientRect();
  const column = Math.floor((event.clientX - box.left) / box.width * painter.columns);
  const row = Math.floor((event.clientY - box.top) / box.height * painter.rows);
  const within = (value, most) => Math.min(most - 1, Math.max(0, value));
  worker.postMessage({ kind: "pointer", act, column: within(column, painter.columns), row: within(row, painter.rows) });
}

function watch() {
  screen_.addEventListener("keydown", key);
  screen_.addEventListener("pointerdown", (event) => {
    screen_.focus();
    heed();
    isHeld = true;
    if (event.button === 0) { screen_.setPointerCapture(event.pointerId); point(0, event); }
    if (event.button === 2) point(2, event);
  });
  screen_.addEventListener("pointermove", (event) => event.buttons & 1 && point(1, event));
  for (const end of ["pointerup", "pointercancel"]) screen_.addEventListener(end, () => { isHeld = false; });
  screen_.addEventListener("contextmenu", (event) => event.preventDefault());
  screen_.addEventListener("wheel", (event) => {
    event.preventDefault();
    if (event.deltaY) point(event.deltaY < 0 ? 3 : 4, event);
  }, { passive: false });
  for (const button of document.querySelectorAll("[data-key]")) {
    button.addEventListener("click", (event) => {
      press(button.dataset.key, 0);
      // After a finger or a mouse the keyboard is the explorer's; who came by keyboard stays.
      if (event.detail) screen_.focus();
    });
  }
  at("table").addEventListener("click", () => worker.postMessage({ kind: "table" }));
  at("scene").addEventListener("click", () => worker.postMessage({ kind: "scene" }));
  at("picture").addEventListener("click", () => screen_.toBlob((blob) => download("asperity.png", blob)));
  at("again").addEventListener("click", () => { open(); screen_.focus(); });
  window.addEventListener("hashchange", open);
  window.addEventListener("dragover", (event) => event.preventDefault());
  window.addEventListener("drop", async (event) => {
    event.preventDefault();
    const file = event.dataTransfer.files[0];
    if (!file) return;
    if (SCAN.test(file.name) && file.size <= MOST_SCAN) mapDropped(file.name, await file.arrayBuffer());
    else dropped(file.size > MOST_TEXT ? "#".repeat(MOST_TEXT + 1) : await file.text());
  });
  let waits = 0;
  new ResizeObserver(() => {
    clearTimeout(waits);
    waits = setTimeout(() => painter.columns && worker.postMessage({ kind: "resize", screen: size() }), 60);
  }).observe(at("room"));
  const still = matchMedia("(prefers-reduced-motion: reduce)");
  const pace = () => worker.postMessage({ kind: "pace", ms: still.matches ? 500 : 25 });
  still.addEventListener("change", pace);
  pace();
}

function dropped(text) {
  worker.postMessage({ kind: "drop", text, screen: size() });
}

function mapDropped(name, bytes) {
  worker.postMessage({ kind: "map", name, bytes, screen: size() }, [bytes]);
}

// A run of a link's scene in a module of its own: its table, counters and time.
async function measure(pairs, steps) {
  const own = newWorker();
  const bytes = await module_();
  return new Promise((done) => {
    own.onmessage = (event) => {
      if (event.data.loaded) own.postMessage({ kind: "measure", link: pairs.replaceAll("&", "\n"), steps });
      if (event.data.measured || event.data.broken) { done(event.data.measured ?? event.data); own.terminate(); }
    };
    own.postMessage({ kind: "load", bytes }, [bytes]);
  });
}

window.asperity = { state, painter, measure, dropped, mapDropped };
worker = newWorker();
worker.onmessage = hear;
worker.onerror = (event) => { state.broken = event.message; tell(`The page cannot run: ${event.message}`, true); };
watch();
module_().then((bytes) => worker.postMessage({ kind: "load", bytes }, [bytes]), (error) => { state.broken = String(error); tell(state.broken, true); });
screen_.focus();
