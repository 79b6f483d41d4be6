// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The figures of client/view/README.md: node figures.mjs, by tests/browser/run --figures.
import fs from "node:fs";
import path from "node:path";
import { Stack, untilShown } from "./stack.mjs";

const SECONDS = 15;
const TICKS_PER_SECOND = 100; // of /proc/PID/stat on Linux
const stack = new Stack();

/** Processor seconds of a process so far. */
const cpu = (program) => {
  const fields = fs.readFileSync("/proc/" + program.child.pid + "/stat", "utf8").split(") ")[1].split(" ");
  return (Number(fields[11]) + Number(fields[12])) / TICKS_PER_SECOND;
};

/** In a page of the view's origin: takes frames as fast as they come, draws nothing. */
function takeFrames() {
  window.counted = { frames: 0, bytes: 0 };
  const socket = new WebSocket("ws://" + location.host + "/socket");
  socket.binaryType = "arraybuffer";
  socket.onmessage = ({ data }) => {
    window.counted.bytes += data.byteLength ?? data.length;
    if (!(data instanceof ArrayBuffer)) return;
    ++window.counted.frames;
    socket.send(JSON.stringify({ type: "ack", serial: Number(new DataView(data).getBigInt64(20, true)) }));
  };
}
/** In the view's own page: what is drawn. */
function countPictures() {
  window.counted = { frames: 0, bytes: 0, last: "" };
  setInterval(() => {
    const serial = document.body.dataset.serial;
    if (serial !== window.counted.last) ++window.counted.frames;
    window.counted.last = serial;
  }, 5);
  const { connection } = window.page;
  const received = connection.received.bind(connection);
  connection.received = (data) => {
    window.counted.bytes += data.byteLength ?? data.length;
    received(data);
  };
}

async function rates(page, view, what) {
  const counted = () => page.evaluate(() => ({ ...window.counted }));
  const [start, startCpu, startTime] = [await counted(), cpu(view), performance.now()];
  await page.waitForTimeout(1000 * SECONDS);
  const [end, endCpu] = [await counted(), cpu(view)];
  const seconds = (performance.now() - startTime) / 1000;
  const frames = (end.frames - start.frames) / seconds;
  const work = (endCpu - startCpu) / seconds;
  console.log([what, frames.toFixed(1) + " frames/s", ((end.bytes - start.bytes) / seconds / 1e6).toFixed(1) + " MB/s",
    (100 * work).toFixed(0) + " % of a core", ((1000 * work) / frames).toFixed(1) + " ms a frame"].join(", "));
}

async function measureServer(type) {
  const view = await stack.startView();
  // From files: to draw frames costs more than to show them.
  const camera = stack.start("graspd-publish", frames, "--rate", "15", "--loop", "--type", type);
  await new Promise((done) => setTimeout(done, 3000));
  const before = cpu(view);
  await new Promise((done) => setTimeout(done, 5000));
  console.log(type + ", no page: " + (20 * (cpu(view) - before)).toFixed(1) + " % of a core");
  const page = await stack.open(view.url.split("#")[0] + "icon.svg");
  await page.evaluate(takeFrames);
  await page.waitForTimeout(2000);
  await rates(page, view, type + ", taken and not drawn");
  await page.close();
  await stack.end(camera);
  console.log(type + ", sent: " + camera.errors().trim().split("\n").pop());
  await stack.end(view);
}

async function measurePage() {
  const daemon = await stack.startDaemon(stack.file("graspd.yaml", "{}\n"));
  const view = await stack.startView();
  const camera = stack.start("graspd-simulate", "--seed", "5", "--rate", "15", "--type", "depth");
  await new Promise((done) => setTimeout(done, 3000));
  const opened = performance.now();
  const page = await stack.open(view.url);
  await untilShown(page, () => true, "the first picture");
  console.log("first picture after " + ((performance.now() - opened) / 1000).toFixed(2) + " s");
  await page.evaluate(countPictures);
  await page.waitForTimeout(2000);
  await rates(page, view, "depth, worked on and drawn in software");
  const redraws = await page.evaluate(() => new Promise((done) => {
    const { world } = window.page;
    const timer = setInterval(() => world.redraw(), 1);
    setTimeout(() => (clearInterval(timer), done(world.fps)), 3000);
  }));
  console.log("page, redrawing all the time: " + redraws.toFixed(0) + " pictures/s");
  await stack.end(camera);
  await stack.end(daemon);
}

const frames = path.join(stack.folder, "frames");
try {
  stack.run("graspd-simulate", "--seed", "5", "--output", frames, "--frames", "4");
  await stack.openBrowser();
  for (const type of ["cloud", "depth"]) await measureServer(type);
  await measurePage();
} finally {
  await stack.stop();
}
