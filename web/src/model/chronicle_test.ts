import { describe, expect, it } from 'vitest';
import { Chronicle } from './chronicle';

describe('a chronicle', () => {
  it('Before it is full it keeps every sample, and gaps', () => {
    const chronicle = new Chronicle(4, ['last', 'most'], 1);
    for (const [time, value] of [[0, 3], [1, NaN], [2, 5]] as const) chronicle.push(time, [time, value]); // prettier-ignore
    expect(chronicle.columns()).toEqual([[0, 1, 2], [0, 1, 2], [3, null, 5]]); // prettier-ignore
  });

  it('When it is full two neighbours become one, which keeps what each series asks for', () => {
    const chronicle = new Chronicle(4, ['last', 'most', 'least'], 1);
    const values = [5, 1, 4, 2, 3];
    values.forEach((value, time) => chronicle.push(time, [value, value, value]));
    expect(chronicle.columns()).toEqual([[1, 3, 4], [1, 2, 3], [5, 4, 3], [1, 2, 3]]); // prettier-ignore
  });

  it('However long it goes on it reaches from the beginning to now, in bounded memory and with every extreme', () => {
    const chronicle = new Chronicle(16, ['most', 'least'], 1);
    for (let time = 0; time < 5000; time++) chronicle.push(time, [time === 1234 ? 9 : 1, time === 777 ? -9 : 1]);
    const [times, most, least] = chronicle.columns();
    expect(times.length).toBeLessThanOrEqual(16);
    expect(times.length).toBeGreaterThan(8);
    expect(times[times.length - 1]).toBe(4999);
    expect(most).toContain(9);
    expect(least).toContain(-9);
    expect(times.findIndex((time) => time >= 1234)).toBe(most!.indexOf(9));
  });

  it('What is nearer to the last sample than its spacing goes into it; what is not newer is left out', () => {
    const chronicle = new Chronicle(8, ['most'], 1);
    for (const [time, value] of [[0, 1], [0.5, 7], [0.5, 99], [1, 2], [0.2, 99]] as const) chronicle.push(time, [value]); // prettier-ignore
    expect(chronicle.columns()).toEqual([[0.5, 1], [7, 2]]); // prettier-ignore
  });

  it('A gap gives way to a number', () => {
    const chronicle = new Chronicle(2, ['most', 'least'], 1);
    for (const [time, a, b] of [[0, NaN, 4], [1, 3, NaN], [2, 1, 1]] as const) chronicle.push(time, [a, b]); // prettier-ignore
    expect(chronicle.columns()).toEqual([[1, 2], [3, 1], [4, 1]]); // prettier-ignore
  });
});
