// How does the tree leave the studio? As a file of any format, as it stands or as it grows, as a picture, as a film, as a project, as a command line.

import { button } from "../../parts/button";
import { choice } from "../../parts/choice";
import { dialog } from "../../parts/dialog";
import { element } from "../../parts/element";
import type { Choice } from "../../messages";
import type { Store } from "../../store";
import { ask, Refused } from "../ask";
import { onList } from "../catalogue";
import { download, nameOf } from "../download";
import { commandLine } from "./command_line";
import { exportControls } from "./export_controls";
import { formatButton, type FormatLook, type Wanted } from "./export_format";
import { groups, type FormatGroup } from "./export_groups";
import { growthControls, movingGroups } from "./export_growth";
import { fitting } from "./export_options";
import { filmButton, pictureButton, type Views } from "./views";

type What = "tree" | "growth";

const WHAT: { value: What; label: string; title: string }[] = [
  { value: "tree", label: "The tree", title: "As it stands" },
  { value: "growth", label: "Its growth", title: "As it grows: files that move, and films" },
];

export function exportTree(store: Store, views: Views): () => void {
  const box = dialog({ title: "Export", testId: "export-dialog", wide: true });
  const trouble = element("p", { class: "export-trouble", role: "alert", testId: "export-trouble" });
  const failed = (error: Refused | null): void => {
    trouble.hidden = error === null;
    trouble.replaceChildren(element("strong", {}, error?.message ?? ""), ` ${error?.remedy ?? ""}`);
  };
  const started = (): void => failed(null);
  let what: What = "tree";
  const [stands, grows] = [exportControls(), growthControls(store)];
  const wanted = (format: string, of: What): Wanted =>
    ({ format, tree: treeOf(store), revision: store.known.revision, ...(of === "growth" ? { growth: grows.options() } : fitting(stands.options(), format)) });
  const command = commandLine(() => wanted(".glb", what), failed);
  const halves = {
    tree: half(stands.root, "Options", "Press a format: the file is made with these options, and saved."),
    growth: half(grows.root, "How it grows", "Press a format: the file is made, which takes a while, and saved. A film takes a minute or two."),
  };
  const format = (of: What) => (one: Choice, hint: string): HTMLElement =>
    formatButton({ store, format: one, hint, testId: of === "growth" ? "export-growing" : "export", started, failed, request: () => wanted(one.name, of) } satisfies FormatLook);
  onList(store, (welcome) => welcome.formats, (all) => fill(halves.tree.formats, groups(all), format("tree")));
  onList(store, (welcome) => welcome.moving, (all) => fill(halves.growth.formats, movingGroups(all), format("growth")));
  const show = (of: What): void => {
    what = of;
    halves.tree.root.hidden = of !== "tree";
    halves.growth.root.hidden = of !== "growth";
    command.reset();
  };
  const pick = choice<What>({ label: "What to export", value: what, options: WHAT, testId: "export-what", onPick: show });
  const empty = element("p", { class: "hint" }, "There is no tree yet: draw a trunk and a few branches first.");
  box.body.append(empty, trouble, element("div", { class: "export-what" }, pick.root), halves.tree.root, halves.growth.root, command.shown);
  const project = button({
    label: "Download project", icon: "save", testId: "download-project", hint: "Drawing, edits and settings in one file",
    onPress: () => { keepProject().catch((error: unknown) => { if (error instanceof Refused) failed(error); }); },
  });
  const look = { views, started, failed, name: () => (store.known.name ?? "tree").replace(/\.[a-z]+$/i, "") };
  box.foot.append(command.copy, element("span", { class: "foot-words" }), pictureButton(look), filmButton(look), project);
  show(what);
  return () => {
    started();
    command.reset();
    empty.hidden = store.known.strokes.size > 0;
    box.open();
    halves[what].formats.querySelector("button")?.focus();
  };
}

/** The one that is shown. */
function treeOf(store: Store): "photo" | "drawn" {
  return store.known.photoTree ? "photo" : "drawn";
}

/** Formats to the left, what counts for them to the right. */
function half(controls: HTMLElement, title: string, hint: string): { root: HTMLElement; formats: HTMLElement } {
  const formats = element("div", { class: "formats" });
  const side = element("section", { class: "export-side" }, element("h3", {}, title), controls, element("p", { class: "hint how" }, hint));
  return { root: element("div", { class: "export-halves" }, formats, side), formats };
}

function fill(root: HTMLElement, all: readonly FormatGroup[], make: (format: Choice, hint: string) => HTMLElement): void {
  root.replaceChildren(...all.map((group) => element("section", {},
    element("h3", {}, group.title), element("div", { class: "format-grid" }, ...group.formats.map(({ format, hint }) => make(format, hint))))));
}

async function keepProject(): Promise<void> {
  const answer = await ask("download");
  download(await answer.blob(), nameOf(answer, "tree.sketchtree"));
}
