// Makes the page without a run: program, style and licences put into page.html. What muster report puts the run into.
// usage: node build.js OUT; the packages are looked for in NODE_PATH
import {readFileSync, writeFileSync, mkdirSync} from 'node:fs';
import {createRequire} from 'node:module';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {gzipSync} from 'node:zlib';

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2];
const packages = process.env.NODE_PATH;
const {buildSync} = createRequire(join(packages, 'x.js'))('esbuild');

function bundled(entry, options) {
  const result = buildSync({
    entryPoints: [join(here, entry)], bundle: true, minify: true, write: false, target: ['es2022'], nodePaths: [packages],
    legalComments: 'none', logLevel: 'warning', outdir: 'unused', ...options});
  return Object.fromEntries(result.outputFiles.map((file) => [file.path.split('.').pop(), file.text]));
}

const program = bundled('main.js', {format: 'iife'});
const style = bundled('style.css', {}).css;
const starter = bundled('starter.js', {format: 'iife'}).js;
const licences = ['three', 'uplot'].map((name) => {
  const about = JSON.parse(readFileSync(join(packages, name, 'package.json'), 'utf8'));
  return `${name} ${about.version}\n\n${readFileSync(join(packages, name, 'LICENSE'), 'utf8').trim()}\n`;
}).join('\n\n');

const parts = {
  STYLE: (program.css + style).replaceAll('</style', '<\\/style'),
  LICENCES: licences.replaceAll('<', '\u2039'),
  PROGRAM: gzipSync(program.js, {level: 9}).toString('base64'),
  STARTER: starter.trim(),
};
const page = readFileSync(join(here, 'page.html'), 'utf8').replace(/@(STYLE|LICENCES|PROGRAM|STARTER)@/g, (_, name) => parts[name]);
mkdirSync(dirname(out), {recursive: true});
writeFileSync(out, page);
