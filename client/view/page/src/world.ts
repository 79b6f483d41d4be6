// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The three-dimensional scene: camera, views, axes, scale bar. Draws only when something has changed.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Glyphs } from "./glyphs";
import { NO_SEGMENT, SEGMENTATION_STRIDE, SUPPORT, type Frame, type Handle, type Vec3 } from "./frame";
import { PointView } from "./points";

export type View = "camera" | "top" | "front";

const vector = (v: Vec3): THREE.Vector3 => new THREE.Vector3(...v);

/** A letter that always faces the camera. */
function label(text: string, color: string): THREE.Sprite {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const context = canvas.getContext("2d");
  if (context) {
    context.font = "600 44px system-ui, sans-serif";
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.fillStyle = color;
    context.fillText(text, 32, 34);
  }
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  return new THREE.Sprite(new THREE.SpriteMaterial({ map: texture, depthTest: false }));
}

function axes(length: number): THREE.Group {
  const group = new THREE.Group();
  const directions: [Vec3, string, string][] = [
    [[1, 0, 0], "#e4685f", "x"],
    [[0, 1, 0], "#6fbf73", "y"],
    [[0, 0, 1], "#5b9be6", "z"],
  ];
  for (const [direction, color, name] of directions) {
    const end = vector(direction).multiplyScalar(length);
    const geometry = new THREE.BufferGeometry().setFromPoints([new THREE.Vector3(), end]);
    const text = label(name, color);
    text.position.copy(end).multiplyScalar(1.22);
    text.scale.setScalar(length * 0.42);
    group.add(new THREE.Line(geometry, new THREE.LineBasicMaterial({ color, depthTest: false })), text);
  }
  return group;
}

export class World {
  readonly points = new PointView();
  readonly glyphs = new Glyphs();
  fps = 0;
  onDrawn: (() => void) | null = null;

  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  private readonly origin = axes(0.1);
  private readonly corner = new THREE.Scene();
  private readonly camera = new THREE.PerspectiveCamera(45, 1, 0.02, 50);
  private readonly cornerCamera = new THREE.OrthographicCamera(-1.5, 1.5, 1.5, -1.5, 0.1, 10);
  private readonly light = new THREE.DirectionalLight(0xffffff, 2.2);
  private controls: OrbitControls;
  private frame: Frame | null = null;
  private up = new THREE.Vector3(0, -1, 0);
  private center = new THREE.Vector3();
  private view: View | null = "camera";
  private dirty = true;
  private drawn: number[] = [];

