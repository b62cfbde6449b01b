// One view: a canvas with its camera, the layers in it, and what the pointer does there.
import {
  AmbientLight,
  Box3,
  Color,
  DirectionalLight,
  type Matrix4,
  OrthographicCamera,
  PerspectiveCamera,
  Plane,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { BubbleLayer, DrawnLayer, GridLayer, SurfaceLayer } from "./layers";
import { type Frame, floats } from "./link";
import { type Theme, THEMES } from "./palette";

export type Side = "perspective" | "top" | "front" | "side";

/** Where the eye stands for each side, seen from the middle. */
const SIDES: Record<Side, Vector3> = {
  perspective: new Vector3(-0.62, -1, 0.62),
  top: new Vector3(0, 0, 1),
  front: new Vector3(0, -1, 0),
  side: new Vector3(1, 0, 0),
};

/** Pixels of the canvas for one of the page; more cannot be told apart. */
const SHARPEST = 2;

/** Whether this machine draws without a graphics card: then smoothing while things move costs half the pictures. */
const SLOW = drawsInSoftware();

function drawsInSoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = info ? String(gl!.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

export interface Sight {
  origin: [number, number, number];
  direction: [number, number, number];
}

export class View {
  readonly surface = new SurfaceLayer();
  readonly bubbles = new BubbleLayer();
  readonly grid: GridLayer;
  readonly drawing = new DrawnLayer();
  readonly canvas = document.createElement("canvas");
  /** Pictures drawn so far, milliseconds spent on the last one here, and its draw calls: for measuring. */
  drawn = 0;
  spent = 0;
  calls = 0;
  onCamera: (() => void) | null = null;
  private readonly scene = new Scene();
  private readonly renderer: WebGLRenderer;
  private readonly perspective = new PerspectiveCamera(32, 1, 0.1, 1000);
  private readonly parallel = new OrthographicCamera(-1, 1, 1, -1, 0.1, 1000);
  private camera: PerspectiveCamera | OrthographicCamera = this.perspective;
  private readonly controls: OrbitControls;
  private readonly sun = new DirectionalLight("#ffffff", 2.1);
  private readonly box = new Box3(new Vector3(-1, -1, -1), new Vector3(1, 1, 1));
  private readonly section = new Plane(new Vector3(0, -1, 0), 0);
  private cut = false;
  private theme: Theme = THEMES.light;
  private side: Side = "perspective";
  private ghost = false;
  private stale = true;
  private quiet = false;
  private turning = false;

  constructor(private readonly host: HTMLElement) {
    this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: !SLOW, preserveDrawingBuffer: true });
    this.renderer.localClippingEnabled = true;
    this.grid = new GridLayer(this.theme);
    this.scene.add(this.surface.group, this.bubbles.points, this.grid.group);
    this.scene.add(this.drawing.line, this.drawing.ends);
    this.scene.add(new AmbientLight("#ffffff", 1.3), this.sun);
    this.bubbles.points.visible = false;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", "The surface and its grid; drag to turn, wheel to zoom");
    host.append(this.canvas);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.addEventListener("change", () => {
      this.redraw();
      if (!this.quiet) this.onCamera?.();
    });
    this.controls.addEventListener("start", () => this.turns(true));
    this.controls.addEventListener("end", () => this.turns(false));
    this.controls.zoomToCursor = true;
    for (const camera of [this.perspective, this.parallel]) camera.up.set(0, 0, 1);
    new ResizeObserver(() => this.resize()).observe(host);
    this.sharpen();
    this.resize();
    const loop = () => {
      requestAnimationFrame(loop);
      if (!this.stale) return;
      this.stale = false;
      this.draw();
    };
    loop();
  }

  redraw(): void {
    this.stale = true;
  }

  dress(theme: Theme): void {
    this.theme = theme;
    this.scene.background = new Color(theme.background);
    const planes = this.cut ? [this.section] : [];
    this.surface.dress(theme, planes);
    this.grid.dress(theme, planes);
    this.bubbles.points.material.clippingPlanes = planes;
    this.redraw();
  }

  showSurface(frame: Frame): void {
    this.surface.show(frame);
    this.surface.veil(false, this.ghost);
    this.box.setFromArray(floats(frame, "xyz"));
    this.grid.group.visible = false;
    this.bubbles.points.visible = false;
    this.dress(this.theme);
    this.look("perspective");
  }

  showBubbles(frame: Frame): void {
    this.bubbles.show(frame, this.theme);
    this.surface.veil(false, this.ghost);
    this.grid.group.visible = false;
    this.sharpen();
    this.redraw();
  }

  showGrid(frame: Frame): void {
    this.grid.show(frame);
    this.frames(new Box3().setFromArray(floats(frame, "xyz")));
    this.surface.veil(true, this.ghost);
    this.bubbles.points.visible = false;
    this.sharpen();
    this.redraw();
  }

  /** Only the surface. */
  clear(): void {
    this.grid.group.visible = false;
    this.bubbles.points.visible = false;
    this.surface.veil(false, this.ghost);
    this.redraw();
  }

  /** Whether the surface is hinted at behind the grid. */
  showsSurface(yes: boolean): void {
    this.ghost = yes;
    this.surface.veil(this.grid.group.visible, yes);
    this.redraw();
  }

  /** Let one part of the surface stand out; 0 for none. */
  pointAt(part: number): void {
    this.surface.pointAt(part);
    this.redraw();
  }

  /** Let these nodes stand out. */
  mark(nodes: number[]): void {
    this.grid.mark(nodes);
    this.redraw();
  }

  /** Look at all of a grid that lies on another surface than what was looked at. */
  private frames(grid: Box3): void {
    const reach = (box: Box3) => box.getSize(new Vector3()).length() || 1;
    const apart = grid.getCenter(new Vector3()).distanceTo(this.box.getCenter(new Vector3()));
    const ratio = reach(grid) / reach(this.box);
    if (ratio > 0.5 && ratio < 2 && apart < 0.5 * reach(this.box)) return;
    this.box.copy(grid);
    this.whole();
  }

  /** Look at all of it again, from the same side. */
  whole(): void {
    this.look(this.side);
  }

  /** Look from a side at all of it. */
  look(side: Side): void {
    const middle = this.box.getCenter(new Vector3());
    const reach = this.box.getSize(new Vector3()).length() / 2 || 1;
    const flat = side !== "perspective";
    this.camera = flat ? this.parallel : this.perspective;
    this.controls.object = this.camera;
    const eye = SIDES[side].clone().normalize();
    const far = reach / Math.sin((this.perspective.fov * Math.PI) / 360);
    const aspect = (this.host.clientWidth || 1) / (this.host.clientHeight || 1);
    this.side = side;
    this.camera.position.copy(middle).addScaledVector(eye, far * 0.84 * Math.max(1, 1.2 / aspect));
    if (side === "top") this.camera.position.y -= 1e-4 * reach;
    this.controls.target.copy(middle);
    for (const camera of [this.perspective, this.parallel]) {
      camera.near = 0.004 * far;
      camera.far = 4 * far;
    }
    this.parallel.zoom = 1;
    this.fit();
    this.controls.enableRotate = true;
    this.controls.update();
    this.redraw();
  }

  /** Take over another view's camera. */
  follow(other: View): void {
    this.quiet = true;
    this.camera = other.camera === other.perspective ? this.perspective : this.parallel;
    this.controls.object = this.camera;
    this.camera.position.copy(other.camera.position);
    this.camera.quaternion.copy(other.camera.quaternion);
    this.camera.zoom = other.camera.zoom;
    this.camera.near = other.camera.near;
    this.camera.far = other.camera.far;
    this.controls.target.copy(other.controls.target);
    this.fit();
    this.controls.update();
    this.redraw();
    this.quiet = false;
  }

  /** Cut off what lies in front of a vertical plane; `share` is how much, 0 to 1. */
  slice(share: number): void {
    this.cut = share > 0;
    const y = this.box.min.y + share * (this.box.max.y - this.box.min.y);
    this.section.setFromNormalAndCoplanarPoint(new Vector3(0, 1, 0), new Vector3(0, y, 0));
    this.dress(this.theme);
  }

  /** Show a line that is being drawn. */
  draws(points: [number, number, number][]): void {
    this.drawing.show(points);
    this.redraw();
  }

  /** The line of sight through a point of the canvas. */
  sight(x: number, y: number): Sight {
    const box = this.canvas.getBoundingClientRect();
    const at = new Vector2(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2);
    const ray = new Raycaster();
    ray.setFromCamera(at, this.camera);
    return { origin: ray.ray.origin.toArray(), direction: ray.ray.direction.toArray() };
  }

  /** World to screen. */
  matrix(): number[] {
    const m: Matrix4 = this.camera.projectionMatrix.clone().multiply(this.camera.matrixWorldInverse);
    return m.toArray();
  }

  /** Where a point is on the canvas, in pixels. */
  project(point: [number, number, number]): [number, number] {
    const p = new Vector3(...point).project(this.camera);
    const box = this.canvas.getBoundingClientRect();
    return [((p.x + 1) / 2) * box.width, ((1 - p.y) / 2) * box.height];
  }

  rotates(yes: boolean): void {
    this.controls.enabled = yes;
  }

  picture(): Promise<Blob | null> {
    this.draw();
    return new Promise((done) => this.canvas.toBlob(done, "image/png"));
  }

  dispose(): void {
    this.controls.dispose();
    this.renderer.dispose();
    this.canvas.remove();
  }

  private turns(yes: boolean): void {
    this.turning = yes;
    this.sharpen();
  }

  /** Fewer pixels for what moves where drawing is slow; what stands still there is smoothed by more of them. */
  private sharpen(): void {
    const moves = this.turning || this.bubbles.points.visible || this.grid.live;
    const quick = moves && (SLOW || this.grid.large);
    const pixels = quick ? 1 : SLOW ? SHARPEST : Math.min(window.devicePixelRatio, SHARPEST);
    if (pixels === this.renderer.getPixelRatio()) return;
    this.renderer.setPixelRatio(pixels);
    this.resize();
  }

  private draw(): void {
    this.sun.position
      .copy(this.camera.position)
      .add(new Vector3(0, 0, 1).multiplyScalar(this.camera.far / 6));
    this.sun.target.position.copy(this.controls.target);
    this.sun.target.updateMatrixWorld();
    const began = performance.now();
    this.renderer.render(this.scene, this.camera);
    this.spent = performance.now() - began;
    this.calls = this.renderer.info.render.calls;
    this.drawn++;
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    const pixels = this.renderer.getPixelRatio();
    this.grid.resize(width, height, pixels);
    this.drawing.ends.material.uniforms["pixels"]!.value = pixels;
    const uniforms = this.bubbles.points.material.uniforms;
    uniforms["height"]!.value = height * pixels;
    uniforms["pixels"]!.value = pixels;
    this.fit();
    this.redraw();
  }

  private fit(): void {
    const aspect = (this.host.clientWidth || 1) / (this.host.clientHeight || 1);
    this.perspective.aspect = aspect;
    const size = this.box.getSize(new Vector3());
    const half = 0.56 * Math.max(size.length() / 1.25, 1e-6);
    const narrow = Math.max(1, 0.8 / aspect);
    this.parallel.left = -half * aspect * narrow;
    this.parallel.right = half * aspect * narrow;
    this.parallel.top = half * narrow;
    this.parallel.bottom = -half * narrow;
    this.perspective.updateProjectionMatrix();
    this.parallel.updateProjectionMatrix();
  }
}
