// What stands in the view: the surface, bubbles and a grid, each as a few large buffers.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  DynamicDrawUsage,
  Group,
  Line,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshLambertMaterial,
  type Plane,
  Points,
  ShaderMaterial,
  Vector2,
} from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { type Frame, floats, wholes } from "./link";
import { inks, type Theme } from "./palette";
import { type Wire, wired } from "./wire";

/** Members are lines of their own up to so many; more of them, and those that move, are edges of the panels. */
const MOST_LINES = 24000;

/** What is meant, and what does not move. */
const MARKED = "#2f7fe0";
const FIXED = "#e0a33c";

const DISC_VERTEX = `
  attribute vec3 fill;
  attribute float size;
  uniform float pixels;
  uniform float height;
  uniform bool metric;
  varying vec3 vFill;
  #include <clipping_planes_pars_vertex>
  void main() {
    vFill = fill;
    vec4 mvPosition = modelViewMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * mvPosition;
    float depth = isOrthographic ? 1.0 : -mvPosition.z;
    float onScreen = projectionMatrix[1][1] * height * size / depth;
    gl_PointSize = metric ? max(onScreen, 2.0 * pixels) : size * pixels;
    if (!metric) gl_Position.z -= 0.0006 * gl_Position.w;
    #include <clipping_planes_vertex>
  }`;

const DISC_FRAGMENT = `
  uniform vec3 rim;
  uniform bool metric;
  varying vec3 vFill;
  #include <clipping_planes_pars_fragment>
  void main() {
    #include <clipping_planes_fragment>
    vec2 p = 2.0 * gl_PointCoord - 1.0;
    float r = dot(p, p);
    if (r > 1.0) discard;
    vec3 color = vFill;
    if (metric) {
      vec3 n = vec3(p.x, -p.y, sqrt(1.0 - r));
      float light = 0.62 + 0.38 * max(dot(n, normalize(vec3(-0.4, 0.6, 0.7))), 0.0);
      color = mix(vFill * light, rim, smoothstep(0.86, 1.0, r) * 0.5);
    } else {
      color = mix(vFill, rim, smoothstep(0.52, 0.62, r));
    }
    gl_FragColor = vec4(color, 1.0);
    #include <colorspace_fragment>
  }`;

function discs(metric: boolean): Points<BufferGeometry, ShaderMaterial> {
  const material = new ShaderMaterial({
    uniforms: {
      pixels: { value: 1 },
      height: { value: 1 },
      metric: { value: metric },
      rim: { value: new Color("#15181c") },
    },
    vertexShader: DISC_VERTEX,
    fragmentShader: DISC_FRAGMENT,
    clipping: true,
  });
  const points = new Points(new BufferGeometry(), material);
  points.frustumCulled = false;
  return points;
}

function put(geometry: BufferGeometry, name: string, array: Float32Array, width: number): void {
  const old = geometry.getAttribute(name);
  if (old instanceof BufferAttribute && old.array.length === array.length) {
    (old.array as Float32Array).set(array);
    old.needsUpdate = true;
    return;
  }
  geometry.setAttribute(name, new BufferAttribute(array, width).setUsage(DynamicDrawUsage));
}

/** Positions of these corners, one after the other. */
function gather(xyz: Float32Array, corners: Uint32Array): Float32Array {
  const out = new Float32Array(3 * corners.length);
  for (let k = 0; k < corners.length; k++) {
    const v = 3 * corners[k]!;
    out[3 * k] = xyz[v]!;
    out[3 * k + 1] = xyz[v + 1]!;
    out[3 * k + 2] = xyz[v + 2]!;
  }
  return out;
}

export class SurfaceLayer {
  readonly group = new Group();
  private part: Uint32Array = new Uint32Array();
  private theme: Theme | null = null;
  private pointedAt = 0;
  private readonly mesh: Mesh<BufferGeometry, MeshLambertMaterial>;
  private readonly lines: LineSegments<BufferGeometry, LineBasicMaterial>;

