// A scene that a person plays with: the engine computes it in the page, by the rules of a window of taut play.
'use strict';

const playing = 'M8 5h3v14H8zM14 5h3v14h-3z', paused = 'M8 5l11 7-11 7z';
const tickBudget = 0.045;    // [s] of wall time for the ticks of a picture
const betweenBudget = 0.008; // and for some of those that are due still, between two pictures
const panelPause = 100;      // [ms] between two looks at the figures
const typingPause = 400;     // [ms] after a key until the scene is read again
const slowPicture = 1 / 30, fastPicture = 1 / 50;  // [s] longer ones are drawn coarser, shorter ones finer
const roomAround = 0.3;      // of the size of all that is seen: how far it may go until its shadow has to be placed anew
const help = [
  ['drag', 'pull'], ['drag beside it', 'turn the view; two fingers move it'],
  ['wheel, pinch', 'zoom'], ['c', 'scene\'s camera'], ['space', 'pause'], ['.', 'one tick'],
  ['s  [  ]', 'slow motion: slower, faster'], ['backspace', 'restart'], ['m', 'next method, restart'],
  ['+  -', 'half or twice the step, restart'], ['o', 'figures and sliders'], ['e', 'edit the scene'],
  ['r', 'download what was done as a scenario, for taut test and taut render'],
  ['drop a file', 'a scene (.toml) and what it names (.obj, pictures)'], ['h', 'this help'],
];

function element(name) { return document.getElementById(name); }

function download(name, text) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([text], {type: 'text/plain'}));
  link.download = name;
  link.click();
  URL.revokeObjectURL(link.href);
}

class LivePage {
  // given: what the page was made of, see web_page.cpp.
  constructor(taut, renderer, given) {
    Object.assign(this, {taut, renderer, given});
    this.canvas = renderer.domElement;
    this.scene = {...given.scene};  // name, text, files
    this.changes = {};              // overrides by key: method and step
    this.session = this.picture = this.film = this.fault = null;
    this.isPlaying = true;
    this.isFollowing = true;  // the scene's camera, until somebody takes hold of it
    this.isEdited = false;
    this.steps = 0;  // single ticks that are asked for
    this.before = this.computed = null;  // [ms] of the last picture, of the last ticks
    this.between = new MessageChannel();
    this.between.port1.onmessage = () => this.catchUp();
    this.isBetween = false;  // a message is on its way
    this.pointer = null;  // that holds a point
    this.place = {x: 0, y: 0};  // of the pointer, in shares of width and height
    this.rate = {pictures: 0, real: 1};
    this.lookedAt = 0;  // [ms]
    this.fineness = 0;  // of look.js
    // [s] since the fineness was last thought of
    this.pace = {pictures: 0, wall: 0, computing: 0, betweens: 0, patience: 2, changed: 0, wasFiner: false};
    this.graph = new EnergyGraph(element('graph'), element('legend'));
    for (const name of given.methods) element('method').add(new Option(name, name));
    for (const [key, meaning] of help) {
      const row = element('keys').firstElementChild.insertRow(), head = document.createElement('th');
      head.textContent = key;
      row.append(head);
      row.insertCell().textContent = meaning;
    }
    element('text').value = this.scene.text;
    this.listen();
  }

  // Plays this scene from the start; where it is refused, what is there goes on. Returns whether it was taken.
  async open(scene, changes) {
    let session = null, film;
    try {
      const overrides = [...(scene.overrides || []), ...Object.entries(changes).map(([key, value]) => `${key}=${value}`)];
      session = new this.taut.Session(scene.text, scene.files, {name: scene.name, overrides});
      film = await readLive(session, this.aspect);
    } catch (error) {
      if (session) session.free();
      this.showFault(error);
      return false;
    }
    const {session: old} = this;
    this.scene = scene;
    this.changes = changes;
    this.session = session;
    this.show(film);
    if (old) old.free();
    this.pointer = null;
    this.controls.enabled = true;
    this.steps = 0;
    this.graph.clear();
    this.showFault(null);
    this.fillControls();
    if (session.warnings.length > 0) console.info(session.warnings.join('\n'));
    return true;
  }

