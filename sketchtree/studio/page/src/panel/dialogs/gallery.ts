// What can be drawn? Examples, each opened by a click.

import { dialog } from "../../parts/dialog";
import { element } from "../../parts/element";
import { thumbnail } from "../../parts/thumbnail";
import type { Choice } from "../../messages";
import type { Store } from "../../store";
import { onList } from "../catalogue";
import { roving } from "../roving";

const PHOTO = /\.(jpg|ply)$/; // pictures that fill their frame

export function gallery(store: Store): () => void {
  const box = dialog({ title: "Examples", testId: "gallery-dialog", wide: true });
  const grid = element("div", { class: "gallery", role: "group", aria: { label: "Examples" } });
  const walk = roving(grid, () => [...grid.querySelectorAll<HTMLElement>("button")]);
  box.body.append(element("p", { class: "hint" }, "Open one, draw a branch more, take one away. Undo brings back what is on the page now."), grid);
  onList(store, (welcome) => welcome.examples, (examples) => {
    grid.replaceChildren(...examples.map((one) => example({ ...one, picture: one.picture && store.address(one.picture) }, () => {
      box.close();
      store.send({ type: "open", name: one.name, example: true });
    })));
    walk.keep();
  });
  return () => {
    box.open();
    grid.querySelector("button")?.focus();
  };
}

function example(choice: Choice, onPress: () => void): HTMLElement {
  const made = element("button", { class: "example", title: `Open ${choice.title}`, testId: `example-${choice.name}` });
  made.type = "button";
  const look = PHOTO.test(choice.name) ? "example-picture photo" : "example-picture";
  const frame = choice.picture === null ? element("span", { class: look }) : thumbnail(choice.picture, look);
  made.append(frame, element("span", {}, choice.title));
  made.addEventListener("click", onPress);
  return made;
}
