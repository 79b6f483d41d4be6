// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Parameters of the shown source, changed through the daemon's control messages, with an undo.
import { element } from "./dom";

interface SourceSettings {
  name: string; channel: string; gripper: string; leaf_size_m: number; theta_low_deg: number; theta_high_deg: number; edge_share: number;
}
export interface Settings { can_control: number; grippers: string[]; sources: SourceSettings[] }

type Key = "theta_low_deg" | "theta_high_deg" | "edge_share" | "leaf_size_m";
interface Slider { key: Key; title: string; hint: string; min: number; max: number; step: number; scale: number; unit: string }

const SLIDERS: Slider[] = [
  { key: "theta_low_deg", title: "theta_low", hint: "below this angle between normals neighbours are one surface", min: 0.5, max: 30, step: 0.5, scale: 1, unit: "°" },
  { key: "theta_high_deg", title: "theta_high", hint: "above it they are not", min: 1, max: 60, step: 1, scale: 1, unit: "°" },
  { key: "edge_share", title: "k", hint: "share of the neighbourhood above theta_high that makes an edge point", min: 0, max: 1, step: 0.02, scale: 1, unit: "" },
  { key: "leaf_size_m", title: "voxel", hint: "edge of a voxel; the radius of neighbourhoods goes with it", min: 2, max: 10, step: 0.5, scale: 1000, unit: " mm" },
];

export class SettingsPanel {
  private readonly inputs = new Map<Key, { input: HTMLInputElement; output: HTMLOutputElement; slider: Slider }>();
  private readonly gripper = element("select", { id: "gripper", "aria-label": "gripper" });
  private readonly undoButton = element("button", { id: "undo", title: "take back the newest change (u)" }, "Undo");
  private readonly resetButton = element("button", { id: "reset", title: "take back all changes" }, "Reset");
  private readonly note = element("p", { class: "quiet", id: "settings-note" });
  private settings: Settings | null = null;
  private source: SourceSettings | null = null;
  private channel = "";
  private mayWrite = false;
  private sent = 0;

  constructor(root: HTMLElement, private readonly send: (message: object) => void) {
    for (const slider of SLIDERS) root.append(this.row(slider));
    root.append(element("label", { class: "row" }, element("span", {}, "gripper"), this.gripper, element("output")));
    root.append(element("div", { class: "buttons" }, this.undoButton, this.resetButton), this.note);
    this.gripper.onchange = () => this.set({ gripper: this.gripper.value });
    this.undoButton.onclick = () => this.undo();
    this.resetButton.onclick = () => this.send({ type: "reset" });
    this.apply();
  }

  private row(slider: Slider): HTMLElement {
    const input = element("input", { type: "range", id: slider.key, min: String(slider.min), max: String(slider.max), step: String(slider.step) });
    const output = element("output");
    const show = (): void => void (output.textContent = Number(input.value) + slider.unit);
    input.oninput = show;
    input.onchange = () => this.set({ [slider.key]: Number(input.value) / slider.scale });
    this.inputs.set(slider.key, { input, output, slider });
    return element("label", { class: "row", title: slider.hint }, element("span", {}, slider.title), input, output);
  }

  private set(change: object): void {
    if (this.source) this.send({ type: "set", source: this.source.name, ...change });
  }
  undo(): void {
    this.send({ type: "undo" });
  }

  show(settings: Settings): void {
    this.settings = settings;
    this.apply();
  }
  use(channel: string, mayWrite: boolean): void {
    if (channel === this.channel && mayWrite === this.mayWrite) return;
    this.channel = channel;
    this.mayWrite = mayWrite;
    this.apply();
  }
  /** A change is on its way to the daemon. */
  wait(id: number): void {
    this.sent = id;
    this.note.textContent = "sent ...";
  }
  /** What the daemon says came of the newest one. */
  answer(controlId: number, error: string, overrides: string): void {
    if (this.sent !== 0 && controlId < this.sent) return;
    this.sent = 0;
    this.note.className = error ? "bad" : "quiet";
    this.note.textContent = error ? "not taken: " + error : overrides ? "changed, until the daemon ends" : this.hint();
    if (error) this.apply(false);
  }

  private hint(): string {
    if (!this.settings?.can_control) return "The daemon takes no control messages here (lcm.control_channel).";
    return this.mayWrite ? "" : "Read only: this page was opened without the token.";
  }

  private apply(withNote = true): void {
    const sources = this.settings?.sources ?? [];
    this.source = sources.find((s) => s.channel === this.channel) ?? sources[0] ?? null;
    const enabled = this.mayWrite && !!this.settings?.can_control && !!this.source;
    for (const { input, output, slider } of this.inputs.values()) {
      input.disabled = !enabled;
      if (!this.source) continue;
      const value = Number((this.source[slider.key] * slider.scale).toFixed(3));
      input.value = String(value);
      output.textContent = value + slider.unit;
    }
    const names = [...new Set([...(this.settings?.grippers ?? []), ...(this.source ? [this.source.gripper] : [])])];
    this.gripper.replaceChildren(...names.map((name) => element("option", { value: name }, name)));
    if (this.source) this.gripper.value = this.source.gripper;
    for (const control of [this.gripper, this.undoButton, this.resetButton]) control.disabled = !enabled;
    if (withNote && this.hint()) this.note.textContent = this.hint();
  }
}
