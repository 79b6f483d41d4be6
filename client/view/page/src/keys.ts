// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The keyboard.
import { byId, element } from "./dom";
import type { ColorMode } from "./points";
import type { View } from "./world";

interface Actions {
  setColor(mode: ColorMode): void;
  toggleEdges(): void;
  nextGlyphMode(): void;
  look(view: View): void;
  togglePause(): void;
  step(): void;
  undo(): void;
  selectNeighbour(step: number): void;
  deselect(): void;
  toggleTheme(): void;
  save(): Promise<void>;
}

const HELP: [string, string][] = [
  ["1 2 3", "camera colours, depth, segments"],
  ["e", "mark edge points"],
  ["g", "grippers: all, one, none"],
  ["c t f", "view from the sensor, from above, from the front"],
  ["space", "pause, go on"],
  [".", "step: the next frame"],
  ["up, down", "select a handle"],
  ["esc", "select nothing"],
  ["u", "undo the newest change of parameters"],
  ["s", "save the picture"],
  ["d", "dark, light"],
  ["drag, wheel", "orbit, zoom; with the right button: move"],
];

export function showKeys(): void {
  const dialog = byId<HTMLDialogElement>("keys");
  const rows = HELP.flatMap(([key, what]) => [element("dt", {}, key), element("dd", {}, what)]);
  const close = element("button", {}, "Close");
  close.onclick = () => dialog.close();
  dialog.replaceChildren(element("h2", {}, "Keys"), element("dl", {}, ...rows), close);
  dialog.showModal();
}

export function bindKeys(actions: Actions): void {
  const keys: Record<string, () => void> = {
    "1": () => actions.setColor("rgb"),
    "2": () => actions.setColor("depth"),
    "3": () => actions.setColor("segment"),
    e: () => actions.toggleEdges(),
    g: () => actions.nextGlyphMode(),
    c: () => actions.look("camera"),
    t: () => actions.look("top"),
    f: () => actions.look("front"),
    " ": () => actions.togglePause(),
    ".": () => actions.step(),
    ArrowDown: () => actions.selectNeighbour(1),
    ArrowUp: () => actions.selectNeighbour(-1),
    Escape: () => actions.deselect(),
    u: () => actions.undo(),
    s: () => void actions.save(),
    d: () => actions.toggleTheme(),
    "?": () => showKeys(),
  };
  window.addEventListener("keydown", (event) => {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey || byId<HTMLDialogElement>("keys").open) return;
    if (target.matches("input, select") || (target.matches("button") && event.key === " ")) return;
    const action = keys[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