  constructor() {
    this.mesh = new Mesh(
      new BufferGeometry(),
      new MeshLambertMaterial({
        side: DoubleSide,
        polygonOffset: true,
        polygonOffsetFactor: 2,
        polygonOffsetUnits: 4,
      }),
    );
    this.lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial());
    this.group.add(this.mesh, this.lines);
  }

  show(frame: Frame): void {
    const xyz = new BufferAttribute(floats(frame, "xyz"), 3);
    this.mesh.geometry.dispose();
    this.mesh.geometry = new BufferGeometry();
    this.mesh.geometry.setAttribute("position", xyz);
    this.mesh.geometry.setAttribute("normal", new BufferAttribute(floats(frame, "normals"), 3));
    this.mesh.geometry.setIndex(new BufferAttribute(wholes(frame, "triangles"), 1));
    this.part = wholes(frame, "part");
    this.pointAt(0);
    this.lines.geometry.dispose();
    this.lines.geometry = new BufferGeometry();
    this.lines.geometry.setAttribute("position", xyz);
    this.lines.geometry.setIndex(new BufferAttribute(wholes(frame, "lines"), 1));
  }

  /** Let one part stand out; 0 for none. */
  pointAt(part: number): void {
    this.pointedAt = part;
    const { geometry, material } = this.mesh;
    material.vertexColors = part > 0;
    material.needsUpdate = true;
    if (!this.theme) return;
    material.color.set(part > 0 ? "#ffffff" : this.theme.surface);
    if (part === 0) return;
    const [own, others] = [new Color(this.theme.chosen), new Color(this.theme.surface)];
    const colors = new Float32Array(3 * this.part.length);
    for (let k = 0; k < this.part.length; k++) (this.part[k] === part ? own : others).toArray(colors, 3 * k);
    put(geometry, "color", colors, 3);
  }

  /** Behind a grid the surface is only hinted at, or just its lines are seen. */
  veil(behindGrid: boolean, ghost: boolean): void {
    const material = this.mesh.material;
    this.mesh.visible = !behindGrid || ghost;
    material.transparent = behindGrid;
    material.opacity = behindGrid ? 0.4 : 1;
    material.depthWrite = !behindGrid;
    this.mesh.renderOrder = behindGrid ? 2 : 0;
  }

  dress(theme: Theme, planes: Plane[]): void {
    this.theme = theme;
    this.pointAt(this.pointedAt);
    this.lines.material.color.set(theme.lines);
    this.mesh.material.clippingPlanes = planes;
    this.lines.material.clippingPlanes = planes;
  }
}

export class BubbleLayer {
  readonly points = discs(true);

  show(frame: Frame, theme: Theme): void {
    const radii = floats(frame, "radii");
    const fill = new Float32Array(3 * radii.length);
    const color = new Color(theme.bubble);
    for (let k = 0; k < radii.length; k++) color.toArray(fill, 3 * k);
    put(this.points.geometry, "position", floats(frame, "xyz"), 3);
    put(this.points.geometry, "size", radii, 1);
    put(this.points.geometry, "fill", fill, 3);
    this.points.visible = true;
  }
}

export class GridLayer {
  readonly group = new Group();
  private readonly panels: Mesh<BufferGeometry, MeshLambertMaterial>;
  private readonly wire: Wire = {
    pixels: { value: 1 },
    wire: { value: 0 },
    wireColored: { value: false },
    wireColor: { value: new Color() },
  };
  private readonly members: LineSegments2;
  private readonly memberMaterial = new LineMaterial({ linewidth: 1.6 });
  private readonly features: LineSegments2;
  private readonly featureMaterial = new LineMaterial({ linewidth: 2.6 });
  private readonly nodes = discs(false);
  private readonly fixed = discs(false);
  private readonly marks = discs(false);
  private frame: Frame | null = null;
  private theme: Theme;
  private width = 1.6;

  constructor(theme: Theme) {
    this.theme = theme;
    this.panels = new Mesh(
      new BufferGeometry(),
      new MeshLambertMaterial({
        side: DoubleSide,
        flatShading: true,
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 2,
      }),
    );
    wired(this.panels.material, this.wire);
    this.members = new LineSegments2(new LineSegmentsGeometry(), this.memberMaterial);
    this.features = new LineSegments2(new LineSegmentsGeometry(), this.featureMaterial);
    for (const part of [this.panels, this.members, this.features]) part.frustumCulled = false;
    this.group.add(this.panels, this.members, this.features, this.fixed, this.marks, this.nodes);
    this.fixed.visible = false;
    this.group.visible = false;
  }

