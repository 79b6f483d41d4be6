// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
import { defineConfig } from "vite";

export default defineConfig({
  build: {
    target: "es2022",
    sourcemap: false,
    modulePreload: false,
    license: { fileName: "licenses.md" },
    chunkSizeWarningLimit: 1500,
    assetsInlineLimit: 0, // the page's policy knows no data: scripts or styles
  },
});
