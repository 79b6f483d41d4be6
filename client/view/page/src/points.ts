// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The points of a frame: the cloud in its colours or by depth, the segmentation by segment, edge points marked.
import * as THREE from "three";
import { SCALE_GLSL, segmentColor } from "./colors";
import { NO_SEGMENT, SEGMENTATION_STRIDE, type Frame, type Handle } from "./frame";

export type ColorMode = "rgb" | "depth" | "segment";

const MODES: ColorMode[] = ["rgb", "depth", "segment"];
const PALETTE_SIZE = 256;

const VERTEX = `
uniform vec3 origin, viewpoint, patchHalf;
uniform float gridStep, pointSize, near, far, hasPatch, spread;
uniform int mode, edgesMarked, selectedSegment;
uniform vec3 plain, edge, marked;
uniform float fade;
uniform mat4 patchInverse;
uniform sampler2D palette;
attribute vec3 color;
attribute vec2 segment;
varying vec3 shade;
varying float width;
${SCALE_GLSL}
void main() {
  vec3 p = origin + gridStep * position;
  float depth = (distance(p, viewpoint) - near) / (far - near);
  shade = mode == 0 ? color : mode == 1 ? colorScale(1.0 - depth) : plain * mix(1.0, fade, clamp(depth, 0.0, 1.0));
  // Points of a sensor are as far apart as they are from it; voxels have one size.
  float size = pointSize * (spread > 0.0 ? spread * distance(p, viewpoint) : 1.0);
  if (mode == 2) {
    int id = int(segment.x + 0.5);
    int flags = int(segment.y + 0.5);
    if (id != ${NO_SEGMENT}) shade = texelFetch(palette, ivec2(id % ${PALETTE_SIZE}, 0), 0).rgb;
    if (id == selectedSegment && id != ${NO_SEGMENT}) shade = mix(shade, marked, 0.6);
    if (edgesMarked == 1 && flags % 2 == 1) shade = edge;
  }
  vec3 q = abs((patchInverse * vec4(p, 1.0)).xyz);
  if (hasPatch > 0.5 && all(lessThan(q, patchHalf))) {
    shade = marked;
    size *= 1.6;
  }
  vec4 seen = modelViewMatrix * vec4(p, 1.0);
  gl_Position = projectionMatrix * seen;
  if (mode == 3) gl_Position.z += 0.004; // behind what is made of the same points
  width = clamp(size / -seen.z, 1.0, 24.0);
  gl_PointSize = width;
}`;

const FRAGMENT = `
varying vec3 shade;
varying float width;
void main() {
  if (width > 7.0 && length(gl_PointCoord - 0.5) > 0.5) discard;
  gl_FragColor = vec4(shade, 1.0);
}`;

function paletteTexture(): THREE.DataTexture {
  const data = new Uint8Array(4 * PALETTE_SIZE);
  for (let i = 0; i < PALETTE_SIZE; ++i) data.set([...segmentColor(i).map((v) => Math.round(255 * v)), 255], 4 * i);
  const texture = new THREE.DataTexture(data, PALETTE_SIZE, 1);
  texture.needsUpdate = true;
  return texture;
}

/** One set of points in one draw call. */
class PointSet {
  readonly object: THREE.Points;
  readonly uniforms: Record<string, THREE.IUniform>;
  private readonly geometry = new THREE.BufferGeometry();

  constructor(palette: THREE.Texture) {
    const vec3 = (): THREE.IUniform => ({ value: new THREE.Vector3() });
    this.uniforms = {
      origin: vec3(), viewpoint: vec3(), patchHalf: vec3(), plain: { value: new THREE.Color() }, fade: { value: 1 },
      edge: { value: new THREE.Color() }, marked: { value: new THREE.Color() }, gridStep: { value: 0 },
      pointSize: { value: 2 }, spread: { value: 0 }, near: { value: 0 }, far: { value: 1 }, hasPatch: { value: 0 }, mode: { value: 0 },
      edgesMarked: { value: 0 }, selectedSegment: { value: -1 }, patchInverse: { value: new THREE.Matrix4() },
      palette: { value: palette },
    };
    const material = new THREE.ShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms: this.uniforms });
    this.object = new THREE.Points(this.geometry, material);
    this.object.frustumCulled = false;
  }

  setCloud(frame: Frame): void {
    const { geometry } = this;
    geometry.setAttribute("position", new THREE.BufferAttribute(frame.points, 3));
    if (frame.colors) geometry.setAttribute("color", new THREE.BufferAttribute(frame.colors, 3, true));
    else geometry.deleteAttribute("color");
    this.finish(frame.grid.origin, frame.grid.step, frame.points.length / 3);
  }

  setSegmentation(frame: Frame): void {
    const { geometry } = this;
    const data = new THREE.InterleavedBuffer(frame.segmentationPoints, SEGMENTATION_STRIDE);
    geometry.setAttribute("position", new THREE.InterleavedBufferAttribute(data, 3, 0));
    geometry.setAttribute("segment", new THREE.InterleavedBufferAttribute(data, 2, 3));
    const count = frame.segmentationPoints.length / SEGMENTATION_STRIDE;
    this.finish(frame.segmentationGrid.origin, frame.segmentationGrid.step, count);
  }

  private finish(origin: number[], step: number, count: number): void {
    (this.uniforms.origin.value as THREE.Vector3).fromArray(origin);
    this.uniforms.gridStep.value = step;
    this.geometry.setDrawRange(0, count);
  }

  /** The old buffers go before the new ones come, or a page that is open for a day fills the card. */
  release(): void {
    this.geometry.dispose();
  }
}

