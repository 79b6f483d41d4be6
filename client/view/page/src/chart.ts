// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A minute of a number as a small line.
import { element } from "./dom";

const SAMPLES = 60;

export class Chart {
  readonly root: HTMLElement;
  private readonly canvas = element("canvas", { width: "120", height: "28" });
  private readonly value = element("output");
  private samples: number[] = [];

  constructor(title: string, private readonly unit: string, private readonly digits: number) {
    this.root = element("div", { class: "chart" }, element("span", {}, title), this.canvas, this.value);
  }

  add(value: number): void {
    this.samples = [...this.samples.slice(1 - SAMPLES), value];
    this.value.textContent = value.toFixed(this.digits) + " " + this.unit;
    this.draw();
  }

  private draw(): void {
    const context = this.canvas.getContext("2d");
    if (!context) return;
    const ratio = Math.min(window.devicePixelRatio, 2);
    const width = (this.canvas.width = 120 * ratio);
    const height = (this.canvas.height = 28 * ratio);
    const most = Math.max(...this.samples, 1e-9);
    const style = getComputedStyle(this.root);
    context.strokeStyle = style.getPropertyValue("--accent");
    context.lineWidth = 1.5 * ratio;
    context.lineJoin = "round";
    context.beginPath();
    this.samples.forEach((sample, i) => {
      const x = width - ((this.samples.length - 1 - i) / (SAMPLES - 1)) * (width - 4) - 2;
      context.lineTo(x, height - 3 * ratio - (sample / most) * (height - 6 * ratio));
    });
    context.stroke();
  }
}
