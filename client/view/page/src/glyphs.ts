// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Handles as grippers in their true size, coloured by score; patch and gaps of the selected one.
import * as THREE from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { scoreColor } from "./colors";
import type { Gripper, Handle } from "./frame";

export type GlyphMode = "all" | "one" | "none";

const PALM_M = 0.008; // depth of the palm in the drawing; the gripper's description says nothing of it

function box(size: [number, number, number], at: [number, number, number]): THREE.BufferGeometry {
  return new THREE.BoxGeometry(...size).translate(...at);
}

/** In the gripper's frame: y closing, z into the object, the fingertips l below the origin. */
function gripperGeometry(g: Gripper): THREE.BufferGeometry {
  const top = g.grasp_depth - g.finger_length;
  const middle = g.grasp_depth - g.finger_length / 2;
  const finger = (side: number): THREE.BufferGeometry =>
    box([g.finger_thickness, g.finger_width, g.finger_length], [0, (side * (g.aperture + g.finger_width)) / 2, middle]);
  const palm = box([g.finger_thickness, g.aperture + 2 * g.finger_width, PALM_M], [0, 0, top - PALM_M / 2]);
  const stem = box([g.finger_thickness * 0.6, g.finger_thickness * 0.6, 0.03], [0, 0, top - PALM_M - 0.015]);
  return mergeGeometries([finger(-1), finger(1), palm, stem]);
}

export function handlePose(handle: Handle): THREE.Matrix4 {
  const [w, x, y, z] = handle.orientation;
  const pose = new THREE.Matrix4().makeRotationFromQuaternion(new THREE.Quaternion(x, y, z, w));
  return pose.setPosition(...handle.position);
}

/** The band of the patch and the free gaps on both sides of it, in the gripper's frame. */
function patchLines(handle: Handle, g: Gripper): THREE.BufferGeometry {
  const e = g.finger_thickness / 2;
  const w = handle.width / 2;
  const points: number[] = [];
  const line = (...p: number[]): void => void points.push(...p);
  for (const z of [0, g.grasp_depth]) {
    line(-e, -w, z, e, -w, z, e, -w, z, e, w, z, e, w, z, -e, w, z, -e, w, z, -e, -w, z);
  }
  [-1, 1].forEach((side, i) => {
    const from = side * w;
    const to = side * (w + handle.gap[i]);
    line(0, from, 0, 0, to, 0, -e, to, 0, e, to, 0, 0, to, 0, 0, to, g.grasp_depth);
  });
  return new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
}

export class Glyphs {
  readonly object = new THREE.Group();
  private mesh: THREE.InstancedMesh | null = null;
  private readonly patch: THREE.LineSegments;
  private readonly material = new THREE.MeshLambertMaterial({ transparent: true, opacity: 0.92 });
  private handles: Handle[] = [];
  private shown: Handle[] = [];
  private gripper: Gripper | null = null;
  private geometryOf = "";
  private geometry = new THREE.BufferGeometry();
  private mode: GlyphMode = "all";
  private minScore = 0;
  private selected = -1;
  private hovered = -1;
  private marked = new THREE.Color();

  constructor() {
    this.patch = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ depthTest: false }));
    this.patch.visible = false;
    this.patch.frustumCulled = false;
    this.patch.renderOrder = 2;
    this.object.add(this.patch);
  }

  show(handles: Handle[], gripper: Gripper | null): void {
    this.handles = handles;
    this.gripper = gripper;
    const key = JSON.stringify(gripper);
    if (gripper && key !== this.geometryOf) {
      this.geometry.dispose();
      this.geometry = gripperGeometry(gripper);
      this.geometryOf = key;
    }
    this.apply();
  }
  setMode(mode: GlyphMode): void {
    this.mode = mode;
    this.apply();
  }
  setMinScore(score: number): void {
    this.minScore = score;
    this.apply();
  }
  setTheme(marked: string): void {
    this.marked.set(marked);
    (this.patch.material as THREE.LineBasicMaterial).color.set(marked);
    this.apply();
  }
  select(id: number): void {
    this.selected = id;
    this.apply();
  }
  hover(id: number): void {
    this.hovered = id;
    this.color();
  }
  count(): number {
    return this.shown.length;
  }

  private isShown(handle: Handle): boolean {
    if (handle.id === this.selected) return this.mode !== "none";
    if (this.mode === "none" || handle.score < this.minScore) return false;
    return this.mode === "all" || (this.selected < 0 && handle.id === 0);
  }

  private apply(): void {
    this.shown = this.gripper ? this.handles.filter((handle) => this.isShown(handle)) : [];
    if (this.mesh) {
      this.object.remove(this.mesh);
      this.mesh.dispose();
      this.mesh = null;
    }
    if (this.shown.length > 0) {
      this.mesh = new THREE.InstancedMesh(this.geometry, this.material, this.shown.length);
      this.mesh.frustumCulled = false;
      this.shown.forEach((handle, i) => this.mesh?.setMatrixAt(i, handlePose(handle)));
      this.object.add(this.mesh);
    }
    this.color();
    this.showPatch();
  }

  private color(): void {
    this.shown.forEach((handle, i) => {
      const color = new THREE.Color().setRGB(...scoreColor(handle.score), THREE.SRGBColorSpace);
      if (handle.id === this.selected) color.copy(this.marked);
      else if (handle.id === this.hovered) color.lerp(this.marked, 0.5);
      this.mesh?.setColorAt(i, color);
    });
    if (this.mesh?.instanceColor) this.mesh.instanceColor.needsUpdate = true;
  }

  private showPatch(): void {
    const handle = this.handles.find((h) => h.id === this.selected);
    this.patch.visible = !!handle && !!this.gripper;
    if (!handle || !this.gripper) return;
    this.patch.geometry.dispose();
    this.patch.geometry = patchLines(handle, this.gripper);
    this.patch.matrixAutoUpdate = false;
    this.patch.matrix.copy(handlePose(handle));
  }

  /** The handle whose gripper the ray meets first. */
  pick(raycaster: THREE.Raycaster): Handle | null {
    if (!this.mesh) return null;
    this.mesh.boundingSphere = null; // of other instances
    const hit = raycaster.intersectObject(this.mesh, false)[0];
    return hit?.instanceId === undefined ? null : this.shown[hit.instanceId];
  }
}
