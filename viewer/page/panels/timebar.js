// The slider of time with its keys, and the marks of events on it.

const step = 1;  // [s] of an arrow key; ten times that with shift

export const seconds = (time) => `${time.toFixed(time < 100 ? 2 : 1)} s`;

export class Timebar {
  constructor(page) {
    this.page = page;
    const {clock} = page;
    this.at = (id) => document.getElementById(id);
    const slider = this.at('time');
    Object.assign(slider, {min: clock.first, max: clock.last, step: 'any'});
    slider.addEventListener('input', () => clock.seek(Number(slider.value)));
    this.at('play').addEventListener('click', () => clock.play(!clock.is_playing));
    for (const speed of clock.speeds) this.at('speed').append(new Option(`${speed}\u00d7`, speed, false, speed === clock.speed));
    this.at('speed').addEventListener('change', (event) => clock.set_speed(Number(event.target.value)));
    document.addEventListener('keydown', (event) => this.key(event), true);
    this.renew();
    clock.listen(() => this.show());
    this.show();
  }

  /** Of the record that the page now has. */
  renew() {
    const {clock, record} = this.page;
    this.at('time').max = clock.last;
    this.at('ticks').replaceChildren(...record.run.events.map(({time, message}) => {
      const tick = document.createElement('i');
      tick.style.left = `${100 * (time - clock.first) / (clock.last - clock.first || 1)}%`;
      tick.title = message;
      return tick;
    }));
  }

  key(event) {
    const {clock} = this.page;
    const target = event.target;
    if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector('dialog[open]')) return;
    if (target.closest?.('select') || (event.key === ' ' && target.closest?.('button, summary'))) return;
    const far = event.shiftKey ? 10 * step : step;
    const acts = {
      ' ': () => clock.play(!clock.is_playing),
      ArrowLeft: () => clock.seek(clock.time - far),
      ArrowRight: () => clock.seek(clock.time + far),
      ArrowUp: () => this.change_speed(1),
      ArrowDown: () => this.change_speed(-1),
      Home: () => clock.seek(clock.first),
      End: () => clock.seek(clock.last),
    };
    if (!acts[event.key]) return;
    event.preventDefault();
    event.stopPropagation();
    acts[event.key]();
  }

  change_speed(by) {
    const {clock} = this.page;
    const at = clock.speeds.indexOf(clock.speed) + by;
    if (at >= 0 && at < clock.speeds.length) clock.set_speed(clock.speeds[at]);
  }

  show() {
    const {clock} = this.page;
    const slider = this.at('time');
    slider.value = clock.time;
    slider.setAttribute('aria-valuetext', seconds(clock.time));
    this.at('clock').textContent = `${seconds(clock.time)}`;
    this.at('speed').value = clock.speed;
    this.at('play').textContent = clock.is_playing ? '\u275a\u275a' : '\u25b6';
    this.at('play').setAttribute('aria-label', clock.is_playing ? 'Pause' : 'Play');
  }
}
