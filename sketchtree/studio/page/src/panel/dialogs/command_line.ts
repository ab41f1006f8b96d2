// Which command makes this tree again? Shown, and copied.

import { button } from "../../parts/button";
import { element } from "../../parts/element";
import { ask, Refused } from "../ask";
import type { Wanted } from "./export_format";

export interface CommandLine {
  copy: HTMLButtonElement;
  shown: HTMLElement; // the command, once it was asked for
  reset: () => void;
}

const NEEDS = { project: "Save the project first: the command reads it.", photo: "Save the photo and its strokes (SVG) beside it first: the command reads them." };

export function commandLine(wanted: () => Wanted, failed: (error: Refused) => void): CommandLine {
  const line = element("textarea", { class: "field command", testId: "command-line", aria: { label: "Command line" } });
  line.readOnly = true;
  line.rows = 3;
  line.addEventListener("focus", () => line.select());
  const words = element("p", { class: "hint", role: "status" });
  const shown = element("div", { class: "command-shown" }, element("h3", {}, "In a terminal"), line, words);
  const fetched = async (): Promise<void> => {
    try {
      line.value = (await (await ask(`command?export=${encodeURIComponent(JSON.stringify(wanted()))}`)).text()).trim();
    } catch (error) {
      if (error instanceof Refused) failed(error);
      return;
    }
    shown.hidden = false;
    const needs = line.value.startsWith("sketchtree photo ") ? NEEDS.photo : NEEDS.project;
    words.textContent = needs;
    await navigator.clipboard.writeText(line.value).then(
      () => { words.textContent = `Copied. ${needs}`; },
      () => line.focus(), // this browser keeps its clipboard shut: the text is selected, ready for Ctrl+C
    );
  };
  const hint = "A command that makes this very tree again";
  const copy = button({ label: "Copy command line", icon: "copy", testId: "copy-command", hint, onPress: () => { void fetched(); } });
  return { copy, shown, reset: () => { shown.hidden = true; } };
}
