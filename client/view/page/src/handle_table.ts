// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The handles as a list: sorted by any column, filtered by score.
import { css, scoreColor } from "./colors";
import { element, mm } from "./dom";
import type { Handle } from "./frame";

interface Column {
  title: string;
  hint: string;
  value: (handle: Handle) => number;
  text: (handle: Handle) => string;
  descending?: boolean;
}

const COLUMNS: Column[] = [
  { title: "#", hint: "rank in the list, 0 is the best", value: (h) => h.id, text: (h) => String(h.id) },
  { title: "score", hint: "how likely it holds", value: (h) => h.score, text: (h) => h.score.toFixed(2), descending: true },
  { title: "width", hint: "of the object between the jaws [mm]", value: (h) => h.width, text: (h) => mm(h.width) },
  { title: "gaps", hint: "free beside the object, -y / +y [mm]; sorted by the smaller", value: (h) => Math.min(...h.gap),
    text: (h) => h.gap.map(mm).join(" / "), descending: true },
  { title: "seg.", hint: "segment", value: (h) => h.segment_id, text: (h) => String(h.segment_id) },
];

export class HandleTable {
  private handles: Handle[] = [];
  private sortedBy = 0;
  private reversed = false;
  private minScore = 0;
  private selected = -1;

  constructor(private readonly table: HTMLTableElement, private readonly count: HTMLElement,
    private readonly onSelect: (id: number) => void, private readonly onHover: (id: number) => void) {
    table.addEventListener("click", (event) => {
      const row = (event.target as HTMLElement).closest("tr");
      if (row?.dataset.id) this.onSelect(Number(row.dataset.id));
    });
    table.addEventListener("pointerover", (event) => {
      const row = (event.target as HTMLElement).closest("tr");
      this.onHover(row?.dataset.id ? Number(row.dataset.id) : -1);
    });
    table.addEventListener("pointerleave", () => this.onHover(-1));
  }

  show(handles: Handle[]): void {
    this.handles = handles;
    this.render();
  }
  setMinScore(score: number): void {
    this.minScore = score;
    this.render();
  }
  select(id: number): void {
    const changed = id !== this.selected;
    this.selected = id;
    this.render();
    if (changed) this.reveal();
  }
  /** Scrolls the table alone, and only as far as it must. */
  private reveal(): void {
    const row = this.table.querySelector<HTMLElement>("tr.selected");
    const box = this.table.parentElement;
    if (!row || !box) return;
    const head = 26;
    if (row.offsetTop < box.scrollTop + head) box.scrollTop = row.offsetTop - head;
    else if (row.offsetTop + row.offsetHeight > box.scrollTop + box.clientHeight)
      box.scrollTop = row.offsetTop + row.offsetHeight - box.clientHeight;
  }

  /** The one after (or before) the selected one, as they stand here; -1: there is none. */
  neighbour(step: number): number {
    const rows = this.rows();
    const at = rows.findIndex((h) => h.id === this.selected);
    const next = at < 0 ? 0 : Math.min(Math.max(at + step, 0), rows.length - 1);
    return rows[next]?.id ?? -1;
  }

  private rows(): Handle[] {
    const column = COLUMNS[this.sortedBy];
    const sign = (column.descending ? -1 : 1) * (this.reversed ? -1 : 1);
    const rows = this.handles.filter((h) => h.score >= this.minScore);
    return rows.sort((a, b) => sign * (column.value(a) - column.value(b)) || a.id - b.id);
  }

  private sort(index: number): void {
    this.reversed = this.sortedBy === index && !this.reversed;
    this.sortedBy = index;
    this.render();
  }

  private header(): HTMLTableRowElement {
    const row = element("tr");
    COLUMNS.forEach((column, i) => {
      const button = element("button", { title: column.hint }, column.title);
      button.onclick = () => this.sort(i);
      const sorted = i === this.sortedBy ? ((column.descending ?? false) !== this.reversed ? "descending" : "ascending") : "none";
      row.append(element("th", { "aria-sort": sorted }, button));
    });
    return row;
  }

  private render(): void {
    const rows = this.rows();
    this.count.textContent = rows.length === this.handles.length ? String(rows.length) : rows.length + " of " + this.handles.length;
    const body = rows.map((handle) => {
      const row = element("tr", { "data-id": String(handle.id) });
      if (handle.id === this.selected) row.className = "selected";
      COLUMNS.forEach((column, i) => row.append(element("td", {}, column.text(handle), ...(i === 0 ? [dot(handle.score)] : []))));
      return row;
    });
    this.table.replaceChildren(element("thead", {}, this.header()), element("tbody", {}, ...body));
  }
}

function dot(score: number): HTMLElement {
  const made = element("span", { class: "dot" });
  made.style.background = css(scoreColor(score));
  return made;
}
