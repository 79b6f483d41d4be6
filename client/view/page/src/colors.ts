// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Colours that keep apart also for people who see few of them.

export type Rgb = [number, number, number]; // 0 to 1

/** Low to high: dark violet, blue, green, yellow (a polynomial through viridis). */
export function scale(t: number): Rgb {
  const x = Math.min(Math.max(t, 0), 1);
  const poly = (c: number[]): number => Math.min(Math.max(c.reduceRight((sum, k) => sum * x + k, 0), 0), 1);
  return [
    poly([0.2777, 0.1051, -0.3309, -4.6342, 6.2283, 4.7764, -5.4355]),
    poly([0.0054, 1.4046, 0.2148, -5.7991, 14.1799, -13.7451, 4.6459]),
    poly([0.3341, 1.3846, 0.0951, -19.3324, 56.6906, -65.353, 26.3124]),
  ];
}

/** The same in GLSL. */
export const SCALE_GLSL = `
vec3 colorScale(float t) {
  float x = clamp(t, 0.0, 1.0);
  vec3 c0 = vec3(0.2777, 0.0054, 0.3341), c1 = vec3(0.1051, 1.4046, 1.3846), c2 = vec3(-0.3309, 0.2148, 0.0951);
  vec3 c3 = vec3(-4.6342, -5.7991, -19.3324), c4 = vec3(6.2283, 14.1799, 56.6906);
  vec3 c5 = vec3(4.7764, -13.7451, -65.353), c6 = vec3(-5.4355, 4.6459, 26.3124);
  return clamp(c0 + x * (c1 + x * (c2 + x * (c3 + x * (c4 + x * (c5 + x * c6))))), 0.0, 1.0);
}`;

/** Of a score: its lower end is light enough for a dark ground. */
export const scoreColor = (score: number): Rgb => scale(0.3 + 0.66 * score);

function hsl(h: number, s: number, l: number): Rgb {
  const f = (n: number): number => {
    const k = (n + h * 12) % 12;
    return l - s * Math.min(l, 1 - l) * Math.max(-1, Math.min(k - 3, 9 - k, 1));
  };
  return [f(0), f(8), f(4)];
}

/** Neighbouring numbers differ in hue and in lightness. */
export function segmentColor(id: number): Rgb {
  return hsl((id * 0.61803398875 + 0.08) % 1, 0.55, [0.62, 0.46, 0.74][id % 3]);
}

export const css = (c: Rgb): string => "rgb(" + c.map((v) => Math.round(255 * v)).join(" ") + ")";
