// The page in headless Chromium: node tests/web/page.mjs PAGES PROGRAM [SHOTS]
//   PAGES    what assets/web/build.py made: asperity.html, folder/
//   PROGRAM  the terminal program, for the same numbers and times
//   SHOTS    where screenshots go
// Needs playwright-core and Chromium (CHROMIUM, else /usr/bin/chromium).
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import http from "node:http";
import os from "node:os";
import path from "node:path";
import { createRequire } from "node:module";

const [pages, program, shots] = process.argv.slice(2).map((given) => path.resolve(given));
const { chromium } = createRequire(path.join(process.env.PLAYWRIGHT ?? process.cwd(), "x.js"))("playwright-core");
const FIRST_LIFE_MS = 3000;
const FRAMES = 200;
const SCENES = ["demonstration_quick", "twin_disc", "mtm_ball_on_disc"];
const SLOWER = 4; // times the native single thread, at most

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"],
});

const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".gz": "application/octet-stream" };
const server = http.createServer((ask, answer) => {
  const name = ask.url === "/" ? "index.html" : path.basename(ask.url);
  const file = path.join(pages, "folder", name);
  if (!fs.existsSync(file)) return answer.writeHead(404).end();
  answer.writeHead(200, { "content-type": types[path.extname(name)] }).end(fs.readFileSync(file));
});
await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
const local = `http://127.0.0.1:${server.address().port}/`;
const disk = `file://${path.join(pages, "asperity.html")}`;

// A page whose every error and request is kept.
async function opened(url, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, ...options });
  const page = await context.newPage();
  page.faults = [];
  page.on("pageerror", (error) => page.faults.push(String(error)));
  page.on("console", (line) => ["error", "warning"].includes(line.type()) && page.faults.push(line.text()));
  page.on("request", (ask) => {
    const own = ask.url().startsWith("data:") || ask.url().startsWith("blob:") || ask.url().split("#")[0] === url.split("#")[0];
    if (!own && !(url.startsWith(local) && ask.url().startsWith(local))) page.faults.push(`request ${ask.url()}`);
  });
  await page.goto(url);
  return page;
}
const state = (page) => page.evaluate(() => ({ ...asperity.state, hash: location.hash, text: asperity.painter.text(), told: document.getElementById("told").textContent }));
const life = async (page) => Number(/^Relative life ([\d.e-]+)/.exec((await state(page)).spoken)?.[1]);
async function until(page, what, holds, seconds = 20) {
  const end = Date.now() + 1000 * seconds;
  for (;;) {
    const now = await state(page);
    if (holds(now)) return now;
    assert.ok(!now.broken, now.broken);
    if (Date.now() > end) assert.fail(`${what} within ${seconds} s\n${now.hash} ${now.spoken} ${now.told}\n${now.text}`);
    await page.waitForTimeout(100);
  }
}
const alive = (page) => until(page, "a first life", (now) => now.firstLifeMs !== null);
async function shot(page, name) {
  if (shots) await page.screenshot({ path: path.join(shots, `web_${name}.png`) });
}
// The middle of a cell on the page.
const cell = (page, column, row) => page.evaluate(([column, row]) => {
  const box = document.getElementById("screen").getBoundingClientRect();
  return [box.left + (column + 0.5) * box.width / asperity.painter.columns, box.top + (row + 0.5) * box.height / asperity.painter.rows];
}, [column, row]);
// The row of the screen with a knob's name in its first columns.
async function knobRow(page, name) {
  const rows = (await state(page)).text.split("\n");
  const row = rows.findIndex((line) => line.slice(0, 30).includes(name));
  assert.ok(row >= 0, `${name}\n${rows.join("\n")}`);
  return row;
}

let passed = 0;
async function test(name, work) {
  try {
    await work();
    passed += 1;
    console.log(`ok   ${name}`);
  } catch (error) {
    console.log(`FAIL ${name}\n${error.stack}`);
    process.exitCode = 1;
  }
}

await test("from the disk: a life within 3 s, knobs by key, mouse and wheel, no error, no request", async () => {
  const page = await opened(disk);
  const now = await alive(page);
  console.log(`     first life ${now.firstLifeMs.toFixed(0)} ms after the page began`);
  assert.ok(now.firstLifeMs <= FIRST_LIFE_MS);
  assert.deepEqual(page.faults, []);
  const before = await life(page);
  await page.keyboard.press("Shift+ArrowRight");
  await until(page, "S by key", (now) => /S=/.test(now.hash));
  await until(page, "another life", (now) => Math.abs(Number(/life ([\d.e-]+)/.exec(now.spoken)?.[1]) / before - 1) > 0.01);
  const load = await knobRow(page, "load");
  const lifeOfS = await life(page);
  await page.mouse.click(...await cell(page, 5, load + 1));
  await until(page, "load by mouse", (now) => /load=/.test(now.hash));
  await until(page, "another life", (now) => Math.abs(Number(/life ([\d.e-]+)/.exec(now.spoken)?.[1]) / lifeOfS - 1) > 0.01);
  await shot(page, "explorer");
  assert.deepEqual(page.faults, []);
  await page.context().close();
});

await test("from a server, by touch, on a phone", async () => {
  const page = await opened(local, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 });
  await alive(page);
  const before = await life(page);
  const row = await knobRow(page, "A₁");
  await page.touchscreen.tap(...await cell(page, 4, row + 1));
  await until(page, "roughness by touch", (now) => /A1=/.test(now.hash));
  await until(page, "another life", (now) => Math.abs(Number(/life ([\d.e-]+)/.exec(now.spoken)?.[1]) / before - 1) > 0.01);
  await shot(page, "phone");
  assert.deepEqual(page.faults, []);
  await page.context().close();
});

