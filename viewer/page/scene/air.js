// What is in the air: links coloured by RSSI between the radios that hear each other, and the messages on their way.

import {BufferGeometry, CanvasTexture, Color, CylinderGeometry, Float32BufferAttribute, Group, InstancedMesh, Matrix4, Mesh, MeshBasicMaterial, OctahedronGeometry, Points, PointsMaterial, Quaternion, Vector3} from 'three';
import {css_of, ink_on, ramp, themed} from '../colours.js';
import {usual_interval} from '../model/tables.js';

const most_messages = 500;      // drawn at once
const most_levels = 12;         // links with their figure written beside
const up = new Vector3(0, 1, 0);  // of three's cylinder

function disc_texture() {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 32;
  const pen = canvas.getContext('2d');
  pen.arc(16, 16, 14, 0, 2 * Math.PI);
  pen.fillStyle = '#fff';
  pen.fill();
  return new CanvasTexture(canvas);
}

/** Where a radio is now: on its robot, or in the world. */
export class Radios {
  constructor(scene, robots) {
    this.robots = robots;
    this.by_name = new Map(scene.radios.map((radio) => [radio.name, radio]));
    this.stations = scene.radios.filter((radio) => !radio.robot);
  }
  place(name) {
    const radio = this.by_name.get(name);
    const robot = this.robots.find(radio ? radio.robot : name);
    if (robot) return robot.is_there ? robot.point(radio?.at ?? [0, 0, 0.3]) : null;
    return radio ? new Vector3(...radio.at) : null;
  }
}

export class Air {
  constructor(record, stage, radios, range) {
    Object.assign(this, {stage, radios, range, source: record.links[0] ?? null, shown: []});
    const most = Math.max(1, ...record.links.map(({links}) => links.length));
    this.beams = new InstancedMesh(new CylinderGeometry(1, 1, 1, 6, 1, true), new MeshBasicMaterial(), most);
    this.beams.setColorAt(0, new Color());
    this.beams.frustumCulled = false;
    this.beams.name = 'links';
    this.stations = new Group();
    this.stations.name = 'stations';
    for (const station of radios.stations) {
      const mast = new Group();
      mast.name = `station ${station.name}`;
      const head = new Mesh(new OctahedronGeometry(1), new MeshBasicMaterial());
      const pole = new Mesh(new CylinderGeometry(0.02, 0.02, Math.max(0.01, station.at[2]), 8).rotateX(Math.PI / 2), new MeshBasicMaterial());
      head.position.set(...station.at);
      pole.position.set(station.at[0], station.at[1], station.at[2] / 2);
      mast.add(pole, head);
      this.stations.add(mast);
    }
    this.find_messages(record);
    stage.scene.add(this.beams, this.stations, this.dots);
    stage.before_drawing.push(() => this.size());
    this.recolour();
  }

