// Guides in the picture's corners: a triad of axes, a scale bar, and what false colours mean.
import {axes, size} from "./camera.mjs";
import {by, svg} from "./dom.mjs";
import {set_camera} from "./frames.mjs";
import {dot, number} from "./numbers.mjs";
import {angles_of} from "./shapes.mjs";
import {view} from "./state.mjs";

const TEXT = {"font-size": 12, "font-family": "sans-serif", "text-anchor": "middle", fill: "var(--ink)"};
const COLORS = ["#d8434a", "#2f9e44", "#3b7ddd"], ARM = 34;
export const guides = svg("g");
const bar = {path: svg("path", {stroke: "var(--ink)", "stroke-width": 1.5}),
             text: svg("text", {...TEXT, "text-anchor": "start"})};
const triad = svg("g", {id: "triad"});
/// A view by a click: of the six along the axes, and iso.
function viewpoint(name, color, angles) {
  const is_small = name.startsWith("-"), group = svg("g", {class: "viewpoint", id: "look" + name});
  const line = svg("path", {stroke: color, "stroke-width": 2}), text = svg("text", {...TEXT, fill: "#fff"});
  const grip = svg("circle", {r: is_small ? 5 : 8, fill: color});
  text.textContent = is_small ? "" : name.slice(1);
  group.append(line, grip, text);
  group.addEventListener("click", event => set_camera(angles, event));
  return {group, line, grip, text};
}
const viewpoints = [0, 1, 2].flatMap(i => [1, -1].map(sign => {
  const direction = [0, 1, 2].map(k => k === i ? sign : 0), angles = angles_of(direction);
  if (i === 2) angles.azimuth = 270;  // as the key 7 has it
  return {direction, ...viewpoint((sign < 0 ? "-" : "+") + "xyz"[i], COLORS[i], angles)};
}));
const iso = viewpoint("-iso", "var(--ink)", {azimuth: 35, elevation: 25});
triad.append(iso.group, ...viewpoints.map(({group}) => group));
guides.append(triad, bar.path, bar.text);
/// The longest of 1, 2 and 5 times a power of ten that is no longer than `most`.
export function round_length(most) {
  const power = 10 ** Math.floor(Math.log10(most) + 1e-12);
  return [5, 2, 1].find(factor => factor * power <= most * (1 + 1e-12)) * power;
}
const length_text = mm => mm >= 1000 ? `${number(mm / 1000)} m` : mm >= 1 || mm === 0 ? `${number(mm)} mm` :
  `${number(mm * 1000)} \u00b5m`;
export function draw_guides(camera) {
  const {right, up, back} = axes(camera), {css_width: w, css_height: h} = size, [x, y] = [w - 56, h - 56];
  triad.style.display = view.guides && Math.min(w, h) > 250 ? "" : "none";
  const place = ({line, grip, text}, ax, ay) => {
    line.setAttribute("d", `M${x} ${y}L${ax} ${ay}`);
    for (const [name, value] of [["cx", ax], ["cy", ay]]) grip.setAttribute(name, value);
    for (const [name, value] of [["x", ax], ["y", ay + 4]]) text.setAttribute(name, value);
  };
  place(iso, x, y);
  const sorted = [...viewpoints].sort((a, b) => dot(a.direction, back) - dot(b.direction, back));
  for (const one of sorted) place(one, x + ARM * dot(one.direction, right), y - ARM * dot(one.direction, up));
  if (sorted.some((one, i) => triad.children[i + 1] !== one.group)) triad.append(...sorted.map(one => one.group));
  const scale = h / camera.view_size, mm = round_length(0.25 * w / scale), length = mm * scale;
  bar.path.setAttribute("d", view.guides ? `M14 ${h - 20}v6h${length}v-6` : "");
  for (const [name, value] of [["x", 18], ["y", h - 25]]) bar.text.setAttribute(name, value);
  bar.text.textContent = view.guides ? length_text(mm) + (camera.perspective ? " at the centre" : "") : "";
}
/// Says what the colours of the picture mean, which has values in a range.
export function draw_legend(range) {
  const [low, high] = range ?? [0, 0];
  const text = {depth: [length_text(+low.toPrecision(4)), length_text(+high.toPrecision(4))],
                segments: ["1", String(high)], normal: ["x red, y green, z blue: half at 0", ""]}[view.show];
  by("legend").hidden = !text || !range && view.show !== "normal";
  if (by("legend").hidden) return;
  by("legend").className = view.show;
  by("legend-low").textContent = text[0];
  by("legend-high").textContent = text[1];
}
