// SPDX-License-Identifier: Apache-2.0
//
// The 3D view: the mesh at one of the frames, and features of contacts over it.
//
// All that is drawn shares one buffer of positions, so a frame costs one copy; what is highlighted are indices into it.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

const partColours = [0x3b78c4, 0xd07a2d, 0x3f9c6b, 0x8e63b8, 0xc0567a, 0x5f8f9f, 0xa2902f, 0x7a6a5c];
const fixedColour = 0x9aa3af;

/** Each edge of the faces once, and the loose edges. */
function edgesOf(cells) {
  const seen = new Set();
  const edges = [];
  const add = (a, b) => {
    const key = Math.min(a, b) * 4294967296 + Math.max(a, b);
    if (seen.has(key)) return;
    seen.add(key);
    edges.push(a, b);
  };
  for (let i = 0; i < cells.faces.length; i += 3) {
    for (let k = 0; k < 3; ++k) add(cells.faces[i + k], cells.faces[i + ((k + 1) % 3)]);
  }
  for (let i = 0; i < cells.edges.length; i += 2) add(cells.edges[i], cells.edges[i + 1]);
  return edges;
}

function coloursOf(scene) {
  const colours = new Uint8Array(3 * scene.vertices);
  scene.parts.forEach((part, i) => {
    const c = part.fixed ? fixedColour : partColours[i % partColours.length];
    for (let v = part.first; v < part.first + part.vertices; ++v) {
      colours.set([c >> 16, (c >> 8) & 255, c & 255], 3 * v);
    }
  });
  return colours;
}

export class View {
  constructor(stage, scene, cells, frames) {
    this.stage = stage;
    this.frames = frames;
    this.drawn = 0;
    this.renderer = new THREE.WebGLRenderer({ antialias: true, powerPreference: "high-performance" });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    stage.append(this.renderer.domElement);
    this.world = new THREE.Scene();
    this.world.background = new THREE.Color(0xe9edf3);
    this.makeObjects(scene, cells);
    this.makeCamera(scene);
    this.show(0);
    new ResizeObserver(() => this.resize()).observe(stage);
  }

  makeObjects(scene, cells) {
    this.positions = new THREE.BufferAttribute(new Uint16Array(3 * scene.vertices), 3, true);
    this.positions.setUsage(THREE.DynamicDrawUsage);
    const colours = new THREE.BufferAttribute(coloursOf(scene), 3, true);
    // What is drawn: positions from 0 to 1, which this group takes to the scene's box.
    this.group = new THREE.Group();
    this.group.position.fromArray(scene.least);
    this.group.scale.fromArray(scene.greatest.map((x, k) => Math.max(x - scene.least[k], 1e-30)));
    this.world.add(this.group);
    const add = (Kind, indices, material, coloured) => {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", this.positions);
      if (coloured) geometry.setAttribute("color", colours);
      geometry.setIndex(new THREE.BufferAttribute(Uint32Array.from(indices), 1));
      const object = new Kind(geometry, material);
      object.frustumCulled = false;  // its bounds change with each frame
      this.group.add(object);
      return object;
    };
    const edges = edgesOf(cells);
    const side = THREE.DoubleSide;
    const dot = { size: 7, sizeAttenuation: false };
    add(THREE.Mesh, cells.faces,
      new THREE.MeshLambertMaterial({ vertexColors: true, flatShading: true, side, polygonOffset: true,
                                      polygonOffsetFactor: 1, polygonOffsetUnits: 1 }), true);
    this.edges = add(THREE.LineSegments, edges, new THREE.LineBasicMaterial({ color: 0x1c2330, transparent: true, opacity: 0.28 }));
    add(THREE.LineSegments, cells.edges, new THREE.LineBasicMaterial({ vertexColors: true }), true);
    add(THREE.Points, cells.points, new THREE.PointsMaterial({ ...dot, vertexColors: true }), true);
    const over = { depthTest: false, transparent: true };
    const red = 0xd32011;
    this.marks = [
      add(THREE.Points, [], new THREE.PointsMaterial({ ...dot, ...over, color: red })),
      add(THREE.LineSegments, [], new THREE.LineBasicMaterial({ ...over, color: red })),
      add(THREE.Mesh, [], new THREE.MeshBasicMaterial({ ...over, color: red, opacity: 0.45, side })),
    ];
    const sky = new THREE.HemisphereLight(0xffffff, 0x8a93a3, 2.2);
    this.light = new THREE.DirectionalLight(0xffffff, 1.4);
    this.world.add(sky, this.light);
  }

  makeCamera(scene) {
    const least = new THREE.Vector3(...scene.least), greatest = new THREE.Vector3(...scene.greatest);
    const centre = least.clone().add(greatest).multiplyScalar(0.5);
    this.radius = Math.max(0.5 * greatest.distanceTo(least), 1e-30);
    const flat = scene.dimension === 2;
    this.camera = new THREE.PerspectiveCamera(35, 1, this.radius * 0.01, this.radius * 100);
    this.camera.up.set(0, flat ? 1 : 0, flat ? 0 : 1);
    const from = flat ? new THREE.Vector3(0, 0, 1) : new THREE.Vector3(0.8, -1.4, 0.7).normalize();
    this.camera.position.copy(centre).addScaledVector(from, 3.4 * this.radius);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.target.copy(centre);
    this.controls.addEventListener("change", () => this.draw());
    this.controls.update();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.stage;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    // Once it is known how wide the view is, all is in it; from then on whoever looks decides.
    if (!this.fitted) {
      const away = this.camera.position.clone().sub(this.controls.target);
      this.camera.position.copy(this.controls.target).addScaledVector(away, 1 / Math.min(1, width / height));
      this.controls.update();
      this.fitted = true;
    }
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  show(frame) {
    this.positions.array.set(this.frames[frame]);
    this.positions.needsUpdate = true;
    this.draw();
  }

  showEdges(visible) {
    this.edges.visible = visible;
    this.draw();
  }

  /** Features of contacts: lists of one to three vertices. */
  mark(features) {
    const indices = [[], [], []];
    for (const feature of features) indices[feature.length - 1].push(...feature);
    this.marks.forEach((object, i) => object.geometry.setIndex(new THREE.BufferAttribute(Uint32Array.from(indices[i]), 1)));
    this.draw();
  }

  draw() {
    this.light.position.copy(this.camera.position);
    this.renderer.render(this.world, this.camera);
    ++this.drawn;
  }
}
