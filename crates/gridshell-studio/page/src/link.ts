// The socket to the server: messages as JSON, frames as flat arrays; opened anew when it breaks.
import type { Event, FrameHead, Request, Scale, Shows } from "./messages";
import { Signals } from "./signals";

/** A frame with its arrays laid over the bytes that came. */
export interface Frame {
  shows: Shows;
  run: number;
  scale: Scale | null;
  arrays: Map<string, Float32Array | Uint32Array>;
}

/** What is heard of by name: events by their kind, and whether the server can be reached. */
type Heard = { [K in Event["kind"]]: Extract<Event, { kind: K }> } & { connected: boolean };

/** Waiting before the next attempt, milliseconds: first and longest. */
const PAUSE = [250, 4000] as const;

export class Link {
  private socket: WebSocket | null = null;
  private pause: number = PAUSE[0];
  private readonly events = new Signals<Heard>();
  private readonly frames = new Signals<Record<Shows, Frame>>();

  constructor() {
    this.open();
  }

  on<K extends keyof Heard>(kind: K, act: (event: Heard[K]) => void): void {
    this.events.on(kind, act);
  }

  onFrame(shows: Shows, act: (frame: Frame) => void): void {
    this.frames.on(shows, act);
  }

  send(request: Request): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(request));
    return true;
  }

  private open(): void {
    const address = new URL("socket", location.href);
    address.protocol = "ws:";
    const socket = new WebSocket(address);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.pause = PAUSE[0];
      this.events.tell("connected", true);
    };
    socket.onmessage = (message: MessageEvent<string | ArrayBuffer>) => {
      if (typeof message.data === "string") {
        const event = JSON.parse(message.data) as Event;
        this.events.tell(event.kind, event);
      } else {
        const frame = decode(message.data);
        this.frames.tell(frame.shows, frame);
      }
    };
    socket.onclose = () => {
      this.events.tell("connected", false);
      setTimeout(() => this.open(), this.pause);
      this.pause = Math.min(2 * this.pause, PAUSE[1]);
    };
    this.socket = socket;
  }
}

export function decode(bytes: ArrayBuffer): Frame {
  const length = new DataView(bytes).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length))) as FrameHead;
  const arrays = new Map<string, Float32Array | Uint32Array>();
  let at = 4 + length;
  for (const array of head.arrays) {
    const kind = array.of === "f32" ? Float32Array : Uint32Array;
    arrays.set(array.name, new kind(bytes, at, array.length));
    at += 4 * array.length;
  }
  return { shows: head.shows, run: head.run, scale: head.scale, arrays };
}

export function floats(frame: Frame, name: string): Float32Array {
  const array = frame.arrays.get(name);
  return array instanceof Float32Array ? array : new Float32Array();
}

export function wholes(frame: Frame, name: string): Uint32Array {
  const array = frame.arrays.get(name);
  return array instanceof Uint32Array ? array : new Uint32Array();
}
