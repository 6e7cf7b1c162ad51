// The shipped scenes and scenarios as the module takes them, in node and in browsers.
const folders = ['models', 'textures', 'scenes', 'scenarios'];

// read(path): the bytes of a file below assets/.
export async function filesFrom(list, read) {
  const wanted = list.filter((path) => folders.includes(path.split('/')[0]));
  return Object.fromEntries(await Promise.all(wanted.map(async (path) => [path, await read(path)])));
}

// The state hash of a scene after each tick, from 0 on.
export function hashesOf(World, path, files, ticks) {
  const world = new World(new TextDecoder().decode(files[path]), files, {name: path});
  const hashes = [world.hash, ...world.hashes(ticks)];
  world.free();
  return hashes;
}
