// The one time of the page. Scene, plots and slider listen to it; whoever is used to seek tells it.

export class Clock {
  constructor(first, last) {
    Object.assign(this, {first, last, time: first, speed: 1, is_playing: false, listeners: []});
    // Fast enough that the whole run takes about half a minute.
    const wanted = (last - first) / 30;
    this.speeds = [0.1, 0.25, 0.5, 1, 2, 4, 8, 16, 32, 64];
    this.speed = this.speeds.reduce((best, speed) => Math.abs(Math.log(speed / wanted)) < Math.abs(Math.log(best / wanted)) ? speed : best, 1);
  }
  listen(listener) { this.listeners.push(listener); }
  tell() { for (const listener of this.listeners) listener(this.time); }

  /** The run has gone on; who was at its end stays there. */
  extend(last) {
    const is_at_end = this.time >= this.last;
    this.last = last;
    this.seek(is_at_end ? last : this.time);
  }
  seek(time) {
    this.time = Math.min(this.last, Math.max(this.first, time));
    this.tell();
  }
  play(is_playing) {
    if (is_playing && this.time >= this.last) this.time = this.first;
    this.is_playing = is_playing;
    this.before = undefined;
    if (is_playing) requestAnimationFrame((now) => this.frame(now));
    this.tell();
  }
  set_speed(speed) { this.speed = speed; this.tell(); }

  frame(now) {
    if (!this.is_playing) return;
    const passed = this.before === undefined ? 0 : (now - this.before) / 1000;
    this.before = now;
    this.time = Math.min(this.last, this.time + passed * this.speed);
    if (this.time >= this.last) this.is_playing = false;
    this.tell();
    if (this.is_playing) requestAnimationFrame((next) => this.frame(next));
  }
}
