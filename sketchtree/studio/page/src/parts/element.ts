// The small parts that panels are made of live in this folder. All look by style/parts.css, take their texts and test id by name, and know no store:
//
//   element    element("p", { class: "hint", testId: "hint", aria: { live: "polite" } }, "text", child)
//   button     button({ label, icon, testId, onPress })        block(button, "reason" | null)
//   choice     choice({ label, options, value, onPick })       one of a few, as a row of buttons; arrows move
//   slider     slider({ label, min, max, step, value, onInput, reset })
//   toggle     toggle({ label, on, onSwitch })                 a switch
//   dialog     dialog({ title, testId })                       .body, .foot, .open(), .close(); modal, focus kept inside, Escape closes
//   popover    popover(anchor, content)                        .open(), .close(); a press elsewhere closes
//   toast      toast("message", { remedy, kind, action })      at the foot of the screen, read aloud


type Value = string | number | boolean | null | undefined; // true: present and empty; false and null: absent

/** Attributes by name; `testId` is data-testid, and those of `aria` and `data` get that before their names. */
export type Attributes = { [name: string]: Value | Record<string, Value> };
export type Child = Node | string | null;

/** An HTML element with its attributes and what is in it. No markup is ever parsed from text. */
export function element<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  set(made, attributes);
  made.append(...children.filter((child) => child !== null));
  return made;
}

/** Other attributes; what is null or false goes. */
export function set(on: Element, attributes: Attributes): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "object" && value !== null) for (const [part, of] of Object.entries(value)) put(on, `${name}-${part}`, of);
    else put(on, name === "testId" ? "data-testid" : name, value);
  }
}

function put(on: Element, name: string, value: Value): void {
  if (value === null || value === undefined || value === false) on.removeAttribute(name);
  else on.setAttribute(name, value === true ? "" : String(value));
}

let counted = 0;

/** An id no other element has, for labels. */
export function freshId(what: string): string {
  counted += 1;
  return `${what}-${counted}`;
}
