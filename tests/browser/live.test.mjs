// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The live view against the real daemon and the simulated camera.
import assert from "node:assert/strict";
import net from "node:net";
import path from "node:path";
import { after, before, test } from "node:test";
import { number, PICTURES, readPcd, shown, Stack, until, untilShown } from "./stack.mjs";

const CAMERA = ["--type", "cloud", "--sensor", "ideal", "--seed", "3", "--width", "320"];
const stack = new Stack();
let view, page, listener, token;

before(async () => {
  token = stack.file("token", "a token of 24 letters ok\n");
  const config = stack.file("graspd.yaml", "lcm: {control_channel: GRASPD_CONTROL}\n");
  listener = stack.start("graspd-listen", "--format", "json");
  await stack.startDaemon(config);
  view = await stack.startView("--config", config, "--token-file", token);
  await stack.openBrowser();
  page = await stack.open(view.url);
  stack.empty = await page.evaluate(pixels);
  stack.start("graspd-simulate", ...CAMERA, "--rate", "3");
  await untilShown(page, (state) => Number(state.glyphs) > 0, "a frame with handles");
  await until(() => page.evaluate(() => !document.querySelector("[data-color=segment]").disabled), "segments");
});
after(() => stack.stop());

/** In the page: the picture as numbers. */
async function pixels() {
  const blob = await window.page.world.picture();
  const image = await createImageBitmap(blob);
  const canvas = new OffscreenCanvas(image.width, image.height);
  const context = canvas.getContext("2d");
  context.drawImage(image, 0, 0);
  return { width: image.width, height: image.height, data: [...context.getImageData(0, 0, image.width, image.height).data] };
}
/** The list that LCM carried for the frame that the page shows. */
const listOf = (state) => until(() => listener.text().split("\n").filter((line) => line.endsWith("}")).map((line) => JSON.parse(line))
  .find((list) => String(list.utime) === state.utime && String(list.seq) === state.seq), "the list of the shown frame");
const hold = async () => {
  if ((await page.textContent("#pause")) === "Pause") await page.click("#pause");
  await page.waitForTimeout(300); // a frame that is on its way still comes
};
const goOn = async () => {
  if ((await page.textContent("#pause")) !== "Pause") await page.click("#pause");
};
const picture = (name) => page.screenshot({ path: path.join(PICTURES, name + ".png") });

test("the picture changes when points come, and shows the scene's colours where its points are", async () => {
  stack.run("graspd-simulate", ...CAMERA, "--frames", "1", "--output", path.join(stack.folder, "truth"));
  const points = readPcd(path.join(stack.folder, "truth/camera0.pcd"));
  await page.keyboard.press("1");
  await page.keyboard.press("c");
  await page.keyboard.press("g");
  await page.keyboard.press("g");
  await untilShown(page, (state) => state.glyphs === "0", "the grippers to go");
  const image = await page.evaluate(pixels);
  const changed = image.data.filter((value, i) => i % 4 !== 3 && Math.abs(value - stack.empty.data[i]) > 16).length;
  assert.ok(changed > 0.3 * image.width * image.height, "the picture has hardly changed");
  const sample = points.filter((_, i) => i % 97 === 0);
  const places = await page.evaluate((list) => list.map((place) => {
    const bounds = document.getElementById("view").getBoundingClientRect();
    const at = window.page.world.project(place);
    return [at.x - bounds.left, at.y - bounds.top];
  }), sample.map((point) => point.place));
  let same = 0;
  let inside = 0;
  sample.forEach(({ rgb }, i) => {
    const [x, y] = places[i].map(Math.round);
    if (x < 2 || y < 40 || x > image.width - 120 || y > image.height - 40) return; // captions and axes are there
    ++inside;
    const at = 4 * (y * image.width + x);
    if (rgb.every((value, k) => Math.abs(value - image.data[at + k]) <= 40)) ++same;
  });
  await picture("rgb");
  await page.keyboard.press("g");
  assert.ok(inside > 200, inside + " points are in the picture");
  assert.ok(same > 0.9 * inside, same + " of " + inside + " points have their colour");
});

