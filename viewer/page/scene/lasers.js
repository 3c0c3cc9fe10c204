// Laser scans: the last one of each robot as a fan of what it saw, and a dot at each echo.

import {BufferGeometry, Color, DoubleSide, Float32BufferAttribute, Group, Mesh, MeshBasicMaterial, Points, PointsMaterial, Quaternion, Vector3} from 'three';
import {is_dark} from '../colours.js';
import {last_at} from '../model/tables.js';

const stale = 1;  // [s] after which a scan is no longer shown

export class Lasers {
  constructor(record, stage) {
    this.group = new Group();
    this.group.name = 'scans';
    this.table = record.scans;
    this.fans = [];
    stage.scene.add(this.group);
    if (!this.table) return;
    this.fan_material = new MeshBasicMaterial({side: DoubleSide, transparent: true, opacity: 0.11, depthWrite: false});
    this.dot_material = new PointsMaterial({size: 2.5 * Math.min(devicePixelRatio, 2), sizeAttenuation: false});
    for (const name of this.table.keys) {
      const motion = record.motions.find((one) => one.name === name);
      const fan = new Mesh(new BufferGeometry(), this.fan_material), dots = new Points(new BufferGeometry(), this.dot_material);
      fan.frustumCulled = dots.frustumCulled = false;
      this.group.add(fan, dots);
      const [from, to] = this.table.range(name);
      this.fans.push({motion, fan, dots, from, to, row: -1});
    }
    this.recolour();
  }

  value(column, row) { return this.table.column(column).data[row]; }

  set(t) {
    for (const one of this.fans) {
      const row = last_at(this.table.time, t, one.from, one.to);
      const is_fresh = row >= one.from && t - this.table.time[row] <= stale && one.motion;
      one.fan.visible = one.dots.visible = Boolean(is_fresh);
      if (is_fresh && row !== one.row) this.draw(one, row);
    }
  }

  /** From the robot's pose at the time of the scan. */
  draw(one, row) {
    one.row = row;
    const taken = this.table.column('scan_t')?.data[row] ?? this.table.time[row];
    const pose = one.motion.pose_at(taken) ?? one.motion.pose_at(this.table.time[row]);
    if (!pose) return;
    const place = new Vector3(pose[0], pose[1], pose[2]), turn = new Quaternion(pose[4], pose[5], pose[6], pose[3]);
    const origin = new Vector3(this.value('at_x', row), this.value('at_y', row), this.value('at_z', row)).applyQuaternion(turn).add(place);
    turn.multiply(new Quaternion(this.value('qx', row), this.value('qy', row), this.value('qz', row), this.value('qw', row)));
    const {starts, values} = this.table.column('ranges').data;
    const farthest = this.value('max_range', row), first = this.value('min_angle', row), step = this.value('step', row);
    const rim = [...origin.toArray()], hits = [], triangles = [];
    for (let i = starts[row], k = 0; i < starts[row + 1]; ++i, ++k) {
      const is_echo = Number.isFinite(values[i]);
      const range = is_echo ? values[i] : values[i] > 0 ? farthest : 0;
      const angle = first + k * step;
      const end = new Vector3(range * Math.cos(angle), range * Math.sin(angle), 0).applyQuaternion(turn).add(origin).toArray();
      rim.push(...end);
      if (is_echo) hits.push(...end);
      if (k > 0) triangles.push(0, k, k + 1);
    }
    one.fan.geometry.dispose();
    one.dots.geometry.dispose();
    one.fan.geometry = new BufferGeometry().setAttribute('position', new Float32BufferAttribute(rim, 3));
    one.fan.geometry.setIndex(triangles);
    one.dots.geometry = new BufferGeometry().setAttribute('position', new Float32BufferAttribute(hits, 3));
  }

  recolour() {
    if (!this.table) return;
    const colour = new Color(is_dark() ? '#ff9ecb' : '#b0005e');
    this.fan_material.color = this.dot_material.color = colour;
  }
}
