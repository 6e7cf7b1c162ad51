// The module in node: `node node_test.mjs PROGRAM PACKAGE ASSETS PYTHON-MODULE`. Hashes of every tick of every shipped
// scene and scenario are the program's; states and tapes of one side go on on the other; faults have the program's words.
import assert from 'node:assert/strict';
import {execFileSync, spawnSync} from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import {filesFrom, hashesOf} from './assets.mjs';

const [program, packageFolder, assets, pythonModule] = process.argv.slice(2);
const taut = await import(path.join(packageFolder, 'taut.mjs'));
const {start, World, Session, TautError, recordTape, replayTape} = taut;
await start();
process.chdir(fs.mkdtempSync(path.join(os.tmpdir(), 'taut-web-')));

const list = fs.readdirSync(assets, {recursive: true}).filter((file) => fs.statSync(path.join(assets, file)).isFile());
const files = await filesFrom(list, (file) => fs.promises.readFile(path.join(assets, file)));
const run = (command, ...words) => execFileSync(command, words, {encoding: 'utf8', maxBuffer: 1 << 26});
const textOf = (file) => new TextDecoder().decode(files[file]);
const shipped = (name) => new World(textOf(`scenes/${name}.toml`), files, {name: `scenes/${name}.toml`});

// What the program says of each tick: lines "TICK HASH".
function hashesByProgram(file) {
  const told = run(program, 'render', file, '--no-pictures', '--hash-every', 'tick', '--threads', '1', '--quiet');
  return told.split('\n').map((line) => /^\d+ ([0-9a-f]{16})$/.exec(line)?.[1]).filter(Boolean);
}

