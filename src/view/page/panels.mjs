// Panels, and the warnings in theirs.
import {act} from "./acts.mjs";
import {select} from "./ask.mjs";
import {by, el, say} from "./dom.mjs";
import {draw_overlay} from "./overlay.mjs";
import {model, regions} from "./state.mjs";
import {draw_tree} from "./tree.mjs";

export const SECTIONS = ["answer", "cut", "warnings", "save"];
export function open_panel(name, open = by(name).hidden) {
  if (by(name).hidden === !open) return;
  by(name).hidden = !open;
  by("toggle-" + name).ariaPressed = String(open);
  by("side").hidden = SECTIONS.every(section => by(section).hidden);
  if (open && name !== "parts") by(name).scrollIntoView({block: "nearest"});
  draw_overlay();
  draw_tree();
}
export function draw_warnings() {
  const {warnings} = model;
  by("toggle-warnings").textContent = warnings.length ? `Warnings (${warnings.length})` : "Warnings";
  by("warning-list").replaceChildren(...warnings.map(({text, object, place, count}, i) => {
    const what = (object ? object + ": " : "") + text + (count > 1 ? ` (${count} times)` : "");
    return el("button", {id: "warning-" + i, textContent: what, title: place, onclick: event => go_to(object, event)});
  }), warnings.length ? "" : "The model has none.");
}
/// Selects and fits the first path with a leg of that name.
function go_to(object, event) {
  for (const path of object ? regions.paths : []) {
    const legs = path.split("/"), at = legs.findIndex(leg => leg === object || leg.startsWith(object + "@"));
    if (at < 0) continue;
    const whole = legs.slice(0, at + 1).join("/");
    open_panel("parts", true);
    select(whole);
    act.fit(whole, event);
    return say("warning", "");
  }
  say("warning", object ? `No region's path has ${object}: nothing of it is in the picture.` : "");
}
