// One format of the export dialog: a press makes the file and saves it. It says how far it is, how big the file is, or why there is none.

import { element } from "../../parts/element";
import type { Choice } from "../../messages";
import type { Store } from "../../store";
import { ask, Refused } from "../ask";
import { download, nameOf } from "../download";
import { bytes, duration } from "../figures";
import { Pending } from "../pending";
import type { GrownOptions } from "./export_growth";
import type { ExportOptions } from "./export_options";

const TICK = 200; // milliseconds between two figures of the clock

/** As the program's `Export`. */
export type Wanted = { format: string; tree: "photo" | "drawn"; revision: number } & (ExportOptions | { growth: GrownOptions });

export interface FormatLook {
  store: Store;
  format: Choice;
  hint: string;
  testId: string;
  request: () => Wanted;
  failed: (error: Refused) => void; // what went wrong, for the dialog to tell
  started: () => void;
}

export function formatButton(look: FormatLook): HTMLButtonElement {
  const extension = look.format.name.replace(/^\./, "");
  const note = element("span", { class: "format-note" }, look.hint);
  const title = element("span", { class: "format-title" }, look.format.title);
  const words = [element("strong", {}, `.${extension}`), note, title];
  const made = element("button", { class: "format", title: `${look.format.title}: make it and save it`, testId: `${look.testId}-${extension}` }, ...words);
  made.type = "button";
  let working: AbortController | null = null;
  made.addEventListener("click", () => {
    if (working) return working.abort();
    working = new AbortController();
    look.started();
    made.classList.add("working");
    title.textContent = "Press to stop";
    made.style.setProperty("--part", "0%");
    void make(look, working.signal, note, (done) => made.style.setProperty("--part", `${Math.round(100 * done)}%`)).finally(() => {
      working = null;
      made.classList.remove("working");
      title.textContent = look.format.title;
    });
  });
  return made;
}

async function make(look: FormatLook, signal: AbortSignal, note: HTMLElement, part: (done: number) => void): Promise<void> {
  const began = performance.now();
  let share = 0;
  const pending = new Pending(look.store, (done) => part((share = done)));
  const passed = (): string => `${((performance.now() - began) / 1000).toFixed(1)} s`;
  const clock = setInterval(() => { note.textContent = `${share > 0 ? `${Math.round(100 * share)} %, ` : ""}${passed()}`; }, TICK);
  note.textContent = "Working";
  try {
    const body = JSON.stringify({ ...look.request(), id: pending.id });
    const answer = await ask("export", { method: "POST", headers: { "content-type": "application/json" }, body, signal });
    const contents = await answer.blob();
    download(contents, nameOf(answer, `tree${look.format.name}`));
    note.textContent = `Saved, ${bytes(contents.size)} in ${duration(performance.now() - began)}`;
  } catch (error) {
    if (error instanceof DOMException && error.name === "AbortError") {
      note.textContent = "Stopped";
      return;
    }
    note.textContent = "Not made";
    look.failed(error instanceof Refused ? error : new Refused("The file could not be made.", "Try again; if it stays so, start the studio again."));
  } finally {
    clearInterval(clock);
    pending.end();
  }
}
