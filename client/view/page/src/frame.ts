// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// One frame from the server: the other side of client/view/frame_message.hpp.

export type Vec3 = [number, number, number];

export interface Gripper {
  name: string;
  aperture: number;
  finger_width: number;
  finger_thickness: number;
  finger_length: number;
  grasp_depth: number;
  min_gap: number;
}

export interface Handle {
  id: number;
  segment_id: number;
  position: Vec3;
  orientation: [number, number, number, number]; // w, x, y, z
  rpy: Vec3;
  approach: Vec3;
  closing_axis: Vec3;
  major_axis: Vec3;
  width: number;
  gap: [number, number];
  observed_free: [number, number];
  num_points: number;
  score: number;
}

export interface HandleList {
  status: string;
  status_text: string;
  frame_name: string;
  gripper: Gripper;
  config_revision: number;
  voxel_size: number;
  degraded: number;
  points_in: number;
  points_used: number;
  num_segments: number;
  num_candidates: number;
  candidate_failures: Record<string, number>;
  segment_failures: Record<string, number>;
  stages: Record<string, number>;
  latency: number;
  handles: Handle[];
}

export interface Segment {
  id: number;
  object: number;
  num_points: number;
  centroid: Vec3;
  normal: Vec3;
  major_axis: Vec3;
  num_candidates: number;
  num_handles: number;
  reason: string;
  why: string; // the reason for people
  failures: Record<string, number>;
}

export interface Segmentation {
  voxel_size: number;
  support_plane: [number, number, number, number];
  segments: Segment[];
}

export interface FrameInfo {
  channel: string;
  utime: number;
  seq: number;
  frame_name: string;
  cloud_frame_name: string;
  camera: { position: Vec3; orientation: [number, number, number, number] };
  viewpoint: Vec3;
  points_in: number;
  list?: HandleList;
  segmentation?: Segmentation;
}

/** Points on a grid: position = origin + step * (x, y, z). */
export interface Grid {
  origin: Vec3;
  step: number;
}

export interface Frame {
  serial: number;
  info: FrameInfo;
  grid: Grid;
  points: Uint16Array; // x, y, z of each
  colors: Uint8Array | null; // r, g, b of each
  segmentationGrid: Grid;
  segmentationPoints: Uint16Array; // x, y, z, segment, flags of each
}

export const NO_SEGMENT = 65535;
export const EDGE = 1;
export const SUPPORT = 2;
export const SEGMENTATION_STRIDE = 5;

const MAGIC = 0x31465647; // "GVF1"
const HEADER_BYTES = 60;

const aligned = (bytes: number): number => (bytes + 3) & ~3;

/** Throws where the message is not what it should be. */
export function decodeFrame(buffer: ArrayBuffer): Frame {
  const view = new DataView(buffer);
  if (buffer.byteLength < HEADER_BYTES || view.getUint32(0, true) !== MAGIC) throw new Error("not a frame");
  const [jsonBytes, count, segmentationCount, flags] = [4, 8, 12, 16].map((at) => view.getUint32(at, true));
  const grid = (at: number): Grid => ({
    origin: [view.getFloat32(at, true), view.getFloat32(at + 4, true), view.getFloat32(at + 8, true)],
    step: view.getFloat32(at + 12, true),
  });
  let at = HEADER_BYTES;
  const part = (bytes: number): number => {
    const start = at;
    at += aligned(bytes);
    if (start + bytes > buffer.byteLength) throw new Error("a frame that is cut short");
    return start;
  };
  const json = new Uint8Array(buffer, part(jsonBytes), jsonBytes);
  const points = new Uint16Array(buffer, part(6 * count), 3 * count);
  const colors = flags & 1 ? new Uint8Array(buffer, part(3 * count), 3 * count) : null;
  const values = SEGMENTATION_STRIDE * segmentationCount;
  const segmentationPoints = new Uint16Array(buffer, part(2 * values), values);
  return {
    serial: Number(view.getBigInt64(20, true)),
    info: JSON.parse(new TextDecoder().decode(json)) as FrameInfo,
    grid: grid(28),
    points,
    colors,
    segmentationGrid: grid(44),
    segmentationPoints,
  };
}