  show(frame: Frame): void {
    const was = this.frame?.shows;
    this.frame = frame;
    const xyz = floats(frame, "xyz");
    const corners = gather(xyz, wholes(frame, "panels"));
    put(this.panels.geometry, "position", corners, 3);
    this.panels.geometry.setDrawRange(0, corners.length / 3);
    const members = wholes(frame, "members");
    this.members.visible = frame.shows !== "live" && members.length / 2 <= MOST_LINES;
    if (this.members.visible) {
      this.members.geometry.dispose();
      this.members.geometry = new LineSegmentsGeometry();
      this.members.geometry.setPositions(gather(xyz, members));
    }
    const features = wholes(frame, "features");
    this.features.visible = features.length > 0;
    if (features.length) {
      this.features.geometry.dispose();
      this.features.geometry = new LineSegmentsGeometry();
      this.features.geometry.setPositions(gather(xyz, features));
    }
    this.dots(this.fixed, wholes(frame, "fixed"), FIXED, 7);
    const odd = wholes(frame, "irregular");
    const excess = floats(frame, "excess");
    // As in the paper: black where a node has too few members, white where it has too many.
    const fill = new Float32Array(3 * odd.length);
    for (let k = 0; k < odd.length; k++) fill.fill(excess[k]! < 0 ? 0.01 : 1, 3 * k, 3 * k + 3);
    put(this.nodes.geometry, "position", gather(xyz, odd), 3);
    put(this.nodes.geometry, "fill", fill, 3);
    put(
      this.nodes.geometry,
      "size",
      new Float32Array(odd.length).fill(xyz.length > 24000 ? 6.5 : xyz.length > 2400 ? 8.5 : 11),
      1,
    );
    this.width = xyz.length > 2400 ? 1.15 : 1.6;
    if (was !== "live" || frame.shows !== "live") this.plain();
    this.mark([]);
    this.group.visible = true;
  }

  /** Without values to color by. */
  plain(): void {
    this.panels.material.vertexColors = false;
    this.panels.material.needsUpdate = true;
    this.memberMaterial.vertexColors = false;
    this.memberMaterial.needsUpdate = true;
    this.wire.wireColored.value = false;
    this.widen(this.width);
    this.dressParts();
  }

  color(frame: Frame): void {
    const scale = frame.scale;
    if (!scale || !this.frame) return;
    this.plain();
    const steps = wholes(frame, "steps");
    const ink = inks(scale);
    const at = (k: number) => ink(steps[k]);
    if (scale.on === "members") {
      this.widen(this.width + 1.4);
      if (this.members.visible) this.colorMembers(at);
      else this.colorWire(at);
      return;
    }
    const corners = wholes(this.frame, "panels");
    const colors = new Float32Array(3 * corners.length);
    for (let c = 0; c < corners.length; c++) {
      at(scale.on === "panels" ? Math.floor(c / 3) : corners[c]!).toArray(colors, 3 * c);
    }
    put(this.panels.geometry, "color", colors, 3);
    this.panels.material.vertexColors = true;
    this.panels.material.color.set("#ffffff");
    this.panels.material.needsUpdate = true;
  }

  private widen(width: number): void {
    this.memberMaterial.linewidth = width;
    this.wire.wire.value = this.members.visible ? 0 : width;
  }

  private colorMembers(at: (k: number) => Color): void {
    const count = wholes(this.frame!, "members").length / 2;
    const colors = new Float32Array(6 * count);
    for (let k = 0; k < count; k++) {
      at(k).toArray(colors, 6 * k);
      colors.copyWithin(6 * k + 3, 6 * k, 6 * k + 3);
    }
    this.members.geometry.setColors(colors);
    this.memberMaterial.vertexColors = true;
    this.memberMaterial.color.set("#ffffff");
    this.memberMaterial.needsUpdate = true;
  }

