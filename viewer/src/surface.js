// SPDX-License-Identifier: Apache-2.0
//
// How faces are shaded: flat, by a light at the eye, so that a face is brighter the more it faces the viewer, on either
// side. It is cheap, because browsers without a GPU compute every pixel.
import * as THREE from "three";

const vertex = `
  varying vec3 vColour;
  varying vec3 vSeen;
  void main() {
    vec4 mvPosition = modelViewMatrix * vec4(position, 1.0);
    vColour = color;
    vSeen = mvPosition.xyz;
    gl_Position = projectionMatrix * mvPosition;
  }`;

const fragment = `
  varying vec3 vColour;
  varying vec3 vSeen;
  void main() {
    vec3 normal = normalize(cross(dFdx(vSeen), dFdy(vSeen)));
    float facing = abs(dot(normal, normalize(vSeen)));
    gl_FragColor = vec4(vColour * (0.55 + 0.47 * facing), 1.0);
  }`;

/** Colours are those of the vertices, as a screen shows them. */
export function surface() {
  return new THREE.ShaderMaterial({
    vertexShader: vertex,
    fragmentShader: fragment,
    vertexColors: true,
    side: THREE.DoubleSide,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
}
