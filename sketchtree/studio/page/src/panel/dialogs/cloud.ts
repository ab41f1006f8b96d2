// A point cloud is to be opened: which axis is up, what 1 in the file means, and does it lie behind the drawing that is there or on a page of its own? What is refused is told in the dialog, which
// stays open: another choice, and it is tried again.

import type { CloudReading } from "../../messages";
import { block, button } from "../../parts/button";
import { choice } from "../../parts/choice";
import { dialog, type Dialog } from "../../parts/dialog";
import { element, freshId } from "../../parts/element";
import { Refused } from "../ask";
import { HOW_UNIT, HOW_UP, reading, type Said, type Unit, type Up } from "./cloud_words";
import { treeDialog } from "./which_tree";

export type CloudUse = "cloud" | "drawing"; // behind the drawing, or in its place

export interface CloudAsked {
  name: string;
  drawn: boolean; // there is a drawing that the points may lie behind
  read: (use: CloudUse, reading: CloudReading) => Promise<void>; // raises `Refused`
}

/** What became of it; null: it was closed. */
export function cloudDialog(asked: CloudAsked): Promise<CloudUse | null> {
  return new Promise((resolve) => new Asking(asked, resolve).open());
}

class Asking {
  private answer: CloudUse | null = null;
  private readonly said: Said = { up: "auto", unit: "m", height: "" };
  private readonly box: Dialog;
  private readonly height = element("input", { class: "field figure", id: freshId("plant"), testId: "cloud-height" });
  private readonly high = element("div", { class: "row" });
  private readonly wrongHeight = element("p", { class: "hint wrong", id: freshId("wrong"), testId: "cloud-wrong-height" });
  private readonly upWords = element("p", { class: "hint" });
  private readonly unitWords = element("p", { class: "hint" });
  private readonly refusal = element("p", { class: "export-trouble", role: "alert", testId: "cloud-refusal" });
  private readonly work = element("span", { class: "foot-words hint", role: "status" });
  private readonly buttons: HTMLButtonElement[];

  constructor(private readonly asked: CloudAsked, resolve: (use: CloudUse | null) => void) {
    this.box = dialog({ title: `Points of ${asked.name}`, testId: "cloud-dialog", onClose: () => { this.box.root.remove(); resolve(this.answer); } });
    const go = (use: CloudUse, label: string, hint: string, testId: string, look?: "primary"): HTMLButtonElement =>
      button({ label, hint, testId, ...(look ? { look } : {}), onPress: () => { void this.read(use); } });
    this.buttons = asked.drawn
      ? [go("drawing", "On a new page", "An empty page with the points behind it", "cloud-alone"), go("cloud", "Behind my drawing", "Their foot at its foot, and as high as it: its limbs take their depth from the points", "cloud-under", "primary")]
      : [go("drawing", "Open", "An empty page with the points behind it", "cloud-open", "primary")];
    this.box.body.append(...this.controls());
    this.box.foot.append(this.work, button({ label: "Cancel", look: "quiet", onPress: this.box.close }), ...this.buttons);
    this.show();
  }

  open(): void {
    this.box.open();
    this.buttons[this.buttons.length - 1]!.focus(); // mostly all is as it should be: Enter opens it
  }

  private controls(): HTMLElement[] {
    const up = choice<Up>({
      label: "Up", showLabel: true, value: this.said.up, testId: "cloud-up", onPick: (value) => { this.said.up = value; this.show(); },
      options: [{ value: "auto", label: "Find it" }, { value: "y", label: "y" }, { value: "z", label: "z" }],
    });
    const unit = choice<Unit>({
      label: "1 in the file is", showLabel: true, value: this.said.unit, testId: "cloud-unit", onPick: (value) => { this.said.unit = value; this.show(); },
      options: [{ value: "m", label: "1 m" }, { value: "cm", label: "1 cm" }, { value: "mm", label: "1 mm" }, { value: "height", label: "By height" }],
    });
    this.height.type = "number";
    this.height.step = "any";
    this.height.inputMode = "decimal";
    this.height.setAttribute("aria-describedby", this.wrongHeight.id);
    this.height.addEventListener("input", () => { this.said.height = this.height.value; this.wrong(""); });
    this.height.addEventListener("keydown", (event) => { if (event.key === "Enter") this.buttons[this.buttons.length - 1]!.click(); });
    const label = element("label", { class: "row-label" }, "The plant is");
    label.htmlFor = this.height.id;
    this.high.append(label, element("span", { class: "with-unit" }, this.height, "m high"));
    return [element("div", { class: "cloud-asked" }, up.root, this.upWords, unit.root, this.unitWords, this.high, this.wrongHeight), this.refusal];
  }

  private show(): void {
    this.upWords.textContent = HOW_UP[this.said.up];
    this.unitWords.textContent = HOW_UNIT[this.said.unit];
    this.high.hidden = this.said.unit !== "height";
    this.wrong("");
    this.refusal.hidden = true;
  }

  private wrong(text: string): void {
    this.wrongHeight.textContent = text;
    this.wrongHeight.hidden = text === "";
    if (text) this.height.setAttribute("aria-invalid", "true");
    else this.height.removeAttribute("aria-invalid");
  }

  /** Read as it is chosen now; what is refused is said here. */
  private async read(use: CloudUse): Promise<void> {
    const wanted = reading(this.said);
    if ("wrong" in wanted) {
      this.wrong(wanted.wrong);
      this.height.focus();
      return;
    }
    this.refusal.hidden = true;
    this.works(true);
    try {
      if (await this.readOne(use, wanted.reading)) {
        this.answer = use;
        this.box.close();
      }
    } catch (error) {
      this.refusal.textContent = error instanceof Refused ? `${error.message} ${error.remedy}` : `${this.asked.name} could not be read. Try again; if it stays so, start the studio again.`;
      this.refusal.hidden = false;
    } finally {
      this.works(false);
    }
  }

  /** False: several trees stand in it, and none was chosen. */
  private async readOne(use: CloudUse, wanted: CloudReading): Promise<boolean> {
    try {
      await this.asked.read(use, wanted);
    } catch (error) {
      if (!(error instanceof Refused) || error.trees.length === 0) throw error;
      const tree = await treeDialog(this.asked.name, error.trees);
      if (tree === null) return false;
      await this.asked.read(use, { ...wanted, tree });
    }
    return true;
  }

  private works(on: boolean): void {
    this.work.textContent = on ? "Reading the points …" : "";
    for (const one of this.buttons) block(one, on ? "the points are being read" : null);
  }
}