  private colorWire(at: (k: number) => Color): void {
    const members = wholes(this.frame!, "members");
    const panels = wholes(this.frame!, "panels");
    const nodes = floats(this.frame!, "xyz").length / 3;
    const key = (a: number, b: number) => Math.min(a, b) * nodes + Math.max(a, b);
    const number = new Map<number, number>();
    for (let k = 0; 2 * k < members.length; k++) number.set(key(members[2 * k]!, members[2 * k + 1]!), k);
    // The edge across each corner, told to all three.
    for (let edge = 0; edge < 3; edge++) {
      const colors = new Float32Array(3 * panels.length);
      for (let c = 0; c < panels.length; c += 3) {
        const member = number.get(key(panels[c + ((edge + 1) % 3)]!, panels[c + ((edge + 2) % 3)]!));
        const color = at(member ?? -1)
          .clone()
          .convertLinearToSRGB();
        for (let corner = c; corner < c + 3; corner++) color.toArray(colors, 3 * corner);
      }
      put(this.panels.geometry, `edge${edge}`, colors, 3);
    }
    this.wire.wireColored.value = true;
  }

  /** Whether it is one of many that follow each other. */
  get live(): boolean {
    return this.group.visible && this.frame?.shows === "live";
  }

  /** Whether it has so many members that drawing it takes its time. */
  get large(): boolean {
    return !this.members.visible;
  }

  /** Where the irregular nodes are. */
  irregular(): [number, number, number][] {
    if (!this.frame) return [];
    const at = gather(floats(this.frame, "xyz"), wholes(this.frame, "irregular"));
    return Array.from({ length: at.length / 3 }, (_, k) => [at[3 * k]!, at[3 * k + 1]!, at[3 * k + 2]!]);
  }

  /** Show which nodes are meant. */
  mark(nodes: number[]): void {
    this.dots(this.marks, Uint32Array.from(nodes), MARKED, 13);
  }

  /** Whether the nodes that do not move are told from the others. */
  showsFixed(yes: boolean): void {
    this.fixed.visible = yes;
  }

  private dots(of: ReturnType<typeof discs>, nodes: Uint32Array, fill: string, size: number): void {
    const xyz = this.frame ? floats(this.frame, "xyz") : new Float32Array();
    const colors = new Float32Array(3 * nodes.length);
    const color = new Color(fill);
    for (let k = 0; k < nodes.length; k++) color.toArray(colors, 3 * k);
    put(of.geometry, "position", gather(xyz, nodes), 3);
    put(of.geometry, "fill", colors, 3);
    put(of.geometry, "size", new Float32Array(nodes.length).fill(size), 1);
  }

  dress(theme: Theme, planes: Plane[]): void {
    this.theme = theme;
    const materials = [this.panels.material, this.memberMaterial, this.featureMaterial];
    for (const m of materials) m.clippingPlanes = planes;
    this.featureMaterial.color.set(theme.chosen);
    for (const p of [this.nodes, this.marks, this.fixed]) {
      p.material.clippingPlanes = planes;
      (p.material.uniforms["rim"]!.value as Color).set(theme.rim);
    }
    this.dressParts();
  }

  private dressParts(): void {
    if (!this.panels.material.vertexColors) this.panels.material.color.set(this.theme.panels);
    if (!this.memberMaterial.vertexColors) this.memberMaterial.color.set(this.theme.members);
    this.wire.wireColor.value.set(this.theme.members).convertLinearToSRGB();
  }

  /** Sizes on the screen, in pixels. */
  resize(width: number, height: number, pixels: number): void {
    this.memberMaterial.resolution.copy(new Vector2(width, height));
    this.featureMaterial.resolution.copy(this.memberMaterial.resolution);
    this.wire.pixels.value = pixels;
    for (const p of [this.nodes, this.marks, this.fixed]) p.material.uniforms["pixels"]!.value = pixels;
  }
}

/** A line that is being drawn by hand, seen through everything. */
export class DrawnLayer {
  readonly line: Line<BufferGeometry, LineBasicMaterial>;
  readonly ends = discs(false);

  constructor() {
    this.line = new Line(new BufferGeometry(), new LineBasicMaterial({ color: MARKED, depthTest: false }));
    this.line.frustumCulled = false;
    this.line.renderOrder = 3;
    this.show([]);
  }

  show(points: [number, number, number][]): void {
    const at = Float32Array.from(points.flat());
    const color = new Color(MARKED);
    for (const geometry of [this.line.geometry, this.ends.geometry]) put(geometry, "position", at, 3);
    put(this.ends.geometry, "fill", Float32Array.from(points.flatMap(() => color.toArray())), 3);
    put(this.ends.geometry, "size", new Float32Array(points.length).fill(11), 1);
    this.line.visible = this.ends.visible = points.length > 0;
  }
}
