// The overlay: what is drawn over the picture, for the camera of the frame that is shown.
import {answer, previous, selected_boxes} from "./ask.mjs";
import {on_screen, plane_axes, plane_extent, plane_foot, size} from "./camera.mjs";
import {set_plane} from "./cut.mjs";
import {by, svg} from "./dom.mjs";
import {loop, rest} from "./frames.mjs";
import {cross_hair} from "./keys.mjs";
import {draw_guides, guides} from "./legend.mjs";
import {marked} from "./marks.mjs";
import {kept_marks} from "./measure.mjs";
import {along, corners, css, minus, unit} from "./numbers.mjs";
import {bounds, color_of, model, path_of, selection, view} from "./state.mjs";

export const overlay = by("overlay"), marks = {
  planes: svg("path", {stroke: "var(--accent)", "stroke-opacity": 0.75, "stroke-dasharray": "5 4"}),
  box: svg("path", {stroke: "var(--chosen)", "stroke-opacity": 0.8}),
  measure: svg("path", {stroke: "var(--ink)", "stroke-dasharray": "4 3", "stroke-width": 1.5}),
  cross: svg("path", {stroke: "var(--ink)", "stroke-width": 1.5}), ray: svg("g"), kept: svg("g")};
const handles = [0, 1, 2].map(i => {
  const wide = svg("path", {class: "wide"}), shaft = svg("path"), grip = svg("circle", {r: 8});
  const group = svg("g", {class: "handle", id: "handle-" + i}), handle = {group, wide, shaft, grip, drag: null};
  group.append(wide, shaft, grip);
  group.addEventListener("pointerdown", event => begin_handle(event, i));
  group.addEventListener("pointermove", event => drag_handle(event, i));
  group.addEventListener("lostpointercapture", () => {
    handle.drag = null;
    rest();
  });
  return handle;
});
overlay.append(...Object.values(marks), ...handles.map(handle => handle.group), guides);
/// The path along lines of points of the model. A line that comes from behind the eye is left out.
function screen_path(camera, lines) {
  return lines.map(points => points.map(p => on_screen(camera, p))).filter(points => points.every(Boolean))
    .map(points => "M" + points.map(p => p.map(v => v.toFixed(1)).join(" ")).join("L")).join("");
}
const box_edges = box => {
  const all = corners(box);
  return [1, 2, 4].flatMap(bit => all.flatMap((corner, i) => i & bit ? [] : [[corner, all[i | bit]]]));
};
const foot_of = plane => plane_foot(plane, bounds());
function outline(plane) {
  const {right, up} = plane_axes(plane), [x, y] = plane_extent(plane, bounds());
  const at = (i, k) => along(along(foot_of(plane), right, x[i]), up, y[k]);
  return [[at(0, 0), at(1, 0), at(1, 1), at(0, 1), at(0, 0)]];
}
export function draw_overlay() {
  const {camera} = loop.shown, at = cross_hair.place, [x, y] = at ?? [0, 0];
  if (!camera || !model) return;
  draw_guides(camera);
  const cutting = by("cut").hidden ? [] : view.clip;
  marks.planes.setAttribute("d", screen_path(camera, cutting.flatMap(outline)));
  marks.box.setAttribute("d", screen_path(camera, marked.seen ? [] : selected_boxes.flatMap(box_edges)));
  const apart = answer?.point && previous ? [[previous.point, answer.point]] : [];
  marks.measure.setAttribute("d", screen_path(camera, apart));
  marks.cross.setAttribute("d", at ? `M${x - 12} ${y}h9m6 0h9M${x} ${y - 12}v9m0 6v9` : "");
  marks.ray.replaceChildren(...ray_lines(camera));
  marks.kept.replaceChildren(...kept_marks(camera));
  handles.forEach(({group, wide, shaft, grip}, i) => {
    const foot = cutting[i] && on_screen(camera, foot_of(cutting[i]));
    group.style.display = foot ? "" : "none";
    if (!foot) return;
    const step = step_on_screen(camera, cutting[i]), tip = along(foot, step, 64 / Math.hypot(...step));
    for (const line of [wide, shaft]) line.setAttribute("d", `M${foot}L${tip}`);
    grip.setAttribute("cx", tip[0]);
    grip.setAttribute("cy", tip[1]);
  });
}
/// The ray of the answer, with its parts in their colours. The ray is seen when the model is turned.
function ray_lines(camera) {
  if (!answer?.partitions.length) return [];
  const {partitions: parts, ray} = answer, span = 2 * Math.hypot(...minus(bounds().high, bounds().low));
  const t = answer.t ?? parts[0].in ?? 0, lines = [];
  const add = (from, to, attributes) => lines.push(svg("path", {...attributes,
    d: screen_path(camera, [[from, to].map(t => along(ray.origin, ray.direction, t))])}));
  add((parts[0].in ?? t - span) - 0.03 * span, (parts.at(-1).out ?? t + span) + 0.03 * span, {stroke: "var(--ink)"});
  for (const p of parts.slice(0, 300))
    add(p.in ?? t - span, p.out ?? t + span,
        {stroke: css(color_of(p.region)), "stroke-width": selection.includes(path_of(p.region)) ? 8 : 4});
  const [cx, cy] = (answer.point && on_screen(camera, answer.point)) ?? [];
  if (cx !== undefined) lines.push(svg("circle", {cx, cy, r: 4, fill: "#fff", stroke: "#000"}));
  return lines;
}
/// CSS pixels by which a plane's foot moves if the plane moves by a hundredth of the view. A normal along the line of
/// sight has no length in the picture: then upward is toward the eye.
function step_on_screen(camera, plane) {
  const foot = foot_of(plane), from = on_screen(camera, foot);
  const to = on_screen(camera, along(foot, unit(plane.normal), camera.view_size / 100));
  const step = from && to ? minus(to, from) : [0, 0];
  return Math.hypot(...step) > 0.2 ? step : [0, -size.css_height / 100];
}
function begin_handle(event, i) {
  if (event.button !== 0) return;
  event.preventDefault();
  handles[i].group.setPointerCapture(event.pointerId);
  handles[i].drag = {start: [event.clientX, event.clientY], distance: view.clip[i].distance,
                     mm: view.camera.view_size / 100, step: step_on_screen(view.camera, view.clip[i])};
}
function drag_handle(event, i) {
  const {drag} = handles[i];
  if (!drag) return;
  const [x, y] = minus([event.clientX, event.clientY], drag.start), [dx, dy] = drag.step;
  set_plane(i, {distance: drag.distance + drag.mm * (x * dx + y * dy) / (dx * dx + dy * dy)}, event, true);
}
