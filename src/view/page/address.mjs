// The address: it has the view after #, the slice, the selection and the measurement. Back closes what is open.
import {looked} from "./acts.mjs";
import {answer, ask_again, draw_answer, previous, select} from "./ask.mjs";
import {build_planes} from "./cut.mjs";
import {by, say} from "./dom.mjs";
import {set_camera} from "./frames.mjs";
import {escape_all} from "./keys.mjs";
import {checked, read_link, written_link} from "./link.mjs";
import {lost_paths} from "./looks.mjs";
import {hold_kept, kept} from "./measure.mjs";
import {open_panel} from "./panels.mjs";
import {open_slice, slice} from "./slice.mjs";
import {ended, hold, model, regions, selection, view} from "./state.mjs";

let address_timer = 0;
/// The address follows the view. Browsers refuse more than some 20 changes a second.
export function keep_address() {
  address_timer ||= setTimeout(() => {
    address_timer = 0;
    write_address();
  }, 250);
}
const present_link = () => written_link(view, {
  slice: slice.plane < 0 ? null : {plane: slice.plane, place: slice.place, mm: slice.mm}, selected: selection,
  measurements: kept,
  answer: answer && {...answer.asked, ...answer.point && {to: answer.point},
                     ...previous && {from: previous.point, face: previous.normal}}});
export function write_address() {
  if (!ended) history.replaceState(history.state, "", present_link());
}
const choices = () => Object.fromEntries(["show", "light"].map(id => [id, [...by(id).options].map(one => one.value)]));
export const checked_view = given => checked(given, model.view, choices());
export function set_view(given) {
  hold({view: checked_view(given)});
  build_planes();
  looked();
}
export function read_address() {
  if (!location.hash.slice(1) || decodeURI(location.hash) === decodeURI(present_link())) return;
  try {
    use_link(read_link(location.hash.slice(1), model.view, choices()));
    say("address", "");
  } catch (error) {
    say("address", `The link in the address is not used: ${error.message}. The page shows the view as it was.`);
  }
}
function use_link({view: given, slice: part, selected: paths, answer: asked, measurements}) {
  hold_kept(measurements);
  set_view(given);
  const lost = lost_paths(regions, [...given.looks.map(({path}) => path), ...paths]);
  say("lost", !lost.length ? "" : `The link names ${lost.length === 1 ? "a part that is" : lost.length +
    " parts that are"} not in this model, such as ${lost[0]}: they may have gone with another version of the file.`);
  select(...paths.filter(path => !lost.includes(path)));
  if (part) {
    open_panel("cut", true);
    open_slice(part.plane);
    Object.assign(slice, {place: part.place, mm: part.mm});
  }
  set_camera(given.camera);
  if (asked) ask_again(asked);
  else draw_answer();
}

// An entry of the history stands before the page's: Back comes there, and the page goes on.
let is_guarded = history.state === "guard";
export function guard() {
  if (is_guarded || window !== top) return;
  is_guarded = true;
  say("back", "");
  history.replaceState("before", "");
  history.pushState("guard", "");
}
window.addEventListener("popstate", ({state}) => {
  if (state !== "before" && state !== "guard") return;  // another # was typed
  write_address();
  is_guarded = state === "guard";
  if (is_guarded) return;
  if (close_last()) guard();
  else say("back", "Back once more leaves the page.");
  write_address();  // else the event of the other # would open again what was closed
});
for (const name of ["pointerdown", "keydown"]) document.addEventListener(name, guard, true);
/// Closes a dialog, else the slice, else what Escape closes. False: nothing is open.
function close_last() {
  const dialog = document.querySelector("dialog[open]");
  if (dialog) dialog.close();
  else if (slice.plane >= 0) open_slice(-1);
  else return escape_all();
  return true;
}
