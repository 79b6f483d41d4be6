// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The log's player: timeline, play, pause, step, speed.
import { byId } from "./dom";

export interface PlayerState { playing: number; speed: number; position_us: number; length_us: number; start_utime: number }

const clock = (us: number): string => {
  const seconds = us / 1e6;
  return Math.floor(seconds / 60) + ":" + (seconds % 60).toFixed(1).padStart(4, "0");
};

export class PlayerPanel {
  private readonly play = byId<HTMLButtonElement>("play");
  private readonly timeline = byId<HTMLInputElement>("timeline");
  private readonly speed = byId<HTMLSelectElement>("speed");
  private state: PlayerState | null = null;
  private dragging = false;

  constructor(private readonly send: (message: object) => void) {
    this.play.onclick = () => this.toggle();
    byId("player-step").onclick = () => this.step();
    this.timeline.oninput = () => {
      this.dragging = true;
      this.showTime(Number(this.timeline.value));
    };
    this.timeline.onchange = () => {
      this.dragging = false;
      this.send({ type: "player", seek_us: Number(this.timeline.value) });
    };
    this.speed.onchange = () => this.send({ type: "player", speed: Number(this.speed.value) });
  }

  get active(): boolean {
    return this.state !== null;
  }
  toggle(): void {
    this.send({ type: "player", playing: !this.state?.playing });
  }
  step(): void {
    this.send({ type: "player", step: true });
  }

  show(state: PlayerState): void {
    this.state = state;
    byId("player").hidden = false;
    this.play.textContent = state.playing ? "Pause" : "Play";
    this.timeline.max = String(state.length_us);
    this.speed.value = String(state.speed);
    if (this.dragging) return;
    this.timeline.value = String(state.position_us);
    this.showTime(state.position_us);
  }

  private showTime(us: number): void {
    const date = this.state ? new Date((this.state.start_utime + us) / 1000).toLocaleString() : "";
    byId("time").textContent = clock(us) + " / " + clock(this.state?.length_us ?? 0);
    byId("time").title = date;
  }
}
