// One plot over time: a measure to choose, its lines, the present time as a vertical line, and the values there. A click seeks.

import uPlot from 'uplot';
import {series_colour, series_dash, themed} from '../colours.js';
import {last_at} from '../model/tables.js';
import {drawn_series} from './measures.js';

const height = 178;  // [px]

const minus = (text) => text.replaceAll('-', '\u2212');
const number_text = (value) => Number.isNaN(value) ? 'none' : minus(Math.abs(value) >= 1e5 || (value !== 0 && Math.abs(value) < 1e-3) ? value.toExponential(2) : String(+value.toPrecision(5)));

/** Rows as uPlot draws them: one time axis, gaps where a value is null. */
function aligned(series) {
  const drawable = (values) => Array.from(values, (value) => Number.isFinite(value) ? value : null);
  const same = series.every(({time}) => time.length === series[0].time.length && time.every((t, i) => t === series[0].time[i]));
  if (same) return [Array.from(series[0].time), ...series.map(({values}) => drawable(values))];
  return uPlot.join(series.map(({time, values}) => [Array.from(time), drawable(values)]));
}

export class Plot {
  constructor(page, measure) {
    this.page = page;
    this.element = document.createElement('article');
    this.element.className = 'plot';
    this.element.innerHTML = '<div class="choose"><select aria-label="What is plotted"></select><button type="button" class="close" aria-label="Remove this plot" title="Remove">&#10005;</button></div><p class="said" hidden></p><div class="chart"></div><ul class="values" aria-label="Values"></ul>';
    this.part = (name) => this.element.querySelector(`.${name}`);
    this.part('close').addEventListener('click', () => page.remove_plot(this));
    this.fill_chooser(measure);
    new ResizeObserver(() => this.resize()).observe(this.part('chart'));
    this.choose(measure);
  }

  fill_chooser(measure) {
    const select = this.element.querySelector('select');
    const groups = new Map();
    for (const one of this.page.measures) {
      if (!groups.has(one.group)) {
        const group = document.createElement('optgroup');
        group.label = one.group;
        groups.set(one.group, group);
        select.append(group);
      }
      groups.get(one.group).append(new Option(one.title, one.id, false, one === measure));
    }
    select.addEventListener('change', () => this.choose(this.page.measures.find((one) => one.id === select.value)));
  }

  choose(measure) {
    this.measure = measure;
    const {series, left_out} = drawn_series(measure);
    this.series = series;
    this.hidden = new Set();
    const said = this.part('said');
    const words = [];
    if (left_out) words.push(`${left_out} more rows are not drawn.`);
    if (!series.length) words.push('This table has no rows: nothing was recorded in it during the run.');
    said.textContent = words.join(' ');
    said.hidden = !words.length;
    this.make();
  }

  colour(i) { return series_colour(this.colour_index(i)); }
  /** A robot has the colour that it has in the scene. */
  colour_index(i) {
    const robot = this.page.record.motions.findIndex((motion) => motion.name === this.series[i].about);
    return robot >= 0 ? robot : i;
  }

  make() {
    this.chart?.destroy();
    this.chart = null;
    this.part('chart').replaceChildren();
    this.part('values').replaceChildren();
    if (!this.series.length) return;
    const axis = {stroke: () => themed('--soft'), grid: {stroke: () => themed('--grid'), width: 1}, ticks: {stroke: () => themed('--line'), width: 1}, font: '11px system-ui, sans-serif'};
    const options = {
      width: Math.max(200, this.part('chart').clientWidth || 400), height,
      padding: [8, 18, 0, 0],
      scales: {y: {range: (u, low, high) => low === high ? [(low ?? 0) - 1, (low ?? 0) + 1] : uPlot.rangeNum(low, high, 0.1, true)}, x: {time: false, range: (u, low, high) => u.data[0].length > 1 && low !== high ? [low, high] : [this.page.clock.first, this.page.clock.last]}},
      axes: [{...axis, values: (u, values) => values.map((value) => `${+value.toPrecision(6)} s`), space: 70, size: 34}, {...axis, values: (u, values) => values.map((value) => minus(String(+value.toPrecision(8)))), size: 52}],
      series: [{}, ...this.series.map(({label}, i) => ({
        label, stroke: () => this.colour(i), width: 1.5, dash: series_dash(this.colour_index(i)), points: {show: this.series[i].time.length < 2, size: 4}, show: !this.hidden.has(i)}))],
      cursor: {drag: {x: true, y: false, dist: 8}, sync: {key: 'muster'}, points: {size: 6}},
      legend: {show: false},
      hooks: {draw: [(u) => this.draw_events(u), (u) => this.draw_threshold(u), () => this.move()], setCursor: [() => this.say()], ready: [(u) => this.ready(u)], setScale: [() => this.move()]},
    };
    this.chart = new uPlot(options, aligned(this.series), this.part('chart'));
    this.chart.setScale('x', {min: this.page.clock.first, max: this.page.clock.last});
    this.describe();
    this.list_values();
    this.move();
  }