test("there is a gripper for each handle of the LCM message", async () => {
  await hold();
  const state = await shown(page);
  const list = await listOf(state);
  assert.ok(list.handles.length > 3);
  assert.equal(Number(state.glyphs), list.handles.length);
  assert.equal(await page.locator("#handles tbody tr").count(), list.handles.length);
  await page.fill("#min-score", "0.9");
  await untilShown(page, (now) => Number(now.glyphs) === list.handles.filter((h) => h.score >= 0.9).length, "the filter");
  await page.fill("#min-score", "0");
});

test("a click on a gripper shows the message's numbers", async () => {
  await hold();
  const list = await listOf(await shown(page));
  const { gripper } = list;
  const target = await page.evaluate(({ handles, back }) => {
    for (const handle of handles) {
      const palm = handle.position.map((v, k) => v - back * handle.approach[k]);
      const at = window.page.world.project(palm);
      if (window.page.world.pickHandle(at.x, at.y)?.id === handle.id) return { at, id: handle.id };
    }
    return null;
  }, { handles: list.handles, back: gripper.finger_length - gripper.grasp_depth + 0.004 });
  assert.ok(target, "no gripper can be seen");
  await page.mouse.click(target.at.x, target.at.y);
  const handle = list.handles[target.id];
  const value = (name) => page.textContent('#details dd[data-name="' + name + '"]');
  assert.equal(await page.getAttribute("#details > div", "data-id"), String(handle.id));
  assert.equal(await value("score"), handle.score.toFixed(3));
  assert.equal(await value("position [m]"), handle.position.map((v) => v.toFixed(4)).join("  "));
  assert.equal(await value("width [mm]"), (1000 * handle.width).toFixed(0) + " of " + (1000 * gripper.aperture).toFixed(0));
  assert.equal(await value("gaps -y / +y [mm]"), handle.gap.map((v) => (1000 * v).toFixed(0)).join(" / "));
  await picture("handle");
});

test("a click on a surface without a handle tells why", async () => {
  await page.keyboard.press("3");
  await page.keyboard.press("g");
  await page.keyboard.press("g");
  await page.keyboard.press("Escape");
  await hold();
  const found = await page.evaluate(() => {
    const { frame, world } = window.page;
    const listed = new Set(frame.info.list.handles.map((h) => h.segment_id));
    const { segmentationPoints: data, segmentationGrid: grid } = frame;
    for (let i = 0; i < data.length; i += 5) {
      const segment = frame.info.segmentation.segments[data[i + 3]];
      if (!segment || listed.has(segment.id) || data[i + 4] & 1) continue;
      const at = world.project([0, 1, 2].map((k) => grid.origin[k] + grid.step * data[i + k]));
      if (world.pickSegment(at.x, at.y) === segment.id) return { at, segment };
    }
    return null;
  });
  assert.ok(found, "every surface has a handle");
  await page.mouse.click(found.at.x, found.at.y);
  assert.equal(await page.getAttribute("#details > div", "data-kind"), "segment");
  assert.equal(await page.getAttribute("#details > div", "data-id"), String(found.segment.id));
  assert.equal(await page.textContent("#details .why"), found.segment.why);
  assert.ok(found.segment.why.length > 10);
  await picture("segment");
  await page.keyboard.press("g");
  await goOn();
});

test("a parameter changes the segments, and undo brings them back", async () => {
  await goOn();
  const old = await shown(page);
  const slide = (id, value) => page.locator("#" + id).evaluate((input, v) => {
    input.value = v;
    input.dispatchEvent(new Event("change"));
  }, value);
  await slide("theta_high_deg", "40");
  await untilShown(page, (state) => Number(state.revision) > Number(old.revision), "the first change");
  const first = await shown(page);
  await slide("theta_low_deg", "25");
  const changed = await untilShown(page, (state) => Number(state.revision) > Number(first.revision) && Number(state.segments) > 0, "the second change");
  assert.ok(Number(changed.segments) < Number(old.segments), changed.segments + " segments, " + old.segments + " before");
  await picture("parameters");
  await page.click("#undo");
  await untilShown(page, (state) => Number(state.revision) > Number(changed.revision), "the first undo");
  const middle = await number(page, "revision");
  await page.keyboard.press("u");
  await untilShown(page, (state) => Number(state.revision) > middle && state.segments === old.segments, "the segments of before");
  await until(async () => (await page.inputValue("#theta_low_deg")) === "4", "the slider to follow");
});

