// The address: it has the view after #.
import {looked} from "./acts.mjs";
import {build_planes} from "./cut.mjs";
import {by, say} from "./dom.mjs";
import {STATES} from "./looks.mjs";
import {ended, hold, model, view} from "./state.mjs";

let address_timer = 0;
/// Browsers refuse more than some 20 changes a second.
export function keep_address() {
  address_timer ||= setTimeout(() => {
    address_timer = 0;
    if (!ended) history.replaceState(null, "", "#" + encodeURIComponent(JSON.stringify(view)));
  }, 250);
}
/// A whole view of what somebody gave. Throws what is wrong with it.
export function checked(given) {
  const expect = (good, text) => {
    if (!good) throw new Error(text);
  };
  const is_vector = v => Array.isArray(v) && v.length === 3 && v.every(Number.isFinite);
  const is_plane = p => p && is_vector(p.normal) && Math.hypot(...p.normal) > 0 && Number.isFinite(p.distance);
  const is_look = ({path, state, color} = {}) => typeof path === "string" && (!color || is_vector(color)) &&
    (!state || STATES.includes(state));
  expect(given && typeof given === "object", "a view is an object");
  const {clip, looks, show} = {...structuredClone(model.view), ...given};
  const {azimuth, elevation, perspective, center, view_size} = {...model.view.camera, ...given.camera};
  expect([azimuth, elevation, perspective, view_size].every(Number.isFinite) && is_vector(center) && view_size > 0 &&
         Math.abs(elevation) <= 90 && perspective >= 0 && perspective < 180, "its camera is none");
  expect(Array.isArray(clip) && clip.length <= 3 && clip.every(is_plane), "clip is a list of up to three planes");
  expect(Array.isArray(looks) && looks.every(is_look), "looks is a list of paths with states or colours");
  expect([...by("show").options].some(o => o.value === show), "show is unknown");
  return {camera: {azimuth, elevation, perspective, center, view_size},
          clip: clip.map(({normal, distance}) => ({normal, distance})), looks, show};
}
export function set_view(given) {
  hold({view: checked(given)});
  build_planes();
  looked();
}
export function read_address() {
  const text = location.hash.slice(1);
  if (!text) return;
  try {
    const given = JSON.parse(decodeURIComponent(text));
    if (JSON.stringify(given) !== JSON.stringify(view)) set_view(given);
    say("address", "");
  } catch (error) {
    say("address", `The view in the address is not used: ${error.message}.`);
  }
}
