// How it looks: cloth, ground and sky in taut's own light, drawn by three.js.
'use strict';

const skyTexels = 128;
// From fine to coarse: pixels for each of the window, texels of the shadow map, and every how many pictures the sky over
// the ground is looked at.
const finenesses = [
  {pixels: 1, texels: 2048, pause: 1}, {pixels: 0.75, texels: 2048, pause: 2}, {pixels: 0.5, texels: 1024, pause: 4},
  {pixels: 0.35, texels: 1024, pause: 8}, {pixels: 0.25, texels: 512, pause: 16},
];
const skyMargin = 0.8;  // [m] how far things darken the ground around them
const widestNarrow = 0.07, widestReach = 32;  // [rad], [128ths of the map], as lights.h and lights.cpp have them

function bytesOf(base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

// What the page holds in base64 of a gzip file.
async function unpacked(name) {
  const held = document.getElementById(name), bytes = bytesOf(held.textContent);
  held.textContent = '';  // it is no longer needed, and large
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
}

// A shader in the page, with what it includes.
function shaderText(name) {
  return document.getElementById(name).textContent.replace(/^#include "(.*)"$/gm, (_, other) => shaderText(other));
}

function shader(vertex, fragment, uniforms, more = {}) {
  const head = '#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n';
  return new THREE.RawShaderMaterial({vertexShader: head + vertex, fragmentShader: head + fragment, uniforms, ...more});
}

function uniformsOf(values) {
  return Object.fromEntries(Object.entries(values).map(([name, value]) => [name, {value}]));
}

// Whose corners shaders place.
function triangle() {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(9), 3));
  return geometry;
}

function depthMap(texels) {
  const depthTexture = new THREE.DepthTexture(texels, texels, THREE.FloatType);
  return new THREE.WebGLRenderTarget(texels, texels, {depthTexture});
}

const vector = (numbers) => new THREE.Vector3(...numbers);
const four = (three, last = 0) => new THREE.Vector4(...three, last);

class Picture {
  constructor(renderer, film, fineness = finenesses[0]) {
    this.film = film;
    this.renderer = renderer;
    this.fineness = fineness;
    this.drawn = 0;  // pictures
    this.scene = new THREE.Scene();
    this.scene.add(film.scene);
    this.camera = film.camera.clone();
    const {light, background, ground} = film.around;
    this.frame = uniformsOf({  // of shaders/frame.glsl
      viewProjection: new THREE.Matrix4(), toWorld: new THREE.Matrix4(), eye: new THREE.Vector4(),
      lightWay: four(vector(light.direction).normalize().negate().toArray(), 2 * Math.tan(light.softness / 2)),
      lightColour: four(light.colour.map((part) => part / Math.PI), widestReach),
      skyLight: four(light.sky), groundLight: four(light.ground),
      backgroundTop: four(background.top), backgroundHorizon: four(background.horizon), ...this.shadowFrom(light),
    });
    this.kind = ['LAMPS 0', 'LAMP_SHADOWS 0', ...(light.softness > widestNarrow ? ['WIDE'] : [])];
    this.around = [];
    this.views = [];
    this.addAround(triangle(), this.shown('background', 'background', [], {}, {depthWrite: false, depthTest: false}))
      .renderOrder = -1;
    if (ground) this.addGround(ground, background);
    for (const {mesh} of film.shapes) {
      mesh.material = this.materialOf(mesh);
      mesh.visible = mesh.name !== 'ground';  // there is an endless one
    }
    const box = film.bounds();
    this.enclose(box.isEmpty() ? box.expandByPoint(film.target) : box);
    this.resize();
  }

