// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The programs and the browser that the tests run, and waiting with a deadline.
import { spawn, execFileSync } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { chromium } from "playwright-core";

const BIN = process.env.GRASPD_BIN;
export const PICTURES = process.env.GRASPD_PICTURES;
// How long something may take before a test gives up: no measure of speed.
export const PATIENCE_MS = 60000;
process.env.LCM_DEFAULT_URL = "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304";

export async function until(condition, what) {
  const deadline = Date.now() + PATIENCE_MS;
  for (;;) {
    const value = await condition();
    if (value) return value;
    if (Date.now() > deadline) throw new Error("waited in vain for " + what);
    await new Promise((done) => setTimeout(done, 30));
  }
}

/** The programs of one test file, in a folder of their own; all are gone after stop(). */
export class Stack {
  folder = fs.mkdtempSync(path.join(os.tmpdir(), "graspd-browser-"));
  programs = [];
  pages = [];
  errors = [];

  file(name, text) {
    const file = path.join(this.folder, name);
    fs.writeFileSync(file, text);
    return file;
  }
  start(name, ...args) {
    const out = path.join(this.folder, this.programs.length + "-" + name + ".out");
    const err = fs.openSync(out.replace(/out$/, "err"), "w");
    const child = spawn(path.join(BIN, name), args, { stdio: ["ignore", fs.openSync(out, "w"), err] });
    const ended = new Promise((done) => child.on("exit", done));
    const program = { child, ended, text: () => fs.readFileSync(out, "utf8"), errors: () => fs.readFileSync(out.replace(/out$/, "err"), "utf8") };
    this.programs.push(program);
    return program;
  }
  run(name, ...args) {
    return execFileSync(path.join(BIN, name), args, { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] });
  }
  async end(program, signal = "SIGTERM") {
    program.child.kill(signal);
    await program.ended;
  }

  /** The view, and its address. */
  async startView(...args) {
    const view = this.start("graspd-view", "--port", "0", ...args);
    await until(() => view.text().endsWith("\n") || view.child.exitCode !== null, "the view's address: " + view.errors());
    view.url = view.text().trim();
    return view;
  }
  /** Waits until the daemon serves. */
  async startDaemon(config) {
    const daemon = this.start("graspd", "--config", config);
    this.run("graspd-status", "--once", "--timeout", "60", "--format", "json");
    return daemon;
  }

  async openBrowser() {
    this.browser = await chromium.launch({
      executablePath: process.env.GRASPD_CHROMIUM,
      args: ["--no-sandbox", "--disable-dev-shm-usage", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
    });
  }
  /** A page; errors on its console are kept. */
  async open(url, options = {}) {
    const page = await this.browser.newPage({ viewport: { width: 1000, height: 640 }, colorScheme: "dark", ...options });
    page.on("pageerror", (error) => this.errors.push("page: " + error.message));
    page.on("console", (message) => {
      if (["error", "warning"].includes(message.type())) this.errors.push(message.type() + ": " + message.text());
    });
    page.setDefaultTimeout(PATIENCE_MS);
    await page.goto(url);
    this.pages.push(page);
    return page;
  }
  async stop() {
    await this.browser?.close();
    for (const program of this.programs.reverse()) if (program.child.exitCode === null && program.child.signalCode === null) await this.end(program, "SIGKILL");
    fs.rmSync(this.folder, { recursive: true, force: true });
  }
}

/** What the page says of the frame that it shows. */
export const shown = (page) => page.evaluate(() => ({ ...document.body.dataset }));
export const number = async (page, name) => Number((await shown(page))[name] ?? 0);

/** Waits until the page shows a frame for which the condition holds. */
export function untilShown(page, condition, what) {
  return until(async () => {
    const state = await shown(page);
    return state.serial !== undefined && condition(state) ? state : null;
  }, what);
}

/** x, y, z, r, g, b of every point of a binary PCD file of graspd-simulate. */
export function readPcd(file) {
  const bytes = fs.readFileSync(file);
  const mark = bytes.indexOf("DATA binary\n") + "DATA binary\n".length;
  const header = Object.fromEntries(bytes.toString("latin1", 0, mark).split("\n").map((line) => [line.split(" ")[0], line.split(" ").slice(1)]));
  const step = header.SIZE.reduce((sum, size, i) => sum + Number(size) * Number(header.COUNT[i]), 0);
  const offset = (name) => 4 * header.FIELDS.indexOf(name);
  const color = offset(header.FIELDS.includes("rgba") ? "rgba" : "rgb");
  const points = [];
  for (let at = mark; at + step <= bytes.length; at += step) {
    const place = [0, 4, 8].map((k) => bytes.readFloatLE(at + k));
    const rgb = bytes.readUInt32LE(at + color);
    if (place.every(Number.isFinite)) points.push({ place, rgb: [(rgb >> 16) & 255, (rgb >> 8) & 255, rgb & 255] });
  }
  return points;
}
