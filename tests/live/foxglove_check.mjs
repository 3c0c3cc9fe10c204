// A run that clients of Foxglove's protocol watch: what they are sent, held against the log of the same run.
// usage: node foxglove_check.mjs MUSTER WORLD FOLDER; exit code 77: skipped, with the reason
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {connect} from 'node:net';
import {join} from 'node:path';
import {FoxgloveClient, WebSocket, asked, connected, control, end, expect, expect_equal, expect_same, folder, logged, muster, pause, tick_of, until, watched, world} from './watched_run.mjs';

rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const digest_of = (...words) => JSON.parse(execFileSync(muster, ['run', ...words, '--json'], {encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore']})).digest;
const span = ['--until', '4'];
const unwatched = digest_of(world, ...span);

/** So many ticks further, in small parts: a client that reads has had each part before the next, however busy the machine is. */
async function stepped(address, reader, ticks) {
  for (let left = ticks; left > 0; left -= 10) {
    const end = await tick_of(address) + Math.min(left, 10);
    for (let i = 0; i < Math.min(left, 10); ++i) await control(address, 'step=1');
    await until(() => reader.times.at(-1) >= BigInt(end) * 20_000_000n, `the reader has tick ${end}`);
  }
}

/** Every message of the run, byte for byte; a client that comes late has the end of it, and the scene whole. */
async function check_messages(protocol) {
  const file = join(folder, 'run.mcap');
  const run = await watched(world, ...span, '--mcap', file, '--paused', '--speed', '4');
  const client = connected(run.address, protocol);
  await client.ready;
  expect_equal(client.socket.protocol, protocol, 'the subprotocol');
  expect_equal(client.info?.metadata?.world, 'logged', 'the world in serverInfo');
  for (const capability of ['time', 'parameters']) expect(client.info.capabilities.includes(capability), `there is no capability ${capability}`);
  await until(() => client.by_topic.get('/scene').length === 2, 'a client has the scene before the first tick');
  await stepped(run.address, client, 60);
  const late = connected(run.address, protocol);
  await late.ready;
  await until(() => late.by_topic.get('/scene').length === 2 && late.by_topic.get('/tf').length === 1, 'a late client has the present');
  await control(run.address, 'paused=false');
  const {code, err, outcome} = await run.ended;
  expect_equal(code, 0, `the end of the run (${err})`);
  expect_equal(outcome?.digest, unwatched, 'the digest of the watched run');
  expect_equal(await client.closed, 1001, 'the code of the end');
  const log = logged(file);
  expect(log.messages > 1000, `${log.messages} messages in the log`);
  expect_equal([...client.channels.keys()].sort().join(), [...log.channels.keys()].sort().join(), 'the channels');
  for (const [topic, channel] of client.channels) {
    const schema = log.schemas.get(log.channels.get(topic).schemaId);
    expect_equal(channel.encoding, 'cdr', `the encoding of ${topic}`);
    expect_equal(channel.schemaName, schema.name, `the schema of ${topic}`);
    expect_equal(channel.schemaEncoding, schema.encoding, `the schema's encoding of ${topic}`);
    expect_equal(channel.schema, new TextDecoder().decode(schema.data), `the definition of ${topic}`);
    expect_same(client.by_topic.get(topic), log.by_topic.get(topic) ?? [], topic);
    expect_same(late.by_topic.get(topic), log.by_topic.get(topic) ?? [], `${topic}, late`, {is_suffix: topic !== '/scene'});
  }
  expect(late.by_topic.get('/tf').length > 10 && late.by_topic.get('/tf').length < client.by_topic.get('/tf').length, 'the late client was not late');
  expect(client.times.every((time, i) => i === 0 || time >= client.times[i - 1]), 'time goes back');
  expect_equal(client.times.at(-1), 4_000_000_000n, 'the last time');
  expect_equal(client.statuses.length, 0, 'statuses');
}

/** 40 radios that all hear each other: a client that does not read would have to be kept 100 MB. */
function crowd() {
  const robots = Array.from({length: 40}, (_, i) => `<robot name="robot_with_a_long_name_${i}" at="${i % 8} ${i / 8 | 0} 0"/>`).join('\n');
  const text = `<world name="crowd" dt="0.02" until="12"><station name="base" at="0 0 1"/>\n${robots}
<physics.planar name="physics"/><robots.drive/><radio.multiwall tx_power="0" l0="40" n="1.8"/>
<record table="link/*/rssi"/><record table="robot/*/pose"/></world>`;
  mkdirSync(join(folder, 'crowd'), {recursive: true});
  writeFileSync(join(folder, 'crowd', 'world.xml'), text);
  return join(folder, 'crowd');
}

/** It neither holds the run up nor makes it grow; what it missed is counted to the last frame. */
async function check_slow_client() {
  const file = join(folder, 'crowd.mcap'), place = crowd();
  const plain = digest_of(place);
  const run = await watched(place, '--mcap', file, '--paused', '--speed', '1000');
  const slow = connected(run.address), fast = connected(run.address);
  await Promise.all([slow.ready, fast.ready]);
  await until(() => slow.by_topic.get('/link/rssi').length === 1 && fast.by_topic.get('/link/rssi').length === 1, 'both have the first tick');
  const kilobytes = () => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${run.process.pid}/status`, 'utf8'))[1]);
  slow.socket._socket.pause();  // before the run goes on: it may be at its end before a word of ours is heard
  await stepped(run.address, fast, 20);
  const before = kilobytes();
  await stepped(run.address, fast, 560);  // not held up by the one that does not read
  const grown = kilobytes() - before;
  expect(grown < 48_000, `the program grew by ${grown} kB`);
  slow.socket._socket.resume();
  await until(() => slow.statuses.some(({message}) => /left out/.test(message)), 'the client is told what it missed');
  await control(run.address, 'paused=false');
  const {outcome} = await run.ended;
  expect_equal(outcome?.digest, plain, 'the digest');
  await Promise.all([slow.closed, fast.closed]);
  const log = logged(file);
  const bytes = [...log.by_topic.values()].flat().reduce((sum, {data}) => sum + data.length, 0);
  expect(bytes > 60_000_000, `the log has ${bytes} bytes`);
  for (const topic of log.by_topic.keys()) expect_same(fast.by_topic.get(topic), log.by_topic.get(topic), `${topic} of the fast client`);
  expect_equal(fast.statuses.length, 0, 'statuses of the fast client');
  const missed = slow.statuses.reduce((sum, {message}) => sum + Number(/^(\d+) messages were left out/.exec(message)[1]), 0);
  expect(missed > 0 && slow.statuses.every(({level}) => level === 1), `statuses of the slow client: ${JSON.stringify(slow.statuses)}`);
  expect_equal(slow.frames + missed, fast.frames, 'frames read and missed by the slow client');
}

/** What is no request is answered or refused; the run goes on. */
async function check_malformed() {
  const run = await watched(world, ...span, '--paused', '--speed', '1000');
  const client = connected(run.address);
  await client.ready;
  await until(() => client.by_topic.get('/scene').length === 2, 'the client has the scene');
  const said = async (message, wanted, level = 2) => {
    const before = client.statuses.length;
    client.socket.send(message);
    await until(() => client.statuses.length > before, `an answer to ${message}`);
    const status = client.statuses.at(-1);
    expect(wanted.test(status.message) && status.level === level, `${message} gives ${JSON.stringify(status)}; expected ${wanted}`);
  };
  const scene = client.channels.get('/scene').id;
  await said('{', /no JSON/);
  await said('['.repeat(400_000) + ']'.repeat(400_000), /no JSON/);
  await said('[1]', /without "op"/);
  await said('{"op":7}', /without "op"/);
  await said('{"op":"subscribr"}', /did you mean \\?"subscribe/);
  await said('{"op":"subscribe"}', /expected a list "subscriptions"/);
  await said('{"op":"subscribe","subscriptions":[{"id":900,"channelId":9999}]}', /no such channel/);
  await said('{"op":"subscribe","subscriptions":[{"id":-1,"channelId":0}]}', /expected numbers/);
  await said(`{"op":"subscribe","subscriptions":[{"id":900,"channelId":${scene}}]}`, /subscribed to already/);
  await said(`{"op":"subscribe","subscriptions":[{"id":0,"channelId":${scene}}]}`, /the id is in use/);
  await said('{"op":"unsubscribe","subscriptionIds":[900]}', /no subscription 900/, 1);
  await said('{"op":"advertise","channels":[]}', /clientPublish/);
  await said('{"op":"fetchAsset","uri":"file:///etc/passwd","requestId":1}', /assets/);
  await said('{"op":"getParameters","parameterNames":["radio.multiwall/tx_powr"]}', /did you mean \\?"radio.multiwall\/tx_power/, 1);
  await said('{"op":"setParameters","parameters":[{"name":"radio.multiwall/n","value":-5}]}', /out of bounds/);
  await said('{"op":"setParameters","parameters":[{"name":"radio.multiwall/n","value":"x"}]}', /a number/);
  await said(Buffer.from([]), /without a byte/);
  await said(Buffer.from([9, 1]), /unknown opcode 9/);
  await said(Buffer.from([1, 0, 0, 0, 0]), /clientPublish/);
  await said(Buffer.from([2, 0, 0]), /of which 2 are left/);

  const ends = async (bytes, code, words) => {
    const other = connected(run.address);
    await other.ready;
    if (typeof bytes === 'string') other.socket.send(bytes);
    else other.socket._socket.write(bytes);
    const got = await other.closed;
    expect([code].flat().includes(got), `${words} ${got}; expected ${code}`);
  };
  await ends(Buffer.from([0x81, 0x02, 0x7b, 0x7d]), 1002, 'a frame without a mask ends with');
  await ends(Buffer.from([0xf1, 0x80, 0, 0, 0, 0]), 1002, 'a frame with reserved bits ends with');
  await ends(Buffer.from([0x81, 0x82, 0, 0, 0, 0, 0xc3, 0x28]), 1007, 'text that is no UTF-8 ends with');
  // A client that is still sending may meet the closed connection before it reads the code.
  await ends('x'.repeat(2_000_000), [1009, 1006], 'a message of 2 MB ends with');
  const garbage = connect(Number(run.address.port), run.address.hostname);
  garbage.end('\x00\x01\x02 nonsense\r\n\r\n');
  const answer = await new Promise((done) => { let text = ''; garbage.on('data', (data) => { text += data; }); garbage.on('close', () => done(text)); });
  expect(/^HTTP\/1.1 400 /.test(answer), `what is no HTTP gives ${answer}`);

  // Parameters: asked for, and set; then the run is another one.
  const parameter = () => new Promise((done) => {
    client.client.on('parameterValues', function take({parameters, id}) { if (id === 'mine') done(parameters); });
    client.socket.send('{"op":"getParameters","parameterNames":["radio.multiwall/n"],"id":"mine"}');
  });
  expect_equal(JSON.stringify(await parameter()), '[{"name":"radio.multiwall/n","value":1.8,"type":"float64"}]', 'a parameter');
  await control(run.address, 'paused=false');
  const {outcome} = await run.ended;
  expect_equal(outcome?.digest, unwatched, 'the digest after malformed requests');
}

/** The status with which a websocket is refused; 101 if it is not. */
function upgraded(address, {headers = {}, protocols = [FoxgloveClient.SUPPORTED_SUBPROTOCOL]} = {}) {
  return new Promise((done) => {
    const socket = new WebSocket(address.href, protocols, {headers});
    socket.on('unexpected-response', (_, answer) => { done(answer.statusCode); answer.resume(); });
    socket.on('error', () => {});
    socket.on('open', () => { done(101); socket.close(); });
  });
}

async function check_refusals() {
  const run = await watched(world, ...span, '--origin', 'https://site.example', '--paused');
  expect_equal(run.address.hostname, '127.0.0.1', 'the address');
  const own = `http://127.0.0.1:${run.address.port}`;
  for (const [options, status] of [[{}, 101], [{headers: {Origin: own}}, 101], [{headers: {Origin: 'https://site.example'}}, 101],
    [{headers: {Origin: 'https://evil.example'}}, 403], [{headers: {Origin: 'null'}}, 403], [{headers: {Host: 'evil.example'}}, 403],
    [{protocols: ['chat']}, 400], [{protocols: []}, 400], [{protocols: ['chat', 'foxglove.sdk.v1']}, 101]])
    expect_equal(await upgraded(run.address, options), status, `a websocket with ${JSON.stringify(options)}`);
  expect_equal((await asked(run.address, '/state', {headers: {Origin: 'https://evil.example'}})).status, 403, 'a request of another site');
  run.process.kill('SIGINT');
  const {code, err} = await run.ended;
  expect_equal(code, 130, 'the exit code of an interrupt');
  expect(err.includes('a page of "https://evil.example" was refused'), `nothing is said of a refused page: ${err}`);

  const secret = await watched(world, ...span, '--token', 'sesame', '--paused');
  expect_equal(secret.address.search, '?token=sesame', 'the address with a token');
  for (const [query, status] of [['?token=sesame', 101], ['', 403], ['?token=other', 403], ['?token=', 403]])
    expect_equal(await upgraded(new URL(query, secret.address.origin.replace('null', `ws://${secret.address.host}`) + '/')), status, `a websocket at /${query}`);
  secret.process.kill('SIGINT');
  await secret.ended;
}

await check_messages('foxglove.websocket.v1');
await check_messages('foxglove.sdk.v1');
await check_slow_client();
await check_malformed();
await check_refusals();
await pause(0);
end('clients are sent what the log has');
