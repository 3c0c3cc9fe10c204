// The boxes that open over the page: its keys, and what it is made of and from.

const keys = [
  ['Space', 'play, pause'], ['\u2190 \u2192', 'one second back, on; with Shift ten'], ['\u2191 \u2193', 'faster, slower'], ['Home End', 'start, end'],
  ['F', 'show all'], ['T', 'from above'], ['+ \u2212', 'nearer, farther (scene in focus)'], ['W A S D', 'move the view (scene in focus; with Shift turn)'], ['?', 'this list'],
];
const pointers = [
  ['Drag', 'turn the scene; one finger'], ['Right drag', 'move the scene; two fingers'], ['Wheel', 'nearer, farther; pinch'],
  ['Click a plot', 'go to that time'], ['Drag in a plot', 'zoom into a time; double click shows all'], ['Click a name below a plot', 'show or hide its line'],
];

function element(name, text = '', children = []) {
  const made = document.createElement(name);
  made.textContent = text;
  made.append(...children);
  return made;
}

function table_of(rows, first = 'td') {
  return element('table', '', [element('tbody', '', rows.map(([a, b]) => element('tr', '', [element('td', '', [element(first, a)]), element('td', b)])))]);
}

function closing() {
  const form = element('form', '', [element('button', 'Close')]);
  form.method = 'dialog';
  return form;
}

export function fill_keys(box) {
  box.append(element('h2', 'Keys'), table_of(keys, 'kbd'), element('h3', 'Mouse and touch'), table_of(pointers, 'span'), closing());
}

function tables_of(record) {
  const rows = record.tables.map((table) => {
    const part = table.kept_every > 1 ? `of every ${table.kept_every} recorded times one; ${table.file} has all ${table.times_in_record}` : `all of ${table.file}`;
    return [table.name, `${table.rows} rows: ${part}`];
  });
  return rows.length ? table_of(rows, 'code') : element('p', 'The world records no table.');
}

export function fill_about(box, record) {
  const {run} = record;
  box.replaceChildren();
  const facts = [['World', run.world], ['File', run.file], ['Seed', String(run.seed)], ['Step', `${run.dt} s`], ['Ticks', `${run.ticks} (${run.time} s)`], ['Digest', run.digest], ['muster', run.version]];
  box.append(
    element('h2', 'About this page'),
    element('p', 'One run of muster in one file. It holds the record and all that shows it, and loads nothing from elsewhere.'),
    table_of(facts, 'span'), element('h3', 'Recorded tables'), tables_of(record));
  if (record.notes.length) box.append(element('h3', 'Notes'), element('ul', '', record.notes.map((note) => element('li', note))));
  box.append(element('h3', 'Licences'), element('p', 'muster is under the Apache License 2.0. The page contains three.js and uPlot, both under the MIT License:'));
  const texts = document.getElementById('licences').textContent.trim();
  box.append(element('details', '', [element('summary', 'Text of the licences'), element('pre', texts)]), closing());
}
