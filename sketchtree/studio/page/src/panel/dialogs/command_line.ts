// Which command makes this tree again? Shown, and copied.

import { button } from "../../parts/button";
import { element } from "../../parts/element";
import { toast } from "../../parts/toast";
import { ask, Refused } from "../ask";
import { USUAL, type ExportOptions, type OptionName } from "./export_options";

export function commandLine(options: () => ExportOptions): { root: HTMLElement; reset: () => void } {
  const line = element("input", { class: "field command", testId: "command-line", title: "Makes this tree again from the saved project, in a terminal", aria: { label: "Command line" } });
  line.readOnly = true;
  line.hidden = true;
  line.addEventListener("focus", () => line.select());
  const copy = async (): Promise<void> => {
    try {
      line.value = (await (await ask(`command?${query(options())}`)).text()).trim();
      line.hidden = false;
      await navigator.clipboard.writeText(line.value);
      toast("The command line is copied.", { remedy: "Save the project first: the command reads it." });
    } catch (error) {
      if (error instanceof Refused) toast(error.message, { remedy: error.remedy, kind: "wrong" });
      else line.focus(); // this browser keeps its clipboard shut: the text is selected, ready for Ctrl+C
    }
  };
  const made = button({ label: "Copy command line", icon: "copy", testId: "copy-command", hint: "A command that makes this very tree again", onPress: () => { void copy(); } });
  return { root: element("div", { class: "command-row" }, made, line), reset: () => { line.hidden = true; } };
}

/** What is not as usual. */
function query(options: ExportOptions): string {
  const others = (Object.keys(USUAL) as OptionName[]).filter((name) => options[name] !== USUAL[name]);
  return new URLSearchParams(others.map((name) => [name, String(options[name])])).toString();
}