  // Draws this film from now on.
  show(film) {
    if (this.picture) this.picture.dispose();
    const camera = this.picture && !this.isFollowing ? this.picture.camera : null;
    this.film = film;
    this.picture = new Picture(this.renderer, film, finenesses[this.fineness]);
    if (this.controls) this.controls.dispose();
    this.controls = new THREE.OrbitControls(this.picture.camera, this.canvas);
    Object.assign(this.controls, {enableKeys: false, enableDamping: true, dampingFactor: 0.12});
    this.controls.addEventListener('start', () => { this.isFollowing = false; });
    this.picture.fit();
    if (!camera) return this.resetView();
    this.picture.camera.position.copy(camera.position);
    this.controls.target.copy(this.target);
    this.controls.update();
  }

  // What may be changed of the scene that is there.
  fillControls() {
    const {session} = this, {method, step: present} = session.solver;
    element('method').value = method;
    this.step = present;
    const step = element('step'), own = this.changes['solver.dt'];
    if (own === undefined) this.ownStep = present;
    step.textContent = '';
    for (const [name, factor] of [['own', 1], ['× 4', 4], ['× 2', 2], ['½', 0.5], ['¼', 0.25]]) {
      const value = factor === 1 ? '' : this.stepText(factor * this.ownStep);
      step.add(new Option(`${name} (${numberText(1e3 * factor * this.ownStep)} ms)`, value));
    }
    step.value = own === undefined ? '' : own;
    const list = element('sliders');
    list.textContent = '';
    for (const slider of slidersFor(session.rampable(), this.given.sliders))
      list.append(slider.element((key, value) => this.attempt(() => this.session.set(key, value, 0.2))));
  }

  // At most; rounded to whole substeps of a tick.
  stepText(step) {
    const tick = this.session.tickSeconds;
    return (1.00001 * tick / Math.max(1, Math.round(tick / step))).toPrecision(6);
  }

  attempt(what) {
    try {
      return what();
    } catch (error) {
      this.showFault(error);
      return undefined;
    }
  }

  showFault(error) {
    this.fault = error;
    element('fault').textContent = error ? error.message : '';
    element('message').textContent = '';
    if (error && !this.session) element('message').textContent = 'This scene cannot be played.';
  }

  say(text) {
    element('said').textContent = text;
    clearTimeout(this.saying);
    this.saying = setTimeout(() => { element('said').textContent = ''; }, 3000);
  }

