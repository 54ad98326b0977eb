// Bundles what the report's page has of other people: three.js and uPlot, each with its licence notice.
//
// `node_modules => three.min.js, uplot.min.js, uplot.min.css, licences`. See README.md.
import { readFileSync, writeFileSync, copyFileSync } from 'node:fs';
import { build } from 'esbuild';

// Parts of three.js that nothing here draws with: physical materials, environment maps, virtual
// reality. Their shaders and classes are left empty; a page that used one would show nothing of it.
const EMPTY_SHADERS = /ShaderLib\/(background|backgroundCube|cube|equirect|distance|depth|meshmatcap|meshnormal|meshphysical|meshtoon|points|shadow|sprite|vsm|linedashed)\.glsl\.js$/;
const EMPTY_CHUNKS = /ShaderChunk\/(lights_physical_\w+|transmission_\w+|iridescence_\w+|cube_uv_reflection_fragment|envmap_physical_pars_fragment|lights_toon_\w+|clearcoat_\w+|shadowmap_\w+|shadowmask_pars_fragment|morph\w+|skin\w+|bumpmap_\w+|displacementmap_\w+)\.glsl\.js$/;
const EMPTY_CLASSES = new Map([
  ['WebXRManager.js', `import { EventDispatcher } from '../../core/EventDispatcher.js';
    export class WebXRManager extends EventDispatcher {
      enabled = false; isPresenting = false; cameraAutoUpdate = false;
      getCamera() { return null; } getFoveation() { return 0; } getDepthSensingMesh() { return null; }
      hasDepthSensing() { return false; } getEnvironmentBlendMode() { return null; } setAnimationLoop() {} dispose() {} }`],
  ['PMREMGenerator.js', 'export class PMREMGenerator { dispose() {} }'],
  ['DFGLUTData.js', 'export function getDFGLUT() { return null; } export const DFGLUTData = null;'],
  ['WebGLShadowMap.js', 'export class WebGLShadowMap { enabled = false; type = 0; render() {} }'],
]);

const slim = {
  name: 'slim',
  setup(bundler) {
    bundler.onResolve({ filter: /^three$/ }, () => ({ path: new URL('three.controls.js', import.meta.url).pathname }));
    bundler.onLoad({ filter: /\.glsl\.js$/ }, ({ path }) => {
      const source = readFileSync(path, 'utf8');
      const contents = EMPTY_SHADERS.test(path) || EMPTY_CHUNKS.test(path)
        ? source.replace(/`[^`]*`/g, '``')
        : source.replace(/`[^`]*`/g, (text) => text
          .replace(/\/\*[^]*?\*\//g, '').replace(/\/\/[^\n`]*/g, '')
          .replace(/[ \t]+/g, ' ').replace(/ ?\n[ \n]*/g, '\n')
          .replace(/^[^#\n].*$/gm, (line) => line.replace(/ ?([=+*\/<>,;(){}?:&|!-]) ?/g, '$1')));
      return { contents };
    });
    bundler.onLoad({ filter: /three\/src\/.*\.js$/ }, ({ path }) => {
      const contents = EMPTY_CLASSES.get(path.split('/').pop());
      return contents === undefined ? undefined : { contents };
    });
  },
};

const version = (name) => JSON.parse(readFileSync(`node_modules/${name}/package.json`, 'utf8')).version;
const notice = (name, url) => `/* ${name} ${version(name)}, ${url}\n\n${readFileSync(`node_modules/${name}/LICENSE`, 'utf8').trim()}\n*/`;
await build({
  entryPoints: ['three.entry.js'], outfile: 'three.min.js', bundle: true, minify: true, format: 'iife',
  globalName: 'THREE', target: 'es2022', legalComments: 'none', banner: { js: notice('three', 'https://threejs.org') },
  plugins: [slim],
});
copyFileSync('node_modules/three/LICENSE', 'three.LICENSE');

const uplot = 'node_modules/uplot';
const plots = readFileSync(`${uplot}/dist/uPlot.iife.min.js`, 'utf8').replace(/^\/\*!.*\*\/\n/, '');
writeFileSync('uplot.min.js', `${notice('uplot', 'https://github.com/leeoniya/uPlot')}\n${plots}`);
writeFileSync('uplot.min.css', readFileSync(`${uplot}/dist/uPlot.min.css`));
copyFileSync(`${uplot}/LICENSE`, 'uplot.LICENSE');
