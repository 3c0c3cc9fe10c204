// Floor, walls, doors, ceilings and meshes, with their heights. Walls are boxes of one instanced mesh: a plan may have thousands.

import {BoxGeometry, BufferGeometry, Color, DoubleSide, EdgesGeometry, Float32BufferAttribute, Group, InstancedMesh, LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshLambertMaterial, PlaneGeometry, Quaternion, Vector3} from 'three';
import {is_dark, themed} from '../colours.js';

const upright = new Vector3(0, 0, 1);
const least_thickness = 0.04;  // [m] a wall of none is still seen

/** The wall without its doors: {from, to, low, high} in metres along it and up, and the doors' own pieces. */
export function pieces_of(wall, doors) {
  const length = Math.hypot(wall.to[0] - wall.from[0], wall.to[1] - wall.from[1]);
  const pieces = [];
  let begin = 0;
  for (const door of [...doors].sort((a, b) => a.at - b.at)) {
    if (door.at > begin) pieces.push({from: begin, to: door.at, low: 0, high: wall.height});
    if (door.height < wall.height) pieces.push({from: door.at, to: door.at + door.width, low: door.height, high: wall.height});
    begin = Math.max(begin, door.at + door.width);
  }
  if (begin < length) pieces.push({from: begin, to: length, low: 0, high: wall.height});
  return pieces;
}

function box_of(wall, piece, swung = 0) {
  const angle = Math.atan2(wall.to[1] - wall.from[1], wall.to[0] - wall.from[0]);
  const thickness = Math.max(wall.thickness, least_thickness) * (swung ? 0.5 : 1);
  const along = (at) => new Vector3(wall.from[0] + at * Math.cos(angle), wall.from[1] + at * Math.sin(angle), 0);
  const half = (piece.to - piece.from) / 2;
  const hinge = along(piece.from);
  const centre = swung ? hinge.add(new Vector3(half * Math.cos(angle + swung), half * Math.sin(angle + swung), 0)) : along(piece.from + half);
  centre.z = wall.base + (piece.low + piece.high) / 2;
  return new Matrix4().compose(centre, new Quaternion().setFromAxisAngle(upright, angle + swung), new Vector3(2 * half, thickness, piece.high - piece.low));
}

export class Building {
  constructor(description) {
    this.group = new Group();
    this.group.name = 'building';
    this.walls = description.walls;
    this.doors = description.doors.map((door) => ({...door, wall: this.walls.find((wall) => wall.name === door.wall)}));
    this.wall_material = new MeshLambertMaterial({transparent: true});
    this.edge_material = new LineBasicMaterial({transparent: true, opacity: 0.65});
    this.door_material = new MeshLambertMaterial({transparent: true, opacity: 0.5});
    this.mesh_material = new MeshLambertMaterial({side: DoubleSide, flatShading: true, transparent: true});
    this.slab_material = new MeshLambertMaterial({side: DoubleSide, transparent: true, opacity: 0.35, depthWrite: false});
    this.add_walls();
    this.add_doors();
    description.floors.forEach((floor) => this.add_slab(floor));
    description.meshes.forEach((mesh) => this.add_mesh(mesh));
    this.set_look('glass');
  }

  add_walls() {
    const boxes = this.walls.flatMap((wall) => pieces_of(wall, this.doors.filter((door) => door.wall === wall)).map((piece) => box_of(wall, piece)));
    const unit = new BoxGeometry(1, 1, 1);
    this.wall_mesh = new InstancedMesh(unit, this.wall_material, Math.max(1, boxes.length));
    this.wall_mesh.count = boxes.length;
    this.wall_mesh.name = 'walls';
    this.wall_mesh.userData.walls = this.walls.length;
    this.wall_mesh.frustumCulled = false;
    const edges = new EdgesGeometry(unit).getAttribute('position');
    const places = new Float32Array(boxes.length * edges.count * 3);
    const place = new Vector3();
    boxes.forEach((box, i) => {
      this.wall_mesh.setMatrixAt(i, box);
      for (let e = 0; e < edges.count; ++e) place.fromBufferAttribute(edges, e).applyMatrix4(box).toArray(places, 3 * (i * edges.count + e));
    });
    const lines = new BufferGeometry();
    lines.setAttribute('position', new Float32BufferAttribute(places, 3));
    this.group.add(this.wall_mesh, new LineSegments(lines, this.edge_material));
  }

