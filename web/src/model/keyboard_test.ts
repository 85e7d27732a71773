import { describe, expect, it } from 'vitest';
import {
  actionOf,
  chordOf,
  kUsualKeys,
  readKeyMap,
  remapped,
  meaningInField,
  TwoPresses,
  type KeyPress,
} from './keyboard';

const press = (key: string, more: Partial<KeyPress> = {}): string =>
  chordOf({ key, ctrl: false, shift: false, alt: false, ...more });

describe('keyboard', () => {
  it('The usual keys do what the help says', () => {
    expect(actionOf(kUsualKeys, press('l'))).toBe('land');
    expect(actionOf(kUsualKeys, press('L', { shift: true }))).toBe('land-all');
    expect(actionOf(kUsualKeys, press('z', { ctrl: true }))).toBe('undo');
    expect(actionOf(kUsualKeys, press('Z', { ctrl: true, shift: true }))).toBe('redo');
    expect(actionOf(kUsualKeys, press('?', { shift: true }))).toBe('help');
    expect(actionOf(kUsualKeys, press(' '))).toBe('place-here');
    expect(actionOf(kUsualKeys, press('3'))).toBe('drone-3');
    expect(actionOf(kUsualKeys, press('q'))).toBe(null);
  });

  it('No two actions share their usual keys', () => {
    expect(new Set(Object.values(kUsualKeys)).size).toBe(Object.keys(kUsualKeys).length);
  });

  it('A key that is taken is refused with the action that has it', () => {
    expect(remapped(kUsualKeys, 'fit', 'L')).toBe('L already does “Land”.');
    expect(remapped(kUsualKeys, 'fit', '4')).toBe('The digits select drones.');
    expect(remapped(kUsualKeys, 'fit', 'Shift+Shift')).toMatch(/modifier/);
  });

  it('A remapped key works and the old one does nothing', () => {
    const map = remapped(kUsualKeys, 'fit', 'Q');
    if (typeof map === 'string') throw new Error(map);
    expect(actionOf(map, 'Q')).toBe('fit');
    expect(actionOf(map, 'F')).toBe(null);
  });

  it('A stored map that is damaged gives usual keys', () => {
    for (const stored of [null, '', '[', '3', 'null', '{"fit": 3, "nothing": "Q"}'])
      expect(readKeyMap(stored)).toEqual(kUsualKeys);
    expect(readKeyMap('{"fit": "Q"}').fit).toBe('Q');
  });

  it('The emergency stop needs two presses within 0.8 s', () => {
    const stop = new TwoPresses();
    expect(stop.press(0)).toBe(false);
    expect(stop.press(801)).toBe(false);
    expect(stop.press(1601)).toBe(true);
  });

  it('A third press does not stop the motors once more', () => {
    const stop = new TwoPresses();
    expect([0, 100, 200, 300].map((t) => stop.press(t))).toEqual([false, true, false, true]);
  });

  it('In a number field LAND ALL acts, unless it was given a key that numbers have', () => {
    expect(meaningInField(true, 'land-all', 'L')).toBe('land-all');
    expect(meaningInField(true, 'land-all', '-')).toBe('typed');
    expect(meaningInField(true, 'land-all', 'Backspace')).toBe('typed');
    expect(meaningInField(true, 'fit', 'f')).toBe('typed');
  });

  it('In a name Shift+L is text; dots are told apart from dots in a number', () => {
    expect(meaningInField(false, 'land-all', 'L')).toBe('typed');
    expect(meaningInField(false, 'emergency-stop', '.')).toBe('stop-in-text');
    expect(meaningInField(true, 'emergency-stop', '.')).toBe('stop-in-number');
  });

  it('Presses that something came between are not two presses', () => {
    const stop = new TwoPresses();
    stop.press(0);
    stop.forget();
    expect(stop.press(100)).toBe(false);
  });
});
