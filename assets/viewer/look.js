// How it looks: cloth, ground and sky in taut's own light, drawn by three.js.
'use strict';

const skyMargin = 0.8;  // [m] how far things darken the ground around them

function shader(vertexShader, fragmentShader, uniforms, more = {}) {
  for (const name of Object.keys(uniforms)) uniforms[name] = {value: uniforms[name]};
  return new THREE.RawShaderMaterial({vertexShader, fragmentShader, uniforms, ...more});
}

// Upright, seen from +z.
function square(half) {
  const geometry = new THREE.BufferGeometry();
  const corners = [-half, -half, 0, half, -half, 0, -half, half, 0, half, half, 0];
  geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(corners), 3));
  geometry.setIndex([0, 1, 3, 0, 3, 2]);
  return geometry;
}

// To draw into and to read from; `filter` is what lies between its texels.
function drawnMap(texels, filter) {
  return new THREE.WebGLRenderTarget(texels, texels, {minFilter: filter, magFilter: filter});
}

const vector = (numbers) => new THREE.Vector3(...numbers);

class Picture {
  constructor(canvas, context, film) {
    this.film = film;
    this.renderer = new THREE.WebGLRenderer({canvas, context});
    this.scene = new THREE.Scene();
    this.scene.add(film.scene);
    this.camera = film.camera.clone();
    const {light, background, ground} = film.around;
    this.light = {
      lightWay: vector(light.direction).normalize().negate(), lightColour: vector(light.colour).divideScalar(Math.PI),
      skyLight: vector(light.sky), groundLight: vector(light.ground), ...this.shadowFrom(light),
    };
    this.around = [];
    this.views = [];
    this.addSky(background);
    if (ground) this.addGround(ground, background);
    for (const {mesh} of film.shapes) mesh.material = this.materialOf(mesh.material);
    this.resize();
  }

