// The scene of a run: building, robots, radios, links, messages and scans at the clock's time, and the controls above it.

import {Box3, Vector3} from 'three';
import {ramp, series_colour} from './colours.js';
import {rssi_range} from './model/links.js';
import {last_at} from './model/tables.js';
import {Air, Radios} from './scene/air.js';
import {Building} from './scene/building.js';
import {Labels, draw_legend} from './scene/labels.js';
import {Lasers} from './scene/lasers.js';
import {visibilities} from './scene/light.js';
import {Robots} from './scene/robots.js';
import {Stage} from './scene/stage.js';

const at = (id) => document.getElementById(id);

export class View {
  constructor(record, clock) {
    Object.assign(this, {record, clock});
    this.stage = new Stage(at('canvas'));
    this.populate();
    this.add_controls();
    this.list_choices();
    this.add_notes();
    clock.listen((t) => this.set(t));
    this.recolour();
    this.set(clock.time);
    this.stage.fit();
  }

  populate() {
    const {record} = this;
    this.building = new Building(record.scene);
    this.stage.scene.add(this.building.group);
    this.robots = new Robots(record, this.stage);
    this.radios = new Radios(record.scene, this.robots);
    this.range = rssi_range(record.links) ?? [-90, -40];
    this.air = new Air(record, this.stage, this.radios, this.range);
    this.lasers = new Lasers(record, this.stage);
    this.find_box();
    this.building.add_ground(this.stage.box);
    this.stage.light.cover(this.stage.box);
    this.labels = new Labels(at('labels'), this.stage);
    for (const robot of this.robots.list) this.labels.add(robot.name, 'robot', () => robot.is_there ? robot.point([0, 0, 0.2]) : null, () => series_colour(robot.index));
    for (const station of this.radios.stations) this.labels.add(station.name, 'station', () => new Vector3(...station.at), () => 'var(--ink)');
    this.labels.levels_of = () => this.air.levels();
    this.doors = record.tables_of('door', 'state');
  }

  /** The record of a run that has gone on: what is drawn is made anew, camera and choices stay. */
  renew(record) {
    this.record = record;
    const {scene} = this.stage;
    const source = this.air.source?.name, chosen = new Map([...at('show-list').querySelectorAll('input, select')].map((one) => [one.dataset.name, one.disabled ? undefined : one.type === 'checkbox' ? one.checked : one.value]));
    for (const group of scene.children.filter(({isLight}) => !isLight)) {
      scene.remove(group);
      group.traverse((object) => {
        object.geometry?.dispose();
        for (const material of [object.material ?? []].flat()) material.dispose();
        if (object.isInstancedMesh) object.dispose();
      });
    }
    this.stage.before_drawing = [];
    at('labels').replaceChildren();
    this.populate();
    this.air.source = record.links.find(({name}) => name === source) ?? this.air.source;
    at('show-list').replaceChildren();
    this.list_choices();
    for (const one of at('show-list').querySelectorAll('input, select')) {
      const value = chosen.get(one.dataset.name);
      if (value === undefined || one.disabled) continue;
      if (one.type === 'checkbox') one.checked = value; else one.value = value;
      one.dispatchEvent(new Event('change'));
    }
    for (const robot of this.robots.list) if (![...at('follow').options].some(({value}) => value === robot.name)) at('follow').append(new Option(robot.name, robot.name));
    at('notes').replaceChildren();
    this.add_notes();
    this.recolour();
    if (this.stage.is_fitted) this.stage.fit_again();
  }

  /** Around all that is or was there. */
  find_box() {
    const box = this.stage.box, {scene} = this.record;
    const add = (x, y, z) => box.expandByPoint(new Vector3(x, y, z));
    for (const {from, to, base, height} of scene.walls) add(...from, base), add(...to, base + height);
    for (const {corners, z} of scene.floors) for (let i = 0; i < 8; i += 2) add(corners[i], corners[i + 1], z);
    for (const mesh of this.building.group.children) if (mesh.name.startsWith('mesh ')) box.union(new Box3().setFromObject(mesh));
    for (const station of this.radios.stations) add(...station.at);
    for (const motion of this.record.motions) {
      if (motion.declared?.pose) add(...motion.declared.pose.slice(0, 3));
      if (!motion.is_recorded) continue;
      const [x, y, z] = motion.columns;
      for (let r = motion.from; r < motion.to; ++r) add(x[r], y[r], z[r]);
    }
    if (box.isEmpty()) add(0, 0, 0);
    const size = box.getSize(new Vector3());
    if (Math.max(size.x, size.y) < 2) box.expandByVector(new Vector3(1, 1, 0));
    box.max.z = Math.max(box.max.z, box.min.z + 0.3);
  }

  set(t) {
    this.set_doors(t);
    this.robots.set(t);
    this.air.set(t, this.clock.is_playing ? this.clock.speed : 1);
    this.lasers.set(t);
    this.follow();
    this.stage.invalidate();
    if (!this.clock.is_playing) this.describe(t);
  }

  set_doors(t) {
    for (const table of this.doors) {
      this.building.doors.forEach((door, i) => {
        const [from, to] = table.range(door.name);
        const r = last_at(table.time, t, from, to);
        if (r >= from) this.building.set_door(i, table.column('open').data[r] !== 0);
      });
    }
  }

