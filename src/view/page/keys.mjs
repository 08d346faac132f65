// Keys, and the cross that they move.
import {act, go_step} from "./acts.mjs";
import {answer, ask_hover, ask_pixel, forget_answer, hover, pick} from "./ask.mjs";
import {size} from "./camera.mjs";
import {toggle_edges} from "./display.mjs";
import {by} from "./dom.mjs";
import {changed, set_camera} from "./frames.mjs";
import {center_at, pan, turn, zoom} from "./mouse.mjs";
import {attempt} from "./net.mjs";
import {clamp} from "./numbers.mjs";
import {draw_overlay} from "./overlay.mjs";
import {open_panel} from "./panels.mjs";
import {selected, selection, view} from "./state.mjs";
import {list_rows} from "./tree.mjs";

export const cross_hair = {place: null};
export const aim_place = () => cross_hair.place ?? [size.css_width / 2, size.css_height / 2];
function move_cross(dx, dy) {
  const [x, y] = aim_place();
  hover.place = cross_hair.place = [clamp(x + dx, 0, size.css_width - 1), clamp(y + dy, 0, size.css_height - 1)];
  draw_overlay();
  ask_hover();
}
const look_from = (azimuth, elevation) => event => set_camera({azimuth, elevation}, event);
const moving = move => (event, key) => {
  move(key);
  changed(event, true);
};
let perspective = 30;  // of the camera before it was parallel
function toggle_perspective(event) {
  const present = view.camera.perspective;
  perspective = present || perspective;
  set_camera({perspective: present ? 0 : perspective}, event);
}
function show_help() {
  by("help").showModal();
  by("help").scrollTop = 0;  // the focus is on the button at the end
}
export const with_selected = run => event => selected !== null && run(selection, event);
export const ARROWS = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1],
                a: [-1, 0], d: [1, 0], w: [0, -1], s: [0, 1]};
/// Rows of the help: the keys, what the help says, what they do.
export const KEYS = [
  [["1"], "front: azimuth 0, elevation 0", look_from(0, 0)],
  [["2"], "back: azimuth 180, elevation 0", look_from(180, 0)],
  [["3"], "right, as in BRL-CAD: azimuth 270, elevation 0", look_from(270, 0)],
  [["4"], "left: azimuth 90, elevation 0", look_from(90, 0)],
  [["7"], "top: azimuth 270, elevation 90", look_from(270, 90)],
  [["8"], "bottom: azimuth 270, elevation -90", look_from(270, -90)],
  [["9"], "iso: azimuth 35, elevation 25", look_from(35, 25)],
  [["5"], "parallel or perspective", toggle_perspective],
  [["f", "Enter"], "fit what is shown", event => act.fit_shown(event)],
  [["e"], "edges", toggle_edges],
  [["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"], "turn", moving(key => {
    const [x, y] = ARROWS[key], {azimuth, elevation, center} = view.camera;
    turn(azimuth - 5 * x, elevation + 5 * y, center);
  })],
  [["Shift+ArrowLeft", "Shift+ArrowRight", "Shift+ArrowUp", "Shift+ArrowDown"], "pan", moving(key =>
    pan(...ARROWS[key].map(v => 0.05 * v * size.css_height)))],
  [["+", "="], "zoom in, at the cross", moving(() => zoom(0.8, ...aim_place()))],
  [["-"], "zoom out, at the cross", moving(() => zoom(1.25, ...aim_place()))],
  [["a", "d", "w", "s"], "move the cross (with Shift: by a pixel)", (event, key) =>
    move_cross(...ARROWS[key].map(v => v * (event.shiftKey ? 1 : 16)))],
  [["p"], "ask at the cross, or in the middle", () => pick(...aim_place())],
  [["c"], "the point at the cross becomes the centre", async event =>
    center_at((await attempt("pick", () => ask_pixel(...aim_place(), true)))?.point, event)],
  [["h"], "hide what is selected", with_selected((paths, event) => act.state(paths, "hidden", event))],
  [["g"], "ghost what is selected", with_selected((paths, event) => act.state(paths, "ghost", event))],
  [["i"], "isolate what is selected", with_selected(act.isolate)],
  [["u"], "show all", act.show_all],
  [["Ctrl+z"], "undo", event => go_step(-1, event)],
  [["Ctrl+Shift+z", "Ctrl+y"], "redo", event => go_step(1, event)],
  [["/"], "search the parts", begin_search],
  [["?"], "this list", show_help],
  [["Escape"], "forget the answer and the selection, then close the panels", escape_all],
];
export const MOUSE = [["drag", "turn about the point under the mouse"], ["Shift+drag, middle drag", "pan"],
  ["wheel", "zoom to the mouse"], ["click", "ask what is there and behind it"],
  ["double click", "the point becomes the centre"], ["two fingers", "pan and zoom"],
  ["in the tree", "arrows move, Space changes the state, Enter or a double click fits"],
  ["drop a file", "open a saved view"]];
export const run_of = new Map(KEYS.flatMap(([keys, , run]) => keys.map(key => [key, run])));
/// Whether a control needs a key itself: a field needs all but Escape, others the keys that change or press them.
function keeps_key({tagName, type}, key) {
  if (key === "Escape") return false;
  if (tagName === "INPUT" && /^(text|number|search)$/.test(type)) return true;
  if (/^(INPUT|SELECT)$/.test(tagName)) return /^(Arrow|Page|Home|End|Enter| )/.test(key);
  return tagName === "BUTTON" && /^(Enter| )$/.test(key);
}
document.addEventListener("keydown", event => {
  if (event.altKey || document.querySelector("dialog[open]") || !view || keeps_key(event.target, event.key)) return;
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key, ctrl = event.ctrlKey || event.metaKey;
  const shift = event.shiftKey && (ctrl || key.startsWith("Arrow"));
  const run = run_of.get((ctrl ? "Ctrl+" : "") + (shift ? "Shift+" : "") + key);
  if (!run) return;
  event.preventDefault();
  run(event, key);
});
/// Closes what is open, a step a time. False: nothing was.
export function escape_all() {
  const open = ["cut", "check", "display", "warnings", "save"].filter(panel => !by(panel).hidden);
  if (answer || selected !== null || cross_hair.place) {
    cross_hair.place = null;
    forget_answer();
  } else if (by("search").value) {
    by("search").value = "";
    list_rows();
  } else {
    for (const panel of open) open_panel(panel, false);
    return open.length > 0;
  }
  return true;
}
function begin_search() {
  open_panel("parts", true);
  by("search").focus();
}
