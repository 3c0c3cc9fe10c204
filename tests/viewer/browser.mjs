// Chromium without a window, driven over its DevTools protocol through a pipe: no port, no package.
import {spawn} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

const most_seconds = 30;  // for an answer

export class Browser {
  constructor(program) {
    this.profile = mkdtempSync(join(tmpdir(), 'muster_browser_'));
    const flags = ['--headless=new', '--no-sandbox', '--disable-gpu', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
      '--disable-dev-shm-usage', '--no-first-run', '--disable-extensions', '--hide-scrollbars', '--remote-debugging-pipe', `--user-data-dir=${this.profile}`];
    this.process = spawn(program, flags, {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe']});
    this.next = 1;
    this.waiting = new Map();
    this.requests = [];   // addresses asked for, without data: and blob:
    this.complaints = []; // what the page printed as an error, and what it threw
    let rest = '';
    this.process.stdio[4].on('data', (bytes) => {
      const messages = (rest + bytes).split('\0');
      rest = messages.pop();
      for (const message of messages) this.take(JSON.parse(message));
    });
    this.process.on('exit', () => { for (const {fail} of this.waiting.values()) fail(new Error('the browser has ended')); });
  }

  take({id, method, params, result, error}) {
    if (id) {
      const {done, fail} = this.waiting.get(id);
      this.waiting.delete(id);
      return error ? fail(new Error(error.message)) : done(result);
    }
    if (method === 'Network.requestWillBeSent' && !/^(data|blob):/.test(params.request.url)) this.requests.push(params.request.url);
    if (method === 'Runtime.exceptionThrown') this.complaints.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
    if (method === 'Runtime.consoleAPICalled' && ['error', 'assert'].includes(params.type)) this.complaints.push(params.args.map((one) => one.value ?? one.description).join(' '));
    if (method === 'Log.entryAdded' && params.entry.level === 'error') this.complaints.push(params.entry.text);
  }

  call(method, params = {}) {
    const id = this.next++;
    const session = this.session && !method.startsWith('Target.') ? {sessionId: this.session} : {};
    this.process.stdio[3].write(`${JSON.stringify({id, method, params, ...session})}\0`);
    return new Promise((done, fail) => {
      const timer = setTimeout(() => fail(new Error(`${method} ${JSON.stringify(params).slice(0, 200)} was not answered within ${most_seconds} s`)), 1000 * most_seconds);
      this.waiting.set(id, {done: (result) => { clearTimeout(timer); done(result); }, fail: (error) => { clearTimeout(timer); fail(error); }});
    });
  }

  /** Opens the page and waits until it is ready; returns the milliseconds that took. */
  async open(address, {width = 1280, height = 800, scale = 1, theme = 'light', mobile = false} = {}) {
    if (!this.session) {
      const {targetId} = await this.call('Target.createTarget', {url: 'about:blank'});
      this.session = (await this.call('Target.attachToTarget', {targetId, flatten: true})).sessionId;
      for (const domain of ['Page', 'Runtime', 'Log', 'Network']) await this.call(`${domain}.enable`);
    }
    await this.call('Emulation.setDeviceMetricsOverride', {width, height, deviceScaleFactor: scale, mobile});
    await this.call('Emulation.setEmulatedMedia', {features: [{name: 'prefers-color-scheme', value: theme}]});
    await this.call('Page.navigate', {url: 'about:blank'});
    const began = performance.now();
    await this.call('Page.navigate', {url: address});
    while (!await this.value('document.documentElement?.dataset.ready || document.querySelector(".failure:not([hidden])")?.textContent || ""')) {
      if (performance.now() - began > 60000) throw new Error('the page was not ready within a minute');
      await new Promise((done) => setTimeout(done, 20));
    }
    const took = performance.now() - began;
    await this.settle();
    return took;
  }

  /** The value of an expression in the page. */
  async value(expression) {
    const {result, exceptionDetails} = await this.call('Runtime.evaluate', {expression, returnByValue: true, awaitPromise: true});
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  /** Until what was asked for is drawn. */
  settle() { return this.value('new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(() => done(true)))))'); }

  async picture() { return Buffer.from((await this.call('Page.captureScreenshot', {format: 'png'})).data, 'base64'); }

  async click(x, y) {
    for (const type of ['mousePressed', 'mouseReleased']) await this.call('Input.dispatchMouseEvent', {type, x, y, button: 'left', clickCount: 1});
    await this.settle();
  }

  async press(key, code = key, text = undefined) {
    await this.call('Input.dispatchKeyEvent', {type: 'keyDown', key, code, text, windowsVirtualKeyCode: {ArrowLeft: 37, ArrowRight: 39, Home: 36, End: 35, ' ': 32}[key]});
    await this.call('Input.dispatchKeyEvent', {type: 'keyUp', key, code});
    await this.settle();
  }

  async close() {
    await this.call('Browser.close').catch(() => {});
    await new Promise((done) => this.process.exitCode !== null ? done() : this.process.on('exit', done));
    rmSync(this.profile, {recursive: true, force: true});
  }
}
