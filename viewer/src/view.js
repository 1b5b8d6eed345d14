// SPDX-License-Identifier: Apache-2.0
//
// The 3D view: the mesh at one time, and what meets over it.
//
// All that is drawn shares one buffer of positions, so a frame costs one copy; what is highlighted are indices into it.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { aim } from "./aim.js";
import * as colours from "./colours.js";
import { Highlight } from "./highlight.js";
import { depths, frontToBack, notBefore } from "./order.js";
import { surface } from "./surface.js";
import { Topology } from "./topology.js";

const fieldOfView = 35;
const mostOutlined = 3000; // faces about a contact; of more, lines hide what they outline

/** Whether the browser has no GPU: there smooth edges double the time of each frame. */
function drawsInSoftware() {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) return false;
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : gl.getParameter(gl.RENDERER));
  const lose = gl.getExtension("WEBGL_lose_context");
  if (lose) lose.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

/** A colour for each vertex: by the scene's parts, or by connected components where there is one part alone. */
function coloursOf(scene, topology) {
  const list = new Uint8Array(3 * scene.vertices);
  const paint = (v, c) => list.set([c >> 16, (c >> 8) & 255, c & 255], 3 * v);
  if (scene.parts.filter((part) => !part.given).length <= 1) {
    topology.components().forEach((component, v) => paint(v, colours.body(component)));
    return list;
  }
  scene.parts.forEach((part, i) => {
    for (let v = part.first; v < part.first + part.vertices; ++v)
      paint(v, part.fixed ? colours.fixedBody : colours.body(i));
  });
  return list;
}

/** The cells of the motion itself, and those of the part that is given, if there is one. */
function parted(scene, cells) {
  const part = scene.parts.find((p) => p.given);
  if (!part) return [cells, null];
  const of = (list, size, given) => list.filter((_, i) => list[i - (i % size)] >= part.first === given);
  const cut = (given) => ({
    faces: of(cells.faces, 3, given),
    edges: of(cells.edges, 2, given),
    points: of(cells.points, 1, given),
  });
  return [cut(false), cut(true)];
}

function setIndex(geometry, indices) {
  geometry.setIndex(new THREE.BufferAttribute(Uint32Array.from(indices), 1));
}

export class View {
  constructor(stage, scene, cells) {
    this.stage = stage;
    this.scene = scene;
    [this.cells, this.given] = parted(scene, cells);
    cells = this.cells;
    this.topology = new Topology(cells, scene.vertices);
    this.drawn = 0;
    this.renderer = new THREE.WebGLRenderer({ antialias: !drawsInSoftware(), powerPreference: "high-performance" });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    stage.append(this.renderer.domElement);
    this.world = new THREE.Scene();
    this.world.background = new THREE.Color(colours.ground);
    this.makeObjects();
    this.makeCamera();
    new ResizeObserver(() => this.resize()).observe(stage);
  }

  makeObjects() {
    const { scene, cells } = this;
    this.positions = new THREE.BufferAttribute(new Uint16Array(3 * scene.vertices), 3, true);
    this.positions.setUsage(THREE.DynamicDrawUsage);
    this.colours = new THREE.BufferAttribute(coloursOf(scene, this.topology), 3, true);
    // What is drawn: positions from 0 to 1, which this group takes to the scene's box.
    this.group = new THREE.Group();
    this.group.position.fromArray(scene.least);
    this.group.scale.fromArray(scene.greatest.map((x, k) => Math.max(x - scene.least[k], 1e-30)));
    this.world.add(this.group);
    const dot = { size: 7, sizeAttenuation: false };
    this.faces = this.add(THREE.Mesh, cells.faces, surface(), true);
    this.edges = this.add(
      THREE.LineSegments,
      [],
      new THREE.LineBasicMaterial({ color: colours.ink, transparent: true, opacity: 0.28 }),
    );
    this.edges.renderOrder = 2;
    // Thin lines and dots are darker than faces, or nobody would see them.
    const dark = { vertexColors: true, color: new THREE.Color(0.22, 0.22, 0.22) };
    this.add(THREE.LineSegments, cells.edges, new THREE.LineBasicMaterial(dark), true);
    this.add(THREE.Points, cells.points, new THREE.PointsMaterial({ ...dot, ...dark }), true);
    if (this.given) this.makeGiven(dot);
    this.highlight = new Highlight(this.group, this.positions);
  }

  /** Over all else, and seen through. */
  makeGiven(dot) {
    const through = { color: colours.given, transparent: true, opacity: 0.35, depthWrite: false };
    this.givenObjects = [
      this.add(THREE.Mesh, this.given.faces, new THREE.MeshBasicMaterial({ ...through, side: THREE.DoubleSide })),
      this.add(THREE.LineSegments, this.given.edges, new THREE.LineBasicMaterial(through)),
      this.add(THREE.Points, this.given.points, new THREE.PointsMaterial({ ...dot, ...through })),
    ];
    for (const object of this.givenObjects) object.renderOrder = 1;
  }

  showGiven(visible) {
    for (const object of this.givenObjects) object.visible = visible;
    this.changed();
  }

