// What the checks of a watched run share: the program with --view, requests, clients by the packages that Foxglove uses,
// and the log of the same run.
import {spawn} from 'node:child_process';
import {existsSync, readFileSync} from 'node:fs';
import {request} from 'node:http';
import {createRequire} from 'node:module';
import {dirname, join} from 'node:path';

export const [muster, world, folder] = process.argv.slice(2);
const packages = join(dirname(muster), 'viewer', 'npm', 'node_modules');
const missing = ['@foxglove/ws-protocol', 'ws', '@mcap/core', 'fzstd', '@foxglove/rosmsg', '@foxglove/rosmsg2-serialization'].filter((name) => !existsSync(join(packages, name)));
if (missing.length > 0) {
  console.log(`skipped: ${packages} has no ${missing.join(', ')}; scripts/viewer installs them where the npm registry is in reach`);
  process.exit(77);
}
const require = createRequire(join(packages, 'x.js'));
export const {FoxgloveClient} = require('@foxglove/ws-protocol');
export const WebSocket = require('ws');
const {McapStreamReader} = require('@mcap/core');
const {decompress} = require('fzstd');
export const needed = {...require('@foxglove/rosmsg'), ...require('@foxglove/rosmsg2-serialization')};

let failures = 0;
export function expect(is_so, words) {
  if (is_so) return;
  ++failures;
  if (failures <= 20) console.error(`failed: ${words}`);
}
export function expect_equal(found, wanted, words) {
  expect(Object.is(found, wanted), `${words}: ${found}; expected ${wanted}`);
}
export function end(words) {
  console.log(failures ? `${failures} failed` : words);
  process.exit(failures ? 1 : 0);
}
export const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));
export async function until(holds, words) {
  for (let i = 0; i < 3000; ++i) {
    if (await holds()) return;
    await pause(10);
  }
  throw new Error(`never: ${words}`);
}

/** The program with --view: {process, address, ended}; ended gives its exit code and what it printed. */
export async function watched(...words) {
  const child = spawn(muster, ['run', ...words, '--json', '--view'], {stdio: ['ignore', 'pipe', 'pipe']});
  let out = '', err = '';
  child.stdout.on('data', (bytes) => { out += bytes; });
  const ended = new Promise((done) => child.on('close', (code) => done({code, out, err, outcome: code === 0 ? JSON.parse(out) : null})));
  const address = await new Promise((done, fail) => {
    child.on('exit', (code) => fail(new Error(`muster ended with ${code}: ${err}`)));
    child.stderr.on('data', (bytes) => {
      err += bytes;
      const found = / (ws:\S+) in Foxglove/.exec(err);
      if (found) done(new URL(found[1]));
    });
  });
  return {process: child, address, ended};
}

/** Status and text of a request. */
export function asked(address, path, {method = 'GET', headers = {}, body = ''} = {}) {
  return new Promise((done, fail) => {
    const one = request({host: address.hostname, port: address.port, path, method, headers}, (answer) => {
      let text = '';
      answer.on('data', (bytes) => { text += bytes; });
      answer.on('end', () => done({status: answer.statusCode, text}));
    });
    one.on('error', fail);
    one.end(body);
  });
}
export const control = (address, words) => asked(address, `/control?${words}`, {method: 'POST', headers: {'X-Muster': '1'}});
export const tick_of = async (address) => JSON.parse((await asked(address, '/state')).text).tick;

/** A client that subscribes to all channels: what it was sent, by topic. */
export function connected(address, protocol = FoxgloveClient.SUPPORTED_SUBPROTOCOL) {
  const socket = new WebSocket(address.href, [protocol]);
  const client = new FoxgloveClient({ws: socket});
  const seen = {socket, client, channels: new Map(), by_topic: new Map(), times: [], statuses: [], gone: [], services: [], info: null, frames: 0};
  const topics = new Map();
  client.on('error', (error) => seen.statuses.push({level: 2, message: String(error)}));
  client.on('serverInfo', (info) => { seen.info = info; });
  client.on('status', (status) => seen.statuses.push(status));
  client.on('time', ({timestamp}) => { ++seen.frames; seen.times.push(timestamp); });
  client.on('advertiseServices', (services) => seen.services.push(...services));
  client.on('unadvertise', (channels) => seen.gone.push(...channels));
  client.on('advertise', (channels) => {
    for (const channel of channels) {
      seen.channels.set(channel.topic, channel);
      if (!seen.by_topic.has(channel.topic)) seen.by_topic.set(channel.topic, []);
      topics.set(client.subscribe(channel.id), channel.topic);
    }
  });
  client.on('message', ({subscriptionId, timestamp, data}) => {
    ++seen.frames;
    seen.by_topic.get(topics.get(subscriptionId)).push({time: timestamp, data: Buffer.from(data.buffer, data.byteOffset, data.byteLength)});
  });
  seen.ready = new Promise((done, fail) => { client.on('advertise', done); client.on('close', () => fail(new Error('the connection was closed'))); });
  seen.ready.catch(() => {});
  seen.closed = new Promise((done) => client.on('close', (event) => done(event.code)));
  return seen;
}

/** A log's channels and messages, by topic. */
export function logged(file) {
  const reader = new McapStreamReader({decompressHandlers: {zstd: (packed, size) => decompress(packed, new Uint8Array(Number(size)))}});
  reader.append(new Uint8Array(readFileSync(file)));
  const schemas = new Map(), channels = new Map(), by_topic = new Map();
  let messages = 0;
  for (let record; (record = reader.nextRecord());) {
    if (record.type === 'Schema') schemas.set(record.id, record);
    if (record.type === 'Channel') channels.set(record.id, record);
    if (record.type !== 'Message') continue;
    const {topic} = channels.get(record.channelId);
    if (!by_topic.has(topic)) by_topic.set(topic, []);
    by_topic.get(topic).push({time: record.logTime, data: Buffer.from(record.data)});
    ++messages;
  }
  return {schemas, channels: new Map([...channels.values()].map((channel) => [channel.topic, channel])), by_topic, messages};
}

/** Both lists are the same, or the first is the end of the second. */
export function expect_same(found, wanted, words, {is_suffix = false} = {}) {
  if (is_suffix) wanted = wanted.slice(Math.max(0, wanted.length - found.length));
  expect_equal(found.length, wanted.length, `messages of ${words}`);
  found.forEach((one, i) => {
    if (!wanted[i]) return;
    expect(one.time === wanted[i].time, `${words}: message ${i} is of ${one.time}; expected ${wanted[i].time}`);
    expect(one.data.equals(wanted[i].data), `${words}: message ${i}, of ${one.time}, has other bytes`);
  });
}
