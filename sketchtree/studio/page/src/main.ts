// What is on the page? Every region is mounted here, on one store.

import { mountBar } from "./draw/bar";
import { mountDraw } from "./draw/mount";
import { mountTools } from "./draw/tools";
import { mountLink } from "./link/mount";
import { mountPanels } from "./panel/mount";
import { Store } from "./store";
import { mountTheme } from "./style/theme";
import { mountGrowth } from "./tree/growth/mount";
import { mountTree } from "./tree/mount";

function region(id: string): HTMLElement {
  const found = document.getElementById(id);
  if (!found) throw new Error(`index.html has no #${id}`);
  return found;
}

const store = new Store();
mountTheme(store);
mountBar(region("bar"), store);
mountTools(region("tools"), store);
mountDraw(region("page"), store);
const views = mountTree(region("tree"), store);
mountLink(store);
if (views.stand) mountGrowth(views.stand, store);
const roots = { side: region("side"), strip: region("strip"), status: region("status"), page: region("page"), tree: region("tree") };
mountPanels(roots, store, views); // after the link: it times what is sent
document.querySelector(".opening")?.remove();
