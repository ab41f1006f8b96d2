// How do small pictures come to the page? Only those that are in sight, and a few at a time: the program may have to make each, and the browser has but six lines
// to it, which the tree's own bark and leaves need first. Until one is there its place is seen; one that never comes leaves the place empty, not broken.

import { Queue } from "./queue";
import { element } from "./element";

const AT_ONCE = 2;

const queue = new Queue<HTMLImageElement>(AT_ONCE, (image) => image.isConnected);
const addresses = new WeakMap<HTMLImageElement, string>();
let sight: IntersectionObserver | null = null;

export function thumbnail(address: string, name: string): HTMLElement {
  const image = element("img");
  image.alt = "";
  image.decoding = "async";
  image.draggable = false;
  const place = element("span", { class: `thumbnail ${name}` }, image);
  addresses.set(image, address);
  sight ??= new IntersectionObserver(seen, { rootMargin: "80px" });
  sight.observe(image);
  return place;
}

function seen(entries: IntersectionObserverEntry[]): void {
  for (const { isIntersecting, target } of entries) {
    if (!isIntersecting || !(target instanceof HTMLImageElement)) continue;
    sight!.unobserve(target);
    queue.add(target, () => load(target, addresses.get(target)!));
  }
}

function load(image: HTMLImageElement, address: string): Promise<void> {
  return new Promise((done) => {
    const say = (state: string) => (): void => {
      image.parentElement?.setAttribute("data-picture", state);
      done();
    };
    image.addEventListener("load", say("there"), { once: true });
    image.addEventListener("error", say("missing"), { once: true });
    image.src = address;
  });
}