test("pause holds the picture, step takes one frame, go on goes on", async () => {
  await hold();
  const held = await number(page, "serial");
  await page.waitForTimeout(1500);
  assert.equal(await number(page, "serial"), held);
  await page.click("#step");
  await untilShown(page, (state) => Number(state.serial) > held, "the next frame");
  const next = await number(page, "serial");
  await page.waitForTimeout(1000);
  assert.equal(await number(page, "serial"), next);
  await goOn();
  await untilShown(page, (state) => Number(state.serial) > next, "more frames");
});

/** A WebSocket that never takes anything after the handshake. */
function stuckClient(url) {
  const { hostname, port } = new URL(url);
  const socket = net.connect(Number(port), hostname, () => socket.write("GET /socket HTTP/1.1\r\nHost: " + hostname + ":" + port +
    "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"));
  socket.pause();
  return socket;
}

test("three pages at once, and one that is stuck slows nobody", async () => {
  const others = [await stack.open(view.url), await stack.open(view.url)];
  const stuck = stuckClient(view.url);
  const pages = [page, ...others];
  for (const one of pages) await untilShown(one, () => true, "a first frame");
  const start = await Promise.all(pages.map((one) => number(one, "serial")));
  for (const [i, one] of pages.entries()) await untilShown(one, (state) => Number(state.serial) >= start[i] + 6, "six more frames");
  const counted = await until(() => page.evaluate(() => document.querySelector("#status p:last-child").textContent), "the server's numbers");
  assert.match(counted, /^4 pages open/);
  stuck.destroy();
  for (const one of others) await one.close();
});

test("without the token nothing can be changed, and pages of other origins get nothing", async () => {
  const base = view.url.split("#")[0];
  const reader = await stack.open(base);
  await untilShown(reader, () => true, "a frame without the token");
  assert.equal(await reader.textContent("#connection"), "read only");
  assert.ok(await reader.isDisabled("#theta_low_deg"));
  const revision = await number(page, "revision");
  await reader.evaluate(() => window.page.connection.send({ type: "set", source: "camera", theta_low_deg: 20 }));
  await reader.waitForFunction(() => !document.getElementById("note").hidden);
  await untilShown(page, () => true, "a frame");
  assert.equal(await number(page, "revision"), revision);
  await reader.close();
  const errors = stack.errors.length;
  const stranger = await stack.open("data:text/html,<p>a page of another origin</p>");
  const outcome = await stranger.evaluate((url) => new Promise((done) => {
    const socket = new WebSocket(url);
    socket.onopen = () => done("opened");
    socket.onerror = () => done("refused");
  }), base.replace("http", "ws") + "socket");
  assert.equal(outcome, "refused");
  await stranger.close();
  stack.errors.length = errors; // the stranger's own
  await until(() => page.evaluate(() => /2 requests refused/.test(document.querySelector("#status p:last-child").textContent)), "both to be counted");
});

test("dark, light and a phone", async () => {
  await page.keyboard.press("3");
  await page.keyboard.press("e");
  await untilShown(page, (state) => Number(state.glyphs) > 0, "grippers");
  await picture("dark");
  await page.keyboard.press("d");
  await page.keyboard.press("t");
  await page.waitForTimeout(500);
  await picture("light_top");
  await page.setViewportSize({ width: 390, height: 780 });
  await page.keyboard.press("c");
  await page.waitForTimeout(500);
  await picture("phone");
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(wide <= 390, "the page is " + wide + " pixels wide");
  await page.setViewportSize({ width: 1000, height: 640 });
  await page.keyboard.press("d");
});

test("the console is clean, and the page comes back when the server does", async () => {
  assert.deepEqual(stack.errors, []);
  const port = new URL(view.url).port;
  await stack.end(view);
  await until(async () => (await page.textContent("#connection")) === "lost", "the page to see it");
  const last = await shown(page);
  view = stack.start("graspd-view", "--port", port, "--token-file", token); // and the page by its old address
  await until(async () => (await page.textContent("#connection")) === "live", "the page to come back");
  await untilShown(page, (state) => Number(state.utime) > Number(last.utime), "new frames");
});
