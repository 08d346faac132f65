// The model as the server has it, and the start.
import {act, forget_answers, go_step} from "./acts.mjs";
import {checked_view, read_address} from "./address.mjs";
import {answer, ask_selected, copy, draw_answer} from "./ask.mjs";
import {size} from "./camera.mjs";
import {copy_of_overlap, forget_overlaps, run_check} from "./check.mjs";
import {add_plane, build_planes} from "./cut.mjs";
import {set_flag, set_ground, set_light} from "./display.mjs";
import {by, el, named, notes, rove_by_key, say} from "./dom.mjs";
import {MOST_SIDE, canvas, changed, loop, pump, set_camera} from "./frames.mjs";
import {KEYS, MOUSE, run_of, with_selected} from "./keys.mjs";
import {apply_looks, region_table} from "./looks.mjs";
import {ask, ask_model, attempt} from "./net.mjs";
import {clamp, from_hex} from "./numbers.mjs";
import {draw_overlay, overlay} from "./overlay.mjs";
import {SECTIONS, draw_warnings, restore_panels, toggle_panel} from "./panels.mjs";
import {note_rate} from "./rates.mjs";
import {copy_link, open_view, save} from "./save.mjs";
import {angles_of} from "./shapes.mjs";
import {open_slice, refit_slice, slice_changed} from "./slice.mjs";
import {ended, hold, model, range, regions, selection, view} from "./state.mjs";
import {build_tree, draw_tree, list_rows, tree_key} from "./tree.mjs";

export async function load_model() {
  const made = await attempt("model", () => ask_model());
  if (!made || made.generation === model?.generation) return;
  const is_first = !model;
  hold({model: made, regions: region_table(made)});
  document.title = `${model.name} - csgrt`;
  by("name").replaceChildren(named(model.name));
  by("model").textContent = model.name;
  by("name").title = by("model").title = model.title;
  by("device").textContent = model.device;
  by("save-exr").hidden = !model.exr;
  say("file", model.error);
  if (is_first) {
    hold({view: checked_view(model.view)});
    set_first_camera();
  }
  loop.failed = -1;
  forget_answers();
  forget_overlaps();
  apply_looks(regions, view.looks);
  changed();
  hold({selection: selection.filter(path => range(path)[0] < range(path)[1])});
  build_tree();
  build_planes();
  ask_selected();
  draw_answer();
  draw_warnings();
  if (is_first) read_address();
}
/// The first picture has the square that the model's own camera has, also in a window that is higher than wide.
function set_first_camera() {
  const {camera} = view, {width, height} = canvas.getBoundingClientRect();
  view.camera = {...camera, view_size: camera.view_size / Math.min(1, width / height || 1)};
}
/// Looks once a second whether the server is there and its file has changed.
async function look_for_changes() {
  const status = document.hidden ? null : await attempt("status", () => ask("status", {}));
  if (status) {
    if (notes.has("server")) loop.failed = -1;
    say("server", "");
    say("file", status.error);
    by("device").textContent = status.device;
    if (status.generation !== model?.generation) await load_model();
    pump();
  }
  if (!ended) setTimeout(look_for_changes, 1000);
}
async function end_csgrt() {
  by("ask-end").close();
  if (!await attempt("end", () => ask("end", {}))) return;
  hold({ended: true});
  loop.job?.abort.abort();
  by("end-page").hidden = false;
}

