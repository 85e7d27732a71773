import { FrameError, type Part } from './frames';

/** More than this is no message of ours. */
const kMostBytes = 64 << 20;

/** Puts messages that came in parts together again: of each stream one after the other, each from its beginning on. */
export class Parts {
  private readonly begun = new Map<number, { readonly bytes: Uint8Array<ArrayBuffer>; done: number }>();

  /** The bytes of the message whose last part this is; null while parts are missing. Throws FrameError. */
  take({ stream, offset, total, bytes }: Part): ArrayBuffer | null {
    if (offset === 0) this.begin(stream, total);
    const message = this.begun.get(stream);
    if (!message || message.done !== offset || message.bytes.length !== total || offset + bytes.length > total) {
      this.begun.delete(stream);
      throw new FrameError(`a part of stream ${stream} at ${offset} of ${total} bytes does not go on what came before`);
    }
    message.bytes.set(bytes, offset);
    message.done += bytes.length;
    if (message.done < total) return null;
    this.begun.delete(stream);
    return message.bytes.buffer;
  }

  forget(): void {
    this.begun.clear();
  }

  private begin(stream: number, total: number): void {
    this.begun.delete(stream);
    let kept = 0;
    for (const { bytes } of this.begun.values()) kept += bytes.length;
    if (total + kept > kMostBytes)
      throw new FrameError(`parts of messages of ${total + kept} bytes; at most ${kMostBytes}`);
    this.begun.set(stream, { bytes: new Uint8Array(total), done: 0 });
  }
}
