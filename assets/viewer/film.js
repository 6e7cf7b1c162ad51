// The film in the page: what is in it, and where that is at a time. It draws nothing.
'use strict';

// (targets) (numbers) whole numbers of steps from the first shape, as addMoves() of glb_writer.cpp packs them.
function movesIn(bytes, count) {
  const targets = [], changes = new Int16Array(count);
  let before = new Int16Array(count);
  for (let low = 0; low < bytes.length; low += 2 * count) {
    const now = new Int16Array(count);
    for (let i = 0; i < count; ++i) {
      const kept = bytes[low + i] | bytes[low + count + i] << 8;
      changes[i] = ((kept >> 1) ^ -(kept & 1)) + (i < 3 ? 0 : changes[i - 3]);
      now[i] = before[i] + changes[i];
    }
    targets.push(before = now);
  }
  return targets;
}

// Something whose vertices move: it has the places of all keys, and shows those of one time.
class MovingShape {
  constructor(mesh) {
    const loaded = mesh.geometry;
    this.mesh = mesh;
    this.first = loaded.attributes.position.array;
    this.targets = [];
    this.targetOf = null;   // (keys) 0 is the first shape; null: it does not change shape
    if (!mesh.userData.taut) return;
    // Vertices are moved here, not by morph targets on the graphics card, which has room for 256 of them at most.
    const {step, moves, targetOf} = mesh.userData.taut;
    Object.assign(this, {step, targetOf, targets: movesIn(moves, this.first.length)});  // step: [m]
    const geometry = new THREE.BufferGeometry();
    geometry.setIndex(loaded.index);
    if (loaded.attributes.uv) geometry.setAttribute('uv', loaded.attributes.uv);
    for (const name of ['position', 'normal'])
      geometry.setAttribute(name, new THREE.BufferAttribute(loaded.attributes[name].array.slice(), 3));
    mesh.geometry = geometry;
    this.findSmooth(loaded.attributes.normal.array);
  }

  // Vertices that are at first at one place with one normal have a normal in common ever after.
  findSmooth(normals) {
    const known = new Map();
    this.smoothOf = new Uint32Array(this.first.length / 3);
    for (let i = 0; i < this.smoothOf.length; ++i) {
      const key = [...this.first.subarray(3 * i, 3 * i + 3), ...normals.subarray(3 * i, 3 * i + 3)].join();
      if (!known.has(key)) known.set(key, known.size);
      this.smoothOf[i] = known.get(key);
    }
    this.sums = new Float32Array(3 * known.size);
  }

  // Between key and key + 1, by a share of 0 … 1.
  show(key, share) {
    if (!this.targetOf) return;
    const {first, targets, targetOf} = this, attribute = this.mesh.geometry.attributes.position;
    const a = targetOf[key], b = targetOf[Math.min(key + 1, targetOf.length - 1)];
    const out = attribute.array;
    out.set(first);
    for (const [target, part] of [[a, 1 - share], [b, share]]) {
      if (target === 0 || part === 0) continue;
      const moves = targets[target - 1], step = part * this.step;
      for (let i = 0; i < out.length; ++i) out[i] += step * moves[i];
    }
    attribute.needsUpdate = true;
    this.shade();
  }

  // Normals: of the triangles around, by their areas.
  shade() {
    const {index, attributes: {position: {array: x}, normal}} = this.mesh.geometry, {smoothOf, sums} = this;
    sums.fill(0);
    for (let t = 0; t < index.array.length; t += 3) {
      const [a, b, c] = [3 * index.array[t], 3 * index.array[t + 1], 3 * index.array[t + 2]];
      const ux = x[b] - x[a], uy = x[b + 1] - x[a + 1], uz = x[b + 2] - x[a + 2];
      const vx = x[c] - x[a], vy = x[c + 1] - x[a + 1], vz = x[c + 2] - x[a + 2];
      for (const corner of [a, b, c]) {
        const at = 3 * smoothOf[corner / 3];
        sums[at] += uy * vz - uz * vy;
        sums[at + 1] += uz * vx - ux * vz;
        sums[at + 2] += ux * vy - uy * vx;
      }
    }
    for (let i = 0; i < smoothOf.length; ++i) {
      const at = 3 * smoothOf[i], length = Math.hypot(sums[at], sums[at + 1], sums[at + 2]);
      if (length > 0) normal.setXYZ(i, sums[at] / length, sums[at + 1] / length, sums[at + 2] / length);
    }
    normal.needsUpdate = true;
  }

