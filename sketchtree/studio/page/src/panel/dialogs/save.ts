// The project is kept: at once under the name it has, else under one that is asked for. A file that is there already is never overwritten unasked.

import { button } from "../../parts/button";
import { dialog, type Dialog } from "../../parts/dialog";
import { element, freshId } from "../../parts/element";
import { toast } from "../../parts/toast";
import type { Store } from "../../store";
import { EXTENSION, projectName } from "./project_name";

export function saveProject(store: Store): () => void {
  const saving = new Saving(store);
  return () => {
    const { name, welcome } = store.known;
    if (name !== null && welcome?.files.includes(name + EXTENSION)) saving.send(name + EXTENSION, false);
    else saving.open();
  };
}

class Saving {
  private readonly box: Dialog = dialog({ title: "Save the project", testId: "save-dialog" });
  private readonly field = element("input", { class: "field", id: freshId("name"), testId: "save-name" });
  private readonly words = element("p", { class: "hint", role: "status" });
  private readonly go = button({ label: "Save", icon: "save", look: "primary", testId: "save-go", onPress: () => this.save() });
  private over = ""; // the name that may be written over
  private sent = ""; // the name that is being saved

  constructor(private readonly store: Store) {
    this.field.autocomplete = "off";
    this.field.spellcheck = false;
    this.field.maxLength = 120;
    this.field.addEventListener("input", () => this.usual());
    this.field.addEventListener("keydown", (event) => { if (event.key === "Enter") this.save(); });
    const label = element("label", {}, "Name");
    label.htmlFor = this.field.id;
    this.box.body.append(element("div", { class: "name-row" }, label, element("span", { class: "with-unit" }, this.field, EXTENSION)), this.words);
    this.box.foot.append(button({ label: "Cancel", look: "quiet", onPress: this.box.close }), this.go);
    store.on("trouble", () => this.refused());
    store.on("file", () => this.saved());
  }

  open(): void {
    this.field.value = this.store.known.name ?? "my tree";
    this.usual();
    this.box.open();
    this.field.select();
  }

  send(name: string, over: boolean): void {
    this.sent = name;
    this.store.send({ type: "save", name, over });
  }

  private save(): void {
    const read = projectName(this.field.value);
    if ("wrong" in read) return this.show(read.wrong, true);
    const other = read.name !== `${this.store.known.name ?? ""}${EXTENSION}`;
    const there = this.store.known.welcome?.files.includes(read.name) ?? false;
    if (other && there && this.over !== read.name) return this.ask(read.name, `${read.name} is there already. Replace it?`);
    this.send(read.name, this.over === read.name);
  }

  /** The next press writes over that file. */
  private ask(name: string, question: string): void {
    this.over = name;
    this.go.querySelector("span")!.textContent = "Replace";
    this.show(question, true);
  }

  private usual(): void {
    this.over = "";
    this.go.querySelector("span")!.textContent = "Save";
    this.show(`In the folder “${this.store.known.welcome?.folder ?? ""}”. Drawing, edits and settings are in this one file.`);
  }

  private show(text: string, wrong = false): void {
    this.words.textContent = text;
    this.words.classList.toggle("wrong", wrong);
  }

  private refused(): void {
    const { trouble } = this.store.known;
    const name = this.sent;
    if (name === "" || trouble?.about !== "file") return;
    this.sent = "";
    this.store.known.trouble = null; // it is told here
    this.store.tell("trouble");
    if (!this.box.root.open) this.open();
    if (this.store.known.welcome?.files.includes(name)) this.ask(name, `${trouble.message} ${trouble.remedy}`);
    else this.show(`${trouble.message} ${trouble.remedy}`, true);
  }

  private saved(): void {
    if (this.sent === "" || this.sent !== `${this.store.known.file ?? ""}${EXTENSION}`) return;
    const { sent } = this;
    this.sent = "";
    this.box.close();
    toast(`Saved as ${sent}.`, { action: { label: "Save under another name", onPress: () => this.open() } });
  }
}
