import { effect, signal, type Signal } from '@preact/signals';
import { readKeyMap, type KeyMap } from '../model/keyboard';
import type { Span } from './series';

/** What this browser remembers of how its person likes things. Never a token. */

const kPrefix = 'vigil.';

function stored(key: string): string | null {
  try {
    return localStorage.getItem(kPrefix + key);
  } catch {
    return null; // private windows may have no storage: settings then last as long as the page
  }
}

function kept<T>(key: string, read: (text: string | null) => T, write: (value: T) => string): Signal<T> {
  const value = signal(read(stored(key)));
  effect(() => {
    const text = write(value.value);
    try {
      localStorage.setItem(kPrefix + key, text);
    } catch {
      return;
    }
  });
  return value;
}

export type Theme = 'dark' | 'light';

export const kLayers = ['density', 'coverage', 'age', 'trails', 'drones', 'radii', 'noFly', 'labels', 'grid'] as const;
export type Layer = (typeof kLayers)[number];
export const kLayerNames: Record<Layer, string> = {
  density: 'Importance',
  coverage: 'Achieved coverage',
  age: 'Age: time since seen',
  trails: 'Trails',
  drones: 'Drones',
  radii: 'Safety radii',
  noFly: 'No-fly',
  labels: 'Labels',
  grid: 'Grid and coordinates',
};

const kShownFirst: readonly Layer[] = ['density', 'trails', 'drones', 'noFly', 'labels', 'grid'];

function readLayers(text: string | null): ReadonlySet<Layer> {
  if (text === null) return new Set(kShownFirst);
  const words = text.split(',');
  return new Set(kLayers.filter((layer) => words.includes(layer)));
}

export class Settings {
  readonly plotSpan = kept<Span>('plot-span', (text) => (text === 'recent' ? 'recent' : 'whole'), String);
  readonly theme = kept<Theme>('theme', (text) => (text === 'light' ? 'light' : 'dark'), String);
  readonly isMuted = kept<boolean>(
    'muted',
    (text) => text === 'yes',
    (value) => (value ? 'yes' : 'no'),
  );
  readonly name = kept<string>('name', (text) => (text ?? '').slice(0, 32), String);
  readonly keys = kept<KeyMap>('keys', readKeyMap, (map) => JSON.stringify(map));
  readonly layers = kept<ReadonlySet<Layer>>('layers', readLayers, (layers) => [...layers].join(','));

  toggle(layer: Layer): void {
    const next = new Set(this.layers.value);
    if (!next.delete(layer)) next.add(layer);
    this.layers.value = next;
  }
}
