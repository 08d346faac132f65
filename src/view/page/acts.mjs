// What a user does to parts: states, colours, fits; and the steps that undo and redo go.
import {answer, ask_parts, draw_answer, draw_selected, hold_answer, previous} from "./ask.mjs";
import {fitted} from "./camera.mjs";
import {build_planes} from "./cut.mjs";
import {by} from "./dom.mjs";
import {changed} from "./frames.mjs";
import {apply_looks, with_looks, with_state_of_all, without_colors} from "./looks.mjs";
import {hold_kept, kept} from "./measure.mjs";
import {slice_changed} from "./slice.mjs";
import {bounds, range, regions, view} from "./state.mjs";
import {draw_tree} from "./tree.mjs";
import {Steps} from "./undo.mjs";

const steps = new Steps();
const present = () => ({looks: view.looks, clip: view.clip, answer, previous, kept});
/// Notes the present looks, cuts and measurements as a step, to which undo comes back.
export function remember(moving = false) {
  steps.note(present(), moving, performance.now());
  show_steps();
}
function show_steps() {
  by("undo").disabled = !steps.can_undo;
  by("redo").disabled = !steps.can_redo;
}
/// Goes a step back (-1) or forth (1).
export function go_step(count, event) {
  const state = steps.go(count);
  if (!state) return;
  Object.assign(view, {looks: state.looks, clip: state.clip});
  hold_answer(state);
  hold_kept(state.kept);
  build_planes();
  looked(event);
  show_steps();
}
/// Answers have the numbers of a model's regions, and go with the model.
export function forget_answers() {
  const none = {answer: null, previous: null};
  hold_answer(none);
  steps.change(state => ({...state, ...none}));
}
const set_looks = (paths, member, value) => { view.looks = with_looks(regions, view.looks, paths, member, value); };
function fit_box(box, event) {
  view.camera = fitted(view.camera, box);
  changed(event);
}
const fit_ranges = (ranges, event) =>
  ask_parts("fit", [ranges], ([row]) => fit_box(row?.low ? row : bounds(), event));
export const act = {
  state(paths, state, event) {
    set_looks(paths, "state", state);
    looked(event);
  },
  color(paths, rgb, event) {
    set_looks(paths, "color", rgb);
    looked(event, true);
  },
  own_color(paths, event) {
    for (const path of paths) view.looks = without_colors(view.looks, path);
    looked(event);
  },
  isolate(paths, event) {
    view.looks = with_state_of_all(regions, view.looks, "hidden");
    act.state(paths, "shown", event);
  },
  isolate_fit(paths, event) {
    act.isolate(paths, event);
    fit_ranges(paths.map(range), event);
  },
  show_all(event) {
    view.looks = with_state_of_all(regions, view.looks, "shown");
    looked(event);
  },
  fit: (paths, event) => fit_ranges(paths.map(range), event),
  fit_shown(event) {
    if (!regions.states.includes(2)) return fit_box(bounds(), event);
    const shown = [];
    regions.states.forEach((state, i) => { if (state < 2) shown.push([i, i + 1]); });
    fit_ranges(shown, event);
  },
};
/// Draws everything that looks change.
export function looked(event, moving = false) {
  apply_looks(regions, view.looks);
  draw_tree();
  draw_selected();
  draw_answer();
  slice_changed();
  changed(event, moving);
}