  add_doors() {
    this.leaves = this.doors.map((door) => {
      const leaf = new Mesh(new BoxGeometry(1, 1, 1), this.door_material);
      leaf.matrixAutoUpdate = false;
      leaf.name = `door ${door.name}`;
      this.group.add(leaf);
      return leaf;
    });
    this.doors.forEach((door, i) => this.set_door(i, door.open));
  }

  /** Open: the leaf is swung out by 80 degrees about its first end. */
  set_door(i, is_open) {
    const door = this.doors[i];
    const piece = {from: door.at, to: door.at + door.width, low: 0, high: Math.min(door.height, door.wall.height)};
    this.leaves[i].matrix.copy(box_of(door.wall, piece, is_open ? 1.4 : 0));
    this.leaves[i].matrixWorldNeedsUpdate = true;
  }

  add_slab({name, corners, z}) {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new Float32BufferAttribute([0, 1, 2, 3].flatMap((i) => [corners[2 * i], corners[2 * i + 1], z]), 3));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    geometry.computeVertexNormals();
    const slab = new Mesh(geometry, this.slab_material);
    slab.name = `floor ${name}`;
    this.group.add(slab);
  }

  add_mesh({name, vertices, faces}) {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new Float32BufferAttribute(vertices, 3));
    geometry.setIndex(faces);
    geometry.computeVertexNormals();
    const mesh = new Mesh(geometry, this.mesh_material);
    mesh.name = `mesh ${name}`;
    this.group.add(mesh);
  }

  /** The ground under everything, with a line a metre, or a ten-metre in large worlds. */
  add_ground(box) {
    const size = box.getSize(new Vector3()), centre = box.getCenter(new Vector3());
    const step = Math.max(size.x, size.y) > 80 ? 10 : Math.max(size.x, size.y) > 8 ? 1 : 0.25;
    const reach = (middle, length) => [step * Math.floor((middle - length / 2) / step - 1), step * Math.ceil((middle + length / 2) / step + 1)];
    const [x0, x1] = reach(centre.x, size.x), [y0, y1] = reach(centre.y, size.y);
    const z = Math.min(0, box.min.z) - 0.005;
    this.ground_material = new MeshLambertMaterial();
    const ground = new Mesh(new PlaneGeometry(x1 - x0, y1 - y0), this.ground_material);
    ground.position.set((x0 + x1) / 2, (y0 + y1) / 2, z - 0.01);
    ground.name = 'ground';
    const places = [];
    for (let x = x0; x <= x1 + step / 2; x += step) places.push(x, y0, z, x, y1, z);
    for (let y = y0; y <= y1 + step / 2; y += step) places.push(x0, y, z, x1, y, z);
    const lines = new BufferGeometry();
    lines.setAttribute('position', new Float32BufferAttribute(places, 3));
    this.grid_material = new LineBasicMaterial();
    this.group.add(ground, new LineSegments(lines, this.grid_material));
    this.grid_step = step;
    this.recolour();
  }

  /** "glass": robots behind walls are seen; "solid"; "lines". */
  set_look(look) {
    this.wall_material.opacity = {glass: is_dark() ? 0.34 : 0.3, solid: 1, lines: 0.03}[look];
    this.wall_material.depthWrite = look === 'solid';
    this.mesh_material.opacity = {glass: 0.55, solid: 1, lines: 0.1}[look];
    this.mesh_material.depthWrite = look === 'solid';
    for (const mesh of this.group.children) if (mesh.material === this.wall_material || mesh.material === this.mesh_material) mesh.castShadow = look !== 'lines';
    this.look = look;
  }

  recolour() {
    const dark = is_dark();
    this.wall_material.color = new Color(dark ? '#8d9bb0' : '#7c899c');
    this.edge_material.color = new Color(dark ? '#8d9bb0' : '#5b6778');
    this.door_material.color = new Color(dark ? '#c29a63' : '#a97c45');
    this.mesh_material.color = new Color(dark ? '#7f8ea5' : '#8d99aa');
    this.slab_material.color = new Color(dark ? '#5d6a7d' : '#a9b3c1');
    if (this.ground_material) this.ground_material.color = new Color(dark ? '#1a1f27' : '#eef0f3');
    if (this.grid_material) this.grid_material.color = new Color(themed(dark ? '--grid' : '--line'));
    this.set_look(this.look);
  }
}