  add(Kind, indices, material, coloured) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", this.positions);
    if (coloured) geometry.setAttribute("color", this.colours);
    setIndex(geometry, indices);
    const object = new Kind(geometry, material);
    object.frustumCulled = false; // its bounds change with each frame
    this.group.add(object);
    return object;
  }

  makeCamera() {
    const least = new THREE.Vector3(...this.scene.least),
      greatest = new THREE.Vector3(...this.scene.greatest);
    this.centre = least.clone().add(greatest).multiplyScalar(0.5);
    this.radius = Math.max(0.5 * greatest.distanceTo(least), 1e-30);
    this.flat = this.scene.dimension === 2;
    this.usual = this.flat ? new THREE.Vector3(0, 0, 1) : new THREE.Vector3(0.8, -1.4, 0.7).normalize();
    this.camera = new THREE.PerspectiveCamera(fieldOfView, 1, this.radius * 0.01, this.radius * 100);
    this.camera.up.set(0, this.flat ? 1 : 0, this.flat ? 0 : 1);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener("start", () => {
      this.touched = true;
    });
    this.controls.addEventListener("change", () => this.changed());
    this.showAll();
  }

  showAll() {
    const goal = { centre: this.centre, radius: this.radius, direction: this.usual, cut: null };
    this.layOut(goal, this.allPositions());
    this.fit(goal);
  }

  /** Chooses what is drawn for a goal, at the positions that are seen: nothing that reaches before a cut. */
  layOut({ centre, radius, direction, cut }, positions) {
    this.depth = depths(positions, direction);
    this.most = cut ? centre.dot(direction) + cut : Infinity;
    setIndex(this.faces.geometry, frontToBack(this.kept(this.cells.faces, 3), this.depth));
    setIndex(this.edges.geometry, this.kept(this.allEdges ?? [], 2));
    this.highlight.setOthers(this.kept(this.others ?? [], 3));
    const near = this.edges.visible || radius === this.radius ? [] : this.topology.facesNear(positions, centre, radius);
    this.highlight.setNear(near.length < 3 * mostOutlined ? this.kept(near, 3) : []);
  }

  /** Those of the cells that no cut takes away. */
  kept(cells, size) {
    return notBefore(cells, size, this.depth, this.most);
  }

  /** Puts a sphere in the middle; it stays there when the view changes its size, until somebody moves the camera. */
  fit(goal) {
    this.goal = goal;
    this.touched = false;
    const distance = goal.radius / Math.sin((fieldOfView * Math.PI) / 360) / Math.min(1, this.camera.aspect);
    this.distance = distance;
    this.controls.target.copy(goal.centre);
    this.camera.position.copy(goal.centre).addScaledVector(goal.direction, distance);
    this.controls.update();
    this.changed();
  }

  /** The position of a vertex as it is drawn. */
  at(v) {
    return new this.centre.constructor()
      .fromBufferAttribute(this.positions, v)
      .multiply(this.group.scale)
      .add(this.group.position);
  }

  /** Positions of all vertices as they are drawn. */
  allPositions() {
    const { array } = this.positions;
    const scale = this.group.scale.toArray(),
      shift = this.group.position.toArray();
    return Float64Array.from(array, (x, i) => (x / 65535) * scale[i % 3] + shift[i % 3]);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.stage;
    if (width === 0 || height === 0 || (width === this.width && height === this.height)) return;
    Object.assign(this, { width, height });
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (!this.touched) this.fit(this.goal);
    else this.changed();
  }

  /** `write(array)` fills in the positions. */
  move(write) {
    write(this.positions.array);
    this.positions.needsUpdate = true;
    this.highlight.move();
    this.changed();
  }

  showEdges(visible) {
    if (visible && !this.allEdges) {
      this.allEdges = Uint32Array.from(this.topology.edges());
      setIndex(this.edges.geometry, this.kept(this.allEdges, 2));
    }
    this.edges.visible = visible;
    this.changed();
  }

  /** Whether these are features of this mesh: a damaged log may name others. */
  has(features) {
    return features.flat().every((v) => v < this.scene.vertices);
  }

  /** Highlights the features of a contact, or nothing. */
  choose(contact) {
    if (!contact || !this.has(contact.features)) this.highlight.clear();
    else
      this.highlight.set(
        contact.features,
        contact.features.map((f) => this.topology.cornersOf([f])),
      );
  }

  showOthers(contacts) {
    const features = contacts.filter((c) => this.has(c.features)).flatMap((c) => c.features);
    this.others = this.topology.cornersOf(features);
    this.highlight.setOthers(this.kept(this.others, 3));
  }

  /** Turns the camera to a contact. Says whether the view is cut open for it. */
  frame(contact) {
    if (!this.has(contact.features)) return false;
    const mesh = { positions: this.allPositions(), faces: this.cells.faces };
    const points = (list) => list.map((v) => this.at(v));
    const goal = aim({
      corners: contact.features.map((f) => points(this.topology.cornersOf([f]))),
      features: contact.features.map(points),
      point: contact.point ? new THREE.Vector3(...contact.point) : null,
      usual: this.usual,
      flat: this.flat,
      sceneRadius: this.radius,
      mesh,
    });
    this.layOut(goal, mesh.positions);
    this.fit(goal);
    return Boolean(goal.cut);
  }

  /** Draws with the next frame of the browser, however often it is asked to. */
  changed() {
    this.waiting ??= new Promise((done) =>
      requestAnimationFrame(() => {
        this.waiting = null;
        this.draw();
        done();
      }),
    );
    return this.waiting;
  }

  draw() {
    const distance = this.camera.position.distanceTo(this.controls.target);
    this.camera.near = 0.02 * distance;
    this.camera.far = distance + 4 * this.radius;
    this.camera.updateProjectionMatrix();
    this.renderer.render(this.world, this.camera);
    ++this.drawn;
  }
}
