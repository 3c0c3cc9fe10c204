// What can be plotted: each numeric column of each table, columns that belong together (rssi_a, rssi_b), and the RSSI of links.

const most_series = 40;

/** {id, group, title, unit, series()}: series() gives [{label, about, time, values}]; about is the robot or radio that it is of. */
function of_column(table, column) {
  return {
    id: `${table.name}|${column.name}`, group: table.name, title: `${column.title} \u00b7 ${table.name}`, unit: column.unit,
    series: () => table.keys.map((key) => ({label: key || column.name, about: key, ...table.series(column.name, key)})),
  };
}

/** Columns of a table without keys that share a beginning and a unit, and end in names of radios. */
function of_families(table, names, threshold) {
  const families = new Map();
  for (const column of table.columns) {
    const name = names.find((one) => column.name.endsWith(`_${one.replace(/[^A-Za-z0-9]/g, '_')}`));
    if (!name || !column.is_number) continue;
    const stem = column.name.slice(0, -name.length - 1);
    const id = `${stem}|${column.unit}`;
    families.set(id, [...families.get(id) ?? [], {column, name}]);
  }
  return [...families.entries()].filter(([, members]) => members.length > 1).map(([id, members]) => {
    const [stem, unit] = id.split('|');
    return {
      id: `${table.name}|${stem}_*`, group: table.name, title: `${stem}${unit ? ` [${unit}]` : ''} of each \u00b7 ${table.name}`, unit,
      threshold: unit === 'dBm' ? threshold : undefined,
      series: () => members.map(({column, name}) => ({label: name, about: name, ...table.series(column.name, table.keys[0])})),
    };
  });
}

function of_links({name, links}) {
  return {
    id: `links|${name}`, group: 'Links', title: `RSSI [dBm] \u00b7 ${name}`, unit: 'dBm',
    series: () => links.map(({from, to, time, rssi}) => ({label: `${from} \u2192 ${to}`, about: '', time, values: rssi})),
  };
}

export function measures_of(record) {
  const names = record.scene.radios.map((radio) => radio.name).sort((a, b) => b.length - a.length);
  const result = record.links.map(of_links);
  for (const table of record.tables) {
    if (table.keys.length === 1) result.push(...of_families(table, names, record.run.chains?.find((chain) => chain.table === table.name)?.threshold));
    for (const column of table.columns) {
      if (column.name !== 't' && column.name !== table.key_column && column.is_number && column !== table.columns[1]) result.push(of_column(table, column));
    }
  }
  return result;
}

/** Whether a height leaves that of the start by more than a hand. */
const rises = (measure) => measure.series().some(({values}) => values.some((value) => Math.abs(value - values[0]) > 0.3));

/** Links' RSSI first, then how far robots came, and how high where one flies. */
export function first_measures(measures) {
  const is = (pattern) => (measure) => pattern.test(measure.id);
  const chosen = [measures.find(is(/\|smooth_\*$/)), measures.find(is(/^links\|/)), measures.find(is(/\|distance_\*$/)), measures.find(is(/^robot\/.*\/pose\|x$/)), measures.find(is(/^robot\/.*\/pose\|y$/)), measures.find((measure) => is(/^robot\/.*\/pose\|z$/)(measure) && rises(measure))];
  const there = [...new Set(chosen.filter(Boolean))].slice(0, 3);
  return there.length ? there : measures.slice(0, 2);
}

/** The series that are drawn, and how many are left out. */
export function drawn_series(measure) {
  const all = measure.series().filter(({time}) => time.length);
  return {series: all.slice(0, most_series), left_out: Math.max(0, all.length - most_series)};
}
