// Opens the run that the page carries, and ties scene, plots and time together.

import 'uplot/dist/uPlot.min.css';
import {Clock} from './clock.js';
import {Live} from './live.js';
import {opened, unzipped} from './model/payload.js';
import {Record} from './model/record.js';
import {fill_about, fill_keys} from './panels/boxes.js';
import {first_measures, measures_of} from './panels/measures.js';
import {Plot} from './panels/plot.js';
import {Timebar, seconds} from './panels/timebar.js';
import {View} from './view.js';

const at = (id) => document.getElementById(id);

class Page {
  constructor(record) {
    this.record = record;
    this.clock = new Clock(record.first, record.last);
    document.title = `${record.run.world}: a run of muster`;
    at('title').textContent = record.run.world;
    this.say_facts();
    this.timebar = new Timebar(this);
    this.make_view();
    this.make_plots();
    this.list_events();
    this.add_boxes();
    this.add_theme();
    const asked = /^#t=([0-9.]+)$/.exec(location.hash);
    if (asked) this.clock.seek(Number(asked[1]));
  }

  say_facts() {
    const {run} = this.record;
    at('facts').textContent = `${run.time} s, seed ${run.seed}, digest ${run.digest}`;
  }

  /** The record of a run that has gone on. */
  renew(record) {
    this.record = record;
    this.say_facts();
    this.clock.extend(record.last);
    this.view?.renew(record);
    const known = this.measures.map(({id}) => id).join('\n');
    this.measures = measures_of(record);
    if (this.measures.map(({id}) => id).join('\n') !== known) {
      for (const plot of [...this.plots]) this.remove_plot(plot);
      for (const measure of first_measures(this.measures)) this.add_plot(measure);
    } else {
      for (const plot of this.plots) plot.choose(this.measures.find(({id}) => id === plot.measure.id));
    }
    this.list_events();
    this.timebar.renew();
    this.timebar.show();
  }

  /** Where there is no WebGL, the plots are still of use. */
  make_view() {
    try {
      this.view = new View(this.record, this.clock);
    } catch (error) {
      if (!/WebGL/i.test(error.message)) throw error;
      const item = document.createElement('li');
      item.textContent = `The scene needs WebGL, which this browser does not give (${error.message}). Plots and events work without it.`;
      at('notes').append(item);
    }
  }

  make_plots() {
    this.measures = measures_of(this.record);
    this.plots = [];
    for (const measure of first_measures(this.measures)) this.add_plot(measure);
    at('add-plot').addEventListener('click', () => this.add_plot(this.measures.find((one) => !this.plots.some((plot) => plot.measure === one)) ?? this.measures[0]));
    this.clock.listen(() => this.plots.forEach((plot) => plot.move()));
    if (this.measures.length) return;
    at('add-plot').hidden = true;
    const words = document.createElement('p');
    words.className = 'empty';
    words.textContent = "There is nothing to plot: no table was recorded. muster run WORLD --out DIR --record 'robot/*/pose' records one; <record table=\"robot/*/pose\"/> in the world file does so in every run.";
    at('plot-list').append(words);
  }

  add_plot(measure) {
    const plot = new Plot(this, measure);
    this.plots.push(plot);
    at('plot-list').append(plot.element);
    plot.resize();
    return plot;
  }

  remove_plot(plot) {
    this.plots = this.plots.filter((one) => one !== plot);
    plot.chart?.destroy();
    plot.element.remove();
  }

  list_events() {
    const {events} = this.record.run;
    at('events').querySelector('summary').textContent = `Events (${events.length})`;
    at('event-list').replaceChildren();
    at('events').querySelector('p')?.remove();
    for (const {time, instance, message} of events) {
      const item = document.createElement('li'), button = document.createElement('button'), when = document.createElement('time');
      when.textContent = seconds(time);
      button.type = 'button';
      button.append(when, instance ? `${instance}: ${message}` : message);
      button.addEventListener('click', () => this.clock.seek(time));
      item.append(button);
      at('event-list').append(item);
    }
    if (!events.length) {
      const words = document.createElement('p');
      words.textContent = 'No plugin reported an event during this run.';
      at('events').append(words);
    }
  }

  add_boxes() {
    fill_keys(at('keys-box'));
    fill_about(at('about-box'), this.record);
    at('keys').addEventListener('click', () => at('keys-box').showModal());
    at('about').addEventListener('click', () => {
      fill_about(at('about-box'), this.record);  // of a run that has gone on since
      at('about-box').showModal();
    });
    document.addEventListener('keydown', (event) => {
      if (event.key === '?' && !document.querySelector('dialog[open]')) at('keys-box').showModal();
    });
  }

  add_theme() {
    const root = document.documentElement, names = {auto: 'Theme: system', light: 'Theme: light', dark: 'Theme: dark'};
    const apply = () => {
      at('theme').setAttribute('aria-label', names[root.dataset.theme]);
      at('theme').title = `${names[root.dataset.theme]}; press to change`;
      at('theme').textContent = {auto: '\u25d0', light: '\u2600', dark: '\u263e'}[root.dataset.theme] + '\ufe0e';
      this.view?.recolour();
      this.plots.forEach((plot) => plot.recolour());
    };
    at('theme').addEventListener('click', () => {
      root.dataset.theme = {auto: 'dark', dark: 'light', light: 'auto'}[root.dataset.theme];
      apply();
    });
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', apply);
    apply();
  }
}

async function start() {
  const record = new Record(opened(await unzipped(at('payload').textContent)));
  globalThis.muster = new Page(record);  // for whoever looks at the page by its console
  if (document.documentElement.dataset.live) globalThis.muster.live = new Live(globalThis.muster);
  document.documentElement.dataset.ready = String(Math.round(performance.now()));  // [ms] since the page was asked for
}

globalThis.muster_started = start();