function watch_size() {
  const watch = new ResizeObserver(([entry]) => {
    const box = entry.contentRect, exact = entry.devicePixelContentBoxSize?.[0];
    const side = (given, length) => clamp(given ?? Math.round(length * devicePixelRatio), 1, MOST_SIDE);
    Object.assign(size, {width: side(exact?.inlineSize, box.width), height: side(exact?.blockSize, box.height),
                         css_width: box.width || 1, css_height: box.height || 1});
    overlay.setAttribute("viewBox", `0 0 ${size.css_width} ${size.css_height}`);
    if (loop.job && !loop.job.coarse) loop.job.abort.abort();
    draw_overlay();
    pump();
  });
  try { watch.observe(canvas, {box: "device-pixel-content-box"}); } catch { watch.observe(canvas); }
  new ResizeObserver(slice_changed).observe(by("slice-canvas"));
  new ResizeObserver(draw_tree).observe(by("tree"));
}
function look_along_normal(event) {
  set_camera({...angles_of(answer.normal), center: answer.point}, event);
}
function connect() {
  const on = (id, run, name = "click") => by(id).addEventListener(name, run);
  for (const name of ["parts", ...SECTIONS]) on("toggle-" + name, () => toggle_panel(name));
  for (const name of SECTIONS) on("close-" + name, () => toggle_panel(name, false));
  for (const [id, key] of [["view-front", "1"], ["view-right", "3"], ["view-top", "7"], ["view-iso", "9"], ["fit", "f"],
                           ["perspective", "5"], ["edges", "e"], ["help-button", "?"], ["show-all", "u"]])
    on(id, run_of.get(key));
  for (const [id, state] of [["hide", "hidden"], ["ghost", "ghost"], ["show", "shown"]])
    on("selected-" + id, event => act.state(selection, state, event));
  for (const [id, run] of Object.entries({
    "selected-isolate": event => act.isolate(selection, event), "selected-fit": event => act.fit(selection, event),
    "selected-isolate-fit": event => act.isolate_fit(selection, event),
    "undo": event => go_step(-1, event), "redo": event => go_step(1, event),
    "copy-shoot": event => copy("shoot", event.target), "copy-command": event => copy("command", event.target),
    "copy-link": copy_link, "run-check": run_check,
    "copy-overlap-link": copy_of_overlap("link"), "copy-overlap-shoot": copy_of_overlap("shoot"),
    "save-png": save.png, "save-csv": save.csv, "save-exr": save.exr,
    "save-view": save.view, "get-command": save.command, "along-normal": look_along_normal,
    "add-plane": add_plane, "slice-fit": refit_slice, "slice-close": () => open_slice(-1),
    "close-help": () => by("help").close(), "ground-own": () => set_ground(false),
    "end": () => by("ask-end").showModal(),
    "end-no": () => by("ask-end").close(), "end-yes": end_csgrt})) on(id, run);
  on("selected-own", with_selected(act.own_color));
  on("selected-color", event => act.color(selection, from_hex(event.target.value), event), "input");
  on("show", event => {
    view.show = by("show").value;
    changed(event);
  }, "change");
  on("light", set_light, "change");
  for (const id of ["hatch", "guides"]) on(id, set_flag, "change");
  for (const id of ["ground-top", "ground-bottom"]) on(id, () => set_ground(true), "input");
  on("search", list_rows, "input");
  on("tree", draw_tree, "scroll");
  on("tree", tree_key, "keydown");
  for (const group of ["beam", "end-rows"]) on(group, rove_by_key, "keydown");
  on("open-view", event => {
    open_view(event.target.files[0]);
    event.target.value = "";
  }, "change");
  document.addEventListener("dragover", event => event.preventDefault());
  document.addEventListener("drop", event => {
    event.preventDefault();
    open_view(event.dataTransfer.files[0]);
  });
  document.addEventListener("visibilitychange", pump);
  window.addEventListener("hashchange", () => { if (model) read_address(); });
  const line = (keys, does) => el("tr", {}, el("td", {}, ...keys), el("td", {textContent: does}));
  const written = key => key.length === 1 ? key.toUpperCase() :
    key.replace(/Arrow(\w+)/, (_, way) => ({Left: "\u2190", Right: "\u2192", Up: "\u2191", Down: "\u2193"})[way]);
  by("key-list").replaceChildren(...MOUSE.map(([what, does]) => line([what], does)), ...KEYS.map(([keys, does]) =>
    line(keys.flatMap(key => [el("kbd", {textContent: written(key)}), " "]), does)));
}
restore_panels();
connect();
watch_size();
window.addEventListener("load", async () => {
  for (const {encodedBodySize, responseStart, responseEnd} of performance.getEntriesByType("navigation"))
    note_rate(loop, encodedBodySize, responseEnd - responseStart);
  await load_model();
  look_for_changes();
});
