// The slice of a plane: a second pane.
import {keep_address} from "./address.mjs";
import {overlap_at, overlap_text, paths_of, select} from "./ask.mjs";
import {plane_axes, plane_extent, plane_foot, size} from "./camera.mjs";
import {fill_planes} from "./cut.mjs";
import {by, resize} from "./dom.mjs";
import {MOST_SIDE} from "./frames.mjs";
import {ARROWS} from "./keys.mjs";
import {wheel_factor} from "./mouse.mjs";
import {ask, attempt, post} from "./net.mjs";
import {along, clamp, number, numbers, unit} from "./numbers.mjs";
import {keep_in_view} from "./panels.mjs";
import {bounds, color_of, ended, model, path_of, view} from "./state.mjs";

export const slice = {plane: -1, busy: false, again: false, place: [0, 0], mm: 1, ids: null, width: 0, height: 0,
                      drag: null, hover: null, asks: false};
const slice_canvas = by("slice-canvas");
export const pane = () => slice_canvas.getBoundingClientRect();
export function open_slice(plane) {
  slice.plane = plane;
  keep_in_view(() => { by("slice").hidden = plane < 0; });
  if (plane >= 0) {
    write_title();
    fit_slice();
  }
  fill_planes();
  slice_changed();
  keep_address();
}
function write_title() {
  const {normal, distance} = view.clip[slice.plane];
  by("slice-title").textContent =
    `Slice of plane ${slice.plane + 1}: ${numbers(normal, 4)} at ${number(distance, 6)} mm`;
}
/// Puts the model's box into the pane.
export function fit_slice() {
  const {width, height} = pane(), [x, y] = plane_extent(view.clip[slice.plane], bounds());
  slice.place = [(x[0] + x[1]) / 2, (y[0] + y[1]) / 2];
  slice.mm = 1.06 * Math.max((x[1] - x[0]) / (width || 1), (y[1] - y[0]) / (height || 1)) || 1;
}
export function refit_slice() {
  fit_slice();
  slice_changed();
}
/// The point under a place of the pane, in CSS pixels.
function slice_point(x, y) {
  const plane = view.clip[slice.plane], {right, up} = plane_axes(plane), {width, height} = pane(), [u, v] = slice.place;
  return along(along(plane_foot(plane, bounds()), right, u + (x - width / 2) * slice.mm), up,
               v - (y - height / 2) * slice.mm);
}
/// Draws the slice anew: one request at a time, and the newest state wins.
export async function slice_changed() {
  slice.again = true;
  if (slice.busy) return;
  slice.busy = true;
  while (slice.again && slice.plane >= 0 && !ended) {
    slice.again = false;
    await attempt("slice", draw_slice);
  }
  slice.busy = false;
}
async function draw_slice() {
  const box = pane(), plane = view.clip[slice.plane], {right, up} = plane_axes(plane);
  const pixels = length => clamp(Math.round(length * size.width / size.css_width), 1, MOST_SIDE);
  const width = pixels(box.width), height = pixels(box.height), step = v => v * slice.mm * box.height / height;
  const response = await post("slice", {view, center: slice_point(box.width / 2, box.height / 2),
                                        right: right.map(step), up: up.map(step), width, height});
  const ids = new Int32Array(await response.arrayBuffer()), words = new Uint32Array(ids.length);
  const word = rgb => rgb.reduce((sum, v, i) => sum + (Math.round(255 * v) << (8 * i)), 0xff000000);
  const palette = Uint32Array.from(model.paths, (_, id) => word(color_of(id)));
  const overlap = word([1, 0, 0]);
  for (let i = 0; i < ids.length; i++) words[i] = ids[i] >= 0 ? palette[ids[i]] : ids[i] === -2 ? overlap : 0;
  Object.assign(slice, {ids, width, height});
  resize(slice_canvas, width, height);
  const image = new ImageData(new Uint8ClampedArray(words.buffer), width, height);
  slice_canvas.getContext("2d").putImageData(image, 0, 0);
  write_title();
  by("slice-overlap").style.visibility = ids.includes(-2) ? "" : "hidden";
}
function slice_id(x, y) {
  const box = pane(), scale = slice.width / box.width, column = Math.floor(x * scale), line = Math.floor(y * scale);
  return column >= 0 && column < slice.width ? slice.ids?.[line * slice.width + column] ?? -1 : -1;
}
/// The overlap at a place of the pane, or undefined: a ray through the plane there meets it.
async function ask_overlap(x, y) {
  const {normal} = view.clip[slice.plane], center = slice_point(x, y), degrees = 180 / Math.PI;
  const camera = {azimuth: Math.atan2(normal[1], normal[0]) * degrees, elevation: Math.asin(unit(normal)[2]) * degrees,
                  perspective: 0, center, view_size: 1};
  const made = await attempt("slice", () =>
    ask("pick", {view: {...view, camera, clip: []}, width: 1, height: 1, x: 0, y: 0}));
  return made?.generation === model.generation ? overlap_at(made, center) : undefined;
}
/// Names what is under the mouse; what overlaps is asked for, one question at a time.
async function hover_slice(x, y) {
  const id = slice_id(x, y), at = ` at ${numbers(slice_point(x, y), 6)}`;
  by("hover").textContent = (id >= 0 ? path_of(id) : id === -2 ? "several regions overlap" : "nothing") + at;
  slice.hover = [x, y];
  if (id !== -2 || slice.asks) return;
  slice.asks = true;
  const overlap = await ask_overlap(x, y);
  slice.asks = false;
  if (slice.hover[0] === x && slice.hover[1] === y && overlap) by("hover").textContent = overlap_text(overlap) + at;
}
/// Moves by CSS pixels, then zooms. The point x CSS pixels to the right of the middle and y upward stays.
function move_slice(dx, dy, factor = 1, x = 0, y = 0) {
  const [u, v] = slice.place, k = slice.mm * (1 - factor);
  slice.place = [u - dx * slice.mm + x * k, v + dy * slice.mm + y * k];
  slice.mm *= factor;
  slice_changed();
  keep_address();
}
slice_canvas.addEventListener("pointerdown", event => {
  slice_canvas.setPointerCapture(event.pointerId);
  slice.drag = {x: event.offsetX, y: event.offsetY, moved: 0};
});
slice_canvas.addEventListener("pointermove", ({offsetX: x, offsetY: y}) => {
  if (slice.drag) {
    const [dx, dy] = [x - slice.drag.x, y - slice.drag.y];
    slice.drag = {x, y, moved: slice.drag.moved + Math.hypot(dx, dy)};
    move_slice(dx, dy);
  } else if (slice.plane >= 0) {
    hover_slice(x, y);
  }
});
slice_canvas.addEventListener("pointerup", async ({offsetX: x, offsetY: y}) => {
  const id = slice_id(x, y), is_click = slice.drag?.moved < 4;
  slice.drag = null;
  if (!is_click || id === -1) return;
  const overlap = id === -2 && await ask_overlap(x, y);
  if (overlap) select(...paths_of(overlap));
  else if (id >= 0) select(path_of(id));
});
slice_canvas.addEventListener("wheel", event => {
  event.preventDefault();
  move_slice(0, 0, wheel_factor(event), event.offsetX - pane().width / 2, pane().height / 2 - event.offsetY);
}, {passive: false});
slice_canvas.addEventListener("keydown", event => {
  const factor = {"+": 0.8, "=": 0.8, "-": 1.25}[event.key], [x, y] = ARROWS[event.key] ?? [0, 0];
  if (!factor && !x && !y || event.key.length === 1 && !factor || event.ctrlKey || event.metaKey) return;
  event.preventDefault();
  event.stopPropagation();
  move_slice(-40 * x, -40 * y, factor);
});