export class PointView {
  readonly object = new THREE.Group();
  private readonly cloud: PointSet;
  private readonly segmentation: PointSet;
  private frame: Frame | null = null;
  private mode: ColorMode | null = null; // what was asked for
  private edges = false;

  constructor() {
    const palette = paletteTexture();
    this.cloud = new PointSet(palette);
    this.segmentation = new PointSet(palette);
    this.object.add(this.cloud.object, this.segmentation.object);
  }

  show(frame: Frame): void {
    this.frame = frame;
    this.cloud.release();
    this.segmentation.release();
    this.cloud.setCloud(frame);
    this.segmentation.setSegmentation(frame);
    const [near, far] = depthRange(frame);
    for (const set of [this.cloud, this.segmentation]) {
      (set.uniforms.viewpoint.value as THREE.Vector3).fromArray(frame.info.viewpoint);
      set.uniforms.near.value = near;
      set.uniforms.far.value = far;
    }
    this.apply();
  }

  /** What can be shown of the frame that is there. */
  modes(): ColorMode[] {
    return MODES.filter((mode) => this.has(mode));
  }
  has(mode: ColorMode): boolean {
    if (mode === "rgb") return !!this.frame?.colors;
    return mode === "depth" || !!this.frame?.segmentationPoints.length;
  }
  hasEdges(): boolean {
    return !!this.frame?.segmentationPoints.length;
  }
  /** What was asked for, or the next best where the frame does not have it. */
  shownMode(): ColorMode {
    if (this.mode && this.has(this.mode)) return this.mode;
    return this.has("rgb") ? "rgb" : this.has("segment") ? "segment" : "depth";
  }

  setMode(mode: ColorMode): void {
    this.mode = mode;
    this.apply();
  }
  setEdges(marked: boolean): void {
    this.edges = marked;
    this.apply();
  }

  private apply(): void {
    const shown = this.shownMode();
    this.cloud.uniforms.mode.value = { rgb: 0, depth: 1, segment: 3 }[shown];
    this.segmentation.uniforms.mode.value = 2;
    this.segmentation.uniforms.edgesMarked.value = this.edges ? 1 : 0;
    this.segmentation.object.visible = shown === "segment";
  }

  /** pixelsPerMetre: of something one metre away. */
  setPixels(pixelsPerMetre: number): void {
    // A depth camera sees about 0.8 steradians.
    this.cloud.uniforms.pointSize.value = pixelsPerMetre;
    this.cloud.uniforms.spread.value = 1.25 * Math.sqrt(0.8 / Math.max((this.frame?.points.length ?? 0) / 3, 5000));
    this.segmentation.uniforms.pointSize.value = pixelsPerMetre * (this.frame?.info.segmentation?.voxel_size ?? 0.003) * 1.25;
  }
  /** fade: what is far is darker (below 1) or lighter. */
  setTheme(plain: string, edge: string, marked: string, fade: number): void {
    for (const set of [this.cloud, this.segmentation]) {
      set.uniforms.fade.value = fade;
      (set.uniforms.plain.value as THREE.Color).set(plain).convertLinearToSRGB();
      (set.uniforms.edge.value as THREE.Color).set(edge).convertLinearToSRGB();
      (set.uniforms.marked.value as THREE.Color).set(marked).convertLinearToSRGB();
    }
  }

  selectSegment(id: number): void {
    this.segmentation.uniforms.selectedSegment.value = id;
  }
  /** The points between the jaws of a handle. */
  markPatch(handle: Handle | null, thickness_m: number, depth_m: number): void {
    for (const set of [this.cloud, this.segmentation]) {
      set.uniforms.hasPatch.value = handle ? 1 : 0;
      if (!handle) continue;
      const [w, x, y, z] = handle.orientation;
      const pose = new THREE.Matrix4().makeRotationFromQuaternion(new THREE.Quaternion(x, y, z, w));
      pose.setPosition(...handle.position);
      // From a little above the surface to the fingertips.
      const middle = new THREE.Matrix4().makeTranslation(0, 0, (depth_m - 0.01) / 2);
      (set.uniforms.patchInverse.value as THREE.Matrix4).copy(pose.multiply(middle).invert());
      const half = set.uniforms.patchHalf.value as THREE.Vector3;
      half.set(thickness_m / 2, handle.width / 2 + 0.001, (depth_m + 0.01) / 2);
    }
  }
}

/** Between the 1st and the 99th percentile of the distances, from a sample. */
function depthRange(frame: Frame): [number, number] {
  const { points, grid, info } = frame;
  const count = points.length / 3;
  if (count === 0) return [0, 1];
  const distances: number[] = [];
  for (let i = 0; i < count; i += Math.max(1, Math.floor(count / 2000))) {
    const d = [0, 1, 2].map((k) => grid.origin[k] + grid.step * points[3 * i + k] - info.viewpoint[k]);
    distances.push(Math.hypot(...d));
  }
  distances.sort((a, b) => a - b);
  const at = (share: number): number => distances[Math.floor(share * (distances.length - 1))];
  return [at(0.01), Math.max(at(0.99), at(0.01) + 0.01)];
}
