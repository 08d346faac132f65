// Ask: what is selected, what stands at a pixel, and what lies behind it.
import {remember} from "./acts.mjs";
import {keep_address} from "./address.mjs";
import {size} from "./camera.mjs";
import {by, el, is_focused, named, rove} from "./dom.mjs";
import {hook, keep, loop, wake, when_painted} from "./frames.mjs";
import {last_leg, listed_ranges} from "./looks.mjs";
import {load_model} from "./main.mjs";
import {pointers} from "./mouse.mjs";
import {ask, attempt} from "./net.mjs";
import {clamp, css, dot, hex, ink_on, minus, number, numbers} from "./numbers.mjs";
import {draw_overlay} from "./overlay.mjs";
import {ask_marks} from "./marks.mjs";
import {draw_measurements} from "./measure.mjs";
import {open_panel} from "./panels.mjs";
import {described} from "./shapes.mjs";
import {color_of, ended, hold, model, path_of, range, regions, selected, selection, view} from "./state.mjs";
import {draw_tree, reveal, state_word} from "./tree.mjs";

export let answer = null, previous = null;  // the last answer; point and normal of the click before
/// The boxes of the selected parts that are bounded, and what the server told of all of them together.
export let selected_boxes = [];
let selected_row = null, selected_ranges = [];
const MOST_BOXES = 50;
/// Asks for the numbers of parts, which are lists of ranges of the table, and for the boxes around them, and uses the
/// answer.
export async function ask_parts(key, parts, use) {
  loop.asking++;
  const asked = {generation: model.generation, parts: parts.map(ranges => ({regions: listed_ranges(regions, ranges)}))};
  const made = await attempt(key, () => ask("parts", asked));
  if (made) use(made.rows);
  loop.asking--;
  wake();
}
/// Asks for the selected parts, and draws them.
export function ask_selected() {
  const of = selection;
  selected_ranges = of.map(range);
  selected_row = null;
  selected_boxes = [];
  draw_selected();
  const asked = [selected_ranges, ...selected_ranges.slice(-MOST_BOXES).map(one => [one])];
  if (of.length) ask_parts("selected", asked, ([row, ...others]) => {
    if (selection !== of) return;
    selected_row = row;
    selected_boxes = others.filter(other => other?.low);
    draw_selected();
    draw_overlay();
  });
}
/// Selects the parts of these paths or lists of paths, and no others. The last of them comes into sight.
export function select(...paths) {
  hold({selection: paths.flat()});
  if (selected !== null) reveal(selected);
  draw_tree();
  ask_selected();
  for (const part of by("beam").querySelectorAll("button"))
    part.ariaPressed = String(selection.includes(part.dataset.path));
  keep_address();
  ask_marks();
}
/// Selects a part besides the others, or no longer.
export const toggle_selected = path =>
  select(selection.includes(path) ? selection.filter(other => other !== path) : [...selection, path]);
const facts = (list, pairs) => by(list).replaceChildren(...pairs.flatMap(([name, value]) =>
  [el("dt", {textContent: name}), el("dd", {textContent: value})]));
export function draw_selected() {
  by("selected").hidden = selected === null;
  by("hint").hidden = selected !== null || answer !== null;
  if (selected === null) return;
  const ranges = selected_ranges, [low] = ranges.at(-1), several = selection.length > 1;
  const count = ranges.reduce((sum, [low, high]) => sum + high - low, 0), row = selected_row, later = "\u2026";
  by("selected-swatch").style.background = css(regions.colors[low]);
  by("selected-path").textContent = several ? `${selection.length} parts` : selected;
  by("selected-path").title = selection.slice(-30).join("\n");
  if (!is_focused(by("selected-color"))) by("selected-color").value = hex(regions.colors[low]);
  facts("selected-facts", [
    ...several || regions.paths[low] !== selected ? [["regions", count]] :
      [["region id", "region_id"], ["material", "material_id"], ["air", "air"], ["los", "los"]]
        .map(([name, member]) => [name, row?.[member] ?? later]),
    ["state", state_word(ranges)],
    ["box", !row ? later : row.low ? minus(row.high, row.low).map(v => number(v, 5)).join(" x ") : "open"]]);
}
/// Asks what stands at a place of the picture: the server is told whole pixels of the full one.
export async function ask_pixel(x, y, brief) {
  const {width, height, css_width, css_height} = size;
  const pixel = {width, height, x: clamp(Math.floor(x * width / css_width), 0, width - 1),
                 y: clamp(Math.floor(y * height / css_height), 0, height - 1)};
  const made = {...await ask("pick", {view, ...pixel, brief}), asked: {camera: view.camera, ...pixel}};
  if (made.generation === model.generation) return made;
  await load_model();  // the numbers of regions are those of a file that has changed
  if (made.generation !== model.generation) throw new Error("The model has changed: ask again.");
  return made;
}
const t_of = ({origin, direction}, point) => dot(minus(point, origin), direction) / dot(direction, direction);
/// The overlap that is at a point of an answer's ray, or undefined.
export function overlap_at({overlaps, ray}, point) {
  const t = t_of(ray, point), most = 1e-6 * (1 + Math.abs(t));
  return overlaps.find(overlap => (overlap.in ?? -Infinity) <= t + most && (overlap.out ?? Infinity) >= t - most);
}
/// The overlap that a pixel shows: the first on its ray in a picture of overlaps, else the overlap at the surface.
const seen_overlap = made =>
  view.show === "overlap" ? made.overlaps[0] : made.point && overlap_at(made, made.point);
