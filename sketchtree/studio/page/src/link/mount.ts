// How does the page speak with the program? Requests of the store go out by the outbox, events come in and are taken by the store; strokes on their way are
// on the shelf as well.

import { VERSION, type Changed, type Event, type Request } from "../messages";
import type { Store } from "../store";
import { readFrame } from "./frames";
import { Line } from "./line";
import { Outbox } from "./outbox";
import { Shelf, type Kept } from "./shelf";

/** Where the program listens: beside the page. */
export function address(page: string): string {
  const url = new URL("ws", page);
  url.protocol = url.protocol === "https:" ? "wss:" : "ws:";
  url.search = url.hash = "";
  return url.href;
}

const REFUSED = 1500; // ms without an answer after a trouble: then what was sent was refused

export function mountLink(store: Store, shelf: Shelf = new Shelf()): void {
  const outbox = new Outbox((request) => line.send(JSON.stringify(request)), firstKey());
  let asked = false; // `Hello` was said, the whole drawing is next
  let restored = false;

  const hello = (): void => {
    asked = true;
    line.send(JSON.stringify({ type: "hello", version: VERSION } satisfies Request));
  };

  store.send = (request: Request): void => {
    const kept = outbox.add(request);
    if (!kept || kept.request.type !== "strokes") return;
    store.setPending(outbox.strokes, kept.request);
    void shelf.put({ key: kept.key, project: projectOf(store), request: kept.request });
  };

  const restore = async (): Promise<void> => {
    restored = true;
    const left = await shelf.all(projectOf(store));
    const isKnown = ({ request }: Kept): boolean => !!request.put?.length && request.put.every((stroke) => store.known.strokes.has(stroke.id));
    const lost = left.filter((one) => !isKnown(one) && !outbox.has(one.key));
    outbox.restore(lost.map(({ key, request }) => ({ key, request, sent: false })));
    if (lost.length) store.setPending(outbox.strokes);
    void shelf.remove(left.filter((one) => isKnown(one) && !outbox.has(one.key)).map((one) => one.key));
  };

  const changed = (event: Changed): void => {
    const answer = asked && event.since === 0;
    if (answer) asked = false;
    void shelf.remove(outbox.changed(event, answer));
    store.pending = outbox.strokes;
    store.take(event);
    if (answer && !store.known.connected) store.connected(true);
  };

  /** Something was refused; if it was a stroke on its way, the program will never confirm it: ask what there is. */
  const refused = (): void => {
    const { oldest } = outbox;
    if (oldest !== null) setTimeout(() => { if (outbox.oldest === oldest && store.known.connected) hello(); }, REFUSED);
  };

  const take = (event: Event): void => {
    if (event.type === "changed") changed(event);
    else store.take(event);
    if (event.type === "trouble") refused();
    if (!restored && store.known.welcome && store.known.connected) void restore();
  };

  const line = new Line(address(location.href), {
    onOpen: hello,
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

/** Whose strokes those on the shelf are. */
function projectOf(store: Store): string {
  return `${store.known.welcome?.folder ?? ""}/${store.known.name ?? ""}`;
}

/** Grows from visit to visit, and differs between two pages that are open at once. */
function firstKey(): number {
  return Date.now() * 1000 + Math.floor(Math.random() * 1000);
}
