// The controls of the time: a strip over the row at the foot of the view, which a button of that row opens.

import { button, press, swapIcon } from "../../parts/button";
import { element } from "../../parts/element";
import { popover } from "../../parts/popover";

export interface Hands {
  open: () => void;
  close: () => void;
  play: () => void; // or pause
  move: (time: number) => void; // 0-1
  loop: () => void;
}

export interface Shown {
  time: number;
  playing: boolean;
  loops: boolean;
  there: boolean; // a growth that can be shown
  words: string; // in place of the share of the time, where there are any
  remedy: string;
  made: number | null; // how much of the growth is made, 0-1; null: nothing is being made
}

export interface GrowthBar {
  opener: HTMLButtonElement;
  strip: HTMLElement;
  show: (shown: Shown) => void;
}

const KEYS = new Set(["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End", "PageUp", "PageDown", "Enter", " ", "Escape"]);

export function growthBar(how: HTMLElement, hands: Hands): GrowthBar {
  const opener = button({ label: "Growth", icon: "sprout", iconOnly: true, look: "quiet", testId: "growth", hint: "See the tree as it grows", onPress: hands.open });
  opener.setAttribute("aria-expanded", "false");
  const play = button({ label: "Play", icon: "play", iconOnly: true, look: "quiet", testId: "growth-play", hint: "Play or pause", onPress: hands.play });
  const time = timeSlider(hands.move);
  const value = element("span", { class: "tree-growth-value", role: "status", aria: { live: "polite" }, testId: "growth-state" });
  const loop = button({ label: "Again and again", icon: "loop", iconOnly: true, look: "quiet", testId: "growth-loop", onPress: hands.loop });
  const more = button({ label: "How it grows", icon: "settings", iconOnly: true, look: "quiet", testId: "growth-more", onPress: () => over.open() });
  const over = popover(more, how, "growth-how");
  const close = button({ label: "Close", icon: "close", iconOnly: true, look: "quiet", testId: "growth-close", hint: "Back to the tree", onPress: hands.close });
  const made = element("div", { class: "tree-growth-made", role: "progressbar", aria: { label: "Growth is being made" }, testId: "growth-made" });
  [made.ariaValueMin, made.ariaValueMax] = ["0", "100"];
  const strip = element("div", { class: "tree-growth", role: "group", aria: { label: "Growth" }, testId: "growth-bar" }, play, time, value, loop, more, close, made);
  strip.hidden = true;
  strip.addEventListener("keydown", (event) => { // neither the view nor the page acts on them
    if (!KEYS.has(event.key)) return;
    event.stopPropagation();
    if (event.key === "Escape") hands.close();
    if (event.key === " " && event.target === time) {
      event.preventDefault();
      hands.play();
    }
  });
  const show = (shown: Shown): void => {
    const share = `${Math.round(100 * shown.time)} %`;
    time.value = String(shown.time);
    time.style.setProperty("--part", `${(100 * shown.time).toFixed(2)}%`);
    time.setAttribute("aria-valuetext", `${share} grown`);
    time.disabled = play.disabled = !shown.there;
    const stays = shown.there && shown.time < 1; // the growth there was, till the new one comes
    const words = shown.words === "" ? share : stays ? `${share} …` : shown.words;
    if (value.textContent !== words) value.textContent = words;
    value.classList.toggle("words", words === shown.words);
    value.title = shown.remedy || shown.words;
    value.setAttribute("aria-live", shown.words && !shown.made ? "polite" : "off"); // the sliders say where they are
    if ((play.dataset.playing === "true") !== shown.playing) {
      play.dataset.playing = String(shown.playing);
      swapIcon(play, shown.playing ? "pause" : "play");
      play.setAttribute("aria-label", shown.playing ? "Pause" : "Play");
    }
    press(loop, shown.loops);
    made.hidden = shown.made === null;
    const part = Math.round(100 * (shown.made ?? 0));
    made.ariaValueNow = String(part);
    made.style.setProperty("--part", `${part}%`);
  };
  return { opener, strip, show };
}

function timeSlider(move: (time: number) => void): HTMLInputElement {
  const made = element("input", { class: "slider", title: "From seed to tree", aria: { label: "Time of the growth" }, testId: "growth-time" });
  made.type = "range";
  [made.min, made.max, made.step] = ["0", "1", "0.005"];
  made.addEventListener("input", () => move(made.valueAsNumber));
  return made;
}
