// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Prints handles as CSV: graspd-bridge & npm install && npx tsc && node build/listen.js
import { connect, type HandleList } from "./graspd.js";

console.log("frame,px,py,pz,qw,qx,qy,qz,width,score");
connect().on("message", (data) => {
  const { type, message }: { type: string; message: HandleList } = JSON.parse(data.toString());
  if (type !== "handle_list") return;
  for (const h of message.handles) {
    const numbers = [...h.position, ...h.orientation, h.width, h.score];
    // JSON has as many digits as tell 32-bit floats apart.
    console.log([message.frame_name, ...numbers.map((n) => Math.fround(n).toFixed(6))].join(","));
  }
});
