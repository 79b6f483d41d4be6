// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Puts the page together.
import "./style.css";
import { Connection, type Hello, type Message, type State } from "./connection";
import { css, scoreColor } from "./colors";
import { handleDetails, listDetails, segmentDetails } from "./details";
import { byId, element } from "./dom";
import type { Frame, Vec3 } from "./frame";
import type { GlyphMode } from "./glyphs";
import { HandleTable } from "./handle_table";
import { bindKeys, showKeys } from "./keys";
import { PlayerPanel, type PlayerState } from "./player_panel";
import type { ColorMode } from "./points";
import { SettingsPanel, type Settings } from "./settings_panel";
import { StatusPanel, type DaemonStatus, type ServerStatistics } from "./status_panel";
import { World, type View } from "./world";

const GLYPH_MODES: GlyphMode[] = ["all", "one", "none"];
const THEMES = {
  dark: { background: "#11171d", plain: "#4d5964", edge: "#f2f5f7", marked: "#ff9d47", fade: 0.42 },
  light: { background: "#f4f5f3", plain: "#bcc3c1", edge: "#1b2226", marked: "#d9480f", fade: 1.2 },
};

type Selection = { kind: "handle" | "segment"; id: number } | null;

class Page {
  private readonly world = new World(byId<HTMLCanvasElement>("view"), byId("scale"));
  private readonly table = new HandleTable(byId<HTMLTableElement>("handles"), byId("handle-count"),
    (id) => this.select({ kind: "handle", id }), (id) => this.hover(id));
  private readonly status = new StatusPanel(byId("status"));
  private readonly settings = new SettingsPanel(byId("settings"), (message) => this.connection.send(message));
  private readonly player = new PlayerPanel((message) => this.connection.send(message));
  private readonly connection: Connection;
  private frame: Frame | null = null;
  private selection: Selection = null;
  private paused = false;
  private edges = false;
  private glyphMode: GlyphMode = "all";
  private theme: keyof typeof THEMES;
  private channel = "";
  private mayWrite = false;
  private daemon: DaemonStatus | null = null;

