// How does the page speak with the program when it lies in a cell of a notebook? By messages of the widget, the same ones as over the WebSocket; pictures come
// by messages too, for there is no server.
//
//     page → kernel   {say: Request} · {fetch: number, path}      kernel → page   {say: Event} · {frame: true} + [bytes] · {fetched: number} + [bytes] or none
//
// A frame waits until the pictures it names have come, and then they are told by `Store.address`.

import { VERSION, type Event, type Request, type Tree } from "../messages";
import type { Store } from "../store";
import { readFrame } from "./frames";

/** What anywidget gives a page to speak with. */
export interface Model {
  get(name: string): unknown;
  on(name: string, listener: (message: unknown, buffers: DataView[]) => void): void;
  off(name: string, listener: (message: unknown, buffers: DataView[]) => void): void;
  send(content: unknown): void;
}

type Heard = { say?: Event; frame?: boolean; fetched?: number };

/** Returns what ends it. */
export function mountComm(store: Store, model: Model): () => void {
  const pictures = new Pictures(model);
  let last: Promise<void> = Promise.resolve(); // frames are taken in the order they came
  store.address = (path) => pictures.address(path);
  store.bytes = async (path) => {
    await pictures.fetch(path);
    return (await fetch(pictures.address(path))).arrayBuffer();
  };
  store.send = (request: Request) => model.send({ say: request });

  const hear = (message: unknown, buffers: DataView[]): void => {
    const heard = message as Heard;
    if (heard.fetched !== undefined) return pictures.came(heard.fetched, buffers[0]);
    if (heard.say) {
      const event = heard.say;
      last = last.then(() => {
        store.take(event);
        if (event.type === "changed" && !store.known.connected) store.connected(true);
      });
    }
    if (heard.frame && buffers[0]) {
      const { head, arrays } = readFrame(bytes(buffers[0]).buffer);
      const wanted = head.type === "tree" ? maps(head) : [];
      const there = Promise.all(wanted.map((path) => pictures.fetch(path)));
      last = last.then(() => there).then(() => store.take(head, arrays));
    }
  };
  model.on("msg:custom", hear);
  store.send({ type: "hello", version: VERSION });
  return () => {
    model.off("msg:custom", hear);
    pictures.end();
  };
}

/** A copy that begins where an array may begin. */
function bytes(view: DataView): Uint8Array<ArrayBuffer> {
  return new Uint8Array(new Uint8Array(view.buffer, view.byteOffset, view.byteLength));
}

function maps(head: Tree): string[] {
  return head.materials.flatMap((material) => material.maps.map((map) => `/texture/${material.key}/${map}.png`));
}

/** Pictures by their path, each asked for once. */
class Pictures {
  private readonly known = new Map<string, Promise<void>>();
  private readonly addresses = new Map<string, string>();
  private readonly waiting = new Map<number, { path: string; done: () => void }>();
  private counted = 0;

  constructor(private readonly model: Model) {}

  address(path: string): string {
    const plain = path.startsWith("/") ? path : `/${path.replace(/^\.\//, "")}`;
    return this.addresses.get(plain) ?? path;
  }

  fetch(path: string): Promise<void> {
    if (!this.known.has(path)) {
      this.counted += 1;
      const number = this.counted;
      this.known.set(path, new Promise((done) => this.waiting.set(number, { path, done })));
      this.model.send({ fetch: number, path });
    }
    return this.known.get(path)!;
  }

  /** One came; without bytes there is none. */
  came(number: number, data: DataView | undefined): void {
    const asked = this.waiting.get(number);
    if (!asked) return;
    this.waiting.delete(number);
    if (data) this.addresses.set(asked.path, URL.createObjectURL(new Blob([bytes(data)], { type: "image/png" })));
    asked.done();
  }

  end(): void {
    this.addresses.forEach((address) => URL.revokeObjectURL(address));
    this.waiting.forEach(({ done }) => done());
  }
}