  // What the shaders want to know of the shadow map, and the map: it holds all that moves, wherever it goes.
  shadowFrom(light) {
    for (const {mesh} of this.film.shapes) mesh.visible = mesh.name !== 'ground';  // there is an endless one
    const box = this.film.bounds(), corner = new THREE.Vector3(), seen = new THREE.Box3();
    if (box.isEmpty()) box.expandByPoint(this.film.target);
    const sun = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 1);
    sun.up.set(0, Math.abs(light.direction[1]) > 0.99 * Math.hypot(...light.direction) ? 0 : 1, 0);
    if (sun.up.y === 0) sun.up.x = 1;
    sun.lookAt(vector(light.direction));
    sun.updateMatrixWorld(true);
    const ends = [box.min, box.max];
    const toSun = new THREE.Matrix4().copy(sun.matrixWorld).transpose();  // a rotation alone
    for (let i = 0; i < 8; ++i)
      seen.expandByPoint(corner.set(ends[i & 1].x, ends[i >> 1 & 1].y, ends[i >> 2].z).applyMatrix4(toSun));
    seen.expandByScalar(0.02 * seen.getSize(corner).length() + 0.01);
    Object.assign(sun, {left: seen.min.x, right: seen.max.x, bottom: seen.min.y, top: seen.max.y, near: -seen.max.z});
    sun.far = -seen.min.z;
    sun.updateProjectionMatrix();
    this.sun = sun;
    this.map = drawnMap(shadowTexels, THREE.NearestFilter);
    this.depth = shader(depthVertex, depthFragment, {}, {side: THREE.DoubleSide});
    const toMap = new THREE.Matrix4().set(0.5, 0, 0, 0.5, 0, 0.5, 0, 0.5, 0, 0, 0.5, 0.5, 0, 0, 0, 1);
    toMap.multiply(sun.projectionMatrix).multiply(toSun);
    this.box = box;
    return {
      shadowMap: this.map.texture, toMap, toLight: new THREE.Matrix3().setFromMatrix4(toSun),
      mapSize: seen.getSize(new THREE.Vector3()), softness: light.softness,
    };
  }

  materialOf(loaded) {
    const finish = loaded.userData.taut, picture = loaded.map || null;
    // The shader decodes it, in whatever words a release has for that.
    if (picture) Object.assign(picture, {encoding: 3000, colorSpace: '', anisotropy: 8, needsUpdate: true});
    return shader(surfaceVertex, surfaceFragment, {
      ...this.light, front: vector(loaded.color.toArray()), back: vector(finish.back), accent: vector(finish.accent),
      pattern: picture ? 4 : ['plain', 'checker', 'stripes', 'tartan'].indexOf(finish.pattern) % 4,
      isTwoSided: loaded.side === THREE.DoubleSide, repeat: finish.repeat, weave: finish.weave, thread: finish.thread,
      sheen: finish.sheen, translucency: loaded.side === THREE.DoubleSide ? finish.translucency : 0,
      roughness: loaded.roughness, anisotropy: finish.anisotropy || 0, picture,
    }, {side: loaded.side});
  }

  addSky(background) {
    const material = shader(skyVertex, skyFragment, {
      ...this.light, top: vector(background.top), horizon: vector(background.horizon),
    }, {depthWrite: false, depthTest: false});
    this.addAround(square(1), material).renderOrder = -1;
  }

  // Maps of what stands over the ground, seen from below and from above, and of what that hides of the sky.
  hiddenOver(ground) {
    const {min, max} = this.box, low = [min.x - skyMargin, min.z - skyMargin];
    const size = [max.x + skyMargin - low[0], max.z + skyMargin - low[1]], height = Math.max(...size);
    this.views = [1, -1].map((way) => {
      const camera = new THREE.Camera();  // x and z of the world to the right and up, its y ahead or towards the eye
      camera.projectionMatrix.set(
        2 / size[0], 0, 0, -1 - 2 * low[0] / size[0],
        0, 0, 2 / size[1], -1 - 2 * low[1] / size[1],
        0, way * 2 / height, 0, -way * (1 + 2 * ground.height / height),
        0, 0, 0, 1);
      return {camera, map: drawnMap(skyTexels, THREE.NearestFilter)};
    });
    this.hidden = drawnMap(skyTexels, THREE.LinearFilter);
    const material = shader(wholeVertex, hiddenFragment, {
      lowest: this.views[0].map.texture, highest: this.views[1].map.texture, reach: skyMargin,
      extent: new THREE.Vector3(size[0], height, size[1]),
    }, {depthTest: false});
    this.gathering = new THREE.Scene();
    this.gathering.add(new THREE.Mesh(square(1), material));
    return {hidden: this.hidden.texture, hiddenArea: new THREE.Vector4(low[0], low[1], 1 / size[0], 1 / size[1])};
  }

  addGround(ground, background) {
    const {target, camera} = this.film;
    const reach = 2.5 * camera.getWorldPosition(new THREE.Vector3()).distanceTo(target) - 30;  // as fadeOf() has it
    const scale = background.fadesWithCamera ? Math.max(reach / background.fadeEnd, 1) : 1;
    const end = scale * background.fadeEnd;
    const material = shader(groundVertex, groundFragment, {
      ...this.light, ...this.hiddenOver(ground), groundColour: vector(ground.colour),
      horizon: vector(background.horizon), gridSpacing: ground.gridSpacing,
      fade: new THREE.Vector4(target.x, target.z, scale * background.fadeStart, end),
    });
    const plane = this.addAround(square(1.1 * end), material);
    plane.rotation.x = -Math.PI / 2;
    plane.position.set(target.x, ground.height, target.z);
  }

  addAround(geometry, material) {
    const mesh = new THREE.Mesh(geometry, material);
    mesh.frustumCulled = false;
    this.around.push(mesh);
    this.scene.add(mesh);
    return mesh;
  }

  resize() {
    const canvas = this.renderer.domElement;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(canvas.clientWidth, canvas.clientHeight, false);
  }

  // At least as much is seen as the scene's camera sees, up and across.
  fit() {
    const {camera} = this.film, canvas = this.renderer.domElement;
    const aspect = canvas.clientWidth / Math.max(canvas.clientHeight, 1);
    const half = Math.tan(camera.fov * Math.PI / 360) * Math.max(1, camera.aspect / aspect);
    Object.assign(this.camera, {fov: Math.atan(half) * 360 / Math.PI, aspect});
    this.camera.updateProjectionMatrix();
  }

  draw() {
    for (const mesh of this.around) mesh.visible = false;
    this.scene.overrideMaterial = this.depth;
    this.renderer.setClearColor(0xffffff, 1);
    for (const {camera, map} of [{camera: this.sun, map: this.map}, ...this.views]) {
      this.renderer.setRenderTarget(map);
      this.renderer.render(this.scene, camera);
    }
    this.scene.overrideMaterial = null;
    if (this.gathering) {
      this.renderer.setRenderTarget(this.hidden);
      this.renderer.render(this.gathering, this.views[0].camera);
    }
    this.renderer.setRenderTarget(null);
    for (const mesh of this.around) mesh.visible = true;
    this.renderer.render(this.scene, this.camera);
  }
}
