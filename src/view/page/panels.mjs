// Panels, and the warnings in theirs.
import {act} from "./acts.mjs";
import {select} from "./ask.mjs";
import {kept_in_view, size} from "./camera.mjs";
import {by, el, say} from "./dom.mjs";
import {canvas, changed} from "./frames.mjs";
import {draw_overlay} from "./overlay.mjs";
import {bounds, model, regions, view} from "./state.mjs";
import {draw_tree} from "./tree.mjs";

export const SECTIONS = ["answer", "cut", "check", "display", "warnings", "save"];
const is_narrow = () => innerWidth <= 900;
/// Keeps the model in view when a slice or a panel takes some of the picture's room, or gives it back.
export function keep_in_view(run) {
  const before = {...size};
  run();
  const {width, height} = canvas.getBoundingClientRect();
  if (!view || width * height === 0 || width === before.css_width && height === before.css_height) return;
  Object.assign(size, {css_width: width, css_height: height});
  view.camera = kept_in_view(view.camera, bounds(), before);
  changed();
}
/// Opens or closes a panel. A narrow window has room for one panel.
export function open_panel(name, open = by(name).hidden) {
  if (by(name).hidden === !open) return;
  for (const other of open && is_narrow() ? ["parts", ...SECTIONS] : [])
    if (other !== name) open_panel(other, false);
  keep_in_view(() => {
    by(name).hidden = !open;
    by("side").hidden = SECTIONS.every(section => by(section).hidden);
  });
  by("toggle-" + name).ariaPressed = String(open);
  if (open && name !== "parts") by(name).scrollIntoView({block: "nearest"});
  draw_overlay();
  draw_tree();
}
/// Opens or closes a panel for the user, who finds it so when the page is loaded again.
export function toggle_panel(name, open) {
  open_panel(name, open);
  try {
    localStorage.setItem("csgrt " + name, by(name).hidden ? "closed" : "open");
  } catch { /* Storage is not there in a notebook's frame. */ }
}
/// Opens the panels that were open. At first the parts and the answer are, where there is room.
export function restore_panels() {
  for (const name of ["parts", "answer"]) {
    let was = null;
    try {
      was = localStorage.getItem("csgrt " + name);
    } catch { /* as above */ }
    open_panel(name, !is_narrow() && was !== "closed");
  }
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
    act.fit([whole], event);
    return say("warning", "");
  }
  say("warning", object ? `No region's path has ${object}: nothing of it is in the picture.` : "");
}
