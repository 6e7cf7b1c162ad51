// The film in the page: what is in it, and where that is at a time. It draws nothing.
'use strict';

function filmBytes() {
  const element = document.getElementById('film');
  const text = atob(element.textContent);
  element.textContent = '';  // it is no longer needed, and large
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}

// Something whose vertices move: it has the places of all keys, and shows those of one time.
class MovingShape {
  // `weights`: which target counts at each key; none: it does not change shape.
  constructor(mesh, weights) {
    const loaded = mesh.geometry, targets = loaded.morphAttributes;
    this.mesh = mesh;
    this.first = {position: loaded.attributes.position.array, normal: loaded.attributes.normal.array};
    this.targets = {};
    this.targetOf = null;
    if (!targets.position) return;
    for (const name of ['position', 'normal']) this.targets[name] = targets[name].map((attribute) => attribute.array);
    this.targetOf = weights ? keysOf(weights, targets.position.length) : null;
    // Vertices are moved here, not by morph targets on the graphics card, which has room for 256 of them at most.
    const geometry = new THREE.BufferGeometry();
    geometry.setIndex(loaded.index);
    geometry.setAttribute('uv', loaded.attributes.uv);
    for (const name of ['position', 'normal'])
      geometry.setAttribute(name, new THREE.BufferAttribute(this.first[name].slice(), 3));
    mesh.geometry = geometry;
    delete mesh.morphTargetInfluences;
    delete mesh.morphTargetDictionary;
  }

  // Between key and key + 1, by a share of 0 … 1.
  show(key, share) {
    if (!this.targetOf) return;
    const a = this.targetOf[key], b = this.targetOf[Math.min(key + 1, this.targetOf.length - 1)];
    for (const name of ['position', 'normal']) {
      const first = this.first[name], from = this.targets[name][a], to = this.targets[name][b];
      const attribute = this.mesh.geometry.attributes[name], out = attribute.array;
      for (let i = 0; i < out.length; ++i) {
        const start = from ? from[i] : 0;
        out[i] = first[i] + (share > 0 ? start + share * ((to ? to[i] : 0) - start) : start);
      }
      attribute.needsUpdate = true;
    }
  }

  // Grows `box` by all that is ever reached, in the frame of the world where the node rests.
  addTo(box) {
    const point = new THREE.Vector3(), first = this.first.position;
    const add = (delta) => {
      for (let i = 0; i < first.length; i += 3) {
        point.set(first[i], first[i + 1], first[i + 2]);
        if (delta) point.set(point.x + delta[i], point.y + delta[i + 1], point.z + delta[i + 2]);
        box.expandByPoint(point.applyMatrix4(this.mesh.matrixWorld));
      }
    };
    add(null);
    for (const delta of this.targets.position || []) add(delta);
  }
}

// The target that counts at each key, -1 for the shape at first.
function keysOf(track, targets) {
  const keys = [];
  for (let start = 0; start < track.values.length; start += targets)
    keys.push(track.values.subarray(start, start + targets).indexOf(1));
  return keys;
}

class Film {
  constructor(gltf) {
    this.scene = gltf.scene;
    this.around = gltf.scene.userData.taut;  // light, background, ground, camera
    this.camera = gltf.cameras[0];
    this.target = new THREE.Vector3();  // [m] that the camera looks at
    this.shapes = [];
    this.times = [0];
    const tracks = gltf.animations.length > 0 ? gltf.animations[0].tracks : [];
    if (tracks.length > 0) this.times = tracks[0].times;
    const weights = new Map();
    const poses = [];
    for (const track of tracks) {
      const [node, what] = track.name.split('.');
      if (what === 'morphTargetInfluences') weights.set(node, track);
      else poses.push(track);
    }
    const meshes = [];
    this.scene.traverse((node) => { if (node.isMesh) meshes.push(node); });
    for (const mesh of meshes) {
      const track = weights.get(mesh.name);
      this.shapes.push(new MovingShape(mesh, track));
      mesh.frustumCulled = false;  // the bounds known of it are those at first
    }
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

function readFilm() {
  return new Promise((resolve, reject) => {
    new THREE.GLTFLoader().parse(filmBytes(), '', (gltf) => resolve(new Film(gltf)), reject);
  });
}