  // What the shaders want to know of the shadow map, and the map, for which enclose() finds the place.
  shadowFrom(light) {
    const sun = this.sun = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 1);
    sun.up.set(0, Math.abs(light.direction[1]) > 0.99 * Math.hypot(...light.direction) ? 0 : 1, 0);
    if (sun.up.y === 0) sun.up.x = 1;
    sun.lookAt(vector(light.direction));
    sun.updateMatrixWorld(true);
    this.map = depthMap(this.fineness.texels);
    this.depth = shader(shaderText('depth.vert'), 'void main() {}', {}, {side: THREE.DoubleSide, colorWrite: false});
    const {depthTexture} = this.map;
    // Nowhere is it known beforehand what may lie in between: from least to largest depth.
    const bounds = new THREE.DataTexture(new Uint8Array([0, 255, 0, 255]), 1, 1, THREE.RGBAFormat);
    bounds.needsUpdate = true;
    return {
      shadowMap: depthTexture, shadowDepth: depthTexture, shadowBounds: bounds, toMap: new THREE.Matrix4(),
      toLight: new THREE.Matrix4().copy(sun.matrixWorld).transpose(),  // a rotation alone
      mapSize: new THREE.Vector4(),
    };
  }

  // Places the shadow map, and the maps of what stands over the ground, so that they hold all of the box [m].
  enclose(box) {
    this.box = box;
    const {sun, frame} = this, corner = new THREE.Vector3(), seen = new THREE.Box3();
    const ends = [box.min, box.max], toSun = frame.toLight.value;
    for (let i = 0; i < 8; ++i)
      seen.expandByPoint(corner.set(ends[i & 1].x, ends[i >> 1 & 1].y, ends[i >> 2].z).applyMatrix4(toSun));
    seen.expandByScalar(0.02 * seen.getSize(corner).length() + 0.01);
    Object.assign(sun, {left: seen.min.x, right: seen.max.x, bottom: seen.min.y, top: seen.max.y, near: -seen.max.z});
    sun.far = -seen.min.z;
    sun.updateProjectionMatrix();
    frame.toMap.value.set(0.5, 0, 0, 0.5, 0, 0.5, 0, 0.5, 0, 0, 0.5, 0.5, 0, 0, 0, 1)
      .multiply(sun.projectionMatrix).multiply(toSun);
    const size = seen.getSize(corner);
    frame.mapSize.value.set(...size.toArray(), Math.max(size.x, size.y) / this.fineness.texels);
    if (this.overGround) this.placeOverGround(box);
  }

  // One of taut's shaders, whose targets have the curve of displays: here it comes afterwards.
  shown(vertex, fragment, definitions, uniforms, more) {
    const defines = [...this.kind, ...definitions].map((name) => `#define ${name}\n`).join('');
    const inLight = `${defines}#define main drawInLight\n${shaderText(fragment + '.frag')}\n#undef main\n`;
    const main = 'void main() { drawInLight(); colour = vec4(encoded(colour.rgb), 1.0); }';
    return shader(defines + shaderText(vertex + '.vert'), inLight + main, {...this.frame, ...uniforms}, more);
  }

  materialOf(mesh) {
    const loaded = mesh.material, finish = loaded.userData.taut, picture = loaded.map || null;
    // The shader decodes it, in whatever words a release has for that.
    if (picture) Object.assign(picture, {encoding: 3000, colorSpace: '', anisotropy: 8, needsUpdate: true});
    const {uv} = mesh.geometry.attributes;  // of taut's own in metres, v upwards
    for (let i = 0; uv && i < uv.count; ++i) uv.setXY(i, finish.repeat * uv.getX(i), -finish.repeat * uv.getY(i));
    const isTwoSided = loaded.side === THREE.DoubleSide, isWoven = finish.weave > 0 || finish.fuzz > 0;
    const pattern = picture ? 4 : Math.max(['plain', 'checker', 'stripes', 'tartan'].indexOf(finish.pattern), 0);
    const definitions = [`PATTERN ${pattern}`];
    if (isTwoSided) definitions.push('TWO_SIDED');
    if (isWoven) definitions.push(`WEAVE ${finish.binding}`);
    if (finish.slub > 0) definitions.push('SLUB');
    if (finish.fuzz > 0) definitions.push('FUZZ');
    if (finish.anisotropy > 0) definitions.push('FIBRES');
    return this.shown('surface', 'forward', definitions, uniformsOf({
      transform: mesh.matrixWorld, normalTransform: new THREE.Matrix3(), picture, repeat: finish.repeat,
      frontColour: vector(loaded.color.toArray()), accentColour: vector(finish.accent), weave: finish.weave,
      weftColour: vector(finish.back), thread: finish.thread, slub: finish.slub, fuzz: finish.fuzz,
      back: four(finish.back, loaded.roughness), strands: new THREE.Vector2(finish.anisotropy, finish.fuzz),
      kind: new THREE.Vector4(finish.sheen, 0, isTwoSided ? finish.translucency : 0, isWoven ? 1 : 0),
    }), {side: loaded.side});
  }

  // Maps of what stands over the ground, seen from below and from above, and of what that hides of the sky.
  hiddenOver(ground) {
    this.views = [1, -1].map((way) => ({way, camera: new THREE.Camera(), map: depthMap(skyTexels)}));
    this.hidden = new THREE.WebGLRenderTarget(skyTexels / 2, skyTexels / 2);
    this.overGround = {height: ground.height, extent: new THREE.Vector3(), area: new THREE.Vector4()};
    const material = shader(shaderText('screen.vert'), shaderText('hidden.frag'), uniformsOf({
      lowest: this.views[0].map.depthTexture, highest: this.views[1].map.depthTexture, reach: skyMargin,
      extent: this.overGround.extent,
    }), {depthTest: false});
    this.gathering = new THREE.Mesh(triangle(), material);
    this.gathering.frustumCulled = false;
    return {occlusion: this.hidden.texture, occlusionArea: this.overGround.area};
  }

  placeOverGround({min, max}) {
    const low = [min.x - skyMargin, min.z - skyMargin], ground = this.overGround;
    const size = [max.x + skyMargin - low[0], max.z + skyMargin - low[1]], height = Math.max(...size);
    for (const {way, camera} of this.views)  // x and z of the world to the right and up, its y ahead or towards the eye
      camera.projectionMatrix.set(
        2 / size[0], 0, 0, -1 - 2 * low[0] / size[0],
        0, 0, 2 / size[1], -1 - 2 * low[1] / size[1],
        0, way * 2 / height, 0, -way * (1 + 2 * ground.height / height),
        0, 0, 0, 1);
    ground.extent.set(size[0], height, size[1]);
    ground.area.set(...low, 1 / size[0], 1 / size[1]);
  }

  addGround(ground, background) {
    const {target, camera} = this.film;
    const reach = 2.5 * camera.getWorldPosition(new THREE.Vector3()).distanceTo(target) - 30;  // as fadeOf() has it
    const scale = background.fadesWithCamera ? Math.max(reach / background.fadeEnd, 1) : 1;
    const end = scale * background.fadeEnd;
    const Plane = THREE.PlaneBufferGeometry || THREE.PlaneGeometry;  // older, newer releases
    const plane = new Plane(2.2 * end, 2.2 * end).rotateX(-Math.PI / 2).translate(target.x, ground.height, target.z);
    this.addAround(plane, this.shown('ground', 'ground', ['SHADED', 'DARKENED'], uniformsOf({
      ...this.hiddenOver(ground), groundColour: four(ground.colour, ground.gridSpacing),
      fade: new THREE.Vector4(target.x, target.z, scale * background.fadeStart, end),
    })));
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
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2) * this.fineness.pixels);
    this.renderer.setSize(canvas.clientWidth, canvas.clientHeight, false);
  }

  // Draws finer or coarser from now on.
  draws(fineness) {
    this.fineness = fineness;
    this.map.setSize(fineness.texels, fineness.texels);
    this.enclose(this.box);
    this.resize();
  }

  // The angle of verticalField(), engine/taut/view/camera_axes.h.
  fit() {
    const {camera} = this.film, canvas = this.renderer.domElement;
    const aspect = canvas.clientWidth / Math.max(canvas.clientHeight, 1);
    const half = Math.tan(camera.fov * Math.PI / 360) * Math.max(1, 16 / 9 / aspect);
    this.fieldOfView = camera.fov * Math.PI / 180;
    Object.assign(this.camera, {fov: Math.atan(half) * 360 / Math.PI, aspect});
    this.camera.updateProjectionMatrix();
  }

  draw() {
    const {frame, camera: eye} = this;
    eye.updateMatrixWorld();
    frame.viewProjection.value.multiplyMatrices(eye.projectionMatrix, eye.matrixWorldInverse);
    frame.toWorld.value.multiplyMatrices(eye.matrixWorld, eye.projectionMatrixInverse);
    frame.eye.value.copy(eye.position);
    for (const {mesh} of this.film.shapes)
      mesh.material.uniforms.normalTransform.value.setFromMatrix4(mesh.matrixWorld);
    for (const mesh of this.around) mesh.visible = false;
    this.scene.overrideMaterial = this.depth;
    const looksUp = this.gathering && this.drawn++ % this.fineness.pause === 0;
    for (const {camera, map} of [{camera: this.sun, map: this.map}, ...(looksUp ? this.views : [])]) {
      this.renderer.setRenderTarget(map);
      this.renderer.render(this.scene, camera);
    }
    this.scene.overrideMaterial = null;
    if (looksUp) {
      this.renderer.setRenderTarget(this.hidden);
      this.renderer.render(this.gathering, this.views[0].camera);
    }
    this.renderer.setRenderTarget(null);
    for (const mesh of this.around) mesh.visible = true;
    this.renderer.render(this.scene, eye);
  }
  // Gives back what it has on the graphics card; the renderer stays.
  dispose() {
    for (const target of [this.map, this.hidden, ...this.views.map((view) => view.map)]) if (target) target.dispose();
    this.scene.traverse(({geometry, material}) => {
      if (geometry) geometry.dispose();
      if (!material) return;
      if (material.uniforms.picture && material.uniforms.picture.value) material.uniforms.picture.value.dispose();
      material.dispose();
    });
  }
}
