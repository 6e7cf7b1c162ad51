// taut's engine as WebAssembly, for browsers and node. taut.d.ts says what all of it means.
import makeEngine from './engine.mjs';

export class TautError extends Error {
  constructor({kind, message}) {
    super(message);
    this.name = 'TautError';
    this.kind = kind;
  }
}

let starting = null, engine = null, folders = 0;

async function wasmBeside() {
  const place = new URL('taut.wasm', import.meta.url);
  if (place.protocol === 'file:') return (await import('node:fs/promises')).readFile(place);
  const answer = await fetch(place);
  if (!answer.ok) throw new TautError({kind: 'inputOutput', message: `${place}: ${answer.status}`});
  return answer.arrayBuffer();
}

async function begin(wasm) {
  const said = [];
  const print = (line) => said.push(line);
  const locateFile = (name) => name;  // which is not asked for: the bytes are there
  const made = await makeEngine({wasmBinary: await (wasm ?? wasmBeside()), locateFile, print, printErr: print});
  made.said = said;
  engine = made;
  call('start', {});
}

export function start(wasm) {
  starting ??= begin(wasm).catch((error) => {
    starting = null;
    throw error;
  });
  return starting;
}

const arrays = {Uint8Array, Uint32Array, Float32Array, Float64Array};

function seen(key, value) {
  return value?.array ? new arrays[value.array](engine.HEAPU8.buffer, value.at, value.size) : value;
}

function textWithin(text) {
  const size = engine.lengthBytesUTF8(text) + 1, at = engine._malloc(size);
  engine.stringToUTF8(text, at, size);
  return at;
}

function call(what, given) {
  if (!engine) throw new TautError({kind: 'usage', message: 'the engine has not started: await start() first'});
  engine.said.length = 0;
  let answer;
  try {
    const name = textWithin(what), text = textWithin(JSON.stringify(given));
    const told = engine.UTF8ToString(engine._tautCall(name, text));
    engine._free(name);
    engine._free(text);
    answer = JSON.parse(told, seen);
  } catch (error) {
    // What it promised itself does not hold: its memory is not to be trusted any more.
    const message = [`the engine has stopped: ${error.message}`, ...engine.said].join('\n');
    engine = starting = null;
    throw new TautError({kind: 'internal', message});
  }
  if (answer.error) throw new TautError(answer.error);
  return answer.value;
}

// A call with bytes, which are laid into the engine's memory for it.
function callWith(call, bytes, given) {
  const at = engine._malloc(bytes.length);
  engine.HEAPU8.set(bytes, at);
  try {
    return call({...given, at, size: bytes.length});
  } finally {
    engine?._free(at);
  }
}

// The value as TOML.
function tomlText(value) {
  if (Array.isArray(value)) return `[${value.map(tomlText).join(', ')}]`;
  if (value !== null && typeof value === 'object') {
    const pairs = Object.entries(value).map(([key, each]) => `${JSON.stringify(key)} = ${tomlText(each)}`);
    return `{ ${pairs.join(', ')} }`;
  }
  if (typeof value === 'number') return `${value}`.replace('Infinity', 'inf').replace('NaN', 'nan');
  return JSON.stringify(value);
}

// ["key=value"] as it is, {key: value} as that.
function overridesOf(overrides) {
  if (Array.isArray(overrides)) return overrides;
  return Object.entries(overrides).map(([key, value]) => `${key}=${tomlText(value)}`);
}

// A scene with its files in a folder of its own, which is the engine's working folder then.
function laidOut(text, files = {}, {name = 'scene.toml', overrides = []} = {}) {
  if (!engine) call();  // throws
  const folder = `/scenes/${++folders}`;
  const fs = engine.FS;
  for (const [path, content] of Object.entries(text === null ? files : {...files, [name]: text})) {
    const file = `${folder}/${path}`;
    fs.mkdirTree(file.slice(0, file.lastIndexOf('/')));
    fs.writeFile(file, typeof content === 'string' ? content : new Uint8Array(content));
  }
  fs.mkdirTree(folder);
  fs.chdir(folder);
  return {folder, source: {text, name, overrides: overridesOf(overrides)}};
}

// Something in the engine, with files of its own.
class Held {
  #engine; #folder; #object;

  constructor(kind, text, files, options) {
    const {folder, source} = laidOut(text, files, options);
    this.#engine = engine;
    this.#folder = folder;
    this.#object = call(kind, source);
    this.about = this.call('about');
  }

  call(what, given = {}) {
    if (this.#engine !== engine)
      throw new TautError({kind: 'usage', message: 'the engine of this has stopped; start() makes another'});
    engine.FS.chdir(this.#folder);
    return call(what, {object: this.#object, ...given});
  }

  get tickSeconds() { return this.about.tickSeconds; }
  get ticksPerFrame() { return this.about.ticksPerFrame; }
  get seconds() { return this.about.seconds; }
  get title() { return this.about.title; }
  get bodies() { return (this.about = this.call('about')).bodies; }
  get warnings() { return (this.about = this.call('about')).warnings; }
  get hash() { return this.call('hash'); }
  get tick() { return this.call('moment').tick; }
  get time() { return this.call('moment').time; }

  apply(action) { this.call('apply', {table: typeof action === 'string' ? action : tomlText(action)}); }
  metrics(bodies = '') { return this.call('metrics', {bodies}); }
  free() { this.call('free'); }
}

export class World extends Held {
  constructor(text, files, options) { super('World', text, files, options); }

  step(ticks = 1) { return this.call('step', {ticks}); }
  hashes(ticks) { return this.call('hashes', {ticks}); }
  positions(target) { return this.call('positions', {target}); }
  points(target) { return this.call('points', {target}); }
  check() { return this.call('check'); }
  save() { return this.call('save').slice(); }
  restore(bytes) { callWith((given) => this.call('restore', given), bytes); }
}

export async function load(text, files, options) {
  await start();
  return new World(text, files, options);
}

export async function recordTape(text, ticks, files, options) {
  await start();
  return call('recordTape', {...laidOut(text, files, options).source, ticks}).slice();
}

export async function replayTape(bytes, files) {
  await start();
  laidOut(null, files);
  return callWith((given) => call('replayTape', given), bytes);
}

export class Session extends Held {
  constructor(text, files, options) { super('Session', text, files, options); }

  #last = null;
  #moment() { return this.#last ??= this.call('moment'); }

  advance(wall, speed = 1, budget = 0.031) { return (this.#last = this.call('advance', {wall, speed, budget})); }
  step(ticks = 1) { return (this.#last = this.call('step', {ticks})); }
  get tick() { return this.#moment().tick; }
  get time() { return this.#moment().time; }
  get divergence() { return this.#moment().divergence; }
  frame(share) { return this.call('frame', {share}); }
  glb(aspect) { return this.call('glb', {aspect}).slice(); }
  pick(x, y, aspect, camera) { return this.call('pick', {x, y, aspect, camera}); }
  grab(x, y, aspect, camera) { return this.call('grab', {x, y, aspect, camera}); }
  lead(x, y, aspect, camera) { this.call('lead', {x, y, aspect, camera}); }
  release() { this.call('release'); }
  set(key, value, over_s = 0) { this.apply({do: 'ramp', key, to: value, over_s}); }
  get solver() { return this.call('solver'); }
  rampable() { return this.call('rampable'); }
  record(scene) {
    this.#last = null;
    return this.call('record', {scene});
  }
}
