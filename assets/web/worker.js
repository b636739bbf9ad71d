// Owns the module: takes events, steps for some milliseconds, draws, and again.
"use strict";

const STEP_MS = 12; // of stepping between two looks at what has come
const PICTURE_MS = 50; // least time between two pictures of the map
const WORDS_MS = 300; // and between two sentences
let frameMs = 25; // least time between two drawings

let wasm = null;
let isOpen = false;
let isPainting = false;
let drawn = 0;
let pictured = 0;
let room = "";
let told = 0;
let hasLife = false;
let steps = 0;
let since = 0;
const start = performance.now();
const encoder = new TextEncoder();
const decoder = new TextDecoder();
const pulse = new MessageChannel();
pulse.port1.onmessage = turn;

function given() {
  return new Uint8Array(wasm.memory.buffer, wasm.outbox(), wasm.outbox_len()).slice();
}

function words(ask) {
  ask();
  return decoder.decode(given());
}

function put(text) {
  putBytes(encoder.encode(text));
}

function putBytes(bytes) {
  const at = wasm.inbox(bytes.length);
  new Uint8Array(wasm.memory.buffer, at, bytes.length).set(bytes);
}

async function load(bytes) {
  let stream = new Blob([bytes]).stream();
  const isPacked = new Uint8Array(bytes, 0, 1)[0] === 0x1f;
  if (isPacked) stream = stream.pipeThrough(new DecompressionStream("gzip"));
  const module = await new Response(stream).arrayBuffer();
  wasm = (await WebAssembly.instantiate(module, {})).instance.exports;
}

function opened(is, screen) {
  if (is) {
    if (!isOpen) { isOpen = true; pulse.port2.postMessage(0); }
    steps = 0;
    since = performance.now();
    drawn = pictured = told = 0;
    hasLife = isPainting = false;
    postMessage({ opened: screen });
  } else {
    postMessage({ refused: decoder.decode(given()) });
  }
}

function turn() {
  if (!isOpen) return;
  let made = 0;
  try {
    const began = performance.now();
    do {
      made = wasm.step();
      steps += made & 1;
    } while (made && performance.now() - began < STEP_MS);
    if (!isPainting && performance.now() - drawn >= (hasLife ? frameMs : Math.max(frameMs, 100))) draw();
  } catch (error) {
    fail(error);
    return;
  }
  if (made) pulse.port2.postMessage(0);
  else setTimeout(turn, 15);
}

function draw() {
  const now = performance.now();
  drawn = now;
  const goesOn = wasm.draw(now - start);
  const message = { cells: given(), goesOn: goesOn === 1 };
  const parts = [message.cells.buffer];
  wasm.curves();
  const curves = given();
  if (curves.length) {
    message.curves = curves;
    parts.push(curves.buffer);
  }
  // The cells of the picture: where they change, the old one is wiped.
  const place = message.cells.subarray(8, 24).join();
  if (now - pictured >= PICTURE_MS || place !== room) {
    room = place;
    wasm.picture();
    const picture = given();
    if (picture.length > 24) {
      message.picture = picture;
      parts.push(picture.buffer);
    }
    pictured = now;
  }
  // The first life is told as soon as it is there.
  const spoken = hasLife ? "" : words(wasm.spoken);
  const isFirst = spoken.startsWith("Relative life");
  hasLife ||= isFirst;
  if (now - told >= WORDS_MS || isFirst) {
    told = now;
    message.spoken = spoken || words(wasm.spoken);
    message.caption = words(wasm.caption);
    message.link = words(wasm.link);
    message.steps = steps;
    message.seconds = (now - since) / 1000;
    message.bytes = wasm.memory.buffer.byteLength;
  }
  const file = words(wasm.saved);
  if (file) message.file = file;
  isPainting = true;
  postMessage(message, parts);
  if (!goesOn) isOpen = false;
}

// A programming error: the module is broken off, what it said is told.
function fail(error) {
  isOpen = false;
  let said = String(error);
  try { said = words(wasm.panic_words) || said; } catch { /* it said nothing */ }
  postMessage({ broken: said });
}

const hear = {
  load: async (m) => {
    await load(m.bytes);
    postMessage({ loaded: true });
  },
  open: (m) => { put(m.link); opened(wasm.open(...m.screen), m.screen); },
  drop: (m) => { put(m.text); opened(wasm.drop_file(...m.screen), m.screen); },
  map: (m) => {
    const name = encoder.encode(`${m.name}\n`);
    const bytes = new Uint8Array(name.length + m.bytes.byteLength);
    bytes.set(name);
    bytes.set(new Uint8Array(m.bytes), name.length);
    putBytes(bytes);
    opened(wasm.drop_map(...m.screen), m.screen);
  },
  resize: (m) => { wasm.resize(...m.screen); drawn = pictured = 0; isPainting = false; postMessage({ resized: m.screen }); },
  key: (m) => wasm.key(m.code, m.held),
  pointer: (m) => wasm.pointer(m.act, m.column, m.row),
  painted: () => { isPainting = false; },
  pace: (m) => { frameMs = m.ms; },
  table: () => postMessage({ save: ["asperity.csv", words(wasm.table)] }),
  scene: () => postMessage({ save: ["asperity.toml", words(wasm.scene)] }),
  measure: (m) => {
    const began = performance.now();
    put(m.link);
    const is = wasm.measure(m.steps);
    const seconds = (performance.now() - began) / 1000;
    postMessage({ measured: { is: is === 1, seconds, text: decoder.decode(given()), bytes: wasm.memory.buffer.byteLength } });
  },
};

onmessage = async (event) => {
  try {
    await hear[event.data.kind](event.data);
  } catch (error) {
    fail(error);
  }
};
