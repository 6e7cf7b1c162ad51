// A scene that is computed while it is shown: the first moment is read as a film is, then the engine moves its vertices.
'use strict';

class LiveFilm {
  constructor(gltf, session) {
    this.session = session;
    this.scene = gltf.scene;
    this.around = gltf.scene.userData.taut;  // light, background, ground, camera
    this.camera = gltf.cameras[0];
    this.target = new THREE.Vector3(...this.around.camera.target[0]);  // [m] that the camera looks at
    this.shapes = [];
    this.scene.traverse((node) => { if (node.isMesh) this.shapes.push({mesh: node}); });
    this.meshOf = new Map(this.shapes.map(({mesh}) => [mesh.name, mesh]));
    for (const {mesh} of this.shapes) mesh.frustumCulled = false;  // the bounds known of it are those at first
    this.scene.updateMatrixWorld(true);
    this.show(1);
  }

  // Between the last two ticks, by a share of 0 … 1. False: there is something that the first moment lacked.
  show(share) {
    const {camera, parts, fits} = this.session.frame(share);
    if (!fits) return false;
    for (const part of parts) {
      const mesh = this.meshOf.get(part.name);
      if (part.triangles) this.reshape(mesh, part);
      else if (part.positions) this.move(mesh, part);
      mesh.position.set(...part.translation);
      mesh.quaternion.set(...part.rotation);
    }
    this.camera.position.set(...camera.eye);
    this.camera.up.set(...camera.up);
    this.camera.lookAt(this.target.set(...camera.target));
    this.camera.fov = camera.fieldOfView * 180 / Math.PI;
    this.scene.updateMatrixWorld(true);
    return true;
  }

  move(mesh, part) {
    for (const name of ['position', 'normal']) {
      const attribute = mesh.geometry.attributes[name];
      attribute.array.set(part[name + 's']);
      attribute.needsUpdate = true;
    }
  }

  // Cloth that was torn has other triangles.
  reshape(mesh, part) {
    const geometry = new THREE.BufferGeometry();
    geometry.setIndex(new THREE.BufferAttribute(part.triangles.slice(), 1));
    const {positions, normals, uv} = part;
    for (const [name, array, size] of [['position', positions, 3], ['normal', normals, 3], ['uv', uv, 2]]) {
      const attribute = array ? new THREE.BufferAttribute(array.slice(), size) : mesh.geometry.attributes[name];
      if (attribute) geometry.setAttribute(name, attribute);
    }
    mesh.geometry.dispose();
    mesh.geometry = geometry;
  }

  // Where everything visible is now [m].
  bounds() {
    const box = new THREE.Box3(), own = new THREE.Box3();
    for (const {mesh} of this.shapes)
      if (mesh.visible) box.union(own.setFromBufferAttribute(mesh.geometry.attributes.position).applyMatrix4(mesh.matrixWorld));
    return box;
  }
}

function readLive(session, aspect) {
  return new Promise((resolve, reject) => {
    const bytes = session.glb(aspect);
    new THREE.GLTFLoader().parse(bytes.buffer, '', (gltf) => resolve(new LiveFilm(gltf, session)), reject);
  });
}
