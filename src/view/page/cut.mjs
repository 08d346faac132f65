// Cut: the planes, and their fields.
import {axes, plane_foot} from "./camera.mjs";
import {by, el, is_focused, say} from "./dom.mjs";
import {changed} from "./frames.mjs";
import {corners, dot, middle_of, number, unit} from "./numbers.mjs";
import {fit_slice, open_slice, slice, slice_changed} from "./slice.mjs";
import {bounds, view} from "./state.mjs";

export function set_plane(i, members, event, moving = false) {
  view.clip = view.clip.map((plane, k) => k === i ? {...plane, ...members} : plane);
  fill_planes();
  if (slice.plane === i && members.normal) fit_slice();
  slice_changed();
  changed(event, moving);
}
/// Adds a plane through the middle, across the axis that points to the eye most and has no plane: the near half goes.
export function add_plane(event) {
  const {back} = axes(view.camera), is_free = (_, i) => view.clip.every(plane => Math.abs(plane.normal[i]) < 1);
  const lengths = back.map((v, i) => is_free(v, i) ? Math.abs(v) : -1), at = lengths.indexOf(Math.max(...lengths));
  const normal = back.map((v, i) => i === at ? Math.sign(v) || 1 : 0);
  view.clip = [...view.clip, {normal, distance: dot(normal, middle_of(bounds()))}];
  build_planes();
  changed(event);
}
function remove_plane(i, event) {
  view.clip = view.clip.filter((_, k) => k !== i);
  if (slice.plane >= i) open_slice(slice.plane === i ? -1 : slice.plane - 1);
  build_planes();
  changed(event);
}
let plane_rows = [];
export function build_planes() {
  plane_rows = view.clip.map((_, i) => {
    const plane = () => view.clip[i], row = {};
    const name = (key, label) => ({id: `cut-${i}-${key}`, ariaLabel: `Plane ${i + 1}: ${label}`, title: label});
    const field = (key, type, label, oninput) =>
      row[key] = el("input", {...name(key, label), type, step: "any", oninput});
    const button = (key, textContent, label, onclick) =>
      row[key] = el("button", {...name(key, label), textContent, onclick});
    const typed = event => {
      // The view has the unit normal. The fields keep what is typed until the focus leaves them.
      const normal = ["x", "y", "z"].map(key => row[key].valueAsNumber), distance = row.distance.valueAsNumber;
      if (normal.every(Number.isFinite) && Math.hypot(...normal) > 0 && Number.isFinite(distance))
        set_plane(i, {normal: unit(normal), distance}, event);
      const is_none = normal.every(v => v === 0);
      say("plane", is_none ? "A plane's normal is not 0 0 0: the picture has the last one." : "");
    };
    const straight = (key, normal) => button("set-" + key, key, `across ${key}`, event =>
      set_plane(i, {normal, distance: dot(normal, plane_foot(plane(), bounds()))}, event));
    row.box = el("fieldset", {}, el("legend", {textContent: `Plane ${i + 1}`}),
      el("div", {className: "line"}, ...["x", "y", "z"].map(key =>
        el("label", {}, key + " ", field(key, "number", "normal " + key, typed)))),
      el("label", {className: "line"}, "distance ", field("distance", "number", "distance, mm", typed), " mm"),
      field("slider", "range", "distance", event => set_plane(i, {distance: row.slider.valueAsNumber}, event, true)),
      el("div", {className: "line"}, straight("x", [1, 0, 0]), straight("y", [0, 1, 0]), straight("z", [0, 0, 1]),
        button("flip", "flip", "keep the other side", event =>
          set_plane(i, {normal: plane().normal.map(v => -v || 0), distance: -plane().distance || 0}, event)),
        button("slice", "slice", "show the slice of this plane", () => open_slice(slice.plane === i ? -1 : i)),
        button("remove", "remove", "remove", event => remove_plane(i, event))));
    row.box.addEventListener("focusout", () => setTimeout(fill_planes));
    return row;
  });
  by("planes").replaceChildren(...plane_rows.map(row => row.box));
  by("add-plane").disabled = view.clip.length >= 3;
  if (slice.plane >= view.clip.length) open_slice(-1);
  fill_planes();
  slice_changed();
}
export function fill_planes() {
  plane_rows.forEach((row, i) => {
    const plane = view.clip[i];
    if (!plane) return;
    const along_normal = corners(bounds()).map(p => dot(plane.normal, p));
    Object.assign(row.slider, {min: Math.min(...along_normal), max: Math.max(...along_normal)});
    if (!is_focused(row.slider)) row.slider.value = plane.distance;
    row.slice.ariaPressed = String(slice.plane === i);
    if ([row.x, row.y, row.z, row.distance].some(is_focused)) return;
    ["x", "y", "z"].forEach((key, k) => { row[key].value = number(plane.normal[k]); });
    row.distance.value = number(plane.distance, 9);
  });
}