await test("sizes from phone to projector", async () => {
  const page = await opened(disk);
  await alive(page);
  for (const [width, height] of [[360, 640], [844, 390], [1024, 768], [1920, 1080], [3840, 2160]]) {
    await page.setViewportSize({ width, height });
    await until(page, `${width}x${height}`, (now) => /life/i.test(now.text) && !/too small/.test(now.text));
    if (width === 1920) await shot(page, "projector");
  }
  assert.deepEqual(page.faults, []);
  await page.context().close();
});

await test("a lesson asks and answers", async () => {
  const page = await opened(`${disk}#lesson=load`);
  const question = "The load is doubled. What does the greatest pressure";
  for (let beat = 0; beat < 4; beat++) {
    await page.waitForTimeout(2500);
    if ((await state(page)).text.includes(question)) break;
    await page.keyboard.press("n");
  }
  await until(page, "a question", (now) => now.text.includes(question) && now.text.includes("forty per cent more"));
  await shot(page, "lesson");
  await page.keyboard.press("n");
  await until(page, "the lesson shows it", (now) => now.text.includes("cube root"), 60);
  assert.deepEqual(page.faults, []);
  await page.context().close();
});

await test("links are obeyed, hostile ones refused in words", async () => {
  const page = await opened(`${disk}#scene=twin_disc&S=0.2&nodes=65`);
  await until(page, "the link's scene", (now) => /scene=twin_disc/.test(now.hash));
  for (const hostile of ["scene=%3Cscript%3E", "S=NaN", "S=1e300", "load=-1", "nodes=99999999", "A1=1", "x=1", "motion.slide_roll=[[[", "%00=%ff"]) {
    const bad = await opened(`${disk}#${hostile}`);
    await until(bad, hostile, (now) => now.refused);
    assert.equal((await state(bad)).broken, null);
    await bad.context().close();
  }
  await page.evaluate(() => asperity.dropped("no = [scene"));
  await until(page, "a bad file is refused", (now) => now.refused);
  assert.deepEqual(page.faults, []);
  await page.context().close();
});

// A table of comma-separated values as rows by column names.
function rows(csv) {
  const [head, ...lines] = csv.trim().split("\n").map((line) => line.split(","));
  return lines.map((line) => Object.fromEntries(line.map((value, i) => [head[i], value])));
}

await test("the native program's numbers, counters and time", async () => {
  const page = await opened(disk);
  await alive(page);
  // The explorer rests meanwhile.
  await page.keyboard.press(" ");
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), "asperity-web-"));
  for (const scene of SCENES) {
    const made = await page.evaluate(([link, steps]) => asperity.measure(link, steps), [`scene=${scene}&nodes=65`, FRAMES]);
    assert.ok(made.is, made.text ?? made.broken);
    const cut = made.text.lastIndexOf("\n") + 1;
    const [mine, counters] = [rows(made.text.slice(0, cut)), JSON.parse(made.text.slice(cut))];
    const table = path.join(folder, `${scene}.csv`), summary = path.join(folder, `${scene}.json`);
    execFileSync(program, ["run", scene, "--set", "grid.nodes=65", "--set", "numerics.error_estimate=none", "--no-record", "--threads", "1", "--passages", "4", "--table", table, "--summary", summary], { stdio: "ignore" });
    const native = rows(fs.readFileSync(table, "utf8"));
    const told = JSON.parse(fs.readFileSync(summary, "utf8"));
    const least = Math.min(FRAMES, native.length);
    let [central, film, lifes, counts] = [0, 0, 0, 0];
    for (let i = 0; i < least; i++) {
      const off = (name) => native[i][name] === "" ? Number(mine[i][name] !== "") : Math.abs(mine[i][name] / native[i][name] - 1);
      central = Math.max(central, off("h_central_m"));
      film = Math.max(film, off("h_min_m"));
      lifes = Math.max(lifes, off("life_relative"));
      for (const name of Object.keys(native[i]).filter((name) => /iterations|ffts|retries/.test(name))) counts += mine[i][name] !== native[i][name];
    }
    const ratio = made.seconds / counters.steps / (told.wall_s / told.counters.steps);
    console.log(`     ${scene}: ${least} frames, central film off by ${central.toExponential(1)}, least by ${film.toExponential(1)}, life by ${lifes.toExponential(1)}, ${counts} counts differ; ${(1000 * made.seconds / counters.steps).toFixed(1)} ms a step, ${ratio.toFixed(2)} times native`);
    // A page rounds product and sum apart and takes its sums in other lanes. Both iterate until a residual is small, not
    // until the last bit stands, so that what differs is of the size that the iteration leaves: least films, spots of some
    // nm, feel it first.
    const words = `${central} ${film} ${lifes} ${counts} ${least}`;
    assert.ok(central <= 1e-5 && film <= 1e-5 && lifes <= 1e-5 && counts === 0 && least === FRAMES, words);
    if (scene === SCENES[0]) assert.ok(ratio <= SLOWER, `${ratio}`);
  }
  fs.rmSync(folder, { recursive: true });
  await page.context().close();
});

await test("memory stays where it is", async () => {
  const page = await opened(disk);
  await alive(page);
  const seconds = Number(process.env.ASPERITY_PAGE_S ?? 20);
  await page.waitForTimeout(5000);
  const before = (await state(page)).bytes;
  await page.waitForTimeout(1000 * seconds);
  const after = await state(page);
  console.log(`     ${before} bytes, ${after.bytes} after ${seconds} s; ${(after.frames ?? 0).toFixed(0)} whole frames/s on ${after.nodes} nodes`);
  assert.ok(after.bytes <= 1.1 * before);
  assert.deepEqual(page.faults, []);
  await page.context().close();
});

await browser.close();
server.close();
console.log(`${passed} passed, ${process.exitCode ? "some" : 0} failed`);
