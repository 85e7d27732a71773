import { describe, expect, it } from 'vitest';
import { Scrubbing } from './scrubbing';
import type { Session } from './session';

/** A session whose program answers when the test says so. */
function slowProgram() {
  const asked: number[] = [];
  const answers: ((ok: boolean) => void)[] = [];
  const command = async ({ time_s }: { time_s: number }): Promise<boolean> => {
    asked.push(time_s);
    return new Promise((answer) => answers.push(answer));
  };
  const answer = async (ok: boolean): Promise<void> => {
    answers.shift()!(ok);
    await Promise.resolve();
    await Promise.resolve();
  };
  return { scrubbing: new Scrubbing({ command } as unknown as Session), asked, answer };
}

describe('scrubbing', () => {
  it('asks for the newest place alone when the program has followed', async () => {
    const { scrubbing, asked, answer } = slowProgram();
    for (const timeS of [1, 2, 3, 4]) scrubbing.to(timeS);
    expect(asked).toEqual([1]);
    await answer(true);
    expect(asked).toEqual([1, 4]);
    await answer(true);
    expect(asked).toEqual([1, 4]);
    scrubbing.to(5);
    expect(asked).toEqual([1, 4, 5]);
  });

  it('asks for the newest place also where the one before was refused', async () => {
    const { scrubbing, asked, answer } = slowProgram();
    scrubbing.to(1);
    scrubbing.to(2);
    await answer(false);
    expect(asked).toEqual([1, 2]);
    await answer(false);
    scrubbing.to(3);
    expect(asked).toEqual([1, 2, 3]);
  });
});