  follow() {
    const robot = this.robots.find(this.followed);
    if (!robot?.is_there) return;
    const {controls, camera} = this.stage;
    const way = robot.group.position.clone().sub(controls.target);
    controls.target.add(way);
    camera.position.add(way);
  }

  describe(t) {
    const {scene, motions} = this.record;
    const there = this.robots.list.filter((robot) => robot.is_there).length;
    at('canvas').setAttribute('aria-label', `Scene at ${t.toFixed(2)} s: ${there} of ${motions.length} robots, ${this.radios.stations.length} stations, ${scene.walls.length} walls, ${scene.doors.length} doors, ${this.air.shown.length} links`);
  }

  add_controls() {
    at('fit').addEventListener('click', () => this.release(() => this.stage.fit()));
    at('top').addEventListener('click', () => this.release(() => this.stage.fit_from_above()));
    for (const robot of this.robots.list) at('follow').append(new Option(robot.name, robot.name));
    at('follow').addEventListener('change', (event) => this.start_following(event.target.value));
    document.addEventListener('keydown', (event) => this.key(event));
    at('canvas').addEventListener('pointerdown', () => { at('show').open = false; });
  }

  list_choices() {
    const messages = this.air.messages.length;
    this.add_choice('Links', (on) => { this.air.beams.visible = on; }, this.record.links.length ? '' : 'no RSSI recorded');
    this.add_choice('Figures in dBm', (on) => { this.labels.shows_levels = on; }, this.record.links.length ? '' : 'no RSSI recorded');
    this.add_choice('Messages', (on) => { this.air.dots.visible = on; }, messages ? '' : 'inbox/*/message not recorded');
    this.add_choice('Laser scans', (on) => { this.lasers.group.visible = on; }, this.record.scans ? '' : 'scan/*/message not recorded');
    this.add_choice('Ways', (on) => { this.robots.ways.visible = on; }, this.robots.ways.children.length ? '' : 'no poses recorded');
    this.add_choice('Names', (on) => { this.labels.shows_names = on; });
    this.add_choice('Marks around robots', (on) => { this.robots.marks.visible = on; });
    this.add_choice('Shadows', (on) => this.stage.light.set_shadows(on));
    this.add_select('Walls', [['glass', 'see-through'], ['solid', 'solid'], ['lines', 'edges only']], (look) => this.building.set_look(look));
    this.add_select('Fog', [[0, 'none'], ...visibilities(this.stage.box).map((metres) => [metres, `sight of ${metres} m`])], (metres) => this.stage.light.set_visibility(Number(metres)));
    if (this.record.links.length > 1) {
      this.add_select('RSSI of', this.record.links.map(({name}) => [name, name]), (name) => {
        this.air.source = this.record.links.find((source) => source.name === name);
        this.draw_legend();
        this.set(this.clock.time);
      });
    }
  }

  add_choice(words, act, lack = '') {
    const label = document.createElement('label'), box = document.createElement('input'), text = document.createElement('span');
    Object.assign(box, {type: 'checkbox', checked: !lack, disabled: Boolean(lack)});
    box.dataset.name = words;
    text.textContent = words;
    if (lack) {
      const small = document.createElement('small');
      small.textContent = ` (${lack})`;
      text.append(small);
    }
    box.addEventListener('change', () => { act(box.checked); this.stage.invalidate(); });
    label.append(box, text);
    at('show-list').append(label);
  }

  add_select(words, choices, act) {
    const label = document.createElement('label'), select = document.createElement('select');
    for (const [value, text] of choices) select.append(new Option(text, value));
    select.dataset.name = words;
    select.addEventListener('change', () => { act(select.value); this.stage.invalidate(); });
    label.append(words, select);
    at('show-list').append(label);
  }

  release(act) {
    this.followed = at('follow').value = '';
    act();
  }

  /** From near: the robot is some twenty of its lengths away. */
  start_following(name) {
    this.followed = name;
    const robot = this.robots.find(name);
    if (!robot?.is_there) return;
    const from = this.stage.camera.position.clone().sub(this.stage.controls.target).normalize();
    if (from.z > 0.95) from.set(-0.2, -1, 0.8).normalize();
    this.stage.look(robot.group.position, from, Math.max(3, 20 * robot.body.userData.radius));
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest?.('select, dialog[open]')) return;
    const in_scene = event.target === at('canvas');
    const acts = {f: () => at('fit').click(), t: () => at('top').click(), ...(in_scene ? {'+': () => this.stage.zoom(0.8), '-': () => this.stage.zoom(1.25)} : {})};
    acts[event.key.toLowerCase()]?.();
  }

  draw_legend() {
    if (this.air.source) draw_legend(at('legend'), this.range, this.air.source.name, ramp);
  }

  add_notes() {
    for (const {about, text} of this.record.lacks()) {
      const item = document.createElement('li');
      item.dataset.about = about;
      item.textContent = text;
      at('notes').append(item);
    }
  }

  recolour() {
    this.stage.recolour();
    for (const part of [this.building, this.robots, this.air, this.lasers]) part.recolour();
    this.draw_legend();
    this.set(this.clock.time);
  }
}
