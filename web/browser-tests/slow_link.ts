import { createConnection, createServer, type AddressInfo, type Socket } from 'node:net';

/** A way to the program that carries so many bytes a second in each direction, and buffers whatever comes. */
export interface SlowLink {
  readonly address: string;
  /** From now on; before that as much as comes. */
  carry(bytesASecond: number): void;
  close(): Promise<void>;
}

const kTurnMs = 10;
const kUnbounded = 1e12;

/** On a free port of 127.0.0.1, to the program at this address. */
export async function slowLink(to: string): Promise<SlowLink> {
  const port = Number(new URL(to).port);
  const link = { rate: kUnbounded, sockets: new Set<Socket>() };
  const server = createServer((near) => {
    const far = createConnection(port, '127.0.0.1');
    for (const socket of [near, far]) {
      link.sockets.add(socket);
      socket.setNoDelay(true);
      socket.on('error', () => socket.destroy());
    }
    for (const [from, onward] of [[near, far], [far, near]] as const) pour(from, onward, link); // prettier-ignore
  });
  await new Promise<void>((done) => server.listen(0, '127.0.0.1', done));
  return {
    address: `http://127.0.0.1:${(server.address() as AddressInfo).port}`,
    carry: (bytesASecond) => (link.rate = bytesASecond),
    close: () => {
      for (const socket of link.sockets) socket.destroy();
      return new Promise((done) => server.close(() => done()));
    },
  };
}

/** One direction: reads everything at once, and hands it on as the rate allows. */
function pour(from: Socket, onward: Socket, link: { readonly rate: number }): void {
  let waiting = Buffer.alloc(0);
  let credit = 0;
  let lastMs = performance.now();
  const turn = (): void => {
    const nowMs = performance.now();
    credit = waiting.length === 0 ? 0 : Math.min(credit + (link.rate * (nowMs - lastMs)) / 1000, waiting.length);
    lastMs = nowMs;
    const size = Math.floor(credit);
    if (size > 0) onward.write(waiting.subarray(0, size));
    waiting = waiting.subarray(size);
    credit -= size;
  };
  const timer = setInterval(turn, kTurnMs);
  from.on('data', (bytes) => (waiting = Buffer.concat([waiting, bytes])));
  from.on('close', () => {
    clearInterval(timer);
    onward.destroy();
  });
}
