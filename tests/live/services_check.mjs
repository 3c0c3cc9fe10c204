// The verbs of simulation_interfaces, by HTTP and by the websocket: what they do to a run, held against runs without them.
// usage: node services_check.mjs MUSTER WORLD FOLDER; exit code 77: skipped, with the reason
import {execFileSync} from 'node:child_process';
import {mkdirSync, rmSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {asked, connected, end, expect, expect_equal, expect_same, folder, logged, muster, needed, until, watched, world} from './watched_run.mjs';

const {parse, MessageReader, MessageWriter} = needed;
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const span = ['--until', '4'];  // 200 ticks
const unwatched = JSON.parse(execFileSync(muster, ['run', world, ...span, '--json'], {encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore']}));
const UNSUPPORTED = 0, OK = 1, NOT_FOUND = 2, OPERATION_FAILED = 4;
const STOPPED = 0, PLAYING = 1, PAUSED = 2, QUITTING = 3;

/** A service by HTTP: its answer. */
async function call(address, service, request = {}) {
  const {status, text} = await asked(address, `/simulation_interfaces/${service}`, {method: 'POST', body: JSON.stringify(request)});
  expect_equal(status, 200, `the status of ${service} (${text})`);
  return JSON.parse(text);
}
async function expect_code(address, service, request, code, words = /^/) {
  const {result} = await call(address, service, request);
  expect(result.result === code && words.test(result.error_message), `${service} ${JSON.stringify(request)} gives ${JSON.stringify(result)}; expected ${code} ${words}`);
}
const state_of = async (address) => (await call(address, 'GetSimulationState')).state.state;
const tick = async (address) => JSON.parse((await asked(address, '/state')).text).tick;
async function quit(run) {
  await expect_code(run.address, 'SetSimulationState', {state: {state: QUITTING}}, OK);
  const {code, outcome, err} = await run.ended;
  expect_equal(code, 0, `the exit code after STATE_QUITTING (${err})`);
  return outcome;
}

async function check_states() {
  const run = await watched(world, ...span, '--speed', '4'), {address} = run;
  expect_equal(await state_of(address), STOPPED, 'the state before anybody watches');
  await expect_code(address, 'StepSimulation', {steps: 1}, OPERATION_FAILED, /not paused/);
  await expect_code(address, 'SetSimulationState', {state: {state: STOPPED}}, 101);
  await expect_code(address, 'SetSimulationState', {state: {state: 4}}, UNSUPPORTED);
  await expect_code(address, 'SetSimulationState', {state: {state: PAUSED}}, OK);
  expect_equal(await tick(address), 0, 'ticks of a run that was paused at its start');
  await expect_code(address, 'SetSimulationState', {state: {state: PLAYING}}, OK);
  expect_equal(await state_of(address), PLAYING, 'the state');
  await until(async () => await tick(address) > 10, 'a playing run goes on');
  await expect_code(address, 'StepSimulation', {steps: 1}, OPERATION_FAILED, /not paused/);
  await expect_code(address, 'SetSimulationState', {state: {state: PAUSED}}, OK);
  await expect_code(address, 'SetSimulationState', {state: {state: PAUSED}}, 101);
  const paused = await tick(address);
  await expect_code(address, 'StepSimulation', {steps: 7}, OK);
  expect_equal(await tick(address), paused + 7, 'ticks after seven steps');
  await expect_code(address, 'StepSimulation', {}, OK);
  expect_equal(await tick(address), paused + 8, 'ticks after one more: the default is 1');
  expect_equal(await state_of(address), PAUSED, 'the state after steps');
  await expect_code(address, 'StepSimulation', {steps: 5000}, OPERATION_FAILED, /ticks left/);
  await expect_code(address, 'SetSimulationState', {state: {state: STOPPED}}, OK);
  expect_equal(await tick(address), 0, 'ticks of a stopped run');
  expect_equal(await state_of(address), STOPPED, 'the state of a stopped run');
  await expect_code(address, 'SetSimulationState', {state: {state: PLAYING}}, OK);
  await until(async () => await tick(address) === 200, 'the run comes to its end');
  await until(async () => await state_of(address) === PAUSED, 'a driven run waits at its end');
  await expect_code(address, 'SetSimulationState', {state: {state: PLAYING}}, 102, /at its end/);
  const outcome = await quit(run);
  expect_equal(outcome?.digest, unwatched.digest, 'the digest of a run that was stopped and played again');
}

/** Reset in the middle and at the end: each time the run of a fresh start. */
async function check_reset() {
  const file = join(folder, 'reset.mcap');
  const run = await watched(world, ...span, '--paused', '--mcap', file, '--out', join(folder, 'reset')), {address} = run;
  const client = connected(address);
  await client.ready;
  await until(() => client.by_topic.get('/scene').length === 2, 'the client has the scene');
  await expect_code(address, 'StepSimulation', {steps: 60}, OK);
  await expect_code(address, 'SetEntityState', {entity: 'east', set_pose: true, state: {pose: {position: {x: 1, y: 1}}}}, OK);
  await expect_code(address, 'StepSimulation', {steps: 60}, OK);
  await expect_code(address, 'ResetSimulation', {scope: 1}, UNSUPPORTED);
  await expect_code(address, 'ResetSimulation', {}, OK);
  expect_equal(await tick(address), 0, 'ticks after a reset');
  expect_equal(await state_of(address), PAUSED, 'the state after a reset');
  await expect_code(address, 'StepSimulation', {steps: 200}, OK);
  await expect_code(address, 'ResetSimulation', {scope: 255}, OK);
  await expect_code(address, 'StepSimulation', {steps: 200}, OK);
  const outcome = await quit(run);
  expect_equal(outcome?.digest, unwatched.digest, 'the digest after two resets');
  expect_equal(JSON.stringify(outcome?.events), JSON.stringify(unwatched.events), 'the events after two resets');
  await client.closed;
  expect_equal(client.gone.length, 0, 'channels that a reset took away');
  const log = logged(file);
  for (const [topic, messages] of log.by_topic) expect_same(client.by_topic.get(topic).slice(-messages.length), messages, `${topic} after a reset`);
}

/** Whoever waits for steps is answered where the run is made anew on the way, and the next steps are done. */
async function check_reset_of_steps() {
  const run = await watched(world, '--until', '4000', '--paused'), {address} = run;
  for (const [verb, request] of [['ResetSimulation', {}], ['SetSimulationState', {state: {state: STOPPED}}]]) {
    const steps = call(address, 'StepSimulation', {steps: 199_000});
    await until(async () => await tick(address) > 0, 'the steps are under way');
    await expect_code(address, verb, request, OK);
    if (verb !== 'ResetSimulation') await expect_code(address, 'SetSimulationState', {state: {state: PAUSED}}, OK);
    await expect_code(address, 'StepSimulation', {steps: 5}, OK);
    expect_equal(await tick(address), 5, `ticks after ${verb} and five steps`);
    const {result} = await steps;
    expect(result.result === OPERATION_FAILED && /was reset meanwhile/.test(result.error_message), `steps and ${verb} give ${JSON.stringify(result)}`);
    await expect_code(address, 'ResetSimulation', {}, OK);
  }
  await quit(run);
}

/** A pose that is set: it stands at once, the robot goes on from it, and the same calls give the same run. */
async function check_poses() {
  const outcomes = [];
  for (let i = 0; i < 2; ++i) {
    const run = await watched(world, ...span, '--paused'), {address} = run;
    await expect_code(address, 'StepSimulation', {steps: 50}, OK);
    const half = Math.SQRT1_2;
    await expect_code(address, 'SetEntityState', {entity: 'east', set_pose: true,
      state: {pose: {position: {x: 2, y: -4, z: 0}, orientation: {x: 0, y: 0, z: half, w: half}}}}, OK);
    const {state} = await call(address, 'GetEntityState', {entity: 'east'});
    expect(state.pose.position.x === 2 && state.pose.position.y === -4 && Math.abs(state.pose.orientation.z - half) < 1e-15, `the pose is ${JSON.stringify(state.pose)}`);
    expect(state.header.frame_id === 'world' && state.header.stamp.sec === 1 && state.header.stamp.nanosec === 0, `the header is ${JSON.stringify(state.header)}`);
    await expect_code(address, 'StepSimulation', {steps: 50}, OK);
    // It drives at 0.4 m/s, now northwards: 1 s later it is 0.4 m further, less what it takes to turn the velocity.
    const later = (await call(address, 'GetEntityState', {entity: 'east'})).state.pose.position;
    expect(Math.abs(later.x - 2) < 0.03 && Math.abs(later.y + 3.6) < 0.03, `a robot set to (2, -4) is at ${JSON.stringify(later)} a second later`);
    await expect_code(address, 'SetEntityState', {entity: 'north', set_twist: true, state: {twist: {linear: {x: 0.2}}}}, OK);
    expect_equal((await call(address, 'GetEntityState', {entity: 'north'})).state.twist.linear.x, 0.2, 'the twist');
    const faults = [
      [{entity: 'eats', set_pose: true}, NOT_FOUND, /did you mean \\?"east/], [{entity: 'east'}, OPERATION_FAILED, /set_pose/],
      [{entity: 'east', set_pose: true, state: {header: {frame_id: 'map'}}}, UNSUPPORTED, /frames/],
      [{entity: 'east', set_pose: true, state: {pose: {orientation: {w: 0.5}}}}, 101, /length 1/],
      [{entity: 'east', set_pose: true, state: {pose: {position: {x: 1e9}}}}, 101, /within/]];
    for (const [request, code, words] of faults) await expect_code(address, 'SetEntityState', request, code, words);
    await expect_code(address, 'StepSimulation', {steps: 100}, OK);
    outcomes.push(await quit(run));
  }
  expect_equal(outcomes[0]?.digest, outcomes[1]?.digest, 'the digest of the same calls');
  expect(outcomes[0]?.digest !== unwatched.digest, 'a pose that was set changed nothing');
  const events = outcomes[0].events.filter(({message}) => message.includes('is set to the pose'));
  expect(events.length === 1 && events[0].time === 1 && events[0].message.startsWith('robot "east" is set to the pose 2 -4 0'), `the events are ${JSON.stringify(events)}`);
}

async function check_entities() {
  const run = await watched(world, ...span, '--paused'), {address} = run;
  const {features} = await call(address, 'GetSimulatorFeatures');
  expect_equal(features.features.join(), '0,1,8,10,11,12,14,20,23,24,25,26,31,32', 'the features');
  const names = async (filters) => (await call(address, 'GetEntities', {filters})).entities.join();
  expect_equal(await names({}), 'east,north,rover-2', 'the entities');
  expect_equal(await names({filter: '^(east|rover-[0-9])$'}), 'east,rover-2', 'entities by an expression');
  expect_equal(await names({categories: [{category: 5}]}), '', 'entities of another category');
  expect_equal(await names({categories: [{category: 5}, {category: 2}]}), 'east,north,rover-2', 'robots');
  await expect_code(address, 'GetEntities', {filters: {filter: '('}}, OPERATION_FAILED, /regular expression/);
  await expect_code(address, 'GetEntities', {filters: {tags: {tags: ['x']}}}, UNSUPPORTED);
  const states = await call(address, 'GetEntitiesStates', {filters: {filter: 'north'}});
  expect(states.entities.join() === 'north' && states.states[0].pose.position.y === 2, `the states are ${JSON.stringify(states)}`);
  const {info} = await call(address, 'GetEntityInfo', {entity: 'east'});
  expect_equal(info.category.category, 2, 'the category of a robot');
  await expect_code(address, 'GetEntityInfo', {entity: 'wall'}, NOT_FOUND);
  for (const service of ['LoadWorld', 'UnloadWorld', 'SpawnEntities', 'GetNamedPoses']) await expect_code(address, service, {any: 1}, UNSUPPORTED, /./);

  const listed = await call(address, 'GetSpawnables', {sources: ['file:///models']});
  expect_equal(listed.spawnables.map(({uri}) => uri).join(), 'muster:robot/east,muster:robot/north,muster:robot/rover-2', 'what can be spawned');
  expect(listed.result.result === OK && /"file:\/\/\/models"/.test(listed.result.error_message), `a source that is not searched: ${JSON.stringify(listed.result)}`);

  // A copy of a robot with its radio: it is heard, it takes part, it leaves.
  const spawn = {name: 'guest', entity_resource: {uri: 'muster:robot/east'}, initial_pose: {pose: {position: {x: -3, y: 2}}}};
  await expect_code(address, 'StepSimulation', {steps: 20}, OK);
  expect_equal((await call(address, 'SpawnEntity', spawn)).entity_name, 'guest', 'the name of what was spawned');
  await expect_code(address, 'SpawnEntity', spawn, 101, /never reused/);
  expect_equal((await call(address, 'SpawnEntity', {...spawn, allow_renaming: true})).entity_name, 'guest_1', 'a name made unique');
  await expect_code(address, 'SpawnEntity', {...spawn, name: 'a b'}, 102);
  await expect_code(address, 'SpawnEntity', {...spawn, name: 'x', entity_resource: {uri: 'file:///rover.urdf'}}, 103, /muster:robot/);
  await expect_code(address, 'SpawnEntity', {...spawn, name: 'x', entity_resource: {}}, 104);
  await expect_code(address, 'SpawnEntity', {...spawn, name: 'x', entity_namespace: 'fleet'}, 105);
  await expect_code(address, 'SpawnEntity', {...spawn, name: 'x', initial_pose: {pose: {orientation: {w: 0}}}}, 109);
  await expect_code(address, 'StepSimulation', {steps: 20}, OK);
  const {pose} = (await call(address, 'GetEntityState', {entity: 'guest'})).state;
  expect(pose.position.x === -3 && pose.position.y === 2, `nobody commands a guest, but it is at ${JSON.stringify(pose)}`);
  await expect_code(address, 'DeleteEntity', {entity: 'guest'}, OK);
  await expect_code(address, 'DeleteEntity', {entity: 'guest'}, NOT_FOUND);
  await expect_code(address, 'DeleteEntity', {entity: 'east'}, OPERATION_FAILED, /world file/);
  await expect_code(address, 'ResetSimulation', {scope: 4}, OK);
  expect_equal(await names({}), 'east,north,rover-2', 'entities after SCOPE_SPAWNED');
  await expect_code(address, 'StepSimulation', {steps: 20}, OK);
  await expect_code(address, 'ResetSimulation', {}, OK);
  await expect_code(address, 'StepSimulation', {steps: 200}, OK);
  expect_equal((await quit(run))?.digest, unwatched.digest, 'the digest after guests and a reset');
}

/** The same services by the websocket, in JSON and in CDR by the definitions that are advertised. */
async function check_websocket() {
  const run = await watched(world, ...span, '--paused'), {address} = run;
  const client = connected(address);
  await client.ready;
  await until(() => client.services.length === 13, 'services are advertised');
  expect(client.info.capabilities.includes('services') && client.info.supportedEncodings.join() === 'cdr,json', `serverInfo is ${JSON.stringify(client.info)}`);
  let next = 1;
  const ask = (name, encoding, payload) => new Promise((done) => {
    const service = client.services.find((one) => one.name === `/simulation_interfaces/${name}`), callId = next++;
    const take = (answer) => { if (answer.callId === callId) done({...answer, service}); };
    client.client.on('serviceCallResponse', take);
    client.client.on('serviceCallFailure', take);
    client.client.sendServiceCallRequest({serviceId: service.id, callId, encoding, data: payload(service)});
  });
  const json = async (name, request) => {
    const {data} = await ask(name, 'json', () => new TextEncoder().encode(JSON.stringify(request)));
    return JSON.parse(new TextDecoder().decode(data));
  };
  const cdr = async (name, request) => {
    const answer = await ask(name, 'cdr', ({request: {schema}}) => schema ? new MessageWriter(parse(schema, {ros2: true})).writeMessage(request) : new Uint8Array([0, 1, 0, 0, 0]));
    expect_equal(answer.encoding, 'cdr', `the encoding of ${name}'s answer`);
    return new MessageReader(parse(answer.service.response.schema, {ros2: true})).readMessage(answer.data);
  };
  for (const by of [json, cdr]) {
    const before = await tick(address);
    expect_equal((await by('StepSimulation', {steps: by === cdr ? 3n : 3})).result.result, OK, `StepSimulation by ${by.name}`);
    expect_equal(await tick(address), before + 3, `ticks by ${by.name}`);
    expect_equal((await by('GetSimulationState', {})).state.state, PAUSED, `the state by ${by.name}`);
    expect_equal([...(await by('GetSimulatorFeatures', {})).features.features].join(), '0,1,8,10,11,12,14,20,23,24,25,26,31,32', `features by ${by.name}`);
    const filters = {filter: 'r', categories: [{category: 2}], tags: {tags: [], filter_mode: 0}, bounds: {type: 0, points: []}};
    const {entities, states} = await by('GetEntitiesStates', {filters});
    expect_equal(entities.join(), 'north,rover-2', `entities by ${by.name}`);
    const {state} = await call(address, 'GetEntityState', {entity: 'north'});
    expect_equal(states[0].pose.position.x, state.pose.position.x, `a pose by ${by.name}`);
    expect_equal(states[0].twist.angular.z, state.twist.angular.z, `a twist by ${by.name}`);
    expect_equal((await by('GetEntityState', {entity: 'nobody'})).result.result, NOT_FOUND, `a robot that is not, by ${by.name}`);
    expect_equal((await by('GetSpawnables', {sources: []})).spawnables[1].uri, 'muster:robot/north', `what can be spawned by ${by.name}`);
  }
  const failed = async (encoding, payload, words) => {
    const answer = await ask('StepSimulation', encoding, () => new TextEncoder().encode(payload));
    expect(answer.op === 'serviceCallFailure' && words.test(answer.message), `${encoding} ${payload} gives ${JSON.stringify(answer)}`);
  };
  await failed('xml', '<a/>', /expected cdr or json/);
  await failed('json', '{', /no JSON/);
  await failed('json', '{"stepz":1}', /did you mean \\?"steps/);
  await failed('json', '{"steps":-1}', /whole number of 64 bits/);
  await failed('json', '{"steps":"1"}', /whole number/);
  await failed('cdr', '\x00\x01\x00\x00\x01', /of which/);
  const http = async (path, options) => (await asked(address, path, options)).status;
  expect_equal(await http('/simulation_interfaces/StepSimulation'), 405, 'a service by GET');
  expect_equal(await http('/simulation_interfaces/StepSimulatio', {method: 'POST'}), 400, 'a service that is not');
  expect_equal(await http('/simulation_interfaces/StepSimulation', {method: 'POST', body: '{"steps":1.5}'}), 400, 'half a step');
  expect_equal(await http('/simulation_interfaces/StepSimulation', {method: 'POST', body: '['.repeat(400_000) + ']'.repeat(400_000)}), 400, 'a deep request');
  expect_equal(await http('/simulation_interfaces/StepSimulation', {method: 'POST', body: ' '.repeat(2_000_000)}), 413, 'a long request');
  expect_equal(await http('/simulation_interfaces/StepSimulation', {method: 'POST', headers: {Origin: 'https://evil.example'}}), 403, 'a service for another site');
  expect_equal(await tick(address), 6, 'ticks after requests that were refused');
  await quit(run);
}

/** Where a run has the boxes of its robots, what can be spawned is told with its own. */
async function check_boxes() {
  const file = join(folder, 'boxes.xml');
  writeFileSync(file, '<world name="boxes" dt="0.02" until="1"><robot name="rover" model="scarab" at="1 2 0"/><robots.geometry/></world>');
  const run = await watched(file, '--paused'), {address} = run;
  await expect_code(address, 'StepSimulation', {steps: 1}, OK);
  const [{description, spawn_bounds: {type, points: [upper, lower]}}] = (await call(address, 'GetSpawnables')).spawnables;
  expect(/model scarab/.test(description), `the description is ${description}`);
  expect_equal(type, 0, 'the kind of bounds, a box');
  // About the robot's own origin: wider than nothing, no wider than a man is tall, as broad to the left as to the right.
  expect(upper.x > 0 && upper.x < 1 && lower.x < 0 && Math.abs(upper.y + lower.y) < 1e-6, `the box is ${JSON.stringify([upper, lower])}`);
  await quit(run);
}

await check_states();
await check_reset();
await check_reset_of_steps();
await check_poses();
await check_entities();
await check_boxes();
await check_websocket();
end('the verbs do what they say');
