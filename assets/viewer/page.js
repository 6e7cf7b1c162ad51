// What a person does with the page: play, time, speed, camera, keys.
'use strict';

const playing = 'M8 5h3v14H8zM14 5h3v14h-3z', paused = 'M8 5l11 7-11 7z';

class Player {
  constructor(film, picture) {
    this.film = film;
    this.picture = picture;
    this.time = 0;  // [s]
    this.isPlaying = false;
    this.isFollowing = true;  // the scene's camera, until somebody takes hold of it
    this.before = null;       // [ms]
    for (const name of ['play', 'time', 'clock', 'speed', 'reset', 'controls'])
      this[name + 'Element'] = document.getElementById(name);
    this.timeElement.max = film.duration;
    this.controls = new THREE.OrbitControls(picture.camera, picture.renderer.domElement);
    this.controls.enableKeys = false;  // the arrows step through frames
    this.controls.enableDamping = !matchMedia('(prefers-reduced-motion: reduce)').matches;
    this.controls.dampingFactor = 0.12;
    this.listen();
    this.resetView();
    this.play(film.duration > 0 && this.controls.enableDamping);
    this.seek(0);
    this.controlsElement.hidden = film.duration === 0;
    requestAnimationFrame((now) => this.turn(now));
  }

  listen() {
    this.controls.addEventListener('start', () => { this.isFollowing = false; });
    this.controls.addEventListener('change', () => { this.isStale = true; });
    this.playElement.addEventListener('click', () => this.play(!this.isPlaying));
    this.timeElement.addEventListener('input', () => { this.play(false); this.seek(Number(this.timeElement.value)); });
    this.resetElement.addEventListener('click', () => this.resetView());
    this.controlsElement.addEventListener('submit', (event) => event.preventDefault());
    addEventListener('keydown', (event) => this.key(event));
    new ResizeObserver(() => this.resize()).observe(this.picture.renderer.domElement);
  }

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey || event.target.tagName === 'SELECT') return;
    const last = this.film.times.length - 1, key = this.film.keyAt(this.time);
    const back = this.time > this.film.times[key] ? key : key - 1;
    const steps = {ArrowLeft: back, ArrowRight: key + 1, Home: 0, End: last};
    if (event.key in steps) {
      this.play(false);
      this.seek(this.film.times[Math.min(Math.max(steps[event.key], 0), last)]);
    } else if (event.key === ' ') {
      if (event.target.tagName === 'BUTTON') return;  // which space presses
      this.play(!this.isPlaying);
    } else if (event.key === 'r' || event.key === 'R') {
      this.resetView();
    } else {
      return;
    }
    event.preventDefault();
  }

  play(isPlaying) {
    this.isPlaying = isPlaying;
    this.before = null;
    this.playElement.querySelector('path').setAttribute('d', isPlaying ? playing : paused);
    this.playElement.setAttribute('aria-label', isPlaying ? 'Pause' : 'Play');
  }

  seek(time) {
    this.time = time;
    this.film.show(time);
    const text = `${time.toFixed(2)} / ${this.film.duration.toFixed(2)} s`;
    this.timeElement.value = time;
    this.timeElement.setAttribute('aria-valuetext', `${time.toFixed(2)} seconds`);
    this.clockElement.textContent = text;
    if (this.isFollowing) this.follow();
    this.isStale = true;
  }

  resetView() {
    this.isFollowing = true;
    this.follow();
    this.isStale = true;
  }

  // Takes the place of the scene's camera.
  follow() {
    this.picture.fit();
    this.film.camera.getWorldPosition(this.picture.camera.position);
    this.controls.target.copy(this.film.target);
    this.controls.update();
  }

  // Lets the eye go on where it was sent, but not below the ground.
  look() {
    this.controls.update();
    const {ground} = this.film.around, eye = this.picture.camera.position;
    if (!ground || eye.y >= ground.height + 0.02) return;
    eye.y = ground.height + 0.02;
    this.picture.camera.lookAt(this.controls.target);
  }

  resize() {
    this.picture.resize();
    this.picture.fit();
    this.isStale = true;
  }

  // Draws where something has changed since the last time.
  turn(now) {
    requestAnimationFrame((next) => this.turn(next));
    if (this.isPlaying) {
      const passed = this.before === null ? 0 : Math.min(now - this.before, 250) / 1000;
      this.before = now;
      const time = this.time + passed * Number(this.speedElement.value);
      this.seek(time <= this.film.duration ? time : 0);
    }
    if (!this.isFollowing) this.look();
    if (!this.isStale) return;
    this.isStale = false;
    this.picture.draw();
  }
}

function startPage() {
  const message = document.getElementById('message');
  const canvas = document.getElementById('picture');
  const context = canvas.getContext('webgl2', {antialias: true, alpha: false});
  if (!context) {
    message.textContent = 'This page draws with WebGL 2, which this browser lacks or has turned off.';
    return;
  }
  if (typeof DecompressionStream !== 'function') {
    message.textContent = 'This page needs DecompressionStream, which browsers from 2023 on have.';
    return;
  }
  readFilm().then((film) => {
    const picture = new Picture(new THREE.WebGLRenderer({canvas, context}), film);
    const player = new Player(film, picture);
    message.textContent = '';
    // For scripts: the numbers behind the picture.
    window.taut = {
      times: film.times,
      names: film.shapes.map((shape) => shape.mesh.name),
      seek(frame) { player.play(false); player.seek(film.times[frame]); },
      // [m] in the world, three a vertex, at the time that is shown.
      positions(name) {
        const {mesh} = film.shapes.find((shape) => shape.mesh.name === name);
        const {array} = mesh.geometry.attributes.position, point = new THREE.Vector3(), out = [];
        for (let i = 0; i < array.length; i += 3)
          out.push(...point.set(array[i], array[i + 1], array[i + 2]).applyMatrix4(mesh.matrixWorld).toArray());
        return out;
      },
    };
  }).catch((error) => { message.textContent = `The page is damaged: ${error.message || error}`; });
}
