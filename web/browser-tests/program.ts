import { spawn, type ChildProcess } from 'node:child_process';
import { existsSync } from 'node:fs';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';

const kRoot = fileURLToPath(new URL('../..', import.meta.url));
export const kProgram = process.env['VIGIL_PROGRAM'] ?? `${kRoot}/build/release/vigil/apps/vigil`;

export interface Program {
  readonly address: string;
  /** Ends it as Ctrl-C does; resolves when it is gone. */
  stop(): Promise<void>;
  /** Ends it as a crash would. */
  kill(): Promise<void>;
}

/** `vigil serve` with a simulated fleet on 127.0.0.1; port 0: a free one. Gives it back once it listens. */
export async function serve(mission: string, options: readonly string[] = [], port = 0): Promise<Program> {
  if (!existsSync(kProgram)) throw new Error(`no program at ${kProgram}: build it, or set VIGIL_PROGRAM`);
  const page = `${kRoot}/web/dist`;
  const file = mission.includes('/') ? mission : `${kRoot}/missions/${mission}`;
  return start(kProgram, ['serve', file, '--port', String(port), '--page', page, ...options]);
}

/** `vigil replay` of a recorded flight's folder. */
export async function replay(folder: string): Promise<Program> {
  return start(kProgram, ['replay', folder, '--port', '0', '--page', `${kRoot}/web/dist`]);
}

/** Any command that serves the console and prints its address. */
export async function start(command: string, options: readonly string[]): Promise<Program> {
  const child = spawn(command, options, { stdio: ['ignore', 'pipe', 'pipe'] });
  // A test run that ends in whatever way leaves no program behind.
  const takeAlong = (): void => void child.kill('SIGKILL');
  process.once('exit', takeAlong);
  child.once('exit', () => process.off('exit', takeAlong));
  const ended = new Promise<void>((done) => child.once('exit', () => done()));
  const end = (signal: NodeJS.Signals) => async (): Promise<void> => {
    child.kill(signal);
    await ended;
  };
  return { address: await addressFrom(child), stop: end('SIGINT'), kill: end('SIGKILL') };
}

/** The program prints where it listens. */
async function addressFrom(child: ChildProcess): Promise<string> {
  let said = '';
  return new Promise((found, failed) => {
    for (const stream of [child.stdout!, child.stderr!])
      createInterface({ input: stream }).on('line', (line) => {
        said += `${line}\n`;
        const address = /https?:\/\/[\d.]+:\d+/.exec(line);
        if (address) found(address[0]);
      });
    child.once('exit', (code) => failed(new Error(`vigil serve ended with code ${code}: ${said}`)));
  });
}
