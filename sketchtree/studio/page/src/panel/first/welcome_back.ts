// The last session ended suddenly: nothing is lost, and it is said once.

import { toast } from "../../parts/toast";
import type { Store } from "../../store";

export function welcomeBack(store: Store, newPage: () => void): void {
  let told = false;
  store.on("welcome", () => {
    if (told || !store.known.welcome?.recovered) return;
    told = true;
    toast("Welcome back. Your drawing is as you left it.", {
      remedy: "The last session ended suddenly; nothing was lost. Save it, or start a new page.", seconds: 12,
      action: { label: "New page", onPress: newPage },
    });
  });
}
