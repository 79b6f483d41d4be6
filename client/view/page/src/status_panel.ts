// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// How the daemon and the server are: rates, latency, drops by reason, with a minute of history.
import { Chart } from "./chart";
import { element, words } from "./dom";
import type { Frame } from "./frame";

interface Counts { [reason: string]: number }
interface SourceStatus {
  name: string; channel: string; received: number; processed: number; dropped: number; refused: number; lost: number;
  rate: number; latency_p50: number; latency_p99: number; drops: Counts; refusals: Counts; last_error: string;
}
export interface DaemonStatus {
  version: string; cpu: number; rss: number; uptime: number; config_revision: number; config_error: string;
  control_id: number; overrides: string; sources: SourceStatus[];
}
export interface ServerStatistics { pages: number; frames: number; refused_clouds: number; counters: Counts }

const REFUSALS = ["not_found", "bad_requests", "bad_methods", "bad_paths", "foreign_hosts", "foreign_origins", "bad_tokens",
  "too_many", "huge_messages", "floods", "overflows", "refused_messages"];

export class StatusPanel {
  private readonly rate = new Chart("clouds", "Hz", 1);
  private readonly latency = new Chart("latency", "ms", 0);
  private readonly handles = new Chart("handles", "", 0);
  private readonly drawn = new Chart("pictures here", "/s", 0);
  private readonly stages = element("div", { class: "stages" });
  private readonly text = element("dl");
  private readonly server = element("p", { class: "quiet" });
  private heard = 0;
  private lastHandles = 0;

  constructor(root: HTMLElement) {
    root.append(this.rate.root, this.latency.root, this.handles.root, this.drawn.root, this.stages, this.text, this.server);
    this.text.append(element("dt", {}, "daemon"), element("dd", {}, "not heard"));
  }

  /** Once a second. */
  tick(fps: number): void {
    this.drawn.add(fps);
    this.handles.add(this.lastHandles);
    if (this.heard && performance.now() - this.heard > 5000) {
      this.heard = 0;
      this.text.replaceChildren(element("dt", {}, "daemon"), element("dd", { class: "bad" }, "silent for 5 s"));
    }
  }

  showFrame(frame: Frame): void {
    const list = frame.info.list;
    this.lastHandles = list?.handles.length ?? 0;
    const stages = Object.entries(list?.stages ?? {});
    const total = stages.reduce((sum, [, ms]) => sum + ms, 0);
    const bars = stages.map(([name, ms], i) => {
      const bar = element("i", { title: words(name) + " " + ms.toFixed(1) + " ms" });
      bar.style.flexGrow = String(ms);
      bar.style.opacity = String(i % 2 ? 0.45 : 0.8);
      return bar;
    });
    const caption = total > 0 ? "work on this frame: " + total.toFixed(1) + " ms" : "";
    this.stages.replaceChildren(element("span", {}, caption), element("div", {}, ...bars));
  }

  showDaemon(status: DaemonStatus, channel: string): void {
    this.heard = performance.now();
    const source = status.sources.find((s) => s.channel === channel) ?? status.sources[0];
    const rows: [string, string, string?][] = [
      ["daemon", status.version + ", " + (100 * status.cpu).toFixed(0) + " % CPU, " + (status.rss / 1e6).toFixed(0) + " MB"],
    ];
    if (source) {
      this.rate.add(source.rate);
      this.latency.add(1000 * source.latency_p50);
      rows.push(["latency p50 / p99", (1000 * source.latency_p50).toFixed(0) + " / " + (1000 * source.latency_p99).toFixed(0) + " ms"]);
      rows.push(["received, processed", source.received + ", " + source.processed]);
      for (const [name, count] of Object.entries(source.drops)) if (count > 0) rows.push(["dropped: " + words(name), String(count)]);
      for (const [name, count] of Object.entries(source.refusals)) if (count > 0) rows.push(["refused: " + words(name), String(count), "bad"]);
      if (source.lost > 0) rows.push(["lost on the way", String(source.lost)]);
      if (source.last_error) rows.push(["last error", source.last_error, "bad"]);
    }
    if (status.config_error) rows.push(["settings", status.config_error, "bad"]);
    this.text.replaceChildren(...rows.flatMap(([name, value, kind]) =>
      [element("dt", {}, name), element("dd", kind ? { class: kind } : {}, value)]));
  }

  showServer(statistics: ServerStatistics): void {
    const refused = REFUSALS.reduce((sum, name) => sum + (statistics.counters[name] ?? 0), 0);
    this.server.textContent = statistics.pages + (statistics.pages === 1 ? " page" : " pages") + " open, " +
      (statistics.counters.bytes_out / 1e6).toFixed(0) + " MB sent" + (refused ? ", " + refused + " requests refused" : "");
  }
}
