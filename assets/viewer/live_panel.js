// Beside a live picture: energies over time, figures, and sliders for what a ramp may change.
'use strict';

const graphSeconds = 10;  // of scene time that the graph shows
const energies = [
  {name: 'kinetic', colour: '#2f7ed8'}, {name: 'elastic', colour: '#d9541e'},
  {name: 'gravitational', colour: '#2e9e57', isAboveLeast: true}, {name: 'energy', colour: '#8a8a8f', isAboveLeast: true},
];

class EnergyGraph {
  constructor(canvas, legend) {
    this.canvas = canvas;
    this.samples = [];
    for (const {name, colour, isAboveLeast} of energies) {
      const item = document.createElement('span'), mark = document.createElement('i');
      mark.style.background = colour;
      item.append(mark, name === 'energy' ? 'sum' : name);
      if (isAboveLeast) item.title = 'above its least value here';
      legend.append(item);
    }
  }

  clear() { this.samples = []; }

  add(time, metrics) {
    this.samples.push({time, values: energies.map(({name}) => metrics[name])});
    while (this.samples[0].time < time - graphSeconds) this.samples.shift();
  }

  draw() {
    const {canvas, samples} = this, density = Math.min(window.devicePixelRatio, 2);
    const width = canvas.width = canvas.clientWidth * density, height = canvas.height = canvas.clientHeight * density;
    if (samples.length < 2) return;
    const least = energies.map(({isAboveLeast}, k) => isAboveLeast ? Math.min(...samples.map(({values}) => values[k])) : 0);
    const most = Math.max(1e-12, ...samples.flatMap(({values}) => values.map((value, k) => value - least[k])));
    const end = samples[samples.length - 1].time, pen = canvas.getContext('2d');
    const label = 14 * density, x = (time) => width * (1 - (end - time) / graphSeconds);
    const y = (value) => height - 2 - (height - label - 4) * value / most;
    pen.font = `${11 * density}px system-ui, sans-serif`;
    pen.fillStyle = getComputedStyle(canvas).color;
    pen.fillText(`${numberText(most)} J`, 0, label - 3 * density);
    pen.textAlign = 'right';
    pen.fillText(`last ${graphSeconds} s`, width, label - 3 * density);
    pen.lineWidth = 1.5 * density;
    pen.lineJoin = 'round';
    energies.forEach(({colour}, k) => {
      pen.strokeStyle = colour;
      pen.beginPath();
      for (const {time, values} of samples) pen.lineTo(x(time), y(values[k] - least[k]));
      pen.stroke();
    });
  }
}

// Three digits, as people write them.
function numberText(number) {
  if (number === 0) return '0';
  const size = Math.abs(number);
  return size >= 1e4 || size < 1e-2 ? number.toExponential(2).replace('e+', 'e') : Number(number.toPrecision(3)).toString();
}

function showNumbers(list, pairs) {
  list.textContent = '';
  for (const [name, value] of pairs) {
    const term = document.createElement('dt'), number = document.createElement('dd');
    term.textContent = name;
    number.textContent = value;
    list.append(term, number);
  }
}

const unitNames = {
  m: 'metres', s: 'seconds', kg: 'kilograms', N: 'newtons', Pa: 'pascals', J: 'joules', rad: 'radians', degrees: 'degrees',
};

// "N/m" as "newtons per metre".
function unitInWords(unit) {
  const word = (text, isOne) => text.split(' ').map((part, i, all) => {
    const [, letters, power] = /^(.*?)([²³]?)$/.exec(part), name = unitNames[letters] || letters;
    const own = isOne || i + 1 < all.length ? name.replace(/s$/, '') : name;
    return {'': '', '²': 'square ', '³': 'cubic '}[power] + own;
  }).join(' ');
  const [above, ...below] = unit.split('/');
  return [...(above === '1' ? [] : [word(above, false)]), ...below.map((part) => word(part, true))].join(' per ')
    .replace(/^(?=.)/, above === '1' ? 'per ' : '');
}

// "material.sail.stretch_N_per_m" in N/m as "stretch of material sail".
function keyInWords(key, unit) {
  const suffix = `_${unit.replace('1/', 'per_').replace('degrees', 'deg').replace(/\//g, '_per_').replace(/ /g, '_')
    .replace(/²/g, '2').replace(/³/g, '3')}`;
  const path = key.split('.'), last = path.pop();
  const name = (unit !== '' && last.endsWith(suffix) ? last.slice(0, -suffix.length) : last).replace(/_/g, ' ');
  return path.length > 0 ? `${name} of ${path.join(' ')}` : name;
}

// What a slider does with a value of the scene: numbers without a unit and shares go evenly, others by factors of up to
// ten, which is what stiffness asks for; a vector keeps its direction and is made longer or shorter.
class Slider {
  constructor({key, unit, value, low, high}) {
    Object.assign(this, {key, unit, first: value});
    this.size = Math.hypot(...value);
    const isShare = low >= 0 && high <= 1, isFactor = value.length === 1 && unit !== '' && !isShare && this.size > 0;
    this.low = isFactor ? Math.max(Math.log10(Math.max(low, 1e-30) / this.size), -1) : Math.max(low, 0);
    this.high = isFactor ? Math.min(Math.log10(high / this.size), 1) : isShare ? high : Math.min(high, 2.5 * this.size || 1);
    this.sizeAt = isFactor ? (place) => this.size * 10 ** place : (place) => place;
    this.start = isFactor ? 0 : this.size;
  }

  // To three digits, as the scenario writes it.
  valueAt(place) {
    const size = Number(this.sizeAt(place).toPrecision(3));
    return this.first.length === 1 ? size : this.first.map((part) => Number((part * size / this.size).toPrecision(4)));
  }

  element(change) {
    const label = document.createElement('label'), name = document.createElement('span');
    const number = document.createElement('output'), input = document.createElement('input');
    name.textContent = keyInWords(this.key, this.unit);
    label.title = this.key;
    const show = () => { number.textContent = `${numberText(this.sizeAt(Number(input.value)))} ${this.unit}`; };
    Object.assign(input, {type: 'range', min: this.low, max: this.high, step: (this.high - this.low) / 200, value: this.start});
    input.setAttribute('aria-label', [name.textContent, unitInWords(this.unit)].filter((text) => text).join(', '));
    input.addEventListener('input', show);
    input.addEventListener('change', () => change(this.key, this.valueAt(Number(input.value))));
    label.append(name, number, input);
    show();
    return label;
  }
}

// Of all that ramps may change, what most scenes are asked about, the first of each kind.
const usualKeys = [
  /^wind\.[^.]+\.velocity$/, /^world\.gravity$/, /^material\.[^.]+\.stretch_N_per_m/, /^material\.[^.]+\.young_Pa$/,
  /^material\.[^.]+\.bending_rigidity_N_m/, /^material\.[^.]+\.damping/, /^collider\.[^.]+\.friction$/,
];

function slidersFor(rampable, wanted) {
  const may = rampable.filter(({value}) => value.length === 1 || Math.hypot(...value) > 0);
  const keys = wanted ? wanted : usualKeys.map((usual) => (may.find(({key}) => usual.test(key)) || {}).key);
  return keys.map((key) => may.find((field) => field.key === key)).filter((field) => field).map((field) => new Slider(field));
}
