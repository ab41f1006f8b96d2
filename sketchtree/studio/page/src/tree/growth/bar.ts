// The controls of the time: a strip over the row at the foot of the view, which a button of that row opens.

import { button, press, swapIcon } from "../../parts/button";
import { choice } from "../../parts/choice";
import { element } from "../../parts/element";
import { popover } from "../../parts/popover";
import { slider } from "../../parts/slider";
import type { Ageing, Mode } from "./asking";

export interface Hands {
  open: () => void;
  close: () => void;
  play: () => void; // or pause
  move: (time: number) => void; // 0-1
  loop: () => void;
  age: (ageing: Ageing) => void;
}

export interface Shown {
  time: number;
  playing: boolean;
  loops: boolean;
  there: boolean; // a growth that can be shown
  words: string; // in place of the share of the time, where there are any
  remedy: string;
}

export interface GrowthBar {
  opener: HTMLButtonElement;
  strip: HTMLElement;
  show: (shown: Shown) => void;
}

const MODES: { value: Mode; label: string; title: string }[] = [
  { value: "full", label: "Seedling", title: "The tree is small while it is young, and branches come by their age" },
  { value: "age", label: "By age", title: "Branches come by their age, and have their full size at once" },
  { value: "scale", label: "Larger", title: "The whole tree, from small to large" },
];
const BEND = 60; // degrees either way
const CATCH = 3; // so close to straight it is straight
const KEYS = new Set(["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End", "PageUp", "PageDown", "Enter", " ", "Escape"]);

export function growthBar(ageing: Ageing, hands: Hands): GrowthBar {
  const opener = button({ label: "Growth", icon: "sprout", iconOnly: true, look: "quiet", testId: "growth", hint: "See the tree as it grows", onPress: hands.open });
  opener.setAttribute("aria-expanded", "false");
  const play = button({ label: "Play", icon: "play", iconOnly: true, look: "quiet", testId: "growth-play", hint: "Play or pause", onPress: hands.play });
  const time = timeSlider(hands.move);
  const value = element("span", { class: "tree-growth-value", role: "status", aria: { live: "polite" }, testId: "growth-state" });
  const loop = button({ label: "Again and again", icon: "loop", iconOnly: true, look: "quiet", testId: "growth-loop", onPress: hands.loop });
  const more = button({ label: "How it grows", icon: "settings", iconOnly: true, look: "quiet", testId: "growth-more", onPress: () => how.open() });
  const how = popover(more, howItGrows(ageing, hands.age), "growth-how");
  const close = button({ label: "Close", icon: "close", iconOnly: true, look: "quiet", testId: "growth-close", hint: "Back to the tree", onPress: hands.close });
  const strip = element("div", { class: "tree-growth", role: "group", aria: { label: "Growth" }, testId: "growth-bar" }, play, time, value, loop, more, close);
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
    value.setAttribute("aria-live", shown.words ? "polite" : "off"); // the slider says where it is
    if ((play.dataset.playing === "true") !== shown.playing) {
      play.dataset.playing = String(shown.playing);
      swapIcon(play, shown.playing ? "pause" : "play");
      play.setAttribute("aria-label", shown.playing ? "Pause" : "Play");
    }
    press(loop, shown.loops);
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

function howItGrows(ageing: Ageing, age: (ageing: Ageing) => void): HTMLElement {
  let now = ageing;
  const put = (part: Partial<Ageing>): void => age((now = { ...now, ...part }));
  const mode = choice<Mode>({ label: "Mode", value: ageing.mode, options: MODES, testId: "growth-mode", onPick: (value) => put({ mode: value }) });
  const words = (degrees: number): string => (degrees === 0 ? "straight on" : `${Math.abs(degrees)}° ${degrees > 0 ? "up" : "down"}`);
  const caught = (degrees: number): number => (Math.abs(degrees) < CATCH ? 0 : degrees);
  const bend = slider({
    label: "Branches bend", min: -BEND, max: BEND, step: 1, value: ageing.bend, testId: "growth-bend", hint: "As they get heavy, or seek the light",
    show: (degrees) => words(caught(degrees)), onInput: (degrees) => put({ bend: caught(degrees) }), reset: { label: "straight on", onReset: () => { bend.set(0); put({ bend: 0 }); } },
  });
  return element("div", { class: "tree-growth-how" }, mode.root, bend.root);
}