  describe() {
    const scale = this.chart.scales.y;
    const words = `${this.measure.title}, ${this.measure.group}: ${this.series.length} lines over ${this.page.clock.last} s`;
    this.chart.root.setAttribute('role', 'img');
    this.chart.root.setAttribute('aria-label', Number.isFinite(scale.min) ? `${words}, from ${number_text(scale.min)} to ${number_text(scale.max)} ${this.measure.unit}` : words);
  }

  ready(u) {
    this.now = document.createElement('div');
    this.now.className = 'now';
    u.over.append(this.now);
    queueMicrotask(() => this.move());
    let begun = null;
    u.over.addEventListener('pointerdown', (event) => { begun = event.clientX; });
    u.over.addEventListener('click', (event) => {
      if (begun !== null && Math.abs(event.clientX - begun) > 7) return;  // it was a selection
      this.page.clock.seek(u.posToVal(event.clientX - u.over.getBoundingClientRect().left, 'x'));
    });
  }

  draw_events(u) {
    const {ctx, bbox} = u;
    ctx.save();
    ctx.strokeStyle = themed('--event');
    ctx.lineWidth = devicePixelRatio;
    ctx.setLineDash([3 * devicePixelRatio, 3 * devicePixelRatio]);
    for (const {time} of this.page.record.run.events) {
      const x = Math.round(u.valToPos(time, 'x', true));
      if (x < bbox.left || x > bbox.left + bbox.width) continue;
      ctx.beginPath();
      ctx.moveTo(x, bbox.top);
      ctx.lineTo(x, bbox.top + bbox.height);
      ctx.stroke();
    }
    ctx.restore();
  }

  draw_threshold({ctx, bbox, valToPos}) {
    const {threshold} = this.measure;
    if (threshold === undefined) return;
    const y = Math.round(valToPos(threshold, 'y', true));
    if (y < bbox.top || y > bbox.top + bbox.height) return;
    ctx.save();
    ctx.strokeStyle = ctx.fillStyle = themed('--soft');
    ctx.lineWidth = devicePixelRatio;
    ctx.setLineDash([8 * devicePixelRatio, 4 * devicePixelRatio]);
    ctx.beginPath();
    ctx.moveTo(bbox.left, y);
    ctx.lineTo(bbox.left + bbox.width, y);
    ctx.stroke();
    ctx.font = `${11 * devicePixelRatio}px system-ui, sans-serif`;
    ctx.textAlign = 'right';
    ctx.fillText('threshold', bbox.left + bbox.width - 4 * devicePixelRatio, y - 4 * devicePixelRatio);
    ctx.restore();
  }

  list_values() {
    const longest = ({values}) => Math.max(...[0, 0.25, 0.5, 0.75, 1].map((share) => number_text(values[Math.floor(share * (values.length - 1))]).length));
    const widths = this.series.map((one) => 30 + 6.3 * one.label.length + 8 * longest(one));
    this.part('values').style.setProperty('--cell', `${Math.max(...widths)}px`);
    this.figures = this.series.map(({label}, i) => {
      const item = document.createElement('li');
      const button = document.createElement('button');
      button.type = 'button';
      button.title = 'Show or hide this line';
      button.innerHTML = '<svg aria-hidden="true" viewBox="0 0 18 8"><line x1="0" x2="18" y1="4" y2="4" stroke-width="2.5"/></svg><span></span> <b></b>';
      button.querySelector('line').setAttribute('stroke-dasharray', series_dash(this.colour_index(i)).join(' '));
      button.querySelector('span').textContent = label;
      button.setAttribute('aria-pressed', 'true');
      button.addEventListener('click', () => {
        const shown = this.hidden.delete(i) || !this.hidden.add(i);
        button.setAttribute('aria-pressed', String(shown));
        this.chart.setSeries(i + 1, {show: shown});
      });
      item.append(button);
      this.part('values').append(item);
      return {line: button.querySelector('line'), value: button.querySelector('b')};
    });
  }

  /** The value that holds at a time: the last one recorded. */
  value_at(i, t) {
    const {time, values} = this.series[i];
    const r = last_at(time, t);
    return r < 0 ? NaN : values[r];
  }

  say() {
    if (!this.figures) return;
    const left = this.chart?.cursor.left ?? -1;
    const t = left >= 0 && this.chart.cursor.event ? this.chart.posToVal(left, 'x') : this.page.clock.time;
    this.figures.forEach(({line, value}, i) => {
      line.setAttribute('stroke', this.colour(i));
      value.textContent = number_text(this.value_at(i, t));
    });
  }

  /** To the present time. */
  move() {
    if (!this.chart || !this.now) return;
    const x = this.chart.valToPos(this.page.clock.time, 'x');
    this.now.style.left = `${x - 1}px`;
    this.now.hidden = !(x >= 0 && x <= this.chart.over.clientWidth + 1);
    this.say();
  }

  resize() {
    const width = this.part('chart').clientWidth;
    if (!this.chart || !width || width === this.chart.width) return;
    this.chart.setSize({width, height});
    this.move();
  }

  recolour() { this.make(); }
}