  constructor() {
    const wanted = localStorage.getItem("theme") ?? (matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark");
    this.theme = wanted === "light" ? "light" : "dark";
    this.applyTheme();
    this.bindButtons();
    this.bindPointer();
    bindKeys(this);
    this.world.onDrawn = () => this.drawn();
    setInterval(() => this.status.tick(this.world.fps), 1000);
    this.connection = new Connection({
      state: (state) => this.showState(state),
      hello: (hello) => this.hello(hello),
      frame: (frame) => this.show(frame),
      message: (message) => this.received(message),
    });
    this.legend();
  }

  // What comes from the server.

  private showState(state: State): void {
    const root = byId("connection");
    root.textContent = state;
    root.dataset.state = state;
  }

  private hello(hello: Hello): void {
    this.mayWrite = hello.may_write;
    if (this.channel) this.connection.send({ type: "source", channel: this.channel });
    if (this.paused) this.connection.send({ type: "pause" });
    this.settings.use(this.channel, this.mayWrite);
    document.body.dataset.mode = hello.mode;
  }

  private received(message: Message): void {
    if (message.type === "channels") this.showChannels(message.channels as string[]);
    else if (message.type === "settings") this.settings.show(message as unknown as Settings);
    else if (message.type === "sent") this.settings.wait(message.id as number);
    else if (message.type === "server") this.status.showServer(message as unknown as ServerStatistics);
    else if (message.type === "player") this.player.show(message as unknown as PlayerState);
    else if (message.type === "refused") this.say(String(message.why));
    else if (message.type === "status") this.showDaemon(message.status as DaemonStatus);
  }

  private showDaemon(status: DaemonStatus): void {
    this.daemon = status;
    this.status.showDaemon(status, this.channel);
    this.settings.answer(status.control_id, status.config_error, status.overrides);
  }

  private showChannels(channels: string[]): void {
    const select = byId<HTMLSelectElement>("source");
    select.replaceChildren(...channels.map((name) => element("option", { value: name }, name)));
    if (this.channel) select.value = this.channel;
    select.hidden = channels.length === 0;
  }

  private show(frame: Frame): void {
    this.frame = frame;
    this.channel = frame.info.channel;
    byId<HTMLSelectElement>("source").value = this.channel;
    this.settings.use(this.channel, this.mayWrite);
    this.world.show(frame);
    this.table.show(frame.info.list?.handles ?? []);
    this.status.showFrame(frame);
    // Numbers of handles and segments hold for one list only: the place stays selected, not the number.
    this.followSelection();
    this.caption();
    this.applyModes();
  }

  private drawn(): void {
    if (!this.frame) return;
    this.connection.acknowledge(this.frame.serial);
    const { info, serial } = this.frame;
    Object.assign(document.body.dataset, {
      serial: String(serial), utime: String(info.utime), seq: String(info.seq), glyphs: String(this.world.glyphs.count()),
      segments: String(info.segmentation?.segments.length ?? info.list?.num_segments ?? 0),
      revision: String(info.list?.config_revision ?? 0), points: String(this.frame.points.length / 3),
    });
  }

  // What is selected.

  private lastPlace: Vec3 | null = null;

  private select(selection: Selection): void {
    this.selection = selection;
    this.lastPlace = this.place();
    this.showSelection();
  }
  private place(): Vec3 | null {
    if (this.selection?.kind === "handle") return this.selectedHandle()?.position ?? null;
    return this.selectedSegment()?.centroid ?? null;
  }
  private selectedHandle() {
    return this.selection?.kind === "handle" ? this.frame?.info.list?.handles.find((h) => h.id === this.selection?.id) : undefined;
  }
  private selectedSegment() {
    return this.selection?.kind === "segment" ? this.frame?.info.segmentation?.segments.find((s) => s.id === this.selection?.id) : undefined;
  }

  private followSelection(): void {
    const selection = this.selection;
    if (selection && this.lastPlace) {
      const [x, y, z] = this.lastPlace;
      const near = (p: Vec3): number => Math.hypot(p[0] - x, p[1] - y, p[2] - z);
      const places = selection.kind === "handle"
        ? (this.frame?.info.list?.handles ?? []).map((h) => ({ id: h.id, at: near(h.position) }))
        : (this.frame?.info.segmentation?.segments ?? []).map((s) => ({ id: s.id, at: near(s.centroid) }));
      const best = places.sort((a, b) => a.at - b.at)[0];
      this.selection = best && best.at < 0.02 ? { kind: selection.kind, id: best.id } : null;
    }
    this.showSelection();
  }

  private showSelection(): void {
    const handle = this.selectedHandle();
    const segment = this.selectedSegment();
    const list = this.frame?.info.list;
    this.world.glyphs.select(handle?.id ?? -1);
    this.world.points.selectSegment(segment?.id ?? -1);
    this.world.points.markPatch(handle ?? null, list?.gripper.finger_thickness ?? 0, list?.gripper.grasp_depth ?? 0);
    this.table.select(handle?.id ?? -1);
    const listed = list?.handles.filter((h) => h.segment_id === segment?.id).length ?? 0;
    const content = handle && list ? handleDetails(handle, list) : segment ? segmentDetails(segment, listed) : listDetails(list);
    byId("details").replaceChildren(content);
    this.world.redraw();
  }

  private hover(id: number): void {
    this.world.glyphs.hover(id);
    this.world.redraw();
  }

  // What the user does; the keys call these, too.

  private bindButtons(): void {
    const each = (selector: string, action: (button: HTMLElement) => void): void =>
      document.querySelectorAll<HTMLElement>(selector).forEach((button) => (button.onclick = () => action(button)));
    each("[data-color]", (button) => this.setColor(button.dataset.color as ColorMode));
    each("[data-view]", (button) => this.look(button.dataset.view as View));
    byId("edges").onclick = () => this.toggleEdges();
    byId("glyphs").onclick = () => this.nextGlyphMode();
    byId("pause").onclick = () => this.togglePause();
    byId("step").onclick = () => this.step();
    byId("screenshot").onclick = () => void this.save();
    byId("theme").onclick = () => this.toggleTheme();
    byId("help").onclick = () => showKeys();
    byId<HTMLSelectElement>("source").onchange = (event) => this.setSource((event.target as HTMLSelectElement).value);
    byId<HTMLInputElement>("min-score").oninput = (event) => {
      const score = Number((event.target as HTMLInputElement).value);
      byId("min-score-text").textContent = String(score);
      this.table.setMinScore(score);
      this.world.glyphs.setMinScore(score);
      this.world.redraw();
    };
  }

  private bindPointer(): void {
    const canvas = byId<HTMLCanvasElement>("view");
    let down = { x: 0, y: 0 };
    canvas.addEventListener("pointerdown", (event) => (down = { x: event.clientX, y: event.clientY }));
    canvas.addEventListener("click", (event) => {
      const { clientX: x, clientY: y } = event;
      if (Math.hypot(x - down.x, y - down.y) > 4) return; // that was an orbit
      const handle = this.world.pickHandle(x, y);
      const segment = handle ? null : this.world.pickSegment(x, y);
      this.select(handle ? { kind: "handle", id: handle.id } : segment !== null ? { kind: "segment", id: segment } : null);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (event.buttons) return;
      const handle = this.world.pickHandle(event.clientX, event.clientY);
      canvas.style.cursor = handle ? "pointer" : "";
      canvas.title = handle ? "handle " + handle.id + ", score " + handle.score.toFixed(2) + ", " + (1000 * handle.width).toFixed(0) + " mm wide" : "";
      this.hover(handle?.id ?? -1);
    });
  }

  setColor(mode: ColorMode): void {
    this.world.points.setMode(mode);
    this.applyModes();
    this.world.redraw();
  }
  toggleEdges(): void {
    this.edges = !this.edges;
    this.world.points.setEdges(this.edges);
    if (this.edges && this.world.points.shownMode() !== "segment") this.setColor("segment");
    this.applyModes();
    this.world.redraw();
  }
  nextGlyphMode(): void {
    this.glyphMode = GLYPH_MODES[(GLYPH_MODES.indexOf(this.glyphMode) + 1) % GLYPH_MODES.length];
    this.world.glyphs.setMode(this.glyphMode);
    this.applyModes();
    this.world.redraw();
  }
  look(view: View): void {
    this.world.look(view);
  }
  togglePause(): void {
    if (this.player.active) return this.player.toggle();
    this.paused = !this.paused;
    this.connection.send({ type: this.paused ? "pause" : "resume" });
    this.applyModes();
  }
  step(): void {
    if (this.player.active) return this.player.step();
    this.paused = true;
    this.connection.send({ type: "step" });
    this.applyModes();
  }
  undo(): void {
    this.settings.undo();
  }
  selectNeighbour(step: number): void {
    const id = this.table.neighbour(step);
    if (id >= 0) this.select({ kind: "handle", id });
  }
  deselect(): void {
    this.select(null);
  }
  toggleTheme(): void {
    this.theme = this.theme === "dark" ? "light" : "dark";
    localStorage.setItem("theme", this.theme);
    this.applyTheme();
  }
  async save(): Promise<void> {
    const picture = await this.world.picture();
    if (!picture) return;
    const link = element("a", { download: "graspd-" + (this.frame?.info.seq ?? 0) + ".png" });
    link.href = URL.createObjectURL(picture);
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }
  private setSource(channel: string): void {
    this.channel = channel;
    this.select(null);
    this.connection.send({ type: "source", channel });
    if (this.daemon) this.status.showDaemon(this.daemon, channel);
  }

  // How it looks.

  private applyTheme(): void {
    const { background, plain, edge, marked, fade } = THEMES[this.theme];
    document.documentElement.dataset.theme = this.theme;
    byId("theme").textContent = this.theme === "dark" ? "Light" : "Dark";
    this.world.setTheme(background, plain, edge, marked, fade);
  }
  private applyModes(): void {
    const { points } = this.world;
    const pressed = (root: HTMLElement, on: boolean): void => root.setAttribute("aria-pressed", String(on));
    document.querySelectorAll<HTMLButtonElement>("[data-color]").forEach((button) => {
      pressed(button, button.dataset.color === points.shownMode());
      button.disabled = !!this.frame && !points.has(button.dataset.color as ColorMode);
    });
    pressed(byId("edges"), this.edges);
    byId<HTMLButtonElement>("edges").disabled = !!this.frame && !points.hasEdges();
    pressed(byId("glyphs"), this.glyphMode !== "none");
    byId("glyphs").textContent = this.glyphMode === "one" ? "One gripper" : "Grippers";
    pressed(byId("pause"), this.paused);
    byId("pause").textContent = this.paused ? "Go on" : "Pause";
  }
  private caption(): void {
    const info = this.frame?.info;
    if (!info) return;
    const parts = [info.channel, "frame " + info.seq, info.frame_name, (this.frame?.points.length ?? 0) / 3 + " points"];
    if (info.list) parts.push(info.list.num_segments + " segments", info.list.gripper.name);
    if (info.list?.degraded) parts.push("coarser voxels: " + (1000 * info.list.voxel_size).toFixed(1) + " mm");
    byId("caption").textContent = parts.filter(Boolean).join("  ·  ");
  }
  private legend(): void {
    const steps = Array.from({ length: 12 }, (_, i) => css(scoreColor(i / 11)));
    const bar = element("span", { class: "bar" });
    bar.style.background = "linear-gradient(to right, " + steps.join(",") + ")";
    byId("legend").replaceChildren("score 0", bar, "1");
  }
  private say(text: string): void {
    const note = byId("note");
    note.textContent = text;
    note.hidden = false;
    setTimeout(() => (note.hidden = true), 5000);
  }

  /** For tests: where a handle is drawn. */
  whereIs(id: number): { x: number; y: number } | null {
    const handle = this.frame?.info.list?.handles.find((h) => h.id === id);
    return handle ? this.world.project(handle.position) : null;
  }
}

(window as unknown as { page: Page }).page = new Page();
