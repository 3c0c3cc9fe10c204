// Robots where they were at a time, with the wheels and legs that were recorded, a mark that stays visible from afar, and the way so far.

import {BufferGeometry, Color, DoubleSide, Float32BufferAttribute, Group, Line, LineBasicMaterial, Mesh, MeshBasicMaterial, Quaternion, RingGeometry, Shape, ShapeGeometry, Vector3} from 'three';
import {Line2} from 'three/examples/jsm/lines/Line2.js';
import {LineGeometry} from 'three/examples/jsm/lines/LineGeometry.js';
import {LineMaterial} from 'three/examples/jsm/lines/LineMaterial.js';
import {series_colour} from '../colours.js';
import {last_at} from '../model/tables.js';
import {Bodies} from './bodies.js';

const mark_pixels = 9;      // radius of a mark, at least
const most_places = 4000;   // of a way that is drawn

function mark_geometry() {
  const ring = new RingGeometry(0.86, 1, 40);
  const heading = new ShapeGeometry(new Shape().moveTo(1.5, 0).lineTo(1.02, 0.3).lineTo(1.02, -0.3));
  return [ring, heading];
}

class Robot {
  constructor(record, motion, index, bodies) {
    Object.assign(this, {motion, index, name: motion.name});
    this.group = new Group();
    this.group.name = `robot ${motion.name}`;
    this.body = bodies.make(motion.declared?.model ?? '', series_colour(index));
    this.group.add(this.body);
    this.mark_material = new MeshBasicMaterial({color: series_colour(index), side: DoubleSide});
    this.mark = new Group();
    for (const geometry of mark_geometry()) this.mark.add(new Mesh(geometry, this.mark_material));
    this.stem = new Line(new BufferGeometry().setAttribute('position', new Float32BufferAttribute(6, 3)), new LineBasicMaterial({color: series_colour(index)}));
    this.stem.frustumCulled = false;
    this.find_movers(record);
    this.add_way();
  }

  find_movers(record) {
    this.movers = this.body.userData.movers.map((joint) => {
      const rows = record.rows_of('robot', joint.quantity, this.name);
      return rows && {...joint, ...rows, values: rows.table.column(joint.column).data, time: rows.table.time, turn: new Vector3(...joint.axis)};
    }).filter(Boolean);
  }

  add_way() {
    this.way_times = [];
    if (!this.motion.is_recorded) return;
    const {from, to, time, columns: [x, y, z]} = this.motion;
    const stride = Math.ceil((to - from) / most_places);
    const places = [];
    for (let r = from; r < to; r += stride) {
      places.push(x[r], y[r], z[r] + 0.02);
      this.way_times.push(time[r]);
    }
    if (this.way_times.length < 2) return;
    const line = (opacity, width) => {
      const made = new Line2(new LineGeometry().setPositions(places), new LineMaterial({color: series_colour(this.index), linewidth: width, transparent: true, opacity}));
      made.frustumCulled = false;
      return made;
    };
    this.way = line(0.9, 2.5);
    this.way_to_come = line(0.25, 1.5);
  }

  /** Puts the robot where it was; hidden while it is not in the run. */
  set(t) {
    const pose = this.motion.pose_at(t);
    this.is_there = pose !== null;
    for (const object of [this.group, this.mark, this.stem]) object.visible = this.is_there;
    if (this.way) {
      this.way.geometry.instanceCount = Math.max(0, last_at(this.way_times, t));
      this.way.visible = this.way.geometry.instanceCount > 0;
    }
    if (!pose) return;
    this.group.position.set(pose[0], pose[1], pose[2]);
    this.group.quaternion.set(pose[4], pose[5], pose[6], pose[3]);
    this.group.updateMatrixWorld();
    const heading = new Vector3(1, 0, 0).applyQuaternion(this.group.quaternion);
    this.mark.position.set(pose[0], pose[1], pose[2] + 0.015);
    this.mark.rotation.set(0, 0, Math.atan2(heading.y, heading.x));
    const ends = this.stem.geometry.getAttribute('position');
    ends.setXYZ(0, pose[0], pose[1], 0);
    ends.setXYZ(1, pose[0], pose[1], pose[2]);
    ends.needsUpdate = true;
    this.stem.visible = pose[2] > 0.3;  // it flies
    for (const mover of this.movers) {
      const r = last_at(mover.time, t, mover.from, mover.to);
      mover.mover.quaternion.copy(new Quaternion().setFromAxisAngle(mover.turn, r < mover.from ? 0 : mover.values[r]));
    }
  }

  /** A place of its own frame in the world. */
  point(at) { return this.group.localToWorld(new Vector3(...at)); }

  recolour() {
    const colour = new Color(series_colour(this.index));
    this.body.userData.recolour(colour);
    this.mark_material.color = colour;
    this.stem.material.color = colour;
    for (const line of [this.way, this.way_to_come]) if (line) line.material.color = colour;
  }
}

export class Robots {
  constructor(record, stage) {
    this.stage = stage;
    const bodies = new Bodies(record.scene.models);
    this.list = record.motions.map((motion, i) => new Robot(record, motion, i, bodies));
    this.group = new Group();
    this.group.name = 'robots';
    this.marks = new Group();
    this.ways = new Group();
    for (const robot of this.list) {
      this.group.add(robot.group);
      this.marks.add(robot.mark, robot.stem);
      for (const line of [robot.way_to_come, robot.way]) if (line) this.ways.add(line);
    }
    stage.scene.add(this.group, this.marks, this.ways);
    stage.before_drawing.push(() => this.size_marks());
  }

  find(name) { return this.list.find((robot) => robot.name === name); }
  set(t) { for (const robot of this.list) robot.set(t); }

  /** Large enough to be seen from here, and around the body from near. */
  size_marks() {
    for (const {mark, body} of this.list) mark.scale.setScalar(Math.max(1.25 * body.userData.radius, mark_pixels * this.stage.pixel_at(mark.position)));
  }

  recolour() { for (const robot of this.list) robot.recolour(); }
}
