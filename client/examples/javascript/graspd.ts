// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What graspd-bridge sends, and clouds as it takes them. Units and frames are those of lcmtypes/.
import WebSocket from "ws"; // a browser has its own

export interface Handle {
  id: number;
  position: [number, number, number]; // metres
  orientation: [number, number, number, number]; // unit quaternion w, x, y, z: gripper frame to the list's frame
  width: number;
  score: number;
}

export interface HandleList {
  utime: number;
  seq: number;
  source_channel: string;
  frame_name: string;
  status: string;
  status_text: string;
  handles: Handle[]; // best first
}

export interface Field {
  name: string;
  offset: number; // bytes
  datatype: number; // 7: 32-bit float
  count: number;
}

export interface PointCloud {
  utime: number; // microseconds
  seq: number;
  frame_name: string;
  viewpoint: [number, number, number]; // metres
  width: number;
  height: number;
  fields: Field[];
  point_step: number; // bytes
  data: Uint8Array; // little-endian
}

const POINT_CLOUD_FINGERPRINT = 0x19d75af77ba18842n;

/** A point_cloud_t as it is on the wire. */
export function encodeCloud(cloud: PointCloud): Uint8Array {
  const parts: Uint8Array[] = [];
  const number = (size: number, set: (view: DataView) => void) => {
    const view = new DataView(new ArrayBuffer(size));
    set(view);
    parts.push(new Uint8Array(view.buffer));
  };
  const int64 = (value: bigint) => number(8, (view) => view.setBigInt64(0, value));
  const int32 = (value: number) => number(4, (view) => view.setInt32(0, value));
  const int8 = (value: number) => number(1, (view) => view.setInt8(0, value));
  const text = (value: string) => {
    const bytes = new TextEncoder().encode(value + "\0");
    int32(bytes.length);
    parts.push(bytes);
  };
  int64(POINT_CLOUD_FINGERPRINT);
  int64(BigInt(cloud.utime));
  int64(BigInt(cloud.seq));
  text(cloud.frame_name);
  for (const metres of cloud.viewpoint) number(8, (view) => view.setFloat64(0, metres));
  int32(cloud.width);
  int32(cloud.height);
  int32(cloud.fields.length);
  for (const field of cloud.fields) {
    text(field.name);
    int32(field.offset);
    int8(field.datatype);
    int32(field.count);
  }
  int32(cloud.point_step);
  int32(cloud.data.length);
  parts.push(cloud.data);
  return new Uint8Array(Buffer.concat(parts));
}

/** GRASPD_BRIDGE: the address that graspd-bridge prints; with its token clouds may be sent. */
export function connect(): WebSocket {
  return new WebSocket(process.env.GRASPD_BRIDGE ?? "ws://127.0.0.1:8091/socket");
}
