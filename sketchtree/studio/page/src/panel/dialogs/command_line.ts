// Which command makes this tree again? Shown, and copied.

import { button } from "../../parts/button";
import { element } from "../../parts/element";
import { ask, Refused } from "../ask";
import type { ExportOptions } from "./export_options";

export interface CommandLine {
  copy: HTMLButtonElement;
  shown: HTMLElement; // the command, once it was asked for
  reset: () => void;
}

const NEEDS = { drawn: "Save the project first: the command reads it.", photo: "Save the photo and its strokes (SVG) beside it first: the command reads them." };

export function commandLine(options: () => ExportOptions, tree: () => keyof typeof NEEDS, failed: (error: Refused) => void): CommandLine {
  const line = element("textarea", { class: "field command", testId: "command-line", aria: { label: "Command line" } });
  line.readOnly = true;
  line.rows = 3;
  line.addEventListener("focus", () => line.select());
  const words = element("p", { class: "hint", role: "status" });
  const shown = element("div", { class: "command-shown" }, element("h3", {}, "In a terminal"), line, words);
  const fetched = async (): Promise<void> => {
    try {
      line.value = (await (await ask(`command?export=${encodeURIComponent(JSON.stringify({ format: ".glb", tree: tree(), ...options() }))}`)).text()).trim();
    } catch (error) {
      if (error instanceof Refused) failed(error);
      return;
    }
    shown.hidden = false;
    words.textContent = NEEDS[tree()];
    await navigator.clipboard.writeText(line.value).then(
      () => { words.textContent = `Copied. ${NEEDS[tree()]}`; },
      () => line.focus(), // this browser keeps its clipboard shut: the text is selected, ready for Ctrl+C
    );
  };
  const hint = "A command that makes this very tree again";
  const copy = button({ label: "Copy command line", icon: "copy", testId: "copy-command", hint, onPress: () => { void fetched(); } });
  return { copy, shown, reset: () => { shown.hidden = true; } };
}