  listen() {
    const {canvas} = this;
    // Before the camera's controls, which leave a drag alone that holds something.
    canvas.addEventListener('pointerdown', (event) => this.grab(event), true);
    canvas.addEventListener('pointermove', (event) => this.point(event));
    for (const name of ['pointerup', 'pointercancel']) canvas.addEventListener(name, (event) => this.release(event));
    for (const [name, act] of Object.entries({
      play: () => this.play(!this.isPlaying), tick: () => this.tick(), restart: () => this.restart(),
      reset: () => this.resetView(), save: () => this.save(), edit: () => this.toggle('editor'),
      figures: () => this.toggle('panel'), help: () => this.toggle('keys'),
    })) element(name).addEventListener('click', act);
    element('method').addEventListener('change', (event) => this.change('solver.integrator', JSON.stringify(event.target.value)));
    element('step').addEventListener('change', (event) => this.change('solver.dt', event.target.value));
    element('text').addEventListener('input', () => this.typed());
    element('controls').addEventListener('submit', (event) => event.preventDefault());
    addEventListener('keydown', (event) => this.key(event));
    new ResizeObserver(() => {
      this.picture.resize();
      this.picture.fit();
    }).observe(this.canvas);
    addEventListener('dragover', (event) => event.preventDefault());
    addEventListener('drop', (event) => {
      event.preventDefault();
      this.drop([...event.dataTransfer.files]);
    });
  }

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey || ['SELECT', 'TEXTAREA'].includes(event.target.tagName)) {
      if (event.key === 'Escape') event.target.blur();
      return;
    }
    if (event.key === ' ' && event.target.tagName === 'BUTTON') return;  // which space presses
    const speed = element('speed'), method = element('method'), step = element('step');
    const slower = (by) => { speed.selectedIndex = (speed.selectedIndex + by + speed.length) % speed.length; };
    const choose = (list, by) => {
      const next = list.selectedIndex + by;
      if (next < 0 || next >= list.length) return;
      list.selectedIndex = next;
      list.dispatchEvent(new Event('change'));
    };
    const steps = ['× 4', '× 2', 'own', '½', '¼'];  // from long to short
    const chosen = () => steps.findIndex((name) => step.selectedOptions[0].textContent.startsWith(name));
    const chooseStep = (by) => {
      const wanted = steps[chosen() + by];
      const option = [...step.options].findIndex(({textContent}) => wanted && textContent.startsWith(wanted));
      if (option >= 0) choose(step, option - step.selectedIndex);
    };
    const acts = {
      ' ': () => this.play(!this.isPlaying), '.': () => this.tick(), Backspace: () => this.restart(),
      s: () => slower(-1), '[': () => slower(-1), ']': () => slower(1), c: () => this.resetView(),
      m: () => (method.selectedIndex + 1 < method.length ? choose(method, 1) : choose(method, 1 - method.length)),
      '+': () => chooseStep(1), '=': () => chooseStep(1), '-': () => chooseStep(-1), r: () => this.save(),
      o: () => this.toggle('panel'), e: () => this.toggle('editor'), h: () => this.toggle('keys'), F1: () => this.toggle('keys'),
    };
    const act = acts[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!act || !this.session) return;
    event.preventDefault();
    act();
  }

  toggle(name) { element(name).hidden = !element(name).hidden; }

  play(isPlaying) {
    this.isPlaying = isPlaying;
    element('play').querySelector('path').setAttribute('d', isPlaying ? playing : paused);
    element('play').setAttribute('aria-label', isPlaying ? 'Pause' : 'Play');
  }

  tick() {
    this.play(false);
    ++this.steps;
  }

  async restart(said = 'from the start') {
    if (await this.open(this.scene, this.changes)) this.say(said);
  }

  async change(key, value) {
    const changes = {...this.changes, [key]: value};
    if (value === '') delete changes[key];
    if (await this.open(this.scene, changes)) this.say(`from the start with ${key} = ${value || 'its own'}`);
    else this.fillControls();
  }

  typed() {
    clearTimeout(this.typing);
    this.typing = setTimeout(async () => {
      const text = element('text').value;
      if (await this.open({...this.scene, text}, this.changes)) {
        this.isEdited = true;
        this.say('read again');
      }
    }, typingPause);
  }

  // A scene is played; other files are kept for it, and read by the scene that is there.
  async drop(files) {
    const kept = {...this.scene.files};
    let scene = null;
    for (const file of files) {
      if (/\.toml$/i.test(file.name)) scene = {name: file.name, reference: file.name, text: await file.text()};
      else kept[file.name] = new Uint8Array(await file.arrayBuffer());
    }
    const next = {...(scene || this.scene), files: kept};
    element('text').value = next.text;
    if (await this.open(next, {})) this.say(`playing ${next.name}`);
    else if (!scene) this.scene.files = kept;
  }

  async save() {
    if (!this.session) return;
    const recording = this.attempt(() => this.session.record(this.scene.reference));
    if (!recording) return;
    const stem = this.scene.name.split('/').pop().replace(/\.toml$/, '');
    if (this.isEdited) download(`${stem}.toml`, this.scene.text);
    download(`${stem}-played.toml`, recording.text);
    this.say(`${recording.deeds} actions, state hash ${recording.hash} at tick ${recording.tick}`);
  }

  get aspect() { return this.canvas.clientWidth / Math.max(this.canvas.clientHeight, 1); }

  // The eye of the picture, for the engine.
  get eye() {
    const {camera} = this.picture, way = camera.getWorldDirection(new THREE.Vector3());
    return {
      eye: camera.position.toArray(), target: way.add(camera.position).toArray(), up: camera.up.toArray(),
      fieldOfView: this.picture.fieldOfView,
    };
  }

  placeOf(event) {
    const box = this.canvas.getBoundingClientRect();
    return {x: (event.clientX - box.left) / box.width, y: (event.clientY - box.top) / box.height};
  }

  grab(event) {
    this.canvas.focus();
    if (!this.session || event.button !== 0 || !event.isPrimary || this.pointer !== null) return;
    const place = this.place = this.placeOf(event);
    const picked = this.attempt(() => this.session.grab(place.x, place.y, this.aspect, this.eye));
    if (!picked) return;
    this.pointer = event.pointerId;
    this.controls.enabled = false;
    this.canvas.setPointerCapture(event.pointerId);
    this.canvas.classList.add('holding');
    this.say(`holding ${picked.target}`);
  }

  point(event) {
    this.place = this.placeOf(event);
    if (this.pointer !== null || !this.session || event.buttons !== 0 || event.pointerType === 'touch') return;
    const picked = this.attempt(() => this.session.pick(this.place.x, this.place.y, this.aspect, this.eye));
    this.canvas.classList.toggle('over', Boolean(picked));
  }

  release(event) {
    if (event.pointerId !== this.pointer) return;
    this.pointer = null;
    this.controls.enabled = true;
    this.canvas.classList.remove('holding');
    this.attempt(() => this.session.release());
  }

  resetView() {
    this.isFollowing = true;
    this.follow();
  }

  // Takes the place of the scene's camera.
  follow() {
    this.picture.fit();
    this.picture.camera.position.copy(this.film.camera.position);
    this.controls.target.copy(this.film.target);
    this.controls.update();
    this.target = this.controls.target.clone();
  }

  // Lets the eye go on where it was sent, but not below the ground.
  look() {
    this.controls.update();
    this.target = this.controls.target.clone();
    const {ground} = this.film.around, eye = this.picture.camera.position;
    if (!ground || eye.y >= ground.height + 0.02) return;
    eye.y = ground.height + 0.02;
    this.picture.camera.lookAt(this.controls.target);
  }

  // The ticks that are due, as far as there is time [s] for them. Where they are not done, it goes on between pictures.
  compute(budget) {
    const {session} = this, speed = Number(element('speed').value), now = performance.now();
    const wall = this.computed === null ? 0 : (now - this.computed) / 1000;
    this.computed = now;
    if (this.pointer !== null) session.lead(this.place.x, this.place.y, this.aspect, this.eye);
    const wanted = this.steps;
    this.steps = 0;
    if (!this.isPlaying) return wanted > 0 ? session.step(wanted) : null;
    const moment = session.advance(wall, speed, budget);
    const real = moment.done * session.tickSeconds / (wall * speed);
    if (wall > 0) this.rate.real += Math.min(1, 2 * wall) * (real - this.rate.real);
    if (moment.done < moment.due && !this.isBetween) {
      this.isBetween = true;
      this.between.port2.postMessage(null);
    }
    return moment;
  }

  // While the browser waits for what draws, ticks that are due need not.
  catchUp() {
    this.isBetween = false;
    if (!this.session || !this.isPlaying || document.hidden) return;
    const begin = performance.now();
    this.take(this.attempt(() => this.compute(betweenBudget)));
    if (this.pace.betweens++ === 0) this.pace.computing += (performance.now() - begin) / 1000;
  }

  // What the ticks brought that is to be said.
  take(moment) {
    if (!moment) return;
    if (moment.faults.length > 0) this.say(moment.faults.join('\n'));
    if (moment.divergence && this.isPlaying) {
      this.play(false);
      this.showFault(moment.divergence);
    }
  }

  turn(now) {
    requestAnimationFrame((next) => this.turn(next));
    const wall = this.before === null ? 0 : (now - this.before) / 1000;
    this.before = now;
    if (!this.session || document.hidden) return;
    if (wall > 0) this.rate.pictures += Math.min(1, 2 * wall) * (1 / wall - this.rate.pictures);
    const begin = performance.now();
    this.take(this.attempt(() => this.compute(tickBudget)));
    this.adapt(wall, (performance.now() - begin) / 1000);
    if (!this.film.show(this.isPlaying ? undefined : 1)) return this.renew();
    const box = this.film.bounds();
    if (!this.picture.box.containsBox(box))
      this.picture.enclose(box.expandByScalar(roomAround * box.getSize(new THREE.Vector3()).length()));
    if (this.isFollowing) this.follow(); else this.look();
    this.picture.draw();
    this.lookAtFigures(now);
  }

  // Draws coarser where drawing is what takes the time, and finer where there is plenty; if that was wrong, it is longer
  // until it is tried again.
  adapt(wall, computing) {
    const {pace} = this, long = wall > 1;  // the page was out of sight
    if (long) return;
    ++pace.pictures;
    pace.wall += wall;
    pace.computing += computing;
    pace.betweens = 0;
    if (pace.wall < 0.5 || pace.pictures < 3) return;
    const one = pace.wall / pace.pictures, drawing = one - pace.computing / pace.pictures;
    let next = this.fineness;
    if (one > slowPicture && drawing > 0.5 * slowPicture) {
      if (pace.wasFiner) pace.patience = Math.min(2 * pace.patience, 60);
      ++next;
    } else if (one < fastPicture && performance.now() - pace.changed > 1000 * pace.patience) {
      --next;
    }
    const wanted = Math.min(Math.max(next, 0), finenesses.length - 1);
    Object.assign(pace, {pictures: 0, wall: 0, computing: 0});
    if (wanted === this.fineness) return;
    Object.assign(pace, {wasFiner: wanted < this.fineness, changed: performance.now()});
    this.fineness = wanted;
    this.picture.draws(finenesses[wanted]);
    this.picture.fit();
  }

  // Something came that the first moment lacked: all of it is read again.
  renew() {
    if (this.renewing) return;
    this.renewing = readLive(this.session, this.aspect).then((film) => {
      this.renewing = null;
      if (film.session === this.session) this.show(film);
    }, (error) => this.showFault(error));
  }

  lookAtFigures(now) {
    const {session, rate} = this;
    element('clock').textContent = `${session.time.toFixed(2)} s`;
    if (element('panel').hidden || now - this.lookedAt < panelPause) return;
    this.lookedAt = now;
    const metrics = session.metrics(), speed = Number(element('speed').value);
    this.graph.add(session.time, metrics);
    this.graph.draw();
    showNumbers(element('numbers'), [
      ['tick', session.tick], ['pictures a second', rate.pictures.toFixed(0)],
      ['of real time', rate.real > 0.97 ? numberText(speed) : `${(rate.real * speed).toFixed(2)}, too slow`],
      ['step', `${numberText(1e3 * this.step)} ms`], ['largest strain', `${numberText(100 * metrics.max_strain)} %`],
      ['contacts', metrics.contacts + metrics.body_contacts], ['crossings', metrics.crossings],
    ]);
  }
}

