// What of a run the page can show: where robots were, how well radios heard each other, what lasers saw, and for what is
// not recorded the words that say so and how to get it.

import {Table, last_at, usual_interval} from './tables.js';
import {link_sources} from './links.js';

export class Record {
  constructor({head, bytes}) {
    this.run = head.run;
    this.scene = head.scene;
    this.notes = [...head.run.notes ?? [], ...head.notes ?? []];
    this.tables = head.tables.map((table) => new Table(table, bytes));
    this.first = this.run.start ?? 0;  // later than 0 in a run that goes on from a state
    this.last = this.run.time;
    for (const table of this.tables) for (const t of table.time) if (t > this.last) this.last = t;
    this.motions = this.find_motions();
    this.links = link_sources(this);
    this.scans = this.tables.find((table) => table.name === 'scan/*/message' && table.column('ranges')?.code.kind === 'lists');
  }

  /** Tables such as robot/*\/pose, or of single rows of that set (robot/leader/pose). */
  tables_of(set, quantity) {
    return this.tables.filter((table) => {
      const words = table.name.split('/');
      return words[0] === set && words.slice(2).join('/') === quantity;
    });
  }

  /** The rows of one name in such a table: {table, from, to}, or null. */
  rows_of(set, quantity, name) {
    for (const table of this.tables_of(set, quantity)) {
      const [from, to] = table.range(name);
      if (to > from) return {table, from, to};
    }
    return null;
  }

  find_motions() {
    const names = new Set(this.scene.robots.map((robot) => robot.name));
    for (const table of this.tables_of('robot', 'pose')) table.keys.forEach((key) => names.add(key));
    return [...names].map((name) => new Motion(this, name));
  }

  /** Statements on what the record lacks, each with its remedy. */
  lacks() {
    const words = [];
    const still = this.motions.filter((motion) => !motion.is_recorded).map((motion) => motion.name);
    const get = (table) => `Record it with: muster run WORLD --out DIR --record '${table}'`;
    if (this.motions.length && still.length === this.motions.length)
      words.push({about: 'poses', text: `No poses were recorded: robots stand where the world puts them. ${get('robot/*/pose')}`});
    else if (still.length)
      words.push({about: 'poses', text: `No poses of ${still.join(', ')} were recorded; they stand where the world puts them. ${get('robot/*/pose')}`});
    if (!this.motions.length) words.push({about: 'poses', text: 'This world has no robots.'});
    if (!this.links.length && this.tables_of('link', 'rssi').length)
      words.push({about: 'rssi', text: `The record has link/*/rssi without the ends of the links. ${get("link/*/ends' --record 'endpoint/*/radio")}`});
    else if (!this.links.length && this.scene.radios.length)
      words.push({about: 'rssi', text: `No RSSI was recorded. ${get('inbox/*/message')}`});
    for (const note of this.notes) words.push({about: 'record', text: note});
    return words;
  }
}

/** Where one robot was: its recorded poses, or the place that the world gives it. */
class Motion {
  constructor(record, name) {
    this.name = name;
    this.declared = record.scene.robots.find((robot) => robot.name === name);
    const rows = record.rows_of('robot', 'pose', name);
    this.is_recorded = rows !== null;
    if (!rows) return;
    Object.assign(this, rows);
    this.time = rows.table.time;
    this.columns = ['x', 'y', 'z', 'qw', 'qx', 'qy', 'qz'].map((column) => rows.table.column(column).data);
    this.gap = 2.5 * usual_interval(this.time.subarray(rows.from, rows.to));
  }

  row(r) { return this.columns.map((column) => column[r]); }

  /** [x, y, z, qw, qx, qy, qz], linear between recorded poses; null where the robot is not in the run. */
  pose_at(t) {
    if (!this.is_recorded) return this.declared?.pose ?? null;
    const r = last_at(this.time, t, this.from, this.to);
    if (r < this.from) return null;
    const a = this.row(r);
    if (this.time[r] === t) return a;
    if (r + 1 === this.to) return t - this.time[r] > this.gap && this.gap > 0 ? null : a;
    const share = (t - this.time[r]) / (this.time[r + 1] - this.time[r]);
    const b = this.row(r + 1);
    const same = a[3] * b[3] + a[4] * b[4] + a[5] * b[5] + a[6] * b[6] < 0 ? -1 : 1;  // q and -q turn alike
    const mixed = a.map((value, i) => value + share * ((i < 3 ? b[i] : same * b[i]) - value));
    const length = Math.hypot(mixed[3], mixed[4], mixed[5], mixed[6]);
    for (let i = 3; i < 7; ++i) mixed[i] /= length;
    return mixed;
  }
}
