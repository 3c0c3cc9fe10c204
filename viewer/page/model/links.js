// How well radios hear each other, from whichever table of the record has it: messages received, a watched chain, or the
// channel's own links.

import {last_at, usual_interval} from './tables.js';

/** One directed link in time: from, to, time, rssi, and after how long a reading is no longer shown. */
class Link {
  constructor(from, to, time, rssi, lasts) {
    Object.assign(this, {from, to, time, rssi, lasts});
  }
  /** The RSSI in dBm at time t, or null. */
  at(t) {
    const r = last_at(this.time, t);
    if (r < 0 || t - this.time[r] > this.lasts || Number.isNaN(this.rssi[r])) return null;
    return this.rssi[r];
  }
}

function sorted_links(pairs, lasts_of) {
  return [...pairs.values()].map(({from, to, rows, time, rssi}) => {
    const times = Float64Array.from(rows, (r) => time[r]);
    return new Link(from, to, times, Float64Array.from(rows, (r) => rssi[r]), lasts_of(times));
  });
}

function grouped(pairs, from, to, r, time, rssi) {
  const key = `${from}\n${to}`;
  let pair = pairs.get(key);
  if (!pair) pairs.set(key, pair = {from, to, rows: [], time, rssi});
  pair.rows.push(r);
}

/** Of messages received. A message is news until the next is due three times over. */
function from_messages(record) {
  const result = [];
  for (const table of record.tables_of('inbox', 'message')) {
    const pairs = new Map();
    const [to, from] = [table.column('radio'), table.column('from')];
    const order = [...table.time.keys()].sort((a, b) => table.time[a] - table.time[b]);
    for (const r of order) grouped(pairs, from.text(r), to.text(r), r, table.time, table.column('rssi').data);
    result.push(...sorted_links(pairs, (times) => Math.max(3 * usual_interval(times), 3 * record.run.dt)));
  }
  return result;
}

/** Of the chains that observe.chain watches. */
function from_chains(record) {
  const result = [];
  for (const chain of record.run.chains ?? []) {
    const table = record.tables.find((one) => one.name === chain.table);
    if (!table) continue;
    const lasts = table.rows > 1 ? 1.5 * usual_interval(table.time) : Infinity;
    for (const link of chain.links) result.push(new Link(link.from, link.to, table.time, table.column(link.rssi).data, lasts));
  }
  return result;
}

/** Of the channel: link/*\/rssi, whose rows are numbers, joined with link/*\/ends and endpoint/*\/radio of the same time. */
function from_channel(record) {
  const [rssi] = record.tables_of('link', 'rssi'), [ends] = record.tables_of('link', 'ends');
  const [radios] = record.tables_of('endpoint', 'radio');
  if (!rssi || !ends || !radios) return [];
  const at = (time, row) => `${time}/${row}`;
  const radio = new Map(), reading = new Map();
  const row_number = (table) => table.columns[1].data;
  for (let r = 0; r < radios.rows; ++r) radio.set(at(radios.time[r], row_number(radios)[r]), radios.column('radio').text(r));
  for (let r = 0; r < rssi.rows; ++r) reading.set(at(rssi.time[r], row_number(rssi)[r]), r);
  const pairs = new Map();
  const order = [...ends.time.keys()].sort((a, b) => ends.time[a] - ends.time[b]);
  for (const e of order) {
    const t = ends.time[e], r = reading.get(at(t, row_number(ends)[e]));
    const from = radio.get(at(t, ends.column('tx').data[e])), to = radio.get(at(t, ends.column('rx').data[e]));
    if (r !== undefined && from !== undefined && to !== undefined) grouped(pairs, from, to, r, rssi.time, rssi.column('rssi').data);
  }
  return sorted_links(pairs, (times) => 1.5 * usual_interval(times) || Infinity);
}

/** [{name, links}], the most telling first. */
export function link_sources(record) {
  return [
    {name: 'the channel', links: from_channel(record)},
    {name: 'messages received', links: from_messages(record)},
    {name: 'the watched chain', links: from_chains(record)},
  ].filter((source) => source.links.length);
}

/** Lowest and highest RSSI of all sources, to whole fives of dB; null without any. */
export function rssi_range(sources) {
  let low = Infinity, high = -Infinity;
  for (const {links} of sources) {
    for (const {rssi} of links) {
      for (const value of rssi) {
        if (value < low) low = value;  // NaN is neither
        if (value > high) high = value;
      }
    }
  }
  if (low > high) return null;
  const from = 5 * Math.floor(low / 5), to = 5 * Math.ceil(high / 5);
  return [from, Math.max(to, from + 5)];
}
