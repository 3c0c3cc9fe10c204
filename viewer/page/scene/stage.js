// Camera, light and the moment of drawing. It draws when something has changed and rests otherwise.

import {Box3, Color, Object3D, PerspectiveCamera, Scene, Vector3, WebGLRenderer} from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';
import {themed} from '../colours.js';
import {Light} from './light.js';

Object3D.DEFAULT_UP.set(0, 0, 1);  // as in the world: x east, y north, z up

/** From a place so many degrees west of south. */
const from_azimuth = (degrees) => new Vector3(-Math.sin(degrees * Math.PI / 180), -Math.cos(degrees * Math.PI / 180), 1.1).normalize();
const from_south = from_azimuth(9);
const from_aside = [from_azimuth(30), from_azimuth(50)];
const from_above = new Vector3(0, -1e-4, 1).normalize();

export class Stage {
  constructor(canvas) {
    this.canvas = canvas;
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(40, 1, 0.05, 5000);
    this.renderer = new WebGLRenderer({canvas, antialias: true});
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.light = new Light(this);
    this.box = new Box3();
    this.before_drawing = [];
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = !matchMedia('(prefers-reduced-motion: reduce)').matches;
    this.controls.dampingFactor = 0.18;
    this.controls.maxPolarAngle = 0.499 * Math.PI;  // never from below the floor
    this.controls.keys = {LEFT: 'KeyA', UP: 'KeyW', RIGHT: 'KeyD', BOTTOM: 'KeyS'};  // arrows are for time
    this.controls.listenToKeyEvents(canvas);
    this.controls.addEventListener('change', () => this.invalidate());
    this.controls.addEventListener('start', () => { this.is_fitted = false; });
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
  }

  resize() {
    const {clientWidth: width, clientHeight: height} = this.canvas.parentElement;
    if (!width || !height || (width === this.width && height === this.height)) return;
    const was_fitted = this.is_fitted;
    [this.width, this.height] = [width, height];
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (was_fitted) this.fit_again();
    this.draw();  // at once: a new size has emptied the canvas
  }

  invalidate() {
    if (this.is_due) return;
    this.is_due = true;
    requestAnimationFrame(() => this.draw());
  }

  draw() {
    this.is_due = false;
    const is_moving = this.controls.update();
    for (const prepare of this.before_drawing) prepare();
    this.renderer.render(this.scene, this.camera);
    if (is_moving) this.invalidate();
  }

  recolour() {
    this.scene.background = new Color(themed('--ground'));
    this.light.recolour();
    this.invalidate();
  }

  /** Metres that one pixel takes at a place. */
  pixel_at(place) {
    const distance = Math.max(this.camera.near, this.camera.position.distanceTo(place));
    return 2 * distance * Math.tan(this.camera.fov * Math.PI / 360) / this.height;
  }

  /** Where a place is on the canvas in pixels, or null behind the camera. */
  on_screen(place) {
    const seen = place.clone().project(this.camera);
    if (seen.z > 1 || seen.z < -1) return null;
    return {x: (seen.x + 1) / 2 * this.width, y: (1 - seen.y) / 2 * this.height};
  }

  /** Shows the whole box from the south, or from aside where that brings a long one much nearer. */
  fit() {
    const south = this.framed(from_south);
    const near = from_aside.map((from) => this.framed(from)).sort((a, b) => a.distance - b.distance)[0];
    this.frame(near.distance < 0.9 * south.distance ? near : south);
    this.fit_again = this.fit;
  }
  fit_from_above() {
    this.frame(this.framed(from_above));
    this.fit_again = this.fit_from_above;
  }
  frame({target, from, distance}) {
    this.look(target, from, distance);
    this.is_fitted = true;
  }

  /** {target, from, distance}: the box seen from there fills the view, but for room around it for buttons and names. */
  framed(from) {
    const half_height = Math.tan(this.camera.fov * Math.PI / 360) * Math.max(0.6, 1 - 130 / this.height);
    const half_width = Math.tan(this.camera.fov * Math.PI / 360) * this.camera.aspect * Math.max(0.6, 1 - 70 / this.width);
    const right = new Vector3().crossVectors(new Vector3(0, 0, 1), from).normalize();
    const up = new Vector3().crossVectors(from, right);
    const target = this.box.getCenter(new Vector3());
    let distance = 3 * this.box.getSize(new Vector3()).length();
    for (let again = 0; again < 20; ++again) {
      const seen = new Box3();  // x and y as shares of the distance
      for (let corner = 0; corner < 8; ++corner) {
        const place = new Vector3(...['x', 'y', 'z'].map((axis, i) => (corner >> i & 1 ? this.box.max : this.box.min)[axis])).sub(target);
        const away = Math.max(0.1 * distance, distance - place.dot(from));
        seen.expandByPoint(new Vector3(place.dot(right) / away, place.dot(up) / away, 0));
      }
      const middle = seen.getCenter(new Vector3()), size = seen.getSize(new Vector3());
      target.addScaledVector(right, middle.x * distance).addScaledVector(up, middle.y * distance);
      distance = Math.max(1, distance * Math.max(size.x / half_width, size.y / half_height) / 2);
    }
    return {target, from, distance};
  }

  look(target, from, distance) {
    this.is_fitted = false;
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(from, distance);
    this.camera.far = Math.max(1000, 20 * distance);
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.invalidate();
  }

  /** Nearer (factor below 1) or farther. */
  zoom(factor) {
    this.is_fitted = false;
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.invalidate();
  }
}
