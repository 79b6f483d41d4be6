// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Publishes one cloud, a box on a table seen from above:
// graspd-bridge --cloud-channel GRASPD_CLOUD & npm install && npx tsc && GRASPD_BRIDGE=ws://... node build/publish.js
import { connect, encodeCloud } from "./graspd.js";

const [width, height] = [80, 60];
const points = new DataView(new ArrayBuffer(12 * width * height));
for (let v = 0; v < height; ++v) {
  for (let u = 0; u < width; ++u) {
    const onBox = Math.abs(u - 40) < 8 && Math.abs(v - 30) < 16;
    const place = 12 * (v * width + u);
    points.setFloat32(place, (u - 40) * 0.003, true);
    points.setFloat32(place + 4, (v - 30) * 0.003, true);
    points.setFloat32(place + 8, onBox ? 0.74 : 0.8, true); // metres from the sensor
  }
}
const cloud = encodeCloud({
  utime: 1,
  seq: 0,
  frame_name: "javascript",
  viewpoint: [0, 0, 0],
  width,
  height,
  fields: ["x", "y", "z"].map((name, i) => ({ name, offset: 4 * i, datatype: 7, count: 1 })),
  point_step: 12,
  data: new Uint8Array(points.buffer),
});
const socket = connect();
socket.once("message", () => socket.send(cloud, () => socket.close())); // the first message is a greeting
