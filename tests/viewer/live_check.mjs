// A run that is watched as it goes: what the page shows and commands, held against the same run unwatched.
// usage: node live_check.mjs MUSTER WORLD FOLDER [CHROMIUM]; exit code 77: skipped, with the reason
import {execFileSync, spawn} from 'node:child_process';
import {existsSync, mkdirSync} from 'node:fs';
import {request} from 'node:http';
import {dirname, join, resolve} from 'node:path';
import {Browser} from './browser.mjs';

const [muster, world, folder, given] = process.argv.slice(2);
const until = '2';

function skip(reason) {
  console.log(`skipped: ${reason}`);
  process.exit(77);
}
const chromium = [given, '/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find((one) => one && existsSync(one));
if (!chromium) skip('there is no chromium; scripts/setup --browser installs it');
if (!existsSync(join(dirname(muster), 'viewer', 'page.html'))) skip('the build has no viewer/page.html; scripts/viewer makes it where the npm registry is in reach');
mkdirSync(folder, {recursive: true});

let failures = 0;
function expect(is_so, words) {
  if (is_so) return;
  ++failures;
  console.error(`failed: ${words}`);
}

/** The program with --view: {address, ended}; ended gives its exit code and what it printed. */
async function watched(...words) {
  const process_ = spawn(muster, ['run', world, '--until', until, '--json', '--view', ...words], {stdio: ['ignore', 'pipe', 'pipe']});
  let out = '', err = '';
  process_.stdout.on('data', (bytes) => { out += bytes; });
  const address = await new Promise((done, fail) => {
    process_.on('exit', (code) => fail(new Error(`muster ended with ${code}: ${err}`)));
    process_.stderr.on('data', (bytes) => {
      err += bytes;
      const found = /open (http:\S+)/.exec(err);
      if (found) done(new URL(found[1]));
    });
  });
  return {process: process_, address, ended: new Promise((done) => process_.on('close', (code) => done({code, out, err})))};
}

/** Status and text of a request. */
function asked(address, path, {method = 'GET', headers = {}} = {}) {
  return new Promise((done, fail) => {
    const one = request({host: address.hostname, port: address.port, path, method, headers}, (answer) => {
      let text = '';
      answer.on('data', (bytes) => { text += bytes; });
      answer.on('end', () => done({status: answer.statusCode, text}));
    });
    one.on('error', fail);
    one.end();
  });
}

const until_true = async (expression, words) => {
  for (let i = 0; i < 1200; ++i) {
    if (await browser.value(expression)) return;
    await new Promise((done) => setTimeout(done, 50));
  }
  throw new Error(`never: ${words}`);
};

const unwatched = JSON.parse(execFileSync(muster, ['run', world, '--until', until, '--json', '--out', join(folder, 'unwatched')], {stdio: ['ignore', 'pipe', 'ignore']}));
const browser = new Browser(chromium);

async function check_a_run() {
  const {address, ended} = await watched('--speed', '0.1');
  expect(address.hostname === '127.0.0.1', `it is served at ${address.hostname}`);
  const post = {method: 'POST', headers: {'X-Muster': '1'}};
  for (const [path, options, status] of [
    ['/state', {headers: {Host: 'evil.example'}}, 403], ['/control?paused=true', {method: 'POST'}, 405], ['/control?paused=true', {headers: {'X-Muster': '1'}}, 405],
    ['/control?speed=0', post, 400], ['/control?halt=1', post, 400], ['/etc/passwd', {}, 404], ['/state', {method: 'PUT'}, 405]]) {
    const answer = await asked(address, path, options);
    expect(answer.status === status, `${path} ${JSON.stringify(options)} gives ${answer.status}; expected ${status}`);
  }
  expect(JSON.parse((await asked(address, '/state')).text).tick === 0, 'the run has begun before its page was opened');

  await browser.open(address.href);
  const state = async () => JSON.parse((await asked(address, '/state')).text);
  await until_true('muster.live.state?.tick > 0', 'the run goes on');
  await browser.value('document.getElementById("live-pause").click()');
  await until_true('muster.live.state.paused', 'a click pauses');
  const paused = await state();
  expect(paused.tick < paused.ticks, 'the run was over before it could be paused');
  await browser.value('document.getElementById("live-step").click()');
  await until_true(`muster.live.state.tick === ${paused.tick + 1}`, 'a step is one tick');
  const stepped = await state();
  expect(stepped.tick === paused.tick + 1 && stepped.paused, `after a step of tick ${paused.tick}: ${JSON.stringify(stepped)}`);
  await until_true(`muster.live.shown === ${stepped.tick}`, 'the page shows the tick');
  const time = stepped.tick * unwatched.dt;
  const shown = await browser.value('({last: muster.record.last, clock: muster.clock.time, title: document.querySelector("h1").textContent})');
  expect(Math.abs(shown.last - time) < 1e-9 && shown.clock === shown.last, `at ${time} s the page has ${JSON.stringify(shown)}`);
  await browser.settle();
  const robots = 'muster.view.stage.scene.getObjectByName("robots").children.length';
  expect(await browser.value(robots) === await browser.value('muster.record.scene.robots.length'), 'robots are missing, or stay from before');
  expect(await browser.value('muster.view.stage.scene.children.filter(({name}) => name === "robots").length') === 1, 'what was drawn before is still there');

  await browser.value('(() => { const speed = document.getElementById("live-speed"); speed.value = 16; speed.dispatchEvent(new Event("change")); })()');
  await until_true('muster.live.state.speed === 16', 'the speed changes');
  await browser.value('document.getElementById("live-pause").click()');
  await until_true('document.documentElement.dataset.live === "over"', 'the run ends');
  const {code, out, err} = await ended;
  expect(code === 0, `muster ended with ${code}: ${err}`);
  const digest = JSON.parse(out).digest;
  expect(digest === unwatched.digest, `watched, the digest is ${digest}; unwatched ${unwatched.digest}`);
  expect(await browser.value('muster.record.run.digest') === digest, 'the page has another digest');
  expect(await browser.value('muster.clock.last') === unwatched.time, 'the slider does not reach the end');
  await browser.value('muster.clock.seek(0)');  // what was shown stays of use
  expect(await browser.value('muster.clock.time') === 0, 'the slider does not move after the end');
}

/** Every number of the watched record is that of the unwatched one. */
async function check_tables() {
  const words = `muster.record.tables.map((table) => [table.name, Array.from({length: table.rows}, (_, r) => table.columns.filter(({code}) => code.kind !== 'lists').map((column) => column.text(r)).join()).join(';')])`;
  const watched_tables = await browser.value(words);
  await browser.open(`file://${resolve(folder, 'unwatched', 'run.html')}`);
  const offline = await browser.value(words);
  expect(JSON.stringify(watched_tables) === JSON.stringify(offline), 'the watched record differs from the unwatched one');
  expect(offline.length > 0, 'nothing was recorded');
}

async function check_token() {
  const {process: process_, address, ended} = await watched('--token', 'sesame');
  expect(address.search === '?token=sesame', `the address is ${address.href}`);
  for (const path of ['/', '/state', '/record', '/?token=other']) expect((await asked(address, path)).status === 403, `${path} is given without the token`);
  expect((await asked(address, '/state?token=sesame')).status === 200, 'the token does not open the page');
  process_.kill('SIGINT');
  expect((await ended).code === 130, 'an interrupt does not end a run that waits for its page');
}

try {
  await check_a_run();
  const outside = browser.requests.filter((one) => !one.startsWith('http://127.0.0.1:'));
  expect(outside.length === 0, `the page asked for ${outside}`);
  await check_tables();
  await check_token();
  expect(browser.complaints.length === 0, `the page complained: ${browser.complaints.join('; ')}`);
} finally {
  await browser.close();
}
console.log(failures ? `${failures} failed` : 'the page shows the run as it goes');
process.exit(failures ? 1 : 0);
