// How does the tree leave the studio? As a file of any format, as a picture, as a film, as a project, as a command line.

import { button } from "../../parts/button";
import { dialog } from "../../parts/dialog";
import { element } from "../../parts/element";
import type { Choice } from "../../messages";
import type { Store } from "../../store";
import { ask, Refused } from "../ask";
import { onList } from "../catalogue";
import { download, nameOf } from "../download";
import { commandLine } from "./command_line";
import { exportControls } from "./export_controls";
import { formatButton, type FormatLook } from "./export_format";
import { groups } from "./export_groups";
import { fitting } from "./export_options";
import { filmButton, pictureButton, type Views } from "./views";

export function exportTree(store: Store, views: Views): () => void {
  const box = dialog({ title: "Export", testId: "export-dialog", wide: true });
  const formats = element("div", { class: "formats" });
  const controls = exportControls();
  const trouble = element("p", { class: "export-trouble", role: "alert", testId: "export-trouble" });
  const failed = (error: Refused | null): void => {
    trouble.hidden = error === null;
    trouble.replaceChildren(element("strong", {}, error?.message ?? ""), ` ${error?.remedy ?? ""}`);
  };
  const started = (): void => failed(null);
  const command = commandLine(() => fitting(controls.options(), ".glb"), () => treeOf(store), failed);
  const look = { views, started, failed, name: () => (store.known.name ?? "tree").replace(/\.[a-z]+$/i, "") };
  const request = (format: string): ReturnType<FormatLook["request"]> => ({ ...fitting(controls.options(), format), tree: treeOf(store), revision: store.known.revision });
  const format = (one: Choice, hint: string): HTMLElement => formatButton({ format: one, hint, started, failed, request: () => request(one.name) });
  onList(store, (welcome) => welcome.formats, (all) => fill(formats, all, format));
  const empty = element("p", { class: "hint" }, "There is no tree yet: draw a trunk and a few branches first.");
  const how = element("p", { class: "hint how" }, "Press a format on the left: the file is made with these options, and saved.");
  const side = element("section", { class: "export-side" }, element("h3", {}, "Options"), controls.root, how, command.shown);
  box.body.append(empty, trouble, element("div", { class: "export-halves" }, formats, side));
  const project = button({
    label: "Download project", icon: "save", testId: "download-project", hint: "Drawing, edits and settings in one file",
    onPress: () => { keepProject().catch((error: unknown) => { if (error instanceof Refused) failed(error); }); },
  });
  box.foot.append(command.copy, element("span", { class: "foot-words" }), pictureButton(look), filmButton(look), project);
  return () => {
    started();
    command.reset();
    empty.hidden = store.known.strokes.size > 0;
    box.open();
    formats.querySelector("button")?.focus();
  };
}

/** The one that is shown. */
function treeOf(store: Store): "photo" | "drawn" {
  return store.known.photoTree ? "photo" : "drawn";
}

function fill(root: HTMLElement, formats: readonly Choice[], make: (format: Choice, hint: string) => HTMLElement): void {
  root.replaceChildren(...groups(formats).map((group) => element("section", {},
    element("h3", {}, group.title), element("div", { class: "format-grid" }, ...group.formats.map(({ format, hint }) => make(format, hint))))));
}

async function keepProject(): Promise<void> {
  const answer = await ask("download");
  download(await answer.blob(), nameOf(answer, "tree.sketchtree"));
}
