// Reads a log with the packages that Foxglove reads logs with, and holds it against the CSV files of the same run.
// usage: node foreign_reader.mjs MUSTER WORLD FOLDER; exit code 77: skipped, with the reason
import {execFileSync} from 'node:child_process';
import {existsSync, mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {dirname, join} from 'node:path';

const [muster, world, folder] = process.argv.slice(2);
const packages = join(dirname(muster), 'viewer', 'npm', 'node_modules');
const needed = ['@mcap/core', 'fzstd', '@foxglove/rosmsg', '@foxglove/rosmsg2-serialization'];
const missing = needed.filter((name) => !existsSync(join(packages, name)));
if (missing.length > 0) {
  console.log(`skipped: ${packages} has no ${missing.join(', ')}; scripts/viewer installs them where the npm registry is in reach`);
  process.exit(77);
}
const require = createRequire(join(packages, 'x.js'));
const {McapIndexedReader, McapStreamReader} = require('@mcap/core');
const {decompress} = require('fzstd');
const {parse} = require('@foxglove/rosmsg');
const {MessageReader} = require('@foxglove/rosmsg2-serialization');

let failures = 0;
function expect(is_so, words) {
  if (is_so) return;
  ++failures;
  if (failures <= 20) console.error(`failed: ${words}`);
}
function expect_equal(found, wanted, words) {
  expect(Object.is(found, wanted) || found === wanted, `${words}: the log has ${found}, expected ${wanted}`);
}

rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const log = join(folder, 'run.mcap');
const outcome = JSON.parse(execFileSync(muster, ['run', world, '--out', join(folder, 'out'), '--mcap', log, '--json'], {encoding: 'utf8'}));
const bytes = readFileSync(log);
const file = {
  size: async () => BigInt(bytes.length),
  read: async (at, size) => new Uint8Array(bytes.subarray(Number(at), Number(at + size))),
};
const decompressHandlers = {zstd: (packed, size) => decompress(packed, new Uint8Array(Number(size)))};

/** Rows of a recorded table as objects of texts, by column without its unit. */
function rows_of(table) {
  const [header, ...lines] = readFileSync(join(folder, 'out', table), 'utf8').trim().split('\n').map((line) => line.split(','));
  const columns = header.map((title) => title.replace(/\[.*/, ''));
  return lines.map((cells) => Object.fromEntries(columns.map((column, i) => [column, cells[i]])));
}
const real = (cell) => cell === '' ? NaN : Number(cell);
const seconds = (time) => Number(time) / 1e9;
const key_of = (time, ...words) => [Math.round(Number(time) * 1e6), ...words].join(' ');

// By the index: counts, summary, and each message by its channel's own definition.
const reader = await McapIndexedReader.Initialize({readable: file, decompressHandlers});
expect_equal(reader.header.profile, 'ros2', 'the profile');
const definitions = new Map();
for (const schema of reader.schemasById.values())
  definitions.set(schema.id, new MessageReader(parse(new TextDecoder().decode(schema.data), {ros2: true})));
const by_topic = new Map();
const counts = new Map();
let last = 0n, total = 0n;
for await (const message of reader.readMessages()) {
  const channel = reader.channelsById.get(message.channelId);
  const value = definitions.get(channel.schemaId).readMessage(message.data);
  if (!by_topic.has(channel.topic)) by_topic.set(channel.topic, []);
  by_topic.get(channel.topic).push({time: message.logTime, value});
  counts.set(message.channelId, (counts.get(message.channelId) ?? 0n) + 1n);
  expect(message.logTime >= last, `${channel.topic}: a message of ${message.logTime} after one of ${last}`);
  last = message.logTime, ++total;
}
expect_equal(reader.statistics.messageCount, total, 'messages by the statistics');
for (const [id, count] of reader.statistics.channelMessageCounts) expect_equal(counts.get(id) ?? 0n, count, `messages of channel ${id}`);
expect_equal(reader.statistics.channelCount, reader.channelsById.size, 'channels by the statistics');
expect_equal(reader.statistics.chunkCount, reader.chunkIndexes.length, 'chunks by the statistics');
expect_equal(seconds(reader.statistics.messageEndTime), outcome.time, 'the last time');
for (const chunk of reader.chunkIndexes) {
  expect(chunk.messageEndTime - chunk.messageStartTime <= 500_000_000n, `a chunk spans ${chunk.messageEndTime - chunk.messageStartTime} ns`);
  expect(chunk.uncompressedSize <= 262_144n + 10_000n, `a chunk has ${chunk.uncompressedSize} bytes`);
}
expect(reader.chunkIndexes.length >= 24, `${reader.chunkIndexes.length} chunks of 12 s`);

// From the first byte to the last, every checksum.
const stream = new McapStreamReader({decompressHandlers, validateCrcs: true});
stream.append(new Uint8Array(bytes));
let streamed = 0n, metadata = new Map();
for (let record; (record = stream.nextRecord());) {
  if (record.type === 'Message') ++streamed;
  if (record.type === 'Metadata') metadata.set(record.name, record.metadata);
}
expect(stream.done(), 'the stream ends with the file');
expect_equal(streamed, total, 'messages of the stream');
expect_equal(metadata.get('muster.run')?.get('world'), 'logged', 'the world');
expect_equal(metadata.get('muster.outcome')?.get('digest'), outcome.digest, 'the digest');

// Named rows: a channel each, every number bit for bit.
for (const [table, columns] of [['pose', ['x', 'y', 'z', 'qw', 'qx', 'qy', 'qz']], ['command', ['v', 'w']]]) {
  const rows = rows_of(`robot_${table}.csv`);
  expect(rows.length > 300, `${table}: ${rows.length} rows`);
  for (const robot of ['east', 'north', 'rover-2']) {
    const wanted = rows.filter((row) => row.robot === robot), found = by_topic.get(`/robot/${robot}/${table}`) ?? [];
    expect_equal(found.length, wanted.length, `messages of /robot/${robot}/${table}`);
    found.forEach(({time, value}, i) => {
      expect_equal(key_of(seconds(time)), key_of(wanted[i].t), `time of message ${i} of ${robot}`);
      for (const column of columns) expect_equal(value[column], real(wanted[i][column]), `${robot} ${table} ${column} at ${wanted[i].t}`);
    });
  }
}

// Links, by the names of the radios at their ends.
const radio_of = new Map(rows_of('endpoint_radio.csv').map((row) => [key_of(row.t, row.endpoint), row.radio]));
const ends_of = new Map(rows_of('link_ends.csv').map((row) =>
  [key_of(row.t, row.link), `${radio_of.get(key_of(row.t, row.tx))} ${radio_of.get(key_of(row.t, row.rx))}`]));
const links = rows_of('link_rssi.csv');
const wanted_links = new Map(links.map((row) => [key_of(row.t, ends_of.get(key_of(row.t, row.link))), real(row.rssi)]));
expect(wanted_links.size === links.length && links.length > 3000, `${links.length} readings of links`);
let readings = 0;
for (const {time, value} of by_topic.get('/link/rssi')) {
  for (const row of value.rows) {
    ++readings;
    expect_equal(row.rssi, wanted_links.get(key_of(seconds(time), `${row.tx} ${row.rx}`)), `rssi of ${row.tx} to ${row.rx} at ${time}`);
  }
}
expect_equal(readings, links.length, 'readings of links');

// Messages of the network, each once.
const messages = rows_of('inbox_message.csv'), inbox = by_topic.get('/inbox/message') ?? [];
expect(messages.length > 50, `${messages.length} messages`);
expect_equal(inbox.length, messages.length, 'messages of /inbox/message');
inbox.forEach(({value}, i) => {
  expect_equal(value.radio, messages[i].radio, `receiver of message ${i}`);
  expect_equal(value.from, messages[i].from, `sender of message ${i}`);
  expect_equal(value.rssi, real(messages[i].rssi), `rssi of message ${i}`);
  expect_equal(Buffer.from(value.payload).toString('hex'), messages[i].payload, `payload of message ${i}`);
});

// What viewers draw by themselves.
const poses = new Map(rows_of('robot_pose.csv').map((row) => [key_of(row.t, row.robot), row]));
expect_equal(by_topic.get('/tf').length, 601, 'messages of /tf');
for (const {time, value} of by_topic.get('/tf')) {
  expect_equal(value.transforms.length, 3, 'robots of /tf');
  for (const {header, child_frame_id, transform} of value.transforms) {
    const row = poses.get(key_of(seconds(time), child_frame_id));
    expect_equal(header.frame_id, 'world', 'the frame');
    expect_equal(transform.translation.x, real(row.x), `x of ${child_frame_id}`);
    expect_equal(transform.rotation.z, real(row.qz), `qz of ${child_frame_id}`);
    expect_equal(transform.rotation.w, real(row.qw), `qw of ${child_frame_id}`);
  }
}
const markers = by_topic.get('/scene').flatMap(({value}) => value.markers);
const of_space = (space) => markers.filter((marker) => marker.ns === space);
expect_equal(of_space('robots').map((marker) => marker.header.frame_id).join(' '), 'east north rover-2', 'robots of the scene');
expect_equal(of_space('names').map((marker) => marker.text).join(' '), 'base east north rover-2', 'names of the scene');
const [wall, door] = of_space('building');
expect_equal(of_space('building').length, 2, 'walls and doors of the scene');
expect_equal([wall.pose.position.x, wall.pose.position.y, wall.scale.x].join(' '), '4 1.5 9', 'the wall');
expect_equal([door.pose.position.x, door.pose.position.y.toFixed(6), door.scale.x.toFixed(6)].join(' '), '4 -0.050000 0.900000', 'the door');
expect_equal(new Set(markers.map((marker) => marker.id)).size, markers.length, 'numbers of markers');

// What is recovered of a file that ends anywhere, and what is cut, are files as whole as the first.
async function counted(name) {
  const data = readFileSync(join(folder, name));
  const checked = new McapStreamReader({decompressHandlers, validateCrcs: true});
  checked.append(new Uint8Array(data));
  let streamed = 0n;
  for (let record; (record = checked.nextRecord());) if (record.type === 'Message') ++streamed;
  const indexed = await McapIndexedReader.Initialize({decompressHandlers, readable: {
    size: async () => BigInt(data.length),
    read: async (at, size) => new Uint8Array(data.subarray(Number(at), Number(at + size)))}});
  let read = 0n;
  for await (const message of indexed.readMessages()) ++read, expect(message.data.length > 4, `${name}: an empty message`);
  expect(checked.done() && streamed === read, `${name}: ${streamed} messages by the stream, ${read} by the index`);
  expect_equal(indexed.statistics.messageCount, read, `${name}: messages by the statistics`);
  return {read, begin: indexed.statistics.messageStartTime, end: indexed.statistics.messageEndTime};
}
const run_log = (...words) => JSON.parse(execFileSync(muster, ['log', ...words, '--json'], {encoding: 'utf8'}));
for (const share of [0.2, 0.5, 0.9, 0.999]) {
  writeFileSync(join(folder, 'torn.mcap.part'), bytes.subarray(0, Math.floor(bytes.length * share)));
  const done = run_log('recover', join(folder, 'torn.mcap.part'), '--out', join(folder, 'torn.mcap'));
  const {read} = await counted('torn.mcap');
  expect_equal(read, BigInt(done.messages), `messages recovered of ${share} of the file`);
  expect(done.damages.length === 1 && read > 0n && (share < 0.99 ? read < total : read === total), `${read} of ${total} messages recovered of ${share} of the file`);
}
const cut = run_log('cut', log, '--from', '3', '--to', '7.5', '--out', join(folder, 'cut.mcap'));
const span = await counted('cut.mcap');
expect_equal(span.read, BigInt(cut.messages), 'messages of the cut');
expect_equal(span.begin, 3_000_000_000n, 'the first time of the cut');
expect_equal(span.end, 7_480_000_000n, 'the last time of the cut');

console.log(`${total} messages on ${reader.channelsById.size} channels in ${reader.chunkIndexes.length} chunks; ${failures} failures`);
process.exit(failures > 0 ? 1 : 0);
