// Mouse and touch on the picture.
import {ask_hover, ask_pixel, hover, pick, toggle_selected} from "./ask.mjs";
import {depth_in, panned, turned, zoomed} from "./camera.mjs";
import {by} from "./dom.mjs";
import {canvas, changed, rest, set_camera} from "./frames.mjs";
import {cross_hair} from "./keys.mjs";
import {attempt} from "./net.mjs";
import {clamp, minus} from "./numbers.mjs";
import {bounds, path_of, view} from "./state.mjs";

export const pointers = new Map();
/// The wheel's first notch at a place asks what is hit there: in perspective the eye goes toward the point, not past.
export const wheel = {place: null, point: null, factor: 1};
export function turn(azimuth, elevation, pivot) {
  wheel.place = null;
  view.camera = turned(view.camera, azimuth, elevation, pivot);
}
export function pan(dx, dy, z) {
  wheel.place = null;
  view.camera = panned(view.camera, dx, dy, z);
}
export function zoom(factor, x, y, z) {
  view.camera = zoomed(view.camera, factor, Math.hypot(...minus(bounds().high, bounds().low)) || 1, x, y, z);
}
const depth_of = point => depth_in(view.camera, point);
const drag = {pivot: null, moved: false, pan: false, ask: 0, start: [0, 0], click: null};
export const wheel_factor = event => Math.exp(clamp(event.deltaY * [1, 30, 300][event.deltaMode], -300, 300) * 0.0015);
canvas.addEventListener("pointerdown", async event => {
  if (event.button > 1) return;
  if (event.button === 1) event.preventDefault();  // no scrolling by the middle button
  const place = [event.offsetX, event.offsetY], mine = ++drag.ask;
  canvas.setPointerCapture(event.pointerId);
  pointers.set(event.pointerId, place);
  if (pointers.size > 1) {
    drag.moved = true;
    return;
  }
  cross_hair.place = null;
  Object.assign(drag, {pivot: null, moved: false, pan: event.shiftKey || event.button === 1, start: place});
  const made = await attempt("pick", () => ask_pixel(...place, true));
  if (mine === drag.ask) drag.pivot = made?.point ?? null;
});
canvas.addEventListener("pointermove", event => {
  const {offsetX: x, offsetY: y} = event, before = pointers.get(event.pointerId);
  if (!before) {
    hover.place = [x, y];
    return void ask_hover();
  }
  const enough = event.pointerType === "touch" ? 10 : 4;
  if (!drag.moved && Math.hypot(x - drag.start[0], y - drag.start[1]) < enough) return;
  drag.moved = true;
  const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1], [dx, dy] = [x - before[0], y - before[1]];
  pointers.set(event.pointerId, [x, y]);
  if (other) {  // the middle of two fingers moves the picture, their distance zooms
    const apart = (px, py) => Math.max(1, Math.hypot(px - other[0], py - other[1]));
    pan(dx / 2, dy / 2);
    zoom(clamp(apart(...before) / apart(x, y), 0.5, 2), (x + other[0]) / 2, (y + other[1]) / 2);
  } else if (drag.pan) {
    pan(dx, dy, depth_of(drag.pivot));
  } else {
    turn(view.camera.azimuth - 0.4 * dx, view.camera.elevation + 0.4 * dy, drag.pivot ?? view.camera.center);
  }
  changed(event, true);
});
for (const name of ["pointerup", "pointercancel"])
  canvas.addEventListener(name, event => {
    if (pointers.delete(event.pointerId) && !pointers.size && drag.moved) rest();
  });
canvas.addEventListener("pointerleave", () => {
  hover.place = null;
  by("hover").textContent = "";
});
canvas.addEventListener("click", async event => {
  if (drag.moved) return;
  // A panel that the first click opens may move the picture: the second click of a double click means the same point.
  if (event.ctrlKey || event.metaKey) return void select_besides(event.offsetX, event.offsetY);
  if (event.detail === 1) drag.click = pick(event.offsetX, event.offsetY);
  if (event.detail === 2) center_at(await drag.click, event);
});
/// Selects the part at a place besides the others, or no longer.
async function select_besides(x, y) {
  const made = await attempt("pick", () => ask_pixel(x, y, true));
  if (made && made.region !== null) toggle_selected(path_of(made.region));
}
export const center_at = (center, event) => center && set_camera({center}, event);
by("picture").addEventListener("wheel", async event => {
  event.preventDefault();
  const box = canvas.getBoundingClientRect(), place = [event.clientX - box.left, event.clientY - box.top];
  wheel.factor *= wheel_factor(event);
  if (!wheel.place || Math.hypot(...minus(place, wheel.place)) > 2) {
    wheel.place = place;
    wheel.point = attempt("pick", () => ask_pixel(...place, true)).then(made => made?.point);
  }
  const point = await wheel.point;
  if (wheel.factor === 1) return;  // an earlier event took the factor along
  zoom(wheel.factor, ...place, depth_of(point));
  wheel.factor = 1;
  changed(event, true);
}, {passive: false});
