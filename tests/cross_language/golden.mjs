// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// golden.mjs BUILD_FOLDER GOLDEN_FOLDER OUT_FOLDER: encodes the golden cloud from its JSON, as the bridge takes clouds.
import { readFileSync, writeFileSync } from "node:fs";

const [build, golden, out] = process.argv.slice(2);
const { encodeCloud } = await import(`${build}/graspd.js`);
const cloud = JSON.parse(readFileSync(`${golden}/point_cloud_t.json`, "utf8"));
writeFileSync(`${out}/point_cloud_t.bin`, encodeCloud({ ...cloud, data: Uint8Array.from(cloud.data) }));
