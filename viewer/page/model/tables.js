// The recorded tables as typed arrays. A table's rows lie grouped by their key (the robot, the radio), each group in the
// order of time, so that a group's column is a plain subarray.

import {lists, names, numbers} from './codes.js';

class Column {
  constructor(description, bytes) {
    this.name = description.name;
    this.unit = description.unit;
    this.code = description.code;
    this.bytes = bytes;
  }
  get title() { return this.unit ? `${this.name} [${this.unit}]` : this.name; }
  get is_number() { return this.code.kind !== 'names' && this.code.kind !== 'lists'; }
  /** Float64Array, or {levels, level}, or {starts, values}; unpacked when first used. */
  get data() {
    const unpack = this.code.kind === 'names' ? names : this.code.kind === 'lists' ? lists : numbers;
    return this.unpacked ??= unpack(this.code, this.bytes);
  }
  text(row) {
    if (this.code.kind === 'names') return this.data.levels[this.data.level[row]];
    return this.code.kind === 'lists' ? '' : String(this.data[row]);
  }
}

export class Table {
  constructor(description, bytes) {
    Object.assign(this, {name: description.table, file: description.file, rows: description.rows});
    this.times_in_record = description.times_in_record;
    this.kept_every = description.kept_every;
    this.columns = description.columns.map((column) => new Column(column, bytes));
    this.key_column = description.key?.column ?? '';
    this.keys = description.key?.values ?? [''];
    this.starts = description.key?.starts ?? [0, description.rows];
  }
  column(name) { return this.columns.find((column) => column.name === name); }
  get time() { return this.columns[0].data; }
  /** The rows of a key, as [first, last + 1]. */
  range(key) {
    const at = this.keys.indexOf(key);
    return at < 0 ? [0, 0] : [this.starts[at], this.starts[at + 1]];
  }
  /** Times and values of a column for one key. */
  series(name, key) {
    const [from, to] = this.range(key);
    return {time: this.time.subarray(from, to), values: this.column(name).data.subarray(from, to)};
  }
}

/** The last index in [from, to) whose time is not after t, or from - 1. */
export function last_at(time, t, from = 0, to = time.length) {
  let low = from, high = to;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (time[middle] <= t) low = middle + 1; else high = middle;
  }
  return low - 1;
}

/** The interval between neighbouring times that half of the intervals do not exceed; 0 where there is none. */
export function usual_interval(time) {
  const steps = [];
  const stride = Math.max(1, Math.floor(time.length / 2000));
  for (let i = stride; i < time.length; i += stride) if (time[i] > time[i - 1]) steps.push(time[i] - time[i - 1]);
  return steps.length ? steps.sort((a, b) => a - b)[steps.length >> 1] : 0;
}