// The modules of the engine, which the page holds as texts: one asks for the other by its name.
function engineModule(modules) {
  const place = (text) => URL.createObjectURL(new Blob([text], {type: 'text/javascript'}));
  return import(place(modules['taut.mjs'].replace('./engine.mjs', place(modules['engine.mjs']))));
}

// Where no graphics card draws, samples within pixels cost more than pixels.
function drawsInSoftware() {
  const context = document.createElement('canvas').getContext('webgl2');
  if (!context) return false;
  const facts = context.getExtension('WEBGL_debug_renderer_info');
  const name = context.getParameter(facts ? facts.UNMASKED_RENDERER_WEBGL : context.RENDERER);
  const loses = context.getExtension('WEBGL_lose_context');
  if (loses) loses.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

async function startLive() {
  const message = element('message'), canvas = element('picture');
  const lack = (what) => { message.textContent = `This page needs ${what}, which this browser lacks or has turned off.`; };
  const context = canvas.getContext('webgl2', {antialias: !drawsInSoftware(), alpha: false});
  if (!context) return lack('WebGL 2');
  if (typeof WebAssembly !== 'object') return lack('WebAssembly');
  if (typeof DecompressionStream !== 'function') return lack('DecompressionStream');
  try {
    const given = JSON.parse(element('live').textContent);
    for (const [name, content] of Object.entries(given.scene.files)) given.scene.files[name] = bytesOf(content);
    const taut = await engineModule(given.modules);
    await taut.start(await unpacked('engine'));
    const page = new LivePage(taut, new THREE.WebGLRenderer({canvas, context}), given);
    window.taut = page;  // for scripts
    await page.open(page.scene, {});
    for (const name of ['controls', 'tools']) element(name).hidden = false;
    element('editor').hidden = !given.edits;
    element('panel').hidden = innerWidth < 900;
    page.play(true);
    requestAnimationFrame((now) => page.turn(now));
  } catch (error) {
    message.textContent = `The page is damaged: ${error.message || error}`;
  }
}
