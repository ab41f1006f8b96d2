// The small parts that panels are made of live in this folder. All look by style/parts.css, take their texts and test id by name, and know no store:
//
//   element    element("p", { class: "hint" }, "text", child)
//   button     button({ label, icon, testId, onPress })        block(button, "reason" | null)
//   choice     choice({ label, options, value, onPick })       one of a few, as a row of buttons; arrows move
//   slider     slider({ label, min, max, step, value, onInput, reset })
//   toggle     toggle({ label, on, onSwitch })                 a switch
//   dialog     dialog({ title, testId })                       .body, .foot, .open(), .close(); modal, focus kept inside, Escape closes
//   popover    popover(anchor, content)                        .open(), .close(); a press elsewhere closes
//   toast      toast("message", { remedy, kind, action })      at the foot of the screen, read aloud

type Child = Node | string | null | undefined | false;

interface Props {
  class?: string;
  id?: string;
  testId?: string;
  title?: string;
  role?: string;
  aria?: Record<string, string>;
  data?: Record<string, string>;
}

/** An HTML element with its class, marks and children. */
export function element<K extends keyof HTMLElementTagNameMap>(tag: K, props: Props = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  if (props.class) made.className = props.class;
  if (props.id) made.id = props.id;
  if (props.title) made.title = props.title;
  if (props.role) made.setAttribute("role", props.role);
  if (props.testId) made.dataset.testid = props.testId;
  for (const [name, value] of Object.entries(props.aria ?? {})) made.setAttribute(`aria-${name}`, value);
  for (const [name, value] of Object.entries(props.data ?? {})) made.dataset[name] = value;
  for (const child of children) if (child) made.append(child);
  return made;
}

let counted = 0;

/** An id no other element has, for labels. */
export function freshId(what: string): string {
  counted += 1;
  return `${what}-${counted}`;
}
