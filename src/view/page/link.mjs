// Links: a view, and what the page shows besides, as the text after # in an address.
import {STATES} from "./looks.mjs";

const MOST_SELECTED = 200;
export const written_link = (view, {slice, selected, answer, measurements}) =>
  "#" + encodeURIComponent(JSON.stringify({...view, ...slice && {slice},
    ...selected.length && selected.length <= MOST_SELECTED && {selected}, ...answer && {answer},
    ...measurements.length && {measurements}}));

function expect(good, text) {
  if (!good) throw new Error(text);
}
const is_vector = v => Array.isArray(v) && v.length === 3 && v.every(Number.isFinite);
const is_count = v => Number.isInteger(v) && v >= 0;
/// A whole view of what somebody gave. Throws what is wrong. `usual` has what is left out, `choices` has the names that
/// may be chosen of `show` and `light`.
export function checked(given, usual, choices) {
  const is_plane = p => p && is_vector(p.normal) && Math.hypot(...p.normal) > 0 && Number.isFinite(p.distance);
  const is_look = look => look && typeof look.path === "string" && (!look.color || is_vector(look.color)) &&
    (!look.state || STATES.includes(look.state));
  expect(given && typeof given === "object" && !Array.isArray(given), "a view is an object");
  const {clip, looks, show, edges, light, ground = null, hatch = true, guides = true} =
    {...structuredClone(usual), ...given};
  const camera = checked_camera({...usual.camera, ...given.camera});
  expect(Array.isArray(clip) && clip.length <= 3 && clip.every(is_plane), "clip is a list of up to three planes");
  expect(Array.isArray(looks) && looks.every(is_look), "looks is a list of paths with states or colours");
  expect(choices.show.includes(show), "show is unknown");
  expect(choices.light.includes(light), "light is unknown");
  expect([edges, hatch, guides].every(flag => typeof flag === "boolean"), "edges, hatch and guides are true or false");
  expect(ground === null || Array.isArray(ground) && ground.length === 2 && ground.every(is_vector),
         "ground is a list of two colours");
  return {camera, clip: clip.map(({normal, distance}) => ({normal, distance})), looks, show, edges, light, ground,
          hatch, guides};
}
function checked_camera({azimuth, elevation, perspective, center, view_size}) {
  expect([azimuth, elevation, perspective, view_size].every(Number.isFinite) && is_vector(center) && view_size > 0 &&
         Math.abs(elevation) <= 90 && perspective >= 0 && perspective < 180, "its camera is none");
  return {azimuth, elevation, perspective, center, view_size};
}
/// What a link's text has: a view, and `slice`, `selected` and `answer`. Throws what is wrong.
export function read_link(text, usual, choices) {
  let given = null;
  try {
    given = JSON.parse(decodeURIComponent(text));
  } catch {
    throw new Error("it is cut short or damaged");
  }
  const view = checked(given, usual, choices), {slice, selected = [], answer, measurements = []} = given;
  expect(Array.isArray(selected) && selected.every(path => typeof path === "string"), "selected is a list of paths");
  expect(!slice || is_count(slice.plane) && slice.plane < view.clip.length && slice.mm > 0 &&
         Array.isArray(slice.place) && slice.place.length === 2 && slice.place.every(Number.isFinite),
         "its slice is none");
  expect(!answer || [answer.width, answer.height, answer.x, answer.y].every(is_count) && answer.x < answer.width &&
         answer.y < answer.height && [answer.from, answer.to, answer.face].every(p => !p || is_vector(p)),
         "its answer has no pixel");
  expect(Array.isArray(measurements) && measurements.every(one => one && [one.what, one.unit, one.part].every(text =>
    typeof text === "string") && Number.isFinite(one.value) && one.ends?.length === 2 && one.ends.every(is_vector)),
         "its measurements are none");
  return {view, slice, selected, measurements,
          answer: answer && {...answer, camera: checked_camera({...answer.camera})}};
}
