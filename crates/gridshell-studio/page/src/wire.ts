// Members drawn as the edges of panels, by the panels' own shader.
import type { Color, MeshLambertMaterial } from "three";

const WIRE_VERTEX = `
  attribute vec3 edge0;
  attribute vec3 edge1;
  attribute vec3 edge2;
  uniform bool wireColored;
  uniform vec3 wireColor;
  varying vec3 vCorner;
  flat varying vec3 vEdge0;
  flat varying vec3 vEdge1;
  flat varying vec3 vEdge2;`;

/** Each vertex of a panel has a coordinate of its own that is 1 there, 0 on the edge across. */
const WIRE_CORNER = `
  int corner = gl_VertexID % 3;
  vCorner = vec3(corner == 0, corner == 1, corner == 2);
  vEdge0 = wireColored ? edge0 : wireColor;
  vEdge1 = wireColored ? edge1 : wireColor;
  vEdge2 = wireColored ? edge2 : wireColor;`;

const WIRE_FRAGMENT = `
  uniform float wire;
  uniform float pixels;
  varying vec3 vCorner;
  flat varying vec3 vEdge0;
  flat varying vec3 vEdge1;
  flat varying vec3 vEdge2;`;

/**
 * Half of a member lies on each of its panels; its edge is smoothed over a pixel. Panels that are small on the screen
 * have thinner members, and those thinner than a pixel are fainter.
 */
const WIRE_EDGE = `
  if (wire > 0.0) {
    vec3 rate = fwidth(vCorner);
    vec3 off = vCorner / rate;
    float nearest = min(off.x, min(off.y, off.z));
    vec3 member = nearest == off.x ? vEdge0 : nearest == off.y ? vEdge1 : vEdge2;
    float width = min(wire * pixels, 0.16 / max(rate.x, max(rate.y, rate.z)));
    float cover = min(width, 1.0) * clamp(0.5 * max(width, 1.0) + 0.5 - nearest, 0.0, 1.0);
    gl_FragColor.rgb = mix(gl_FragColor.rgb, member, cover);
  }`;

/** What the shader is told; colors as the screen has them, not linear. */
export interface Wire {
  pixels: { value: number };
  wire: { value: number };
  wireColored: { value: boolean };
  wireColor: { value: Color };
}

/** Draws the edges of panels as members `wire` pixels wide: much quicker than a line for each. */
export function wired(material: MeshLambertMaterial, uniforms: Wire): void {
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = shader.vertexShader.replace(
      "void main() {",
      `${WIRE_VERTEX}\nvoid main() {\n${WIRE_CORNER}`,
    );
    shader.fragmentShader = shader.fragmentShader
      .replace("void main() {", `${WIRE_FRAGMENT}\nvoid main() {`)
      .replace("#include <colorspace_fragment>", `#include <colorspace_fragment>\n${WIRE_EDGE}`);
  };
}
