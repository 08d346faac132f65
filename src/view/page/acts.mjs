// What a user does to parts: states, colours, fits.
import {draw_answer, draw_selected} from "./ask.mjs";
import {fitted} from "./camera.mjs";
import {changed} from "./frames.mjs";
import {apply_looks, with_look, without_colors} from "./looks.mjs";
import {union_of} from "./numbers.mjs";
import {slice_changed} from "./slice.mjs";
import {bounds, range, regions, view} from "./state.mjs";
import {draw_tree, top_paths} from "./tree.mjs";

const set_look = (path, member, value) => { view.looks = with_look(regions, view.looks, path, member, value); };
/// Gives all of the model one state.
function set_all(state) {
  view.looks = view.looks.filter(look => look.color).map(({path, color}) => ({path, color}));
  for (const path of top_paths()) set_look(path, "state", state);
}
function fit(parts) {
  view.camera = fitted(view.camera, union_of(parts) ?? bounds());
}
export const act = {
  state(path, state, event) {
    set_look(path, "state", state);
    looked(event);
  },
  color(path, rgb, event) {
    set_look(path, "color", rgb);
    looked(event, true);
  },
  own_color(path, event) {
    view.looks = without_colors(view.looks, path);
    looked(event);
  },
  isolate(path, event) {
    set_all("hidden");
    act.state(path, "shown", event);
  },
  show_all(event) {
    set_all("shown");
    looked(event);
  },
  fit(path, event) {
    fit(regions.sorted.slice(...range(path)));
    changed(event);
  },
  fit_shown(event) {
    fit(regions.sorted.filter((_, i) => regions.states[i] < 2));
    changed(event);
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
