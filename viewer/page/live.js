// A run that is still going: asks the program that serves the page for what has come since, and passes on pause, step and speed.

import {opened, unzipped} from './model/payload.js';
import {Record} from './model/record.js';

const interval = 400;  // [ms] between questions
const speeds = [0.1, 0.25, 0.5, 1, 2, 4, 8, 16, 32, 64];

export class Live {
  constructor(page) {
    this.page = page;
    this.at = (id) => document.getElementById(id);
    this.query = location.search;  // with the token, where there is one
    this.shown = -1;               // tick
    this.at('live').hidden = false;
    this.at('live-pause').addEventListener('click', () => this.control(`paused=${!this.state?.paused}`));
    this.at('live-step').addEventListener('click', () => this.control('step=1'));
    for (const speed of speeds) this.at('live-speed').append(new Option(`${speed}\u00d7`, speed));
    this.at('live-speed').addEventListener('change', (event) => this.control(`speed=${event.target.value}`));
    this.ask();
  }

  async control(words) {
    const answer = await fetch(`/control${this.query ? `${this.query}&` : '?'}${words}`, {method: 'POST', headers: {'X-Muster': '1'}});
    if (answer.ok) this.say(await answer.json());
  }

  async ask() {
    try {
      const state = await (await fetch(`/state${this.query}`)).json();
      this.say(state);
      if (state.tick !== this.shown || state.over) {
        const {head, bytes} = opened(await unzipped(await (await fetch(`/record${this.query}`)).text()));
        this.shown = state.tick;
        this.page.renew(new Record({head, bytes}));
      }
      if (state.over) return this.end('The run is over.');
    } catch (error) {
      if (error instanceof TypeError) return this.end('The run has ended, and its program with it.');
      throw error;
    }
    setTimeout(() => this.ask(), interval);
  }

  say(state) {
    this.state = state;
    const speed = this.at('live-speed');
    if (![...speed.options].some((option) => Number(option.value) === state.speed)) speed.append(new Option(`${state.speed}\u00d7`, state.speed));
    speed.value = state.speed;
    this.at('live-pause').textContent = state.paused ? 'Go on' : 'Pause';
    this.at('live-words').textContent = `${state.paused ? 'paused' : 'live'}, tick ${state.tick} of ${state.ticks}`;
  }

  /** What was shown stays, with its slider and plots. */
  end(words) {
    for (const id of ['live-pause', 'live-step', 'live-speed']) this.at(id).disabled = true;
    this.at('live-words').textContent = words;
    document.documentElement.dataset.live = 'over';
  }
}