  constructor(private readonly canvas: HTMLCanvasElement, private readonly scaleBar: HTMLElement) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: false });
    this.renderer.autoClear = false;
    this.scene.add(this.points.object, this.glyphs.object, this.origin, new THREE.AmbientLight(0xffffff, 1.1));
    this.scene.add(this.light, this.light.target);
    this.corner.add(axes(1));
    this.controls = this.newControls();
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.renderer.setAnimationLoop(() => this.tick());
  }

  show(frame: Frame): void {
    const first = this.frame === null || this.frame.info.channel !== frame.info.channel;
    this.frame = frame;
    this.points.show(frame);
    this.glyphs.show(frame.info.list?.handles ?? [], frame.info.list?.gripper ?? null);
    if (first || this.upHasTurned()) {
      this.look(this.view ?? "camera");
    }
    this.resize();
  }

  setTheme(background: string, plain: string, edge: string, marked: string, fade: number): void {
    this.renderer.setClearColor(background);
    this.points.setTheme(plain, edge, marked, fade);
    this.glyphs.setTheme(marked);
    this.redraw();
  }
  redraw(): void {
    this.dirty = true;
  }

  /** The support's normal, the base frame's z, or away from the sensor's own down. */
  private upDirection(): THREE.Vector3 {
    const info = this.frame?.info;
    const plane = info?.segmentation?.support_plane;
    if (plane && Math.hypot(plane[0], plane[1], plane[2]) > 0.5) return new THREE.Vector3(plane[0], plane[1], plane[2]);
    if (!info) return new THREE.Vector3(0, -1, 0);
    if (info.list && info.list.frame_name !== info.cloud_frame_name) return new THREE.Vector3(0, 0, 1);
    return new THREE.Vector3(0, -1, 0).applyQuaternion(this.cameraRotation());
  }
  private upHasTurned(): boolean {
    return this.view !== null && this.view !== "camera" && this.upDirection().angleTo(this.up) > 0.3;
  }
  private cameraRotation(): THREE.Quaternion {
    const [w, x, y, z] = this.frame?.info.camera.orientation ?? [1, 0, 0, 0];
    return new THREE.Quaternion(x, y, z, w);
  }

  /** Of what stands on the support, or of everything. */
  private middle(): THREE.Vector3 {
    const frame = this.frame;
    const sum = new THREE.Vector3();
    if (!frame) return sum;
    let count = 0;
    const add = (grid: Frame["grid"], data: Uint16Array, at: number): void => {
      sum.x += grid.origin[0] + grid.step * data[at];
      sum.y += grid.origin[1] + grid.step * data[at + 1];
      sum.z += grid.origin[2] + grid.step * data[at + 2];
      ++count;
    };
    const data = frame.segmentationPoints;
    for (let i = 0; i < data.length; i += SEGMENTATION_STRIDE)
      if (data[i + 3] !== NO_SEGMENT && (data[i + 4] & SUPPORT) === 0) add(frame.segmentationGrid, data, i);
    if (count === 0) for (let i = 0; i + 2 < frame.points.length; i += 3 * 50) add(frame.grid, frame.points, i);
    return count ? sum.divideScalar(count) : sum;
  }

  look(view: View): void {
    this.view = view;
    const info = this.frame?.info;
    if (!info) return;
    this.center = this.middle();
    const up = this.upDirection();
    const eye = vector(info.viewpoint);
    const forward = new THREE.Vector3(0, 0, 1).applyQuaternion(this.cameraRotation());
    const distance = Math.max(eye.distanceTo(this.center), 0.2);
    this.up = up.clone();
    let position = eye;
    let target = eye.clone().addScaledVector(forward, Math.max(this.center.clone().sub(eye).dot(forward), 0.1));
    if (view === "camera") {
      this.camera.up.set(0, -1, 0).applyQuaternion(this.cameraRotation());
    } else {
      // Away from the sensor along the support: where "behind" is.
      const back = forward.clone().addScaledVector(up, -forward.dot(up));
      if (back.lengthSq() < 1e-6) back.set(0, -1, 0).applyQuaternion(this.cameraRotation());
      back.normalize();
      target = this.center.clone();
      const direction = view === "top" ? up.clone() : back.clone().multiplyScalar(-1).addScaledVector(up, 0.25).normalize();
      position = target.clone().addScaledVector(direction, distance);
      this.camera.up.copy(view === "top" ? back : up);
    }
    this.camera.position.copy(position);
    this.controls.dispose();
    this.controls = this.newControls();
    this.controls.target.copy(target);
    this.controls.update();
    this.redraw();
  }

  private newControls(): OrbitControls {
    const controls = new OrbitControls(this.camera, this.canvas);
    controls.enableDamping = true;
    controls.dampingFactor = 0.12;
    controls.minDistance = 0.05;
    controls.maxDistance = 20;
    controls.zoomToCursor = true;
    controls.addEventListener("change", () => this.redraw());
    controls.addEventListener("start", () => {
      this.view = null;
    });
    return controls;
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    const size = this.renderer.getSize(new THREE.Vector2());
    if (size.x !== width || size.y !== height) this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    // A VGA depth camera's field of view fits in, whatever the shape of the window.
    const wanted = (47 * Math.PI) / 180;
    this.camera.fov = (2 * Math.atan(Math.tan(wanted / 2) * Math.max(1, 4 / 3 / this.camera.aspect)) * 180) / Math.PI;
    this.camera.updateProjectionMatrix();
    const pixels = height * this.renderer.getPixelRatio();
    this.points.setPixels(pixels / (2 * Math.tan((this.camera.fov * Math.PI) / 360)));
    this.redraw();
  }

  private tick(): void {
    this.controls.update();
    if (!this.dirty) return;
    this.dirty = false;
    this.draw();
    const now = performance.now();
    this.drawn = [...this.drawn.filter((time) => now - time < 1000), now];
    this.fps = this.drawn.length;
    this.onDrawn?.();
  }

  private draw(): void {
    this.light.position.copy(this.camera.position);
    this.light.target.position.copy(this.controls.target);
    this.origin.visible = this.camera.position.length() > 0.5; // who stands in them sees nothing else
    this.renderer.clear();
    this.renderer.render(this.scene, this.camera);
    const { width, height } = this.renderer.getSize(new THREE.Vector2());
    const side = Math.min(96, width / 4);
    this.cornerCamera.position.set(0, 0, 4).applyQuaternion(this.camera.quaternion);
    this.cornerCamera.quaternion.copy(this.camera.quaternion);
    this.renderer.clearDepth();
    this.renderer.setViewport(width - side - 8, height - side - 8, side, side);
    this.renderer.render(this.corner, this.cornerCamera);
    this.renderer.setViewport(0, 0, width, height);
    this.showScale(height);
  }

  /** A round length, drawn as long as it is at the middle of the view. */
  private showScale(height: number): void {
    const distance = this.camera.position.distanceTo(this.controls.target);
    const pixelsPerMetre = height / (2 * distance * Math.tan((this.camera.fov * Math.PI) / 360));
    const wanted = 130 / pixelsPerMetre;
    const decade = 10 ** Math.floor(Math.log10(wanted));
    const length = [5, 2, 1].map((k) => k * decade).find((l) => l <= wanted) ?? decade;
    const [bar, text] = this.scaleBar.children as unknown as HTMLElement[];
    bar.style.width = (length * pixelsPerMetre).toFixed(1) + "px";
    text.textContent = length < 0.01 ? (length * 1000).toFixed(0) + " mm" : length < 1 ? (length * 100).toFixed(0) + " cm" : length.toFixed(0) + " m";
  }

  private ray(x: number, y: number): THREE.Raycaster {
    const bounds = this.canvas.getBoundingClientRect();
    const at = new THREE.Vector2((2 * (x - bounds.left)) / bounds.width - 1, 1 - (2 * (y - bounds.top)) / bounds.height);
    const raycaster = new THREE.Raycaster();
    raycaster.setFromCamera(at, this.camera);
    return raycaster;
  }
  pickHandle(x: number, y: number): Handle | null {
    return this.glyphs.pick(this.ray(x, y));
  }

  /** The segment of the point under the pointer: of those within some pixels the nearest to the eye. */
  pickSegment(x: number, y: number): number | null {
    const frame = this.frame;
    if (!frame) return null;
    const bounds = this.canvas.getBoundingClientRect();
    const matrix = this.camera.projectionMatrix.clone().multiply(this.camera.matrixWorldInverse);
    const { segmentationPoints: data, segmentationGrid: grid } = frame;
    const point = new THREE.Vector3();
    let found: number | null = null;
    let nearest = Infinity;
    for (let i = 0; i < data.length; i += SEGMENTATION_STRIDE) {
      point.set(grid.origin[0] + grid.step * data[i], grid.origin[1] + grid.step * data[i + 1], grid.origin[2] + grid.step * data[i + 2]);
      point.applyMatrix4(matrix);
      const px = bounds.left + ((point.x + 1) / 2) * bounds.width;
      const py = bounds.top + ((1 - point.y) / 2) * bounds.height;
      if (point.z < -1 || point.z >= nearest || Math.hypot(px - x, py - y) > 5) continue;
      nearest = point.z;
      found = data[i + 3];
    }
    return found === NO_SEGMENT ? null : found;
  }

  /** Where on the page a place of the frame is drawn. */
  project(place: Vec3): { x: number; y: number } {
    const bounds = this.canvas.getBoundingClientRect();
    const p = vector(place).project(this.camera);
    return { x: bounds.left + ((p.x + 1) / 2) * bounds.width, y: bounds.top + ((1 - p.y) / 2) * bounds.height };
  }

  async picture(): Promise<Blob | null> {
    this.draw(); // what was drawn before is gone by now
    return new Promise((done) => this.canvas.toBlob(done, "image/png"));
  }
}