export const paths_of = ({regions: ids}) => ids.map(path_of);
export const overlap_text = overlap => "overlap of " + paths_of(overlap).join(" and ");
/// Asks and shows the answer. Returns the point that was hit, or null.
export async function pick(x, y) {
  const begun = performance.now(), made = await attempt("pick", () => ask_pixel(x, y, false));
  if (!made) return null;
  open_panel("answer", true);
  previous = answer?.point ? {point: answer.point, normal: answer.normal} : previous;
  answer = made;
  const overlap = view.show === "overlap" && seen_overlap(made);
  select(...overlap ? paths_of(overlap) : made.region === null ? [] : [path_of(made.region)]);
  draw_answer();
  remember();
  when_painted(() => keep(hook.answers, performance.now() - begun));
  return made.point ?? null;
}
export function draw_answer() {
  by("hit").hidden = !answer;
  draw_measurements();
  draw_overlay();
  if (!answer) return;
  const {partitions: parts, overlaps, point, solid} = answer, shape = described(solid?.shape);
  by("hit-title").textContent = point ? `Last click: ${path_of(answer.region)}` : "Last click";
  const overlap = seen_overlap(answer);
  facts("hit-facts", [...overlap ? [["overlap", paths_of(overlap).join(" and ")]] : [],
    ...!point ? [["hit", "nothing"]] : [
    ["solid", solid ? `${solid.name} (${solid.type})` : "a cut"], ...shape ? [["form", shape.name]] : [],
    ...shape?.center ? [["centre", numbers(shape.center)]] : [], ...shape?.axis ? [["axis", numbers(shape.axis)]] : [],
    ["point", numbers(point)],
    ["distance", `${number(answer.t)} from the ray's start`], ...!answer.normal ? [] :
      [["normal", numbers(answer.normal, 5)],
       ["ray to normal", `${number(angle_of(answer), 3)} degrees; the bar's lengths are along the ray`]]]]);
  by("along-normal").hidden = !answer.normal;
  const apart = point && previous ? minus(point, previous.point) : null;
  by("measure").hidden = !apart;
  if (apart) by("measure").textContent = `From the point clicked before: ${number(Math.hypot(...apart))} mm ` +
    `(dx ${number(apart[0])}, dy ${number(apart[1])}, dz ${number(apart[2])})`;
  draw_beam(parts, overlaps, point ? answer.t : null);
  by("ends").hidden = !parts.length;
  by("end-rows").replaceChildren(...end_rows(parts, overlaps));
  rove(by("end-rows"));
  by("shoot").textContent = answer.shoot;
}
const angle_of = ({normal, ray}) => Math.acos(clamp(-dot(normal, ray.direction), -1, 1)) * 180 / Math.PI;
const thickness = part => part.in === null || part.out === null ? null : part.out - part.in;
/// Draws the bar, to scale from the first finite end to the last. Room beyond shows that an open part goes on.
function draw_beam(parts, overlaps, hit) {
  const ends = parts.flatMap(p => [p.in, p.out]).filter(t => t !== null);
  const low = ends.length ? Math.min(...ends) : -1, high = ends.length ? Math.max(...ends) : 1;
  const room = parts.some(p => thickness(p) === null) ? 6 : 0, percents = (100 - 2 * room) / (high - low || 1);
  const place = (t, open) => t === null ? open : room + (t - low) * percents;
  const stretch = (element, from, to) => {
    const left = place(from, 0), width = place(to, 100) - left;
    element.style.left = `min(${left}%, 100% - 3px)`;
    element.style.width = width + "%";
    return width;
  };
  const marks = parts.map(p => {
    const path = path_of(p.region), thick = number(thickness(p));
    const part = el("button", {title: `${path}\n${thick} mm`, ariaPressed: String(selection.includes(path)),
      ariaLabel: `${path}, ${thick} thick, from ${number(p.in)} to ${number(p.out)}`, onclick: () => select(path)});
    part.dataset.path = path;
    Object.assign(part.style, {background: css(color_of(p.region)), color: ink_on(color_of(p.region))});
    part.classList.toggle("open-in", p.in === null);
    part.classList.toggle("open-out", p.out === null);
    part.classList.toggle("off", regions.states[regions.rank[p.region]] === 2);
    if (stretch(part, p.in, p.out) > 11) part.textContent = number(thickness(p), 4);
    return part;
  });
  for (const overlap of overlaps) {
    marks.push(el("i", {title: overlap_text(overlap), onclick: () => select(...paths_of(overlap))}));
    stretch(marks.at(-1), overlap.in, overlap.out);
  }
  if (hit !== null && hit >= low && hit <= high) {
    marks.push(el("u"));
    marks.at(-1).style.left = place(hit) + "%";
  }
  by("beam").replaceChildren(...marks);
  rove(by("beam"));
  by("beam-low").textContent = parts.length ? number(low) : "";
  by("beam-high").textContent = parts.length ? `${number(high)} mm` : "nothing along this ray";
}
/// Rows: for each part its region and thickness, then a row for each end, and between the parts the gaps. An overlap
/// stands in red before the part in which it begins.
function end_rows(parts, overlaps) {
  const made = [], left = [...overlaps], add = (className, ...cells) => made.push(el("tr", {className}, ...cells));
  const cell = (text, className = "") => el("td", {className}, text);
  const named_cell = name => el("td", {}, name ? named(name) : "-");
  const line = (name, thickness) => el("td", {colSpan: 4}, el("div", {}, name, el("span", {textContent: thickness})));
  const overlaps_before = end => {
    while (left.length && (left[0].in ?? -Infinity) < end) {
      const overlap = left.shift(), paths = paths_of(overlap), names = paths.map(last_leg).join(", ");
      add("red overlap", el("td", {colSpan: 4}, el("button", {
        textContent: `overlap from ${number(overlap.in)} to ${number(overlap.out)}: ${names}`,
        title: paths.join("\n"), onclick: () => select(...paths)})));
    }
  };
  const end = (word, t, solid) =>
    add(word, cell(word), cell(number(t), "number"), named_cell(solid?.name), cell(solid?.type ?? "-"));
  parts.forEach((p, i) => {
    const gap = i && p.in !== null && parts[i - 1].out !== null ? p.in - parts[i - 1].out : 0, path = path_of(p.region);
    if (gap > 0) add("dim gap", line("gap", number(gap, 6) + " mm"));
    overlaps_before(p.out ?? Infinity);
    const swatch = el("span", {className: "swatch"}), thick = thickness(p);
    swatch.style.background = css(color_of(p.region));
    const name = el("button", {title: path, onclick: () => select(path)}, swatch, named(last_leg(path)));
    add("part", line(name, thick === null ? "open" : number(thick, 6) + " mm"));
    end("in", p.in, p.in_solid);
    end("out", p.out, p.out_solid);
  });
  overlaps_before(Infinity);
  return made;
}
/// Takes away the answer, the selection and their marks.
export function forget_answer() {
  hold_answer({answer: null, previous: null});
  select();
  draw_answer();
  remember();
}
export function hold_answer(held) {
  ({answer, previous} = held);
}
/// Copies by the selection: navigator.clipboard is not there in a notebook's frame.
export function copy(source, button) {
  getSelection().selectAllChildren(by(source));
  const label = button.textContent;
  button.textContent = document.execCommand("copy") ? "Copied" : "Selected";
  setTimeout(() => { button.textContent = label; }, 1500);
}
export const hover = {place: null, busy: false};
/// Asks again what a link's answer was: `asked` has the camera, the picture's size and the pixel, `to` the point that
/// was hit, `from` the point that was clicked before.
export async function ask_again({from, face, to, ...asked}) {
  const camera = asked.camera, made = await attempt("pick", () => ask("pick", {...asked, view: {...view, camera}}));
  if (!made || made.generation !== model.generation) return;
  hold_answer({answer: {...made, ...to && hit_at(made, to), asked},
               previous: from ? {point: from, normal: face ?? null} : null});
  draw_answer();
  draw_selected();
  remember();
}
/// The hit at a point of an answer's ray, if it is not the answer's own. It was the first hit before parts
/// were hidden or cut away.
export function hit_at({partitions, ray, t: made_t}, point) {
  const t = t_of(ray, point), most = 1e-6 * (1 + Math.abs(t));
  const part = partitions.find(p => (p.in ?? -Infinity) <= t + most && (p.out ?? Infinity) > t + most);
  const begins = part && part.in !== null && Math.abs(part.in - t) <= most;
  if (made_t !== undefined && Math.abs(made_t - t) <= most) return {};
  return part && {point, t, thickness: null, region: part.region, solid: begins ? part.in_solid : null,
                  normal: begins ? part.in_normal : null};
}
/// Names the region under the mouse: one question at a time, for the newest place, and none while something moves.
export async function ask_hover() {
  if (hover.busy || !hover.place || pointers.size || loop.moving || ended) return;
  hover.busy = true;
  const place = hover.place, made = await attempt("hover", () => ask_pixel(...place, false));
  const overlap = made && seen_overlap(made);
  if (made && hover.place)
    by("hover").textContent = overlap ? overlap_text(overlap) : made.region === null ? "" : path_of(made.region);
  setTimeout(() => {
    hover.busy = false;
    if (hover.place !== place) ask_hover();
  }, 60);
}
