// How does the tree leave the studio? As a file of any format, as a picture, as a film, as a project, as a command line.

import { button } from "../../parts/button";
import { dialog } from "../../parts/dialog";
import { element } from "../../parts/element";
import { toast } from "../../parts/toast";
import type { Store } from "../../store";
import { onList } from "../catalogue";
import { ask, Refused } from "../ask";
import { download, nameOf } from "../download";
import { commandLine } from "./command_line";
import { exportControls } from "./export_controls";
import { formatButton } from "./export_format";
import { groups } from "./export_groups";
import { fitting } from "./export_options";
import { filmButton, pictureButton, type Views } from "./views";

export function exportTree(store: Store, views: Views): () => void {
  const name = (): string => (store.known.name ?? "tree").replace(/\.[a-z]+$/i, "");
  const box = dialog({ title: "Export", testId: "export-dialog", wide: true });
  const formats = element("div", { class: "formats" });
  const controls = exportControls();
  const trouble = element("p", { class: "export-trouble", role: "alert", testId: "export-trouble" });
  const command = commandLine(() => fitting(controls.options(), ".glb"));
  const tell = (error: Refused | null): void => {
    trouble.hidden = error === null;
    trouble.replaceChildren(element("strong", {}, error?.message ?? ""), ` ${error?.remedy ?? ""}`);
  };
  onList(store, (welcome) => welcome.formats, (all) => formats.replaceChildren(...groups(all).map((group) => element("section", {},
    element("h3", {}, group.title),
    element("div", { class: "format-grid" }, ...group.formats.map(({ format, hint }) => formatButton({
      format, hint, started: () => tell(null), refused: tell,
      request: () => ({ ...fitting(controls.options(), format.name), revision: store.known.revision }),
    })))))));
  const empty = element("p", { class: "hint" }, "There is no tree yet: draw a trunk and a few branches first.");
  box.body.append(empty, trouble, element("div", { class: "export-halves" }, formats, element("section", { class: "export-side" }, element("h3", {}, "Options"), controls.root, element("p", { class: "hint how" }, "Press a format on the left: the file is made with these options, and saved."))));
  box.foot.append(command.root, pictureButton(views, name), filmButton(views, name), button({ label: "Project", icon: "save", testId: "download-project", hint: "Download the project: drawing, edits and settings in one file", onPress: () => { void project(); } }));
  return () => {
    tell(null);
    command.reset();
    empty.hidden = store.known.strokes.size > 0;
    box.open();
    formats.querySelector("button")?.focus();
  };
}

async function project(): Promise<void> {
  try {
    const answer = await ask("download");
    download(await answer.blob(), nameOf(answer, "tree.sketchtree"));
  } catch (error) {
    if (error instanceof Refused) toast(error.message, { remedy: error.remedy, kind: "wrong" });
  }
}
