// Holds what a browser shows of a run against the run's record: the tables are read here from their CSV, not from the page.
// usage: node page_check.mjs MUSTER WORLD FOLDER [CHROMIUM]; exit code 77: skipped, with the reason
import {execFileSync} from 'node:child_process';
import {cpSync, existsSync, mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {dirname, join, resolve} from 'node:path';
import {inflateSync} from 'node:zlib';
import {Browser} from './browser.mjs';

const [muster, world, folder, given] = process.argv.slice(2);
const most_bytes = 3e6;

function skip(reason) {
  console.log(`skipped: ${reason}`);
  process.exit(77);
}

const chromium = [given, '/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find((one) => one && existsSync(one));
if (!chromium) skip('there is no chromium; scripts/setup --browser installs it');
if (!existsSync(join(dirname(muster), 'viewer', 'page.html'))) skip('the build has no viewer/page.html; scripts/viewer makes it where the npm registry is in reach');

let failures = 0;
function expect(is_so, words) {
  if (is_so) return;
  ++failures;
  console.error(`failed: ${words}`);
}
function expect_near(found, wanted, slack, words) {
  const fits = found === wanted || Math.abs(found - wanted) <= slack || (Number.isNaN(found) && Number.isNaN(wanted));
  expect(fits, `${words}: the page has ${found}, the record ${wanted}`);
}

/** Rows of a recorded table as objects; numbers where the cell is one. */
function rows_of(file) {
  const [header, ...lines] = readFileSync(join(folder, file), 'utf8').trim().split('\n').map((line) => line.split(','));
  const columns = header.map((title) => title.replace(/\[.*/, ''));
  return lines.map((cells) => Object.fromEntries(columns.map((column, i) => [column, cells[i]])));
}
const real = (cell) => cell === '' ? NaN : cell === 'inf' ? Infinity : cell === '-inf' ? -Infinity : Number(cell);

/** How many colours a part of a screenshot has, and its bytes; the picture is read as PNG without interlace. */
function pixels_of(png, box) {
  const width = png.readUInt32BE(16), channels = png[25] === 6 ? 4 : 3, parts = [];
  for (let at = 8; at < png.length;) {
    const size = png.readUInt32BE(at);
    if (png.toString('latin1', at + 4, at + 8) === 'IDAT') parts.push(png.subarray(at + 8, at + 8 + size));
    at += 12 + size;
  }
  const raw = inflateSync(Buffer.concat(parts)), stride = width * channels, rows = [];
  for (let y = 0, before = Buffer.alloc(stride); y < raw.length / (stride + 1); ++y) {
    const filter = raw[y * (stride + 1)], row = Buffer.from(raw.subarray(y * (stride + 1) + 1, (y + 1) * (stride + 1)));
    for (let i = 0; i < stride; ++i) {
      const a = i >= channels ? row[i - channels] : 0, b = before[i], c = i >= channels ? before[i - channels] : 0;
      const p = a + b - c, [da, db, dc] = [Math.abs(p - a), Math.abs(p - b), Math.abs(p - c)];
      row[i] += [0, a, b, (a + b) >> 1, da <= db && da <= dc ? a : db <= dc ? b : c][filter];
    }
    rows.push(before = row);
  }
  const inside = rows.slice(Math.round(box.y), Math.round(box.y + box.height)).map((row) => row.subarray(Math.round(box.x) * channels, Math.round(box.x + box.width) * channels));
  const colours = new Set();
  for (const row of inside) for (let i = 0; i + 2 < row.length; i += channels) colours.add(row.readUIntBE(i, 3));
  return {colours: colours.size, bytes: Buffer.concat(inside)};
}

rmSync(folder, {recursive: true, force: true});
mkdirSync(dirname(folder), {recursive: true});
execFileSync(muster, ['run', world, '--out', folder], {stdio: ['ignore', 'ignore', 'inherit']});
const page = resolve(folder, 'run.html');
const html = readFileSync(page, 'utf8');
const run = JSON.parse(readFileSync(join(folder, 'run.json'), 'utf8'));
expect(html.length < most_bytes, `the page has ${html.length} bytes; expected less than ${most_bytes}`);

const browser = new Browser(chromium);
const address = `file://${page}`;
const box_of = (selector) => browser.value(`(({x, y, width, height}) => ({x, y, width, height}))(document.querySelector(${JSON.stringify(selector)}).getBoundingClientRect())`);
const seek = (time) => browser.value(`muster.clock.seek(${time})`).then(() => browser.settle());

async function check_scene() {
  const {scene} = run;
  const shown = await browser.value(`(() => {
    const {view} = muster, find = (name) => view.stage.scene.getObjectByName(name);
    return {robots: find('robots').children.length, walls: find('walls').userData.walls, boxes: find('walls').count, stations: find('stations').children.length,
      doors: find('building').children.filter(({name}) => name.startsWith('door ')).length, meshes: find('building').children.filter(({name}) => name.startsWith('mesh ')).length,
      floors: find('building').children.filter(({name}) => name.startsWith('floor ')).length, parts: view.robots.list.map(({body}) => body.userData.parts),
      names: [...document.querySelectorAll('.name:not([hidden])')].map((element) => element.textContent), words: document.getElementById('canvas').getAttribute('aria-label')};
  })()`);
  expect(shown.robots === scene.robots.length, `${shown.robots} robots are shown of ${scene.robots.length}`);
  expect(shown.walls === scene.walls.length && shown.boxes >= shown.walls, `${shown.walls} walls are shown of ${scene.walls.length}`);
  for (const kind of ['doors', 'meshes', 'floors']) expect(shown[kind] === scene[kind].length, `${shown[kind]} ${kind} are shown of ${scene[kind].length}`);
  const stations = scene.radios.filter(({robot}) => !robot).map(({name}) => name);
  expect(shown.stations === stations.length, `${shown.stations} stations are shown of ${stations.length}`);
  const names = [...scene.robots.map(({name}) => name), ...stations].sort();
  expect(JSON.stringify(shown.names.sort()) === JSON.stringify(names), `the names ${shown.names} are shown; expected ${names}`);
  scene.robots.forEach(({name, model}, i) => {
    const parts = scene.models.find((one) => one.name === model).parts.length;
    expect(shown.parts[i] === parts, `${name} has ${shown.parts[i]} parts; expected ${parts}`);
  });
  expect(shown.words.includes(`${scene.robots.length} of ${scene.robots.length} robots`), `the scene is described as "${shown.words}"`);
}

/** The whole scene is in view, and no two names or figures lie on each other. */
async function check_framing() {
  for (const button of ['top', 'fit']) {
    await browser.value(`document.getElementById('${button}').click()`);
    await browser.settle();
    const {corners, width, height} = await browser.value(`(({box, width, height, camera}) => ({width, height, corners: [0, 1, 2, 3, 4, 5, 6, 7].map((i) => {
      const place = box.min.clone().set(...['x', 'y', 'z'].map((axis, a) => (i >> a & 1 ? box.max : box.min)[axis])).project(camera);
      return [place.x, place.y];
    })}))(muster.view.stage)`);
    const span = [0, 1].map((axis) => Math.max(...corners.map((corner) => Math.abs(corner[axis]))));
    expect(Math.max(...span) <= 1, `after "${button}" the scene reaches beyond the view: ${span}`);
    expect(Math.max(...span) > 0.6, `after "${button}" the scene takes ${span} of a view of ${width} x ${height}`);
  }
  await seek(run.run.time);
  const texts = await browser.value(`[...document.querySelectorAll('.name:not([hidden]), .level:not([hidden])')].map((one) => [one.textContent, one.getBoundingClientRect().toJSON()])`);
  texts.forEach(([text, a], i) => texts.slice(0, i).forEach(([other, b]) =>
    expect(a.left >= b.right - 1 || b.left >= a.right - 1 || a.top >= b.bottom - 1 || b.top >= a.bottom - 1, `"${text}" and "${other}" lie on each other`)));
}

/** Every number of every table, as the page has unpacked it. */
async function check_tables() {
  for (const {table, file, columns} of run.tables) {
    const blobs = new Set(columns.split(' ').filter((word) => word.endsWith('{}')).map((word) => word.slice(0, -2)));
    const record = rows_of(file);
    const shown = await browser.value(`(() => {
      const table = muster.record.tables.find(({name}) => name === ${JSON.stringify(table)});
      return {every: table.kept_every, columns: table.columns.map((column) => ({name: column.name, kind: column.code.kind, cells: column.code.kind === 'lists' ? [] : Array.from({length: table.rows}, (_, r) => column.text(r))}))};
    })()`);
    expect(shown.every === 1 && shown.columns[0].cells.length === record.length, `${table}: ${shown.columns[0].cells.length} rows are in the page, ${record.length} in the record`);
    const key = (row) => shown.columns.filter(({name}) => !blobs.has(name)).map(({name}) => row[name]);
    const of_page = shown.columns[0].cells.map((_, r) => key(Object.fromEntries(shown.columns.map(({name, cells}) => [name, cells[r]]))));
    const plain = (cell) => cell === '' ? 'NaN' : Number.isNaN(Number(cell)) || cell === 'Infinity' ? cell.replace('Infinity', 'inf') : String(Number(cell));
    const sorted = (rows) => rows.map((row) => row.map((cell) => plain(cell ?? '')).join(',')).sort();
    const [a, b] = [sorted(of_page), sorted(record.map(key))];
    const wrong = a.findIndex((row, i) => row !== b[i]);
    expect(wrong < 0, `${table}: the page has ${a[wrong]}, the record ${b[wrong]}`);
  }
}

async function check_scans() {
  if (!run.tables.some(({table}) => table === 'scan/*/message')) return;
  const record = rows_of('scan_message.csv');
  const shown = await browser.value(`(() => {
    const table = muster.record.scans, {starts, values} = table.column('ranges').data;
    return {first: Array.from(values.subarray(starts[0], starts[1]), String), robot: table.column('robot').text(0), t: table.time[0]};
  })()`);
  const row = record.find(({t, robot}) => Number(t) === shown.t && robot === shown.robot);
  const bytes = Buffer.from(row.ranges, 'hex');
  const ranges = Array.from({length: bytes.length / 8}, (_, i) => String(bytes.readDoubleLE(8 * i)));
  expect(JSON.stringify(shown.first) === JSON.stringify(ranges), 'the first scan differs from the record');
}

async function check_time() {
  const poses = rows_of('robot_pose.csv');
  const times = [...new Set(poses.map(({t}) => t))];
  for (const t of [times[0], times[Math.floor(times.length / 3)], times.at(-1)]) {
    await seek(t);
    const shown = await browser.value(`muster.view.robots.list.map(({name, group}) => ({name, at: group.position.toArray(), turn: group.quaternion.toArray()}))`);
    for (const {name, at, turn} of shown) {
      const row = poses.find((one) => one.t === t && one.robot === name);
      ['x', 'y', 'z'].forEach((axis, i) => expect_near(at[i], real(row[axis]), 0, `${name}'s ${axis} at ${t} s`));
      ['qx', 'qy', 'qz', 'qw'].forEach((axis, i) => expect_near(turn[i], real(row[axis]), 0, `${name}'s ${axis} at ${t} s`));
    }
    const share = (Number(t) - 0) / run.run.time;
    const lines = await browser.value(`[...document.querySelectorAll('.plot')].map((plot) => { const over = plot.querySelector('.u-over').getBoundingClientRect(), now = plot.querySelector('.now').getBoundingClientRect(); return (now.x + 1 - over.x) / over.width; })`);
    expect(lines.length > 0, 'there is no plot');
    lines.forEach((line, i) => expect_near(line, share, 0.005, `the line of time in plot ${i + 1} at ${t} s`));
    expect(Number(await browser.value('document.getElementById("time").value')) === Number(t), `the slider does not stand at ${t} s`);
  }
}

async function check_plots() {
  const t = run.run.time / 2;
  await seek(t);
  await browser.value(`void muster.add_plot(muster.measures.find(({id}) => id === 'robot/*/pose|x'))`);
  await browser.settle();
  const {drawn, labels, written} = await browser.value(`(() => {
    const {chart, series, element} = muster.plots.at(-1);
    return {drawn: chart.data, labels: series.map(({label}) => label), written: [...element.querySelectorAll('.values b')].map((one) => one.textContent.replace('\\u2212', '-'))};
  })()`);
  const poses = rows_of('robot_pose.csv');
  labels.forEach((name, i) => {
    const own = poses.filter(({robot}) => robot === name);
    expect(own.length === drawn[0].length, `${name}: ${drawn[0].length} points are plotted of ${own.length}`);
    own.forEach((row, r) => { if (drawn[0][r] !== real(row.t) || drawn[i + 1][r] !== real(row.x)) expect(false, `${name} is plotted at ${drawn[0][r]} s with ${drawn[i + 1][r]}, recorded at ${row.t} s with ${row.x}`); });
    const now = own.filter((row) => Number(row.t) <= t).at(-1);
    expect_near(Number(written[i]), real(now.x), 5e-5 * Math.abs(real(now.x)), `${name}'s value below the plot`);
  });
  await browser.value(`muster.plots.at(-1).element.scrollIntoView({block: 'center'})`);
  await browser.settle();
  const over = await browser.value(`(({x, y, width, height}) => ({x, y, width, height}))(muster.plots.at(-1).chart.over.getBoundingClientRect())`);
  await browser.click(over.x + 0.25 * over.width, over.y + over.height / 2);
  expect_near(await browser.value('muster.clock.time'), 0.25 * run.run.time, 0.01 * run.run.time, 'the time after a click into a plot');
}

async function check_keys_and_events() {
  await seek(2);
  await browser.value('document.getElementById("canvas").focus()');
  await browser.press('ArrowRight');
  expect_near(await browser.value('muster.clock.time'), 3, 1e-9, 'the time after the right arrow');
  await browser.press('Home');
  await browser.press(' ', 'Space', ' ');
  await new Promise((done) => setTimeout(done, 400));
  expect(await browser.value('muster.clock.is_playing && muster.clock.time > 0'), 'the space bar does not play');
  await browser.press(' ', 'Space', ' ');
  const ticks = await browser.value('document.querySelectorAll("#ticks i").length');
  expect(ticks === run.run.events.length, `${ticks} events are marked of ${run.run.events.length}`);
  if (!ticks) return;
  await browser.value('document.querySelector("#event-list button").click()');
  expect_near(await browser.value('muster.clock.time'), run.run.events[0].time, 0, 'the time after a click on the first event');
}

/** The scene is drawn, and changes with time. */
async function check_picture() {
  const canvas = await box_of('#canvas');
  await seek(0);
  const begin = pixels_of(await browser.picture(), canvas);
  await seek(run.run.time);
  const end = pixels_of(await browser.picture(), canvas);
  expect(begin.colours > 200, `the scene has ${begin.colours} colours`);
  expect(!begin.bytes.equals(end.bytes), 'the scene looks the same at the start and at the end');
}

/** Where the sun is high in the south, a wall's shadow lies north of it; fog weakens what is seen by exp(-extinction x distance). */
async function check_light() {
  const canvas = await box_of('#canvas');
  const choose = async (name, change) => {
    await browser.value(`(() => { const one = document.querySelector('[data-name="${name}"]'); ${change}; one.dispatchEvent(new Event('change')); })()`);
    await browser.settle();
  };
  const colour_at = (picture, {x, y}) => [...pixels_of(picture, {x: Math.round(canvas.x + x), y: Math.round(canvas.y + y), width: 1, height: 1}).bytes.subarray(0, 3)];
  await seek(0);
  await browser.value('document.getElementById("top").click()');
  await browser.settle();
  const beside = await browser.value(`muster.record.scene.walls.map((wall) => {
    const {stage} = muster.view, sun = stage.light.sun.position.clone().sub(stage.light.sun.target.position), way = 0.5 * wall.height / sun.z;
    return [-1, 1].map((side) => stage.on_screen(stage.controls.target.clone().set((wall.from[0] + wall.to[0]) / 2 + side * way * sun.x, (wall.from[1] + wall.to[1]) / 2 + side * way * sun.y, 0)));
  })`);
  const shaded = await browser.picture();
  await choose('Shadows', 'one.checked = false');
  const bright = await browser.picture();
  await choose('Shadows', 'one.checked = true');
  const darker = (place) => colour_at(bright, place)[1] - colour_at(shaded, place)[1];
  expect(beside.some(([away, near]) => darker(away) > 15 && Math.abs(darker(near)) < 3), `no wall has its shadow on the side away from the sun alone: ${JSON.stringify(beside.map((two) => two.map(darker)))}`);
  const [with_them, without] = [shaded, bright].map((picture) => pixels_of(picture, canvas).bytes);
  expect(with_them.every((value, i) => value <= without[i] + 3), 'a shadow makes something brighter');

  await browser.value('(() => { const follow = document.getElementById("follow"); follow.value = follow.options[1].value; follow.dispatchEvent(new Event("change")); })()');
  await browser.settle();
  const middle = {x: canvas.width / 2, y: canvas.height / 2}, extinction_by_distance = 0.5;
  const clear = colour_at(await browser.picture(), middle);
  await browser.value(`(() => { const {stage} = muster.view; stage.light.set_visibility(3.9 / ${extinction_by_distance} * stage.camera.position.distanceTo(stage.controls.target)); stage.invalidate(); })()`);
  await browser.settle();
  const veiled = colour_at(await browser.picture(), middle);
  const ground = [0xf6, 0xf7, 0xf9];  // of the light theme
  const sum = (way) => way.reduce((all, value) => all + Math.abs(value), 0);
  const left = sum(veiled.map((value, i) => value - ground[i])) / sum(clear.map((value, i) => value - ground[i]));
  expect(sum(clear.map((value, i) => value - ground[i])) > 100, `a followed robot is hardly seen: ${clear}`);
  expect_near(left, Math.exp(-extinction_by_distance), 0.08, 'the contrast that fog leaves of a robot');
  await choose('Fog', 'one.value = "0"');
  await browser.value('document.getElementById("fit").click()');
}

const line_of_time = `(() => { const over = document.querySelector('.u-over').getBoundingClientRect(), now = document.querySelector('.now').getBoundingClientRect(); return (now.x + 1 - over.x) / over.width; })()`;

async function check_link_to_a_time() {
  await browser.open(`${address}#t=3`);
  expect_near(await browser.value('muster.clock.time'), 3, 0, 'the time of a page opened at #t=3');
  expect_near(await browser.value(line_of_time), 3 / run.run.time, 0.01, 'the line of time of a page opened at #t=3');
}

/** A world that records nothing: the page says so where it would show it. */
async function check_bare_record() {
  const bare = join(dirname(folder), 'bare_world'), out = join(dirname(folder), 'bare');
  cpSync(world, bare, {recursive: true});
  writeFileSync(join(bare, 'world.xml'), readFileSync(join(bare, 'world.xml'), 'utf8').replaceAll(/ *<record .*\n/g, ''));
  execFileSync(muster, ['run', bare, '--out', out, '--until', '1'], {stdio: ['ignore', 'ignore', 'inherit']});
  expect(!existsSync(join(out, 'run.html')), 'run writes a page where nothing is recorded');
  execFileSync(muster, ['report', out], {stdio: ['ignore', 'ignore', 'inherit']});
  await browser.open(`file://${resolve(out, 'run.html')}`);
  const said = await browser.value('[...document.querySelectorAll("#notes li, #plots .empty, #show-list small")].map((one) => one.textContent).join(" ")');
  for (const words of ['No poses were recorded', "--record 'robot/*/pose'", 'No RSSI was recorded', "--record 'inbox/*/message'", 'There is nothing to plot', 'scan/*/message not recorded'])
    expect(said.includes(words), `the page of a bare record does not say "${words}": ${said}`);
  expect(await browser.value('document.getElementById("legend").hidden'), 'a legend of RSSI is shown where none was recorded');
  expect(await browser.value('document.querySelectorAll(".name:not([hidden])").length') === 4, 'robots and station of a bare record are not shown');
}

async function check_small_screen() {
  await browser.open(address, {width: 390, height: 844, theme: 'dark', mobile: true});
  expect(await browser.value('document.documentElement.scrollWidth <= innerWidth'), 'the page is wider than a phone');
  expect(await browser.value('getComputedStyle(document.body).backgroundColor') === 'rgb(16, 19, 23)', 'the page is not dark where the system is');
  await browser.value('document.getElementById("theme").click(); document.getElementById("theme").click()');
  expect(await browser.value('getComputedStyle(document.body).backgroundColor') === 'rgb(246, 247, 249)', 'the switch does not make the page light');
}

try {
  const took = await browser.open(address);
  console.log(`page: ${(html.length / 1e6).toFixed(2)} MB, ready after ${await browser.value('document.documentElement.dataset.ready')} ms, drawn after ${took.toFixed(0)} ms`);
  const failure = await browser.value('document.getElementById("failure").textContent');
  expect(failure === '', `the page says "${failure}"`);
  if (!failure) {
    for (const check of [check_scene, check_framing, check_tables, check_scans, check_time, check_plots, check_keys_and_events, check_picture, check_light, check_link_to_a_time, check_bare_record, check_small_screen]) await check();
    writeFileSync(join(folder, 'page.png'), await browser.picture());
  }
  const others = browser.requests.filter((one) => one.replace(/#.*/, '') !== address && !one.endsWith('/bare/run.html'));
  expect(others.length === 0, `the page asked for ${others}`);
  expect(browser.complaints.length === 0, `the page complained: ${browser.complaints.join('; ')}`);
} finally {
  await browser.close();
}
console.log(failures ? `${failures} failed` : 'all as recorded');
process.exit(failures ? 1 : 0);
