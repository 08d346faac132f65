// Shapes: what the parameters of a solid, as scenes have them, say of its size and place.
import {along, cross, dot, minus, unit} from "./numbers.mjs";

const norm = v => Math.hypot(...v);
const is_near = (a, b) => Math.abs(a - b) <= 1e-12 * Math.max(a, b);
const is_square = (a, b) => Math.abs(dot(a, b)) <= 1e-12 * norm(a) * norm(b);
const is_round = (a, b) => is_near(norm(a), norm(b)) && is_square(a, b);
/// A vector of a length across another.
function across(axis, mm) {
  const least = axis.map(Math.abs).indexOf(Math.min(...axis.map(Math.abs)));
  return unit(cross(axis, [0, 1, 2].map(i => Number(i === least)))).map(v => v * mm);
}
// A size: what it is, millimetres, and the two points between which it is measured.
const span = (label, from, way) => ({label, mm: norm(way), ends: [from, along(from, way, 1)]});
const diameter = (label, center, radius) =>
  ({label, mm: 2 * norm(radius), ends: [along(center, radius, -1), along(center, radius, 1)]});
/// The diameters of an ellipse of which p and q are semi-axes: one if it is a circle.
const diameters = (where, center, p, q) => is_round(p, q) ? [diameter("diameter" + where, center, p)] :
  [p, q].map((radius, i) => diameter(`diameter ${i + 1}${where}`, center, radius));
function cone({base, height, a, b, c, d}) {
  const top = along(base, height, 1), is_even = is_near(norm(a), norm(c)) && is_near(norm(b), norm(d));
  const is_circular = is_round(a, b) && is_round(c, d), is_right = is_square(height, a) && is_square(height, b);
  return {name: (is_right ? "" : "oblique ") + (is_circular ? "" : "elliptical ") + (is_even ? "cylinder" : "cone"),
          center: along(base, height, 0.5), axis: unit(height),
          sizes: [...diameters(is_even ? "" : " at the base", base, a, b),
                  ...is_even ? [] : diameters(" at the top", top, c, d),
                  span(is_right ? "height" : "length of the axis", base, height)]};
}
const circular = ({base, height, radius, top_radius = radius}) =>
  cone({base, height, a: across(height, radius), b: unit(cross(height, across(height, 1))).map(v => v * radius),
        c: across(height, top_radius), d: unit(cross(height, across(height, 1))).map(v => v * top_radius)});
/// The vector of a length across two others.
const beside = (v, w, mm) => unit(cross(v, w)).map(x => x * mm);
const bowl = form => ({base, height, a, r1, r2}) =>
  ({name: (is_near(r1, r2) ? "" : "elliptical ") + form, axis: unit(height), sizes: [
    ...diameters(" at the base", base, unit(a).map(x => x * r1), beside(height, a, r2)),
    span("height", base, height)]});
