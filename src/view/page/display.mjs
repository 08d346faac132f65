// Display: edges, light, and the ground behind the picture.
import {keep_address} from "./address.mjs";
import {by} from "./dom.mjs";
import {changed} from "./frames.mjs";
import {ask_marks} from "./marks.mjs";
import {css, from_hex, hex, ink_on} from "./numbers.mjs";
import {view} from "./state.mjs";

const GROUND = ["ground-top", "ground-bottom"];
export function toggle_edges(event) {
  view.edges = !view.edges;
  changed(event);
}
export function set_light(event) {
  view.light = by("light").value;
  changed(event);
}
export function set_flag(event) {
  view[event.target.id] = event.target.checked;
  draw_display();
  ask_marks();
  keep_address();
}
/// Takes the colours of the fields, or those that follow the system.
export function set_ground(is_own) {
  view.ground = is_own ? GROUND.map(id => from_hex(by(id).value)) : null;
  draw_display();
  keep_address();
}
/// Shows the view's edges, light and ground in the controls and behind the picture.
export function draw_display() {
  const {style} = by("picture"), {ground} = view;
  by("edges").ariaPressed = String(view.edges);
  by("light").value = view.light;
  for (const id of ["hatch", "guides"]) by(id).checked = view[id];
  GROUND.forEach((id, i) => {
    style.setProperty("--" + id, ground ? css(ground[i]) : "");
    by(id).value = ground ? hex(ground[i]) : getComputedStyle(by("picture")).getPropertyValue("--" + id).trim();
  });
  style.setProperty("--ink", ground ? ink_on(ground[0]) : "");
}
matchMedia("(prefers-color-scheme: light)").addEventListener("change", () => { if (view) draw_display(); });
