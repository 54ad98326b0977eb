// Bundles CodeMirror for the live view, with the licence notices of what is in it.
//
// `node_modules => codemirror.min.js, codemirror.LICENSE`. See README.md.
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { build } from 'esbuild';

const options = {
  entryPoints: ['codemirror.entry.js'], bundle: true, minify: true, format: 'iife', globalName: 'CodeMirror',
  target: 'es2022', legalComments: 'none', charset: 'utf8',
};

// The packages that the bundle holds code of, as esbuild counts them.
const { metafile } = await build({ ...options, write: false, metafile: true });
const bundled = Object.values(metafile.outputs)[0].inputs;
const packages = new Set();
for (const [path, { bytesInOutput }] of Object.entries(bundled)) {
  const [, name] = path.match(/node_modules\/((?:@[^/]+\/)?[^/]+)\//) || [];
  if (name && bytesInOutput > 0) packages.add(name);
}

// One notice for packages of the same licence text.
const notices = new Map();
for (const name of [...packages].sort()) {
  const folder = `node_modules/${name}`;
  const { version, license } = JSON.parse(readFileSync(`${folder}/package.json`, 'utf8'));
  if (license !== 'MIT' || !existsSync(`${folder}/LICENSE`)) throw new Error(`${name}: check its licence (${license})`);
  const text = readFileSync(`${folder}/LICENSE`, 'utf8').trim();
  notices.set(text, [...(notices.get(text) || []), `${name} ${version}`]);
}
const licence = [...notices].map(([text, names]) => `${names.join(', ')}\n\n${text}`).join('\n\n----\n\n');
writeFileSync('codemirror.LICENSE', `${licence}\n`);
await build({ ...options, outfile: 'codemirror.min.js', banner: { js: `/* CodeMirror, https://codemirror.net\n\n${licence}\n*/` } });
