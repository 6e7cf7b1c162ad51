// taut's engine as WebAssembly, for browsers and node. SI units, radians, y up.
//
//   import {load} from 'taut-engine';
//   const world = await load(toml, {'models/cape.obj': bytes});
//   world.step(60);
//   console.log(world.time, world.positions('cloth.cape'));
//
// Typed arrays lie in the engine's memory: they hold until the next call of anything here. Keep a .slice() of one.

/** What a scene or a call is refused for, with the words, the line and the remedy that the program has. */
export class TautError extends Error {
  /** "internal": the engine is at fault and has stopped; start() makes another, and what was in it is gone. */
  readonly kind: 'usage' | 'badContent' | 'diverged' | 'inputOutput' | 'internal';
}

/** Files that the scene names, as it names them: "sail.obj", "models/sail.obj", "scenes/yard.toml", and textures. */
export type Files = Record<string, string | Uint8Array | ArrayBuffer>;
/** Values in the place of the file's: {"solver.dt": 1e-4}, or ["solver.dt=1e-4"]. */
export type Overrides = Record<string, unknown> | string[];
export interface Options {
  /** The name of the scene's file, for messages, and its folder among the files. "scene.toml" if not given. */
  name?: string;
  overrides?: Overrides;
}
export type Vector = [number, number, number];

/** Starts the engine, once. wasm: the bytes of taut.wasm, where it does not lie beside this module. */
export function start(wasm?: ArrayBuffer | Uint8Array | Promise<ArrayBuffer | Uint8Array>): Promise<void>;

/** start() and a World. */
export function load(toml: string, files?: Files, options?: Options): Promise<World>;

declare class Held {
  readonly tickSeconds: number;
  readonly ticksPerFrame: number;
  /** The scene's length [s]. */
  readonly seconds: number;
  readonly title: string;
  /** The names of the bodies that are there, "cloth.flag". */
  readonly bodies: string[];
  /** What the scene and its steps give reason to say. */
  readonly warnings: string[];
  /** The state hash, chained over the ticks, as 16 hexadecimal digits: the program's at the same tick. */
  readonly hash: string;
  readonly tick: number;
  readonly time: number;
  /** An action as a timeline has it, without its moment: {do: 'push', target: 'cloth.flag', impulse_Ns: [1, 0, 0]}. */
  apply(action: Record<string, unknown> | string): void;
  /** Lets go of its memory in the engine. Nothing may be called after it. */
  free(): void;
}

/** What is measured, by the names of claims, and energies [J]. */
export interface Metrics {
  kinetic: number;
  elastic: number;
  gravitational: number;
  energy: number;
  [name: string]: number | Vector;
}

export interface Result {
  that: string;
  span: string;
  passed: boolean;
  looks: number;
  failures: number;
  reason: string;
}

/** A scene in motion. */
export class World extends Held {
  /** Expects that start() is done. */
  constructor(toml: string, files?: Files, options?: Options);
  /** Throws a TautError of kind "diverged" where the motion leaves all bounds. */
  step(ticks?: number): {tick: number; time: number};
  /** Plays as many ticks and gives the hash after each. */
  hashes(ticks: number): string[];
  /**
   * Where points are [m]: x y z, x y z, …, in the order of authoring.
   * target: "cloth.flag", "cloth.*", "cloth.flag@left".
   */
  positions(target: string): Float64Array;
  /** Velocities [m/s] at the time of the positions, and masses [kg], too. */
  points(target: string): {positions: Float64Array; velocities: Float64Array; masses: Float64Array};
  /** Of all bodies if none are named. */
  metrics(bodies?: string): Metrics;
  /** What became so far of the scene's checks. */
  check(): Result[];
  /** The whole state, which restore() of any world of this scene goes on from: also that of Python, on any machine. */
  save(): Uint8Array;
  restore(bytes: Uint8Array): void;
}

/** A tape, as `taut record` writes it, of so many ticks from the start; `taut replay --verify` reads it. */
export function recordTape(toml: string, ticks: number, files?: Files, options?: Options): Promise<Uint8Array>;

/** Plays what a tape was made of. difference: the first tick, body and point that differ; null: none. */
export function replayTape(tape: Uint8Array, files?: Files): Promise<{ticks: number; difference: string | null}>;

export interface Camera {
  eye: Vector;
  target: Vector;
  up?: Vector;
  /** [rad] vertical in pictures of 16:9 and wider; a narrower one shows the width that 16:9 does. */
  fieldOfView?: number;
}

export interface Moment {
  tick: number;
  time: number;
  /** Why actions since the last call were not done. */
  faults: string[];
  isHolding: boolean;
  /** Why nothing moves any more. */
  divergence: null | {tick: number; time: number; body: string; point: number; safeStep: number; message: string};
}

/** What is drawn of one thing, by the name of its node in the GLB. */
export interface Part {
  name: string;
  translation: Vector;
  rotation: [number, number, number, number];
  /** Only where they changed since the frame before; in the node's own frame, as the GLB has them. */
  positions?: Float32Array;
  normals?: Float32Array;
  /** Only where it tore or was cut since: there may be more vertices, too. */
  triangles?: Uint32Array;
  uv?: Float32Array;
}

export interface Frame {
  time: number;
  camera: Required<Camera>;
  /** false: something is there that the GLB lacks; take glb() again. */
  fits: boolean;
  parts: Part[];
}

export interface Picked {
  /** "cloth.flag@#12" */
  target: string;
  body: string;
  point: number;
  position: Vector;
}

/** A scene that a page plays, with the rules of `taut play`. */
export class Session extends Held {
  /** Expects that start() is done. */
  constructor(toml: string, files?: Files, options?: Options);
  /**
   * Plays what is due after so many seconds of wall time, but no longer than `budget` seconds and one tick; what is
   * left over then is forgotten, but for a little.
   */
  advance(wall: number, speed?: number, budget?: number): Moment & {due: number; done: number};
  /** Plays as many ticks, but not beyond a divergence. */
  step(ticks?: number): Moment;
  readonly divergence: Moment['divergence'];
  /** All of now as a GLB, which `taut export` would write. */
  glb(aspect?: number): Uint8Array;
  /** Between the last two ticks; share 0 … 1, that of advance() if not given. Expects glb() before it. */
  frame(share?: number): Frame;
  /** The point at a place of the picture, in shares of width and height from the top left; aspect: width / height. */
  pick(x: number, y: number, aspect: number, camera?: Camera): Picked | null;
  /** The hand takes hold there, if a free point is there, leads it, lets go. They act at the next tick. */
  grab(x: number, y: number, aspect: number, camera?: Camera): Picked | null;
  lead(x: number, y: number, aspect: number, camera?: Camera): void;
  release(): void;
  /** A field of the scene that ramps may change goes to a value, from the next tick on. */
  set(key: string, value: number | number[], over_s?: number): void;
  /** All that set() may change: in the file's unit, its range and what it is now. */
  rampable(): {key: string; unit: string; low: number; high: number; value: number[]}[];
  /** The method, and the shortest of the steps that bodies go by [s]. */
  readonly solver: {method: string; step: number};
  metrics(): Metrics;
  /**
   * All that was done since the start as a scenario, which leads to that hash at that tick. It plays to the next frame.
   * scene: how the file is to name the scene, such as "shipped:flag"; its name if not given.
   */
  record(scene?: string): {text: string; hash: string; tick: number; deeds: number};
}
