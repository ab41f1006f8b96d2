// How is an element made? By its tag, its attributes and what is in it. No markup is ever parsed from text.

export type Attributes = Record<string, string | number | boolean | null>; // true: present and empty; false, null: absent
export type Child = Node | string | null;

export function element<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  set(made, attributes);
  made.append(...children.filter((child) => child !== null));
  return made;
}

/** Other attributes; what is null or false goes. */
export function set(on: Element, attributes: Attributes): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === false) on.removeAttribute(name);
    else on.setAttribute(name, value === true ? "" : String(value));
  }
}
