// SPDX-License-Identifier: Apache-2.0
//
// What meets, over the mesh: the faces of both features filled, the features themselves as thick lines or dots. Faces
// are drawn twice: where they are seen, and faintly through whatever is before them.
import * as THREE from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import * as colours from "./colours.js";

const size = 65535;

/** A disc of 64 pixels, as a picture for dots. */
function dot(fill, rim) {
  const canvas = Object.assign(document.createElement("canvas"), { width: 64, height: 64 });
  const context = canvas.getContext("2d");
  context.arc(32, 32, 25, 0, 2 * Math.PI);
  Object.assign(context, { fillStyle: fill, strokeStyle: rim, lineWidth: 12 });
  context.fill();
  context.stroke();
  return new THREE.CanvasTexture(canvas);
}

const css = (colour) => `#${colour.toString(16).padStart(6, "0")}`;
const index = (list) => new THREE.BufferAttribute(Uint32Array.from(list), 1);

/** Vertices of the sides of a feature, two a side. */
const sides = (f) => (f.length < 2 ? [] : f.length === 2 ? f : [f[0], f[1], f[1], f[2], f[2], f[0]]);

function faces(positions, material, order) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", positions);
  geometry.setIndex(index([]));
  const mesh = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ side: THREE.DoubleSide, ...material }));
  mesh.renderOrder = order;
  return mesh;
}

/** The sides of faces, thin. */
function outline(positions, opacity) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", positions);
  geometry.setIndex(index([]));
  const object = new THREE.LineSegments(
    geometry,
    new THREE.LineBasicMaterial({ color: colours.ink, transparent: true, opacity }),
  );
  object.renderOrder = 3;
  return object;
}

/** Two vertices for each side of triangles. */
const sidesOf = (corners) => [...corners].flatMap((v, i) => [v, corners[i % 3 === 2 ? i - 2 : i + 1]]);

function dots(fill, rim, pixels) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(0), 3));
  const material = new THREE.PointsMaterial({
    map: dot(fill, rim),
    size: pixels,
    sizeAttenuation: false,
    transparent: true,
    depthTest: false,
  });
  const points = new THREE.Points(geometry, material);
  points.renderOrder = 5;
  return points;
}

function lines(colour) {
  const object = new LineSegments2(
    new LineSegmentsGeometry(),
    new LineMaterial({ color: colour, linewidth: 3.5, depthTest: false, transparent: true }),
  );
  object.renderOrder = 4;
  object.visible = false;
  return object;
}

/** One of the two features. */
class Side {
  constructor(positions, which) {
    const color = colours.meeting[which];
    const offset = { polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1 };
    this.seen = faces(positions, { color, ...offset }, 1);
    this.through = faces(positions, { color, depthTest: false, transparent: true, opacity: 0.5 }, 3);
    this.through.geometry = this.seen.geometry;
    this.line = lines(colours.meetingDark[which]);
    this.dot = dots(css(color), css(colours.meetingDark[which]), 15);
    this.outline = outline(positions, 0.7);
    this.objects = [this.seen, this.through, this.outline, this.line, this.dot];
  }

  set(feature, corners) {
    this.feature = feature;
    this.seen.geometry.setIndex(index(corners));
    this.outline.geometry.setIndex(index(sidesOf(corners)));
    // An edge that no face has is all there is to be seen of it.
    this.line.material.color.setHex(corners.length > 0 ? colours.meetingDark[this.which] : colours.meeting[this.which]);
  }

  /** `at(v)`: the position of a vertex in the unit box. */
  move(at) {
    const ends = sides(this.feature).flatMap(at);
    this.line.visible = ends.length > 0;
    if (ends.length > 0) {
      this.line.geometry.dispose();
      this.line.geometry = new LineSegmentsGeometry().setPositions(ends);
    }
    const alone = this.feature.length === 1 ? at(this.feature[0]) : [];
    this.dot.geometry.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(alone), 3));
  }
}

export class Highlight {
  /** `positions`: of all vertices, shared with the mesh. */
  constructor(group, positions) {
    this.positions = positions;
    this.two = [0, 1].map((which) => Object.assign(new Side(positions, which), { which }));
    const aside = {
      color: colours.others,
      transparent: true,
      opacity: 0.45,
      depthWrite: false,
      polygonOffset: true,
      polygonOffsetFactor: -0.5,
      polygonOffsetUnits: -0.5,
    };
    this.others = faces(positions, aside, 0);
    this.near = outline(positions, 0.2);
    this.objects = [...this.two.flatMap((side) => side.objects), this.others, this.near];
    for (const object of this.objects) object.frustumCulled = false;
    group.add(...this.objects);
    this.clear();
  }

  clear() {
    this.set([[], []], [[], []]);
  }

  /** `corners`: of the faces of either feature. */
  set(features, corners) {
    this.two.forEach((side, i) => side.set(features[i], corners[i]));
    this.move();
  }

  setOthers(corners) {
    this.others.geometry.setIndex(index(corners));
  }

  /** Outlines the faces about a contact, where the edges of all would be too many. */
  setNear(corners) {
    this.near.geometry.setIndex(index(sidesOf(corners)));
  }

  /** After positions have changed. */
  move() {
    const at = (v) => [0, 1, 2].map((k) => this.positions.array[3 * v + k] / size);
    for (const side of this.two) side.move(at);
  }

  show(visible) {
    for (const object of this.objects) object.visible = visible;
  }
}