const tests = {
  'every tick of every shipped scene and scenario has the hash of the program'() {
    const expected = {};
    for (const file of Object.keys(files).filter((name) => name.endsWith('.toml'))) {
      const wanted = expected[file] = hashesByProgram(path.join(assets, file));
      assert(wanted.length > 10, file);
      const hashes = hashesOf(World, file, files, wanted.length - 1);
      const off = hashes.findIndex((hash, tick) => hash !== wanted[tick]);
      assert.equal(off, -1, `${file}: tick ${off}: ${hashes[off]}, by the program ${wanted[off]}`);
    }
    // For the browser's test.
    fs.writeFileSync(path.join(packageFolder, '..', 'hashes.json'), JSON.stringify(expected));
  },

  'a state that Python saved goes on, and one that was saved here goes on in Python'() {
    const python = (code) => execFileSync('/usr/bin/python3', ['-B', '-c', code],
                                          {encoding: 'utf8', env: {...process.env, PYTHONPATH: pythonModule}}).trim();
    const loaded = `import taut\nw = taut.load(${JSON.stringify(path.join(assets, 'scenes/cape.toml'))})\n`;
    const straight = python(`${loaded}w.step(20); open("state", "wb").write(w.save()); w.step(10); print(w.hash)`);
    const world = shipped('cape');
    world.restore(fs.readFileSync('state'));
    assert.equal(world.tick, 20);
    world.step(10);
    assert.equal(world.hash, straight);

    const other = shipped('cape');
    other.step(20);
    fs.writeFileSync('state', other.save());
    assert.equal(python(`${loaded}w.restore(open("state", "rb").read()); w.step(10); print(w.hash)`), straight);
  },

  async 'a tape that the program recorded agrees here, and one that was recorded here agrees with the program'() {
    run(program, 'record', path.join(assets, 'scenes/net.toml'), '--seconds', '0.3', '--quiet', '-o', 'run.tape');
    assert.deepEqual(await replayTape(fs.readFileSync('run.tape'), files), {ticks: 17, difference: null});
    const file = path.join(assets, 'scenes/net.toml');
    fs.writeFileSync('own.tape', await recordTape(textOf('scenes/net.toml'), 12, {}, {name: file}));
    assert.match(run(program, 'replay', 'own.tape', '--quiet', '--verify'), /^the same state at all 12 ticks/m);
    const damaged = fs.readFileSync('own.tape');
    damaged[damaged.length - 9] ^= 1;
    await assert.rejects(replayTape(damaged), {kind: 'badContent'});
  },

  'what a hand did is a scenario that the program plays to the same hash'() {
    const session = new Session(textOf('scenes/flag.toml'), files, {name: 'shipped:flag'});
    session.step(6);
    assert.equal(session.grab(0.02, 0.02, 1.5), null);
    const picked = session.grab(0.5, 0.4, 1.5);
    assert.match(picked.target, /^cloth\.flag@#\d+$/);
    for (let i = 0; i < 12; ++i) {
      session.lead(0.5 + 0.01 * i, 0.4, 1.5);
      session.step();
    }
    session.set('wind.breeze.velocity', [1, 0, 0], 0.1);
    session.release();
    session.step(4);
    const record = session.record();
    fs.writeFileSync('played.toml', record.text);
    assert.equal(hashesByProgram('played.toml')[record.tick], record.hash);
  },

  'a frame has the vertices of the GLB and moves them'() {
    const session = new Session(textOf('scenes/flag.toml'), files);
    const glb = session.glb();
    const size = new DataView(glb.buffer).getUint32(12, true);
    const json = JSON.parse(new TextDecoder().decode(glb.subarray(20, 20 + size)));
    const mesh = json.meshes.find((each) => each.name === 'cloth_flag');
    const vertices = json.accessors[mesh.primitives[0].attributes.POSITION].count;
    session.step(30);
    const {parts, fits} = session.frame(1);
    assert(fits);
    const moved = parts.filter((part) => part.positions);
    assert.deepEqual(moved.map((part) => part.name), ['cloth_flag']);
    assert.equal(moved[0].positions.length, 3 * vertices);
    assert.equal(session.frame(1).parts.filter((part) => part.positions).length, 0);
  },

  'faults have the words of the program'() {
    const bad = 'schema = 1\n[cloth.a]\nsiz = 3\n';
    fs.writeFileSync('bad.toml', bad);
    const told = spawnSync(program, ['check', 'bad.toml'], {encoding: 'utf8'}).stderr;
    assert.throws(() => new World(bad, {}, {name: 'bad.toml'}),
                  (error) => error instanceof TautError && error.kind === 'badContent' && told.includes(error.message));
    const world = shipped('flag');
    assert.throws(() => world.apply({do: 'ramp', key: 'wind.none.velocity', to: [1, 0, 0]}), /there is no wind "none"/);
    assert.throws(() => world.positions('cloth.flg'), /did you mean/);
    world.free();
    assert.throws(() => world.step(), {kind: 'usage'});
  },

  'an hour of play takes no more memory than a minute'() {
    const session = new Session(`schema = 1
[run]
fps = 60
[solver]
dt = 2e-3
[cloth.sail]
size = [1.0, 0.8]
cells = [6, 5]
origin = [-0.5, 1.5, 0.0]
hold = ["top-left", "top-right"]
material = "fabric:nylon"
[wind.breeze]
velocity = [2.0, 0.0, 1.0]
gust = { amplitude = 1.0, period_s = 1.3, seed = 7 }
[camera.main]
eye = [0.0, 1.1, 2.5]
target = [0.0, 1.1, 0.0]
`);
    session.glb();
    let grabs = 0;
    const play = (ticks) => {
      for (let i = 0; i < ticks; i += 50) {
        if (session.grab(0.5, 0.45, 1.5)) ++grabs;
        session.step(25);
        session.frame(0.5);
        session.release();
        session.step(25);
        session.metrics();
      }
    };
    play(3600);
    const before = process.memoryUsage();
    play(200000);
    const after = process.memoryUsage();
    assert(grabs > 1000, `${grabs}`);
    // The engine's memory, 32 MB, grows by a fifth; what it keeps of 8000 deeds has room within that.
    assert(after.external - before.external < 2 * 6.4e6, `${before.external} ${after.external}`);
    session.free();
  },

  'the sample for node runs'() {
    const told = run('node', path.join(assets, '../game/samples/web/hello.mjs'), path.join(packageFolder, 'taut.mjs'));
    const energies = [...told.matchAll(/^ *\d.* ([\d.-]+)$/gm)].map((match) => Number(match[1]));
    assert(energies.length > 5);
    // Nothing damps it: half of the largest stable step keeps the sum within some per cent of the energy of its motion.
    for (const energy of energies) assert(Math.abs(energy - energies[0]) < 0.03, told);
  },
};

for (const [name, test] of Object.entries(tests)) {
  const begin = performance.now();
  await test();
  console.log(`${name}: ${((performance.now() - begin) / 1000).toFixed(1)} s`);
}
