// Check: the regions that overlap, as the server finds them, and the view of each overlap.
import {set_view} from "./address.mjs";
import {copy, select} from "./ask.mjs";
import {by, el} from "./dom.mjs";
import {last_leg} from "./looks.mjs";
import {attempt, post} from "./net.mjs";
import {number} from "./numbers.mjs";
import {view} from "./state.mjs";

let check_run = null;
/// Asks for the overlaps of the model as it was loaded, or ends the check that runs.
export async function run_check() {
  if (check_run) return check_run.abort();
  check_run = new AbortController();
  draw_overlaps([], "checking \u2026", "Stop");
  const min_depth = Number(by("min-depth").value), {signal} = check_run;
  const made = await attempt("check", async () => (await post("check", {min_depth}, signal)).json());
  check_run = null;
  draw_overlaps(made?.overlaps ?? [], !made ? "The check was not completed." : `${made.new_overlaps || "No"} ` +
    `overlap${made.new_overlaps === 1 ? "" : "s"} at least ${number(min_depth)} mm deep. ` +
    `${made.candidates} pairs of regions may overlap.`);
}
/// The list goes with the model.
export function forget_overlaps() {
  check_run?.abort();
  draw_overlaps([]);
}
/// What the link of an overlap holds.
const linked = ({link}) => JSON.parse(decodeURIComponent(link.slice(1)));
function draw_overlaps(overlaps, summary = "", verb = "Find overlaps") {
  by("run-check").textContent = verb;
  by("check-note").textContent = summary;
  by("overlap-shown").hidden = true;
  by("overlap-rows").replaceChildren(...overlaps.map(overlap => {
    const names = linked(overlap).selected;
    return el("div", {className: "line measured"},
      el("span", {textContent: names.map(last_leg).join(", "), title: names.join("\n")}),
      el("span", {className: "gap"}), el("b", {textContent: number(overlap.depth, 4) + " mm"}),
      el("button", {textContent: "Show", ariaLabel: `Show: ${names.join(" and ")}`,
                    onclick: () => show_overlap(overlap)}));
  }));
}
/// Looks at an overlap: both regions are selected, and all others are ghosts. Undo brings looks and cuts back.
function show_overlap(overlap) {
  const {camera, looks, show, selected} = linked(overlap);
  set_view({...view, clip: [], looks, show, camera: {...view.camera, ...camera}});
  select(...selected);
  by("overlap-shown").hidden = false;
  by("overlap-link").textContent = location.href.split("#")[0] + overlap.link;
  by("overlap-shoot").textContent = overlap.shoot;
}
export const copy_of_overlap = name => event => copy("overlap-" + name, event.target);
