// Which keys are there? A sheet of all, made from the table in keys.ts.

import { dialog, type Dialog } from "../parts/dialog";
import { element } from "../parts/element";
import { SHORTCUTS, type Shortcut } from "./keys";

const FILE: Pick<Shortcut, "shown" | "does">[] = [
  { shown: "Ctrl S", does: "Save" }, { shown: "Ctrl O", does: "Open" }, { shown: "Ctrl Alt N", does: "New page" },
  { shown: "Ctrl E", does: "Export" }, { shown: "?", does: "This sheet" },
];

const PEN: Pick<Shortcut, "shown" | "does">[] = [
  { shown: "Wheel", does: "Closer and farther" }, { shown: "Space + drag", does: "Move the page" },
  { shown: "Right drag", does: "Turn the page about the tree; on a photo, a branch, or what is not tree" },
  { shown: "Two fingers", does: "Move and zoom the page" }, { shown: "Alt + erase", does: "Cut out a part" },
  { shown: "Shift + click", does: "Select one more; with points, from here to the next click" },
];

export function makeSheet(): Dialog {
  const made = dialog({ title: "Keys and gestures", testId: "keys", wide: true });
  const groups: [string, Pick<Shortcut, "shown" | "does">[]][] = [
    ...(["Tools", "Trunk from scribbles", "Edit", "View"] as const).map((group): [string, Shortcut[]] => [group, SHORTCUTS.filter((one) => one.group === group && one.shown)]),
    ["Pen, mouse, fingers", PEN], ["File", FILE],
  ];
  made.body.classList.add("keys");
  made.body.append(...groups.map(([title, rows]) => element("section", {}, element("h3", {}, title), element("dl", {}, ...rows.flatMap(row)))));
  return made;
}

function row({ shown, does }: Pick<Shortcut, "shown" | "does">): HTMLElement[] {
  return [element("dt", {}, element("kbd", {}, shown)), element("dd", {}, does)];
}