  // Grows `box` by all that is ever reached, in the frame of the world where the node rests.
  addTo(box) {
    const point = new THREE.Vector3(), {first, step} = this;
    const add = (moves) => {
      for (let i = 0; i < first.length; i += 3) {
        point.set(first[i], first[i + 1], first[i + 2]);
        if (moves) point.set(point.x + step * moves[i], point.y + step * moves[i + 1], point.z + step * moves[i + 2]);
        box.expandByPoint(point.applyMatrix4(this.mesh.matrixWorld));
      }
    };
    add(null);
    this.targets.forEach(add);
  }
}

class Film {
  constructor(gltf) {
    this.scene = gltf.scene;
    this.around = gltf.scene.userData.taut;  // light, background, ground, camera, times
    this.camera = gltf.cameras[0];
    this.target = new THREE.Vector3();  // [m] that the camera looks at
    this.shapes = [];
    this.times = this.around.times;
    const poses = gltf.animations.length > 0 ? gltf.animations[0].tracks : [];
    this.scene.traverse((node) => { if (node.isMesh) this.shapes.push(new MovingShape(node)); });
    for (const {mesh} of this.shapes) mesh.frustumCulled = false;  // the bounds known of it are those at first
    this.mixer = new THREE.AnimationMixer(this.scene);
    this.action = poses.length > 0 ? this.mixer.clipAction(new THREE.AnimationClip('poses', -1, poses)) : null;
    if (this.action) this.action.play();
    this.show(0);
  }

  get duration() { return this.times[this.times.length - 1]; }  // [s]

  // The last key at or before a time.
  keyAt(time) {
    let low = 0, high = this.times.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.times[middle] <= time) low = middle; else high = middle - 1;
    }
    return low;
  }

  show(time) {
    const key = this.keyAt(time), from = this.times[key], to = this.times[key + 1];
    const share = to > from ? Math.min((time - from) / (to - from), 1) : 0;
    for (const shape of this.shapes) shape.show(key, share);
    if (this.action) {
      this.action.time = time;
      this.mixer.update(0);
    }
    this.scene.updateMatrixWorld(true);
    const {target, fieldOfView} = this.around.camera, last = target.length - 1;
    const a = Math.min(key, last), b = Math.min(a + 1, last);
    this.target.set(...target[a]).lerp(new THREE.Vector3(...target[b]), share);
    this.camera.fov = (fieldOfView[a] + share * (fieldOfView[b] - fieldOfView[a])) * 180 / Math.PI;
  }

  // All that is ever reached by what is visible [m].
  bounds() {
    const box = new THREE.Box3();
    for (const shape of this.shapes) if (shape.mesh.visible) shape.addTo(box);
    if (!this.action) return box;
    for (let key = 0; key < this.times.length; ++key) {
      this.action.time = this.times[key];
      this.mixer.update(0);
      this.scene.updateMatrixWorld(true);
      for (const shape of this.shapes) {
        if (shape.targetOf || !shape.mesh.visible) continue;
        const geometry = shape.mesh.geometry;
        if (!geometry.boundingBox) geometry.computeBoundingBox();
        box.union(geometry.boundingBox.clone().applyMatrix4(shape.mesh.matrixWorld));
      }
    }
    this.show(0);
    return box;
  }
}

async function readFilm() {
  const bytes = await unpacked('film');
  const gltf = await new Promise((resolve, reject) => new THREE.GLTFLoader().parse(bytes, '', resolve, reject));
  const moving = [];
  gltf.scene.traverse((node) => { if (node.isMesh && node.userData.taut) moving.push(node.userData.taut); });
  for (const own of moving) own.moves = new Uint8Array(await gltf.parser.getDependency('bufferView', own.moves));
  return new Film(gltf);
}