  find_messages(record) {
    const messages = [];
    for (const table of record.tables_of('inbox', 'message')) {
      const sent = table.column('t_sent').data, received = table.column('t_received').data;
      const from = table.column('from'), to = table.column('radio');
      for (let r = 0; r < table.rows; ++r) messages.push({sent: sent[r], received: received[r], from: from.text(r), to: to.text(r)});
    }
    this.messages = messages.sort((a, b) => a.sent - b.sent);
    this.message_interval = usual_interval(Float64Array.from(this.messages, (message) => message.sent)) || 0.5;
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new Float32BufferAttribute(new Float32Array(3 * most_messages), 3));
    this.dots = new Points(geometry, new PointsMaterial({size: 6 * Math.min(devicePixelRatio, 2), sizeAttenuation: false, map: disc_texture(), alphaTest: 0.5, depthTest: false}));
    this.dots.frustumCulled = false;
    this.dots.name = 'messages';
  }

  /** Share of the scale from 0 to 1. */
  share(rssi) { return (rssi - this.range[0]) / (this.range[1] - this.range[0]); }

  set(t, speed) {
    this.shown = [];
    for (const link of this.source?.links ?? []) {
      const rssi = link.at(t);
      const a = rssi === null ? null : this.radios.place(link.from), b = a && this.radios.place(link.to);
      if (b) this.shown.push({link, rssi, a, b});
    }
    this.beams.count = this.shown.length;
    this.shown.forEach(({rssi}, i) => this.beams.setColorAt(i, new Color(css_of(ramp(this.share(rssi))))));
    if (this.beams.instanceColor) this.beams.instanceColor.needsUpdate = true;
    this.set_messages(t, speed);
  }

  /** A message takes its time; where that is too short to see, a quarter of a second of the reader's. */
  set_messages(t, speed) {
    const least = Math.min(0.25 * speed, Math.max(0.05, 0.9 * this.message_interval));
    const places = this.dots.geometry.getAttribute('position');
    let low = 0, high = this.messages.length, count = 0;
    while (low < high) {  // the first sent after t
      const middle = (low + high) >> 1;
      if (this.messages[middle].sent <= t) low = middle + 1; else high = middle;
    }
    for (let i = low - 1; i >= 0 && count < most_messages && low - i < 20 * most_messages; --i) {
      const {sent, received, from, to} = this.messages[i];
      const share = (t - sent) / Math.max(least, received - sent);
      if (share > 1) {
        if (t - sent > 10) break;  // no message of any network takes longer than this to be looked at
        continue;
      }
      const a = this.radios.place(from), b = a && this.radios.place(to);
      if (b) places.setXYZ(count++, ...a.lerp(b, share).toArray());
    }
    this.dots.geometry.setDrawRange(0, count);
    places.needsUpdate = true;
    this.messages_shown = count;
  }

  /** Beams of a few pixels at any distance, the two directions of a pair side by side. */
  size() {
    const matrix = new Matrix4(), middle = new Vector3(), along = new Vector3(), aside = new Vector3();
    const both = new Set(this.shown.map(({link}) => `${link.from}\n${link.to}`));
    this.shown.forEach((shown, i) => {
      const {link, rssi, a, b} = shown;
      along.subVectors(b, a);
      middle.addVectors(a, b).multiplyScalar(0.5);
      const pixel = Math.min(...[a, middle, b].map((place) => this.stage.pixel_at(place)));  // thin where it is near
      if (both.has(`${link.to}\n${link.from}`)) middle.add(aside.set(-along.y, along.x, 0).normalize().multiplyScalar(2.5 * pixel));
      const width = (0.9 + 1.1 * this.share(rssi)) * pixel;
      matrix.compose(middle, new Quaternion().setFromUnitVectors(up, along.clone().normalize()), new Vector3(width, along.length(), width));
      this.beams.setMatrixAt(i, matrix);
    });
    this.beams.instanceMatrix.needsUpdate = true;
    for (const mast of this.stations.children) {
      const [pole, head] = mast.children;
      const pixel = this.stage.pixel_at(head.position);
      head.scale.setScalar(Math.max(0.06, 7 * pixel));
      pole.scale.set(Math.max(1, 40 * pixel), Math.max(1, 40 * pixel), 1);
    }
  }

  /** Figures to write on links: of the stronger direction of a pair, the strongest first, of not too many; with places for them. */
  levels() {
    const best = new Map();
    for (const shown of this.shown) {
      const pair = [shown.link.from, shown.link.to].sort().join('\n');
      if (!(best.get(pair)?.rssi >= shown.rssi)) best.set(pair, shown);
    }
    if (best.size > (this.stage.width < 500 ? most_levels / 3 : most_levels)) return [];
    return [...best.values()].sort((one, other) => other.rssi - one.rssi).map(({rssi, a, b}) => {
      const colour = ramp(this.share(rssi));
      return {text: `${rssi.toFixed(0).replace('-', '\u2212')}`, places: [0.5, 0.35, 0.65, 0.2, 0.8].map((share) => a.clone().lerp(b, share)), dot: css_of(colour), on: ink_on(colour)};
    });
  }

  recolour() {
    const ink = new Color(themed('--ink'));
    this.dots.material.color = ink;
    for (const mast of this.stations.children) for (const mesh of mast.children) mesh.material.color = ink;
  }
}
