/** Animates the model: a clip, which plays or is paused at a fraction of its duration, or else the looping wind. */
import type { AnimationClip, Interpolant, KeyframeTrack, Mesh, Object3D, Quaternion, Vector3 } from 'three';
import type { Model } from './model';
import { breeze } from './patch';

/** The duration of the wind loop, in seconds. */
const loop = 10;

type Keyed = KeyframeTrack & { createInterpolant(): Interpolant };

/** One animated property of one node. */
interface Channel { curve: Interpolant; set(values: ArrayLike<number>): void }

/** glTF animates four properties; the loader names a track "<node>.<property>". */
function channels_of(root: Object3D, clip: AnimationClip): Channel[] {
  const nodes = new Map<string, Object3D>();
  root.traverse((node) => { nodes.set(node.uuid, node); if (node.name && !nodes.has(node.name)) nodes.set(node.name, node); });
  return clip.tracks.flatMap((track): Channel[] => {
    const dot = track.name.lastIndexOf('.');
    const node = nodes.get(track.name.slice(0, dot)), property = track.name.slice(dot + 1);
    if (!node) return [];
    const curve = (track as Keyed).createInterpolant();
    if (property === 'morphTargetInfluences')
      return [{ curve, set: (values) => { (node as Mesh).morphTargetInfluences?.forEach((_, index, all) => { all[index] = values[index] ?? 0; }); } }];
    const target = (node as unknown as Record<string, Vector3 | Quaternion | undefined>)[property];
    return target ? [{ curve, set: (values) => { target.fromArray(Array.from(values)); } }] : [];
  });
}

export class Motion {
  /** Called with the current fraction while the animation plays. */
  on_time: (share: number) => void = () => {};
  /** The next animated model starts to play from the beginning. */
  begins = false;
  private channels: Channel[] = [];
  private blows = false;
  private duration = 0;
  private running = false;
  private last = 0;
  private share = 1;

  get has_clip(): boolean { return this.channels.length > 0 || this.blows; }
  get is_running(): boolean { return this.running; }
  get seconds(): number { return this.duration; }
  /** The current fraction of the duration. */
  get at(): number { return this.share; }

  take(model: Model | null): void {
    const clip = model?.clips[0];
    const blew = this.blows, had_clip = this.channels.length > 0;
    this.blows = !clip && model !== null && model.sways;
    // The next seed continues at the time of the previous one. A new kind of motion starts at its end, where growth
    // is complete.
    const goes_on = this.blows ? blew : clip !== undefined && had_clip;
    if (this.begins && clip) this.share = 0;
    else if (!goes_on) this.share = 1;
    this.running = (this.blows || clip !== undefined) && (this.begins || (goes_on && this.running));
    this.begins = false;
    this.last = performance.now();
    this.channels = model && clip ? channels_of(model.root, clip) : [];
    this.duration = this.blows ? loop : clip?.duration ?? 0;
    const height = model ? model.box.max.y - model.box.min.y : 0;
    breeze.value.set(0, this.blows ? height * 0.07 : 0, this.blows ? height * 0.006 : 0);
    this.stand(this.share);
  }

  /** 0 is the first frame, 1 the last. */
  stand(share: number): void {
    this.share = share;
    breeze.value.x = share * 2 * Math.PI;
    for (const { curve, set } of this.channels) set(curve.evaluate(share * this.duration) as ArrayLike<number>);
  }

  run(on: boolean): void {
    this.running = on && this.has_clip;
    if (this.running && this.share > 0.999) this.stand(0);
    this.last = performance.now();
  }

  /** Advances by the time since the last call; returns true while more frames are needed. */
  step(): boolean {
    if (!this.running) return false;
    const now = performance.now();
    const next = this.share + (now - this.last) / 1000 / Math.max(this.duration, 1e-3);
    this.stand(this.blows ? next % 1 : Math.min(1, next));
    this.last = now;
    if (this.share >= 1) this.running = false;
    this.on_time(this.share);
    return this.running;
  }
}
