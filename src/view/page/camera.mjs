// Cameras: where points stand in the picture, and the cameras that a turn, a pan, a zoom or a fit leads to.
import {along, clamp, corners, cross, dot, middle_of, minus, radians, unit} from "./numbers.mjs";

/// The picture's size, in device pixels and in CSS pixels.
export const size = {width: 1, height: 1, css_width: 1, css_height: 1};
export function axes({azimuth, elevation}) {
  const [a, e] = [radians(azimuth), radians(elevation)];
  const [ca, sa, ce, se] = [Math.cos(a), Math.sin(a), Math.cos(e), Math.sin(e)];
  return {right: [-sa, ca, 0], up: [-se * ca, -se * sa, ce], back: [ce * ca, ce * sa, se]};
}
/// The point that is x, y and z mm to the right, upward and toward the eye.
const from_camera = ({right, up, back}, start, [x, y, z]) => along(along(along(start, right, x), up, y), back, z);
/// A point as mm from the center: the reverse of from_camera().
function in_camera(camera, point) {
  const q = minus(point, camera.center), {right, up, back} = axes(camera);
  return [dot(q, right), dot(q, up), dot(q, back)];
}
/// CSS pixels a millimetre, of what lies z mm from the center toward the eye; 0 behind the eye.
function scale_at(camera, z) {
  const scale = size.css_height / camera.view_size;
  if (!camera.perspective) return scale;
  const eye = camera.view_size / 2 / Math.tan(radians(camera.perspective) / 2);
  return z < 0.999 * eye ? scale * eye / (eye - z) : 0;
}
/// Where a point stands in the picture, in CSS pixels; null behind the eye.
export function on_screen(camera, point) {
  const [x, y, z] = in_camera(camera, point), scale = scale_at(camera, z);
  return scale > 0 ? [size.css_width / 2 + x * scale, size.css_height / 2 - y * scale] : null;
}
/// The point under a place of the picture, z mm from the center toward the eye.
export function under(camera, x, y, z = 0) {
  const mm = 1 / (scale_at(camera, z) || scale_at(camera, z = 0));
  return from_camera(axes(camera), camera.center, [(x - size.css_width / 2) * mm, (size.css_height / 2 - y) * mm, z]);
}
/// How far a point is from the center toward the eye; 0 for none.
export const depth_in = (camera, point) => point ? in_camera(camera, point)[2] : 0;
/// The camera turned about a pivot. The pivot keeps its coordinates in camera axes, and so its place in the picture.
export function turned(camera, azimuth, elevation, pivot) {
  const held = in_camera(camera, pivot);
  const made = {...camera, azimuth: ((azimuth % 360) + 360) % 360, elevation: clamp(elevation, -90, 90)};
  return {...made, center: from_camera(axes(made), pivot, held.map(v => -v))};
}
/// The camera for which what lies z mm toward the eye moves by CSS pixels.
export function panned(camera, dx, dy, z = 0) {
  const scale = scale_at(camera, z) || scale_at(camera, 0);
  return {...camera, center: from_camera(axes(camera), camera.center, [-dx / scale, dy / scale, 0])};
}
/// The camera whose view is `factor` times as large in mm. What is under the place, z mm toward the eye, stays there.
/// `span` is the model's diagonal, which limits the size.
export function zoomed(camera, factor, span, x, y, z = 0) {
  const view_size = clamp(camera.view_size * factor, 1e-7 * span, 1e4 * span), fixed = under(camera, x, y, z);
  return {...camera, view_size, center: along(fixed, minus(camera.center, fixed), view_size / camera.view_size)};
}
/// The camera that has a box in the picture, from the same direction.
export function fitted(given, box) {
  const camera = {...given, center: middle_of(box)};
  // A point (x, y, z) is seen if |y| <= (size / 2) (eye - z) / eye, where eye = size / 2 / slope.
  const slope = Math.tan(radians(camera.perspective) / 2), aspect = size.css_width / size.css_height;
  const needed = corners(box).map(corner => in_camera(camera, corner))
    .map(([x, y, z]) => 2 * (Math.max(Math.abs(x) / aspect, Math.abs(y)) + slope * z));
  return {...camera, view_size: 1.06 * Math.max(...needed) || camera.view_size};
}

/// How far the farthest corner of a box is from the picture's middle: 1 at an edge, more outside.
export function reach(camera, box) {
  return Math.max(...corners(box).flatMap(corner => {
    const [x, y] = on_screen(camera, corner) ?? [Infinity, Infinity];
    return [Math.abs(2 * x / size.css_width - 1), Math.abs(2 * y / size.css_height - 1)];
  }));
}
/// The camera for a picture that had the size `before`, and has another now. The square in the
/// middle keeps in view and fills the room, and a box that was in view keeps in view.
export function kept_in_view(camera, box, before) {
  const after = {...size}, part = ({css_width, css_height}) => Math.min(1, css_width / css_height);
  Object.assign(size, before);
  const was_in_view = reach(camera, box) <= 1;
  Object.assign(size, after);
  let made = {...camera, view_size: camera.view_size * part(before) / part(after)};
  for (let i = 0; i < 5 && was_in_view && reach(made, box) > 1; i++)
    made = {...made, view_size: made.view_size * 1.01 * Math.min(2, reach(made, box))};
  return made;
}

/// The point of a plane that is nearest the middle of a box.
export function plane_foot({normal, distance}, box) {
  const middle = middle_of(box);
  return along(middle, normal, (distance - dot(normal, middle)) / dot(normal, normal));
}
/// Axes in a plane, seen from the side that the normal points to: z is up, or y where the normal is z.
export function plane_axes({normal}) {
  const n = unit(normal), up = Math.hypot(n[0], n[1]) < 1e-6 ? [0, 1, 0] : unit(along([0, 0, 1], n, -n[2]));
  return {right: cross(up, n), up};
}
/// How far a box reaches over a plane, to the right and upward from the plane's foot.
export function plane_extent(plane, box) {
  const {right, up} = plane_axes(plane), foot = plane_foot(plane, box), all = corners(box).map(p => minus(p, foot));
  return [right, up].map(axis => all.map(p => dot(p, axis))).map(places => [Math.min(...places), Math.max(...places)]);
}
