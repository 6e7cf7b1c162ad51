// A cloth that lies flat in the air, held by two corners, and swings down, in node. Nothing damps it, so that the sum
// of the energies stays. `node hello.mjs` where taut-engine is installed, or `node hello.mjs FOLDER/taut.mjs`.
const {load, TautError} = await import(process.argv[2] ?? 'taut-engine');

const scene = `
schema = 1
[solver]
safety = 0.5                     # half of the largest step that is stable
[material.silk]
density_kg_per_m2 = 0.1
stretch_N_per_m = 100.0
damping_time_s = 0.0
drag_per_s = 0.0
[cloth.scarf]
size = [1.0, 1.0]
cells = [16, 16]
origin = [0.0, 2.0, 0.0]         # the top left corner; y is up
down = [0.0, 0.0, 1.0]
hold = ["top-left", "top-right"]
material = "silk"
`;

const world = await load(scene);
console.log('time [s]   lowest corner [m]          kinetic  elastic  gravitational   sum [J]');
while (world.time < 1) {
  const [x, y, z] = world.positions('cloth.scarf@bottom-left');
  const {kinetic, elastic, gravitational, energy} = world.metrics();
  const numbers = [world.time, x, y, z, kinetic, elastic, gravitational, energy];
  console.log(numbers.map((number) => number.toFixed(4).padStart(9)).join(' '));
  world.step(10);
}

const state = world.save();  // bytes: of a file, of another machine
world.apply({do: 'push', target: 'cloth.scarf', impulse_Ns: [0, 0.5, 0]});
world.step(30);
world.restore(state);
console.log(`back at tick ${world.tick}, hash ${world.hash}`);

try {
  await load(scene.replace('cells', 'cels'), {}, {name: 'scarf.toml'});
} catch (error) {
  if (!(error instanceof TautError)) throw error;
  console.log(`${error.kind}: ${error.message}`);
}
