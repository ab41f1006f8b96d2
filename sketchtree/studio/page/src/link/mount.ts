// How does the page speak with the program? Requests of the store go out by the outbox, events come in and are taken by the store; strokes on their way are
// on the shelf as well.

import { VERSION, type Event, type Request } from "../messages";
import type { Store } from "../store";
import { readFrame } from "./frames";
import { Line } from "./line";
import { Outbox } from "./outbox";
import { Shelf } from "./shelf";

/** Where the program listens: beside the page. */
export function address(page: string): string {
  const url = new URL("ws", page);
  url.protocol = url.protocol === "https:" ? "wss:" : "ws:";
  url.search = url.hash = "";
  return url.href;
}

export function mountLink(store: Store, shelf: Shelf = new Shelf()): void {
  const outbox = new Outbox((request) => line.send(JSON.stringify(request)), firstKey());
  let greeted = false; // `Welcome` came; the whole drawing is next
  let project = ""; // whose strokes those on the shelf are
  let restored = false;

  store.send = (request: Request): void => {
    const kept = outbox.add(request);
    if (!kept || kept.request.type !== "strokes") return;
    store.setPending(outbox.strokes);
    void shelf.put({ key: kept.key, project, request: kept.request });
  };

  const restore = async (): Promise<void> => {
    restored = true;
    const left = (await shelf.all(project)).filter(({ request }) => !outbox.strokes.some((own) => own === request));
    const known = left.filter(({ request }) => (request.put ?? []).every((stroke) => store.known.strokes.has(stroke.id)) && request.put?.length);
    outbox.restore(left.filter((one) => !known.includes(one)).map(({ key, request }) => ({ key, request, sent: false })));
    if (outbox.size) store.setPending(outbox.strokes);
    void shelf.remove(known.map((one) => one.key));
  };

  const take = (event: Event): void => {
    if (event.type === "welcome") greeted = true;
    if (event.type !== "changed") return store.take(event);
    const answer = greeted && event.since === 0;
    if (answer) greeted = false;
    void shelf.remove(outbox.changed(event, answer));
    store.pending = outbox.strokes;
    store.take(event);
    if (!answer) return;
    project = `${store.known.welcome?.folder ?? ""}/${store.known.name ?? ""}`;
    store.connected(true);
    if (!restored) void restore();
  };

  const line = new Line(address(location.href), {
    onOpen: () => line.send(JSON.stringify({ type: "hello", version: VERSION } satisfies Request)),
    onText: (text) => take(JSON.parse(text) as Event),
    onBinary: (data) => {
      const { head, arrays } = readFrame(data);
      store.take(head, arrays);
    },
    onBreak: () => {
      outbox.broke();
      if (store.known.connected) store.connected(false);
    },
  });
}

/** Grows from visit to visit, and differs between two pages that are open at once. */
function firstKey(): number {
  return Date.now() * 1000 + Math.floor(Math.random() * 1000);
}
