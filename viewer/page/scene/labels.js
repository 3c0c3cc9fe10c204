// Names of robots and stations, and figures of links, as text over the scene. Where two names would overlap, the farther one moves up;
// what then finds no place is left out.

import {css_of} from '../colours.js';

const height = 20;       // [px] of a name
const farthest = 100;    // [px] that a name may be above its place
const level_height = 15; // [px]

const meets = (a, b) => a.y < b.y + b.height && b.y < a.y + a.height && a.left < b.left + b.width && b.left < a.left + a.width;

export class Labels {
  constructor(box, stage) {
    Object.assign(this, {box, stage, list: [], levels: [], shows_names: true, shows_levels: true});
    stage.before_drawing.push(() => this.put());
  }

  /** place(): a Vector3 or null; colour(): CSS. */
  add(text, kind, place, colour) {
    const element = document.createElement('div');
    element.className = `name ${kind}`;
    element.textContent = text;
    element.dataset.name = text;
    this.box.append(element);
    this.list.push({element, place, colour});
  }

  put() {
    const boxes = [];
    const there = this.list.map((label) => ({label, at: this.shows_names ? this.seen(label.place()) : null}));
    for (const {label, at} of there) label.element.hidden = !at;
    there.filter(({at}) => at).sort((a, b) => b.at.y - a.at.y).forEach(({label, at}, i) => {
      label.width ??= label.element.offsetWidth;
      const box = {left: at.x - label.width / 2, y: at.y - 1.5 * height, width: label.width, height};
      for (let hit; (hit = boxes.find((other) => meets(box, other)));) box.y = hit.y - height;
      label.element.hidden = at.y - box.y > farthest;
      if (label.element.hidden) return;
      boxes.push(box);
      const {style} = label.element;
      style.setProperty('--dot', label.colour());
      style.setProperty('--stem', `${(at.y - box.y - height).toFixed(1)}px`);
      style.zIndex = there.length - i;  // over the stems of those that are farther
      style.transform = `translate(${box.left.toFixed(1)}px, ${box.y.toFixed(1)}px)`;
    });
    this.put_levels(boxes);
  }

  put_levels(boxes) {
    const wanted = this.shows_levels ? this.levels_of?.() ?? [] : [];
    while (this.levels.length < wanted.length) {
      const element = document.createElement('div');
      element.className = 'level';
      this.box.append(element);
      this.levels.push(element);
    }
    this.levels.forEach((element, i) => {
      const box = i < wanted.length ? this.box_of_level(wanted[i], boxes) : undefined;
      element.hidden = !box;
      if (!box) return;
      boxes.push(box);
      element.textContent = wanted[i].text;
      element.style.setProperty('--dot', wanted[i].dot);
      element.style.setProperty('--on', wanted[i].on);
      element.style.transform = `translate(${box.left.toFixed(1)}px, ${box.y.toFixed(1)}px)`;
    });
  }

  /** At the first of its places that is free. */
  box_of_level({text, places}, boxes) {
    const width = 8 + 7 * text.length;
    return places.map((place) => this.seen(place)).filter(Boolean)
      .map(({x, y}) => ({left: x - width / 2, y: y - level_height / 2, width, height: level_height}))
      .find((box) => !boxes.some((other) => meets(box, other)));
  }

  seen(place) {
    const at = place && this.stage.on_screen(place);
    return at && at.x > -40 && at.x < this.stage.width + 40 && at.y > -10 && at.y < this.stage.height + 30 ? at : null;
  }
}

/** The legend of RSSI: a bar of the scale's colours with figures in dBm. */
export function draw_legend(box, range, source, ramp) {
  const stops = Array.from({length: 9}, (_, i) => css_of(ramp(i / 8))).join(', ');
  const middle = (range[0] + range[1]) / 2;
  box.innerHTML = '<div><b>RSSI</b> of each link <span class="source"></span></div><div class="bar"></div><div class="scale"></div>';
  box.querySelector('.source').textContent = `(${source})`;
  box.querySelector('.bar').style.background = `linear-gradient(to right, ${stops})`;
  for (const value of [range[0], middle, range[1]]) {
    const figure = document.createElement('span');
    figure.textContent = `${String(value).replace('-', '\u2212')}${value === range[1] ? ' dBm' : ''}`;
    box.querySelector('.scale').append(figure);
  }
  box.hidden = false;
}