function hyperboloid({base, height, a, b, neck}) {
  const center = along(base, height, 0.5), other = beside(height, a, b), waist = v => v.map(x => x * neck);
  return {name: (is_near(norm(a), b) ? "" : "elliptical ") + "hyperboloid of one sheet", center, axis: unit(height),
          sizes: [...diameters(" at the ends", base, a, other),
                  ...diameters(" at the waist", center, waist(a), waist(other)), span("height", base, height)]};
}
/// A torus with an ellipse of which c and d are semi-axes.
function elliptical_torus({center, axis, radius, c, d}) {
  const up = unit(axis), level = along(c, up, -dot(c, up));
  const out = norm(level) > 1e-12 * norm(c) ? unit(level) : across(axis, 1);
  const other = beside(cross(up, out), c, d), middle = along(center, out, radius);
  const reach = way => Math.hypot(dot(c, way), dot(other, way));
  return {name: "elliptical torus", center, axis: up, sizes: [
    diameter("diameter of the ring's middle", center, out.map(x => x * radius)),
    ...diameters(" of the tube", middle, c, other),
    diameter("diameter", center, out.map(x => x * (radius + reach(out)))),
    span("height", along(middle, up, -reach(up)), up.map(x => 2 * x * reach(up)))]};
}
const ball = ({center, radius}) => ({name: "ball", center, sizes: [diameter("diameter", center, [radius, 0, 0])]});
function polyhedron({vertices: all}) {
  const edges = [1, 3, 4].map(i => all.length === 8 ? minus(all[i], all[0]) : [0, 0, 0]), [x, y, z] = edges;
  const is_box = [[2, x, y], [5, x, z], [7, y, z], [6, along(x, y, 1), z]].every(([i, a, b]) => {
    const way = all.length === 8 ? minus(minus(all[i], all[0]), along(a, b, 1)) : [1, 1, 1];
    return norm(way) <= 1e-12 * (norm(x) + norm(y) + norm(z));
  }) && is_square(x, y) && is_square(x, z) && is_square(y, z);
  return is_box ? {name: "box", center: along(all[0], all[6], 1).map(v => v / 2),
                   sizes: edges.map((edge, i) => span("edge " + (i + 1), all[0], edge))} :
    {name: `polyhedron of ${all.length} vertices`, sizes: []};
}
const three_diameters = ({center, a, b, c}) =>
  ({center, sizes: [a, b, c].map((radius, i) => diameter(`diameter ${i + 1}`, center, radius))});
const SHAPES = {
  sphere: ball, tgc: cone, cylinder: circular, cone: shape => circular({top_radius: 0, ...shape}),
  ell: ({center, a, b, c}) => is_round(a, b) && is_round(b, c) && is_round(a, c) ? ball({center, radius: norm(a)}) :
    {name: "ellipsoid", ...three_diameters({center, a, b, c})},
  superell: shape => ({name: "superellipsoid", ...three_diameters(shape)}),
  ehy: bowl("hyperboloid"), epa: bowl("paraboloid"), hyp: hyperboloid, eto: elliptical_torus,
  tor: ({center, axis, radius, tube}) => ({name: "torus", center, axis: unit(axis), sizes: [
    diameter("diameter of the ring's middle", center, across(axis, radius)),
    diameter("diameter of the tube", along(center, across(axis, radius), 1), across(axis, tube)),
    diameter("diameter", center, across(axis, radius + tube))]}),
  part: ({base, height, radius, top_radius}) => ({name: "particle", center: along(base, height, 0.5),
    axis: unit(height), sizes: [diameter("diameter at the base", base, across(height, radius)),
      diameter("diameter at the top", along(base, height, 1), across(height, top_radius)),
      span("length of the axis", base, height)]}),
  box: ({low, high}) => ({name: "box", center: along(low, high, 1).map(v => v / 2), sizes: [0, 1, 2].map(i =>
    span("edge " + "xyz"[i], low, minus(high, low).map((v, k) => k === i ? v : 0)))}),
  arb4: polyhedron, arb5: polyhedron, arb6: polyhedron, arb7: polyhedron, arb8: polyhedron,
};
/// The form of a shape: `name`, `sizes`, and if it has them `center` and `axis`, a unit vector. Null: its parameters
/// say nothing that a ruler does.
export const described = shape => SHAPES[shape?.type]?.(shape) ?? null;
/// How two faces lie, of which there are a point and a normal each: the distance of parallel ones, else their angle.
export function between_faces(a, b) {
  const turn = norm(cross(a.normal, b.normal)), way = minus(b.point, a.point);
  if (turn > 1e-9) return {degrees: Math.atan2(turn, Math.abs(dot(a.normal, b.normal))) * 180 / Math.PI};
  const mm = dot(way, a.normal);
  return {mm: Math.abs(mm), ends: [a.point, along(a.point, a.normal, mm)]};
}
/// The camera's angles that look against a normal.
export const angles_of = ([x, y, z]) => ({azimuth: (Math.atan2(y, x) * 180 / Math.PI + 360) % 360,
                                          elevation: Math.atan2(z, Math.hypot(x, y)) * 180 / Math.PI});
