// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A log that was recorded of the real daemon, played in the page.
import assert from "node:assert/strict";
import path from "node:path";
import { after, before, test } from "node:test";
import { number, PICTURES, shown, Stack, until, untilShown } from "./stack.mjs";

const FRAMES = 8;
const stack = new Stack();
let view, page, lists;

before(async () => {
  const log = path.join(stack.folder, "run.lcmlog");
  const config = stack.file("graspd.yaml", "sources: [{name: camera, channel: GRASPD_CLOUD, policy: all, publish_segments: always}]\n");
  const recorder = stack.start("graspd-log", log, "--channel", "GRASPD_.*");
  const listener = stack.start("graspd-listen", "--format", "json");
  await stack.startDaemon(config);
  const camera = stack.start("graspd-simulate", "--seed", "5", "--width", "320", "--rate", "4", "--frames", String(FRAMES));
  await camera.ended;
  lists = () => listener.text().split("\n").filter((line) => line.endsWith("}")).map((line) => JSON.parse(line));
  await until(() => lists().length === FRAMES, "all answers");
  lists = lists();
  await new Promise((done) => setTimeout(done, 1500)); // the last segmentation and status
  await stack.end(recorder);
  for (const program of stack.programs) if (program.child.exitCode === null) await stack.end(program);
  view = await stack.startView("--log", log);
  await stack.openBrowser();
  page = await stack.open(view.url);
  await untilShown(page, () => true, "a frame");
});
after(() => stack.stop());

const time = async () => Number(await page.inputValue("#timeline"));

test("plays to its end and stops there", async () => {
  await untilShown(page, (state) => state.seq === String(FRAMES - 1), "the last frame");
  await until(async () => (await page.textContent("#play")) === "Play", "the player to stop");
  assert.equal(await number(page, "glyphs"), lists[FRAMES - 1].handles.length);
  assert.ok(await page.isEnabled("[data-color=segment]"), "segments are in the log");
});

test("goes anywhere, and steps from there frame by frame", async () => {
  await page.locator("#timeline").evaluate((input) => {
    input.value = "0";
    input.dispatchEvent(new Event("change"));
  });
  await until(async () => (await time()) === 0, "the start");
  await page.click("#player-step");
  await untilShown(page, (state) => state.seq === "0", "the first frame");
  for (let seq = 1; seq < 4; ++seq) {
    await page.keyboard.press(".");
    const state = await untilShown(page, (now) => now.seq === String(seq), "frame " + seq);
    assert.equal(Number(state.glyphs), lists[seq].handles.length);
  }
  await page.screenshot({ path: path.join(PICTURES, "log.png") });
});

test("pauses, goes on, and changes its speed", async () => {
  await page.selectOption("#speed", "0.1");
  await page.click("#play");
  const start = await time();
  await until(async () => (await time()) > start, "the clock to run");
  await page.keyboard.press(" ");
  await until(async () => (await page.textContent("#play")) === "Play", "the pause");
  const paused = await time();
  await page.waitForTimeout(700);
  assert.equal(await time(), paused);
  await page.selectOption("#speed", "20");
  await page.click("#play");
  await untilShown(page, (state) => state.seq === String(FRAMES - 1), "the last frame");
});

test("without the token the player belongs to others; parameters belong to a daemon", async () => {
  const reader = await stack.open(view.url.split("#")[0]);
  await untilShown(reader, () => true, "a frame");
  const before = await shown(page);
  await reader.evaluate(() => window.page.connection.send({ type: "player", seek_us: 0 }));
  await reader.waitForFunction(() => !document.getElementById("note").hidden);
  assert.equal((await shown(page)).serial, before.serial);
  assert.ok(await page.isDisabled("#theta_low_deg"));
  assert.deepEqual(stack.errors, []);
});
