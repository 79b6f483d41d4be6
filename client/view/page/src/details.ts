// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The numbers of what is selected: a handle, or a segment and why it has none.
import { element, mm, percent, words } from "./dom";
import type { Handle, HandleList, Segment } from "./frame";

type Row = [string, string];

function table(rows: Row[]): HTMLElement {
  const list = element("dl");
  for (const [name, value] of rows) list.append(element("dt", {}, name), element("dd", { "data-name": name }, value));
  return list;
}

const numbers = (values: number[], digits: number): string => values.map((v) => v.toFixed(digits)).join("  ");
const degrees = (angle: number): number => (angle * 180) / Math.PI;

export function handleDetails(handle: Handle, list: HandleList): HTMLElement {
  return element("div", { "data-kind": "handle", "data-id": String(handle.id) },
    element("h3", {}, "Handle " + handle.id + " on segment " + handle.segment_id),
    table([
      ["score", handle.score.toFixed(3)],
      ["position [m]", numbers(handle.position, 4)],
      ["quaternion w x y z", numbers(handle.orientation, 4)],
      ["roll pitch yaw [deg]", numbers(handle.rpy.map(degrees), 1)],
      ["width [mm]", mm(handle.width) + " of " + mm(list.gripper.aperture)],
      ["gaps -y / +y [mm]", handle.gap.map(mm).join(" / ")],
      ["seen to be free -y / +y", handle.observed_free.map(percent).join(" / ")],
      ["points between the jaws", String(handle.num_points)],
      ["frame", list.frame_name],
    ]));
}

/** listed: how many handles of it are in the list. */
export function segmentDetails(segment: Segment, listed: number): HTMLElement {
  const failures = Object.entries(segment.failures).filter(([, count]) => count > 0);
  const rows: Row[] = [
    ["points", String(segment.num_points)],
    ["centroid [m]", numbers(segment.centroid, 3)],
    ["object", segment.object < 0 ? "none" : String(segment.object)],
    ["candidates", segment.num_candidates + ", of these good " + segment.num_handles],
    ["in the list", String(listed)],
  ];
  for (const [name, count] of failures) rows.push(["failed: " + words(name), String(count)]);
  const why = element("p", { class: "why" }, segment.why);
  return element("div", { "data-kind": "segment", "data-id": String(segment.id) },
    element("h3", {}, "Segment " + segment.id + (listed > 0 ? "" : " has no handle")), ...(segment.why && listed === 0 ? [why] : []), table(rows));
}

export function listDetails(list: HandleList | undefined): HTMLElement {
  if (!list) return element("p", { class: "quiet" }, "No answer of a daemon to this cloud.");
  if (list.status !== "OK") {
    return element("p", { class: "quiet" }, words(list.status.toLowerCase()) + (list.status_text ? ": " + list.status_text : ""));
  }
  const hint = "A click on a gripper or a row shows its numbers; a click on a surface tells why it has none.";
  return element("p", { class: "quiet" }, hint);
}
