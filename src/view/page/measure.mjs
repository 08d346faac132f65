// Measurements: what an answer tells of lengths and angles, and the list of those that are kept.
import {looked, remember} from "./acts.mjs";
import {answer, previous} from "./ask.mjs";
import {on_screen, size} from "./camera.mjs";
import {by, el, svg} from "./dom.mjs";
import {along, clamp, minus, number} from "./numbers.mjs";
import {between_faces, described} from "./shapes.mjs";
import {path_of} from "./state.mjs";

/// The measurements that are kept: {what, value, unit, part, ends}. Ends are two points.
export let kept = [];
export function hold_kept(list) {
  kept = list;
}
const with_unit = ({value, unit}) => `${number(value)} ${unit}`;
/// All that the last answer measures, the click before included.
export function measured() {
  const {point, normal, thickness, ray, t, region, partitions, solid} = answer ?? {}, made = [];
  if (!point) return made;
  const part = path_of(region), add = (what, value, ends, unit = "mm") => made.push({what, value, unit, part, ends});
  if (thickness > 0) add("thickness along the normal", thickness, [point, along(point, normal, -thickness)]);
  const own = partitions.find(p => p.region === region && p.out !== null && p.out > t);
  if (own) add("thickness along the ray", own.out - t, [point, along(ray.origin, ray.direction, own.out)]);
  for (const {label, mm, ends} of described(solid?.shape)?.sizes ?? []) add(label, mm, ends);
  if (!previous) return made;
  add("distance from the point before", Math.hypot(...minus(point, previous.point)), [previous.point, point]);
  if (!normal || !previous.normal) return made;
  const {mm, degrees, ends} = between_faces(previous, answer);
  if (degrees) add("angle to the face before", degrees, [previous.point, point], "degrees");
  else add("distance from the parallel face before", mm, ends);
  return made;
}
const row = (one, ...buttons) => el("div", {className: "line measured"},
  el("span", {textContent: one.what}), el("span", {className: "gap"}), el("b", {textContent: with_unit(one)}),
  ...buttons);
/// Lists what the answer measures, and what is kept.
export function draw_measurements() {
  by("measured-title").hidden = !answer?.point;
  by("measured").replaceChildren(...measured().map(one => row(one, el("button", {textContent: "Keep",
    ariaLabel: `Keep: ${one.what}`, onclick: event => change_kept(is_kept(one) ? kept : [...kept, one], event)}))));
  by("kept").hidden = !kept.length;
  by("kept-rows").replaceChildren(...kept.map((one, i) => row(one, el("button", {textContent: "\u00d7", title: one.part,
    ariaLabel: `Forget: ${one.what}`, onclick: event => change_kept(kept.filter((_, k) => k !== i), event)}))));
}
const is_kept = one => kept.some(other => JSON.stringify(other) === JSON.stringify(one));
/// The rows are made anew, so the focus goes to the button that is in the pressed button's place then.
function change_kept(list, event) {
  const rows = event.currentTarget.closest("#measured, #kept-rows");
  const at = [...rows.querySelectorAll("button")].indexOf(event.currentTarget);
  hold_kept(list);
  remember();
  looked(event);
  const buttons = rows.querySelectorAll("button");
  (buttons[Math.min(at, buttons.length - 1)] ?? by("measured").querySelector("button"))?.focus();
}
/// The marks of what is kept, with their values, for the picture.
export const kept_marks = camera => kept.flatMap(one => {
  const [a, b] = one.ends.map(point => on_screen(camera, point));
  if (!a || !b) return [];
  const [x, y] = [0, 1].map(i => clamp((a[i] + b[i]) / 2, 12, [size.css_width, size.css_height][i] - 12));
  const text = svg("text", {x: x + 6, y: y - 6, fill: "var(--ink)", stroke: "var(--ground-bottom)", "stroke-width": 3,
                            "paint-order": "stroke", "font-size": 13, "font-family": "sans-serif"});
  text.textContent = with_unit(one);
  return [svg("path", {d: `M${a}L${b}`, stroke: "var(--chosen)", "stroke-width": 2}),
          ...[a, b].map(([cx, cy]) => svg("circle", {cx, cy, r: 3, fill: "var(--chosen)"})), text];
});
/// The list as a table for other programs, with all digits.
export function csv() {
  const quoted = text => `"${text.replaceAll('"', '""')}"`, axes = ["x", "y", "z"];
  return ["what,part,value,unit," + ["from", "to"].flatMap(end => axes.map(axis => `${end} ${axis}`)).join(),
          ...kept.map(({what, part, value, unit, ends}) =>
            [quoted(what), quoted(part), value, unit, ...ends.flat()].join())].join("\n") + "\n";
}
