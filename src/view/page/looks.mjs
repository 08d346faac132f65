// Looks: states and colours of the parts below paths. Regions are sorted by path, so that all below a path are a range.

export const STATES = ["shown", "ghost", "hidden"];

export const covers = (path, other) => path === "/" || other === path || other.startsWith(path + "/");
export const last_leg = path => path.slice(path.lastIndexOf("/") + 1);

/// A table of regions as the server lists them: `paths`, and for each region `look_of`, its place in the looks
/// {state, color} that regions have. The table is sorted by path; `ids` are the places in the list.
export function region_table({paths: listed, own_looks, look_of}) {
  const ids = Uint32Array.from(listed, (_, id) => id).sort((a, b) => listed[a] < listed[b] ? -1 : 1);
  const rank = new Uint32Array(ids.length);
  ids.forEach((id, i) => { rank[id] = i; });
  const paths = Array.from(ids, id => listed[id]), looks = Array.from(ids, id => own_looks[look_of[id]]);
  const own_states = Uint8Array.from(looks, look => Math.max(0, STATES.indexOf(look.state)));
  const own_colors = looks.map(look => look.color);
  return {paths, ids, rank, own_states, own_colors, states: own_states, colors: own_colors};
}
/// Ranges of the table as ranges [first, last) of the model's list, in order.
export function listed_ranges({ids}, ranges) {
  const listed = new Uint32Array(ranges.reduce((sum, [low, high]) => sum + high - low, 0)), made = [];
  let count = 0;
  for (const [low, high] of ranges) {
    listed.set(ids.subarray(low, high), count);
    count += high - low;
  }
  listed.sort();
  for (const id of listed) {
    if (made.at(-1)?.[1] === id) made.at(-1)[1]++;
    else if (!(id < made.at(-1)?.[1])) made.push([id, id + 1]);  // ranges may meet
  }
  return made;
}
function lower_bound(paths, path) {
  let low = 0, high = paths.length;
  while (low < high) {
    const at = (low + high) >> 1;
    if (paths[at] < path) low = at + 1;
    else high = at;
  }
  return low;
}
/// Which of the sorted paths a path means: all below it, or itself; "/" means all.
export function range_of(paths, path) {
  if (path === "/") return [0, paths.length];
  const at = lower_bound(paths, path), after = at + (paths[at] === path);
  if (!paths[after]?.startsWith(path)) return [at, after];
  const low = lower_bound(paths, path + "/"), high = lower_bound(paths, path + "0");  // 0 comes after /
  return low < high ? [low, high] : [at, after];
}
/// Gives the table the states and colours that looks lead to.
export function apply_looks(table, looks) {
  table.states = table.own_states.slice();
  table.colors = table.own_colors.slice();
  for (const look of looks) {
    const [low, high] = range_of(table.paths, look.path);
    if (look.state) table.states.fill(STATES.indexOf(look.state), low, high);
    if (look.color) table.colors.fill(look.color, low, high);
  }
}
/// Whether a path or a path above is in a Set.
function covers_any(paths, path) {
  if (paths.has("/")) return true;
  for (let end = path.length; end > 0; end = path.lastIndexOf("/", end - 1))
    if (paths.has(path.slice(0, end))) return true;
  return false;
}
/// The looks without one member, "state" or "color", at the paths in a Set and below.
function without(looks, paths, member) {
  return looks.flatMap(look => {
    if (look[member] === undefined || !covers_any(paths, look.path)) return [look];
    const {[member]: _, ...others} = look;
    return Object.keys(others).length > 1 ? [others] : [];
  });
}
/// The looks with a value for the member of several paths, where it changes anything. New looks replace those at their
/// paths and below, and several that cover all regions mean "/", so that the list stays short. The time is linear in
/// the regions, looks and paths. The table gets the result.
export function with_looks(table, looks, given, member, value) {
  const covered = new Uint8Array(table.paths.length);
  for (const path of given) covered.fill(1, ...range_of(table.paths, path));
  const paths = given.length > 1 && !covered.includes(0) ? ["/"] : given;
  const made = without(looks, new Set(paths), member), is_state = member === "state";
  apply_looks(table, made);
  const wanted = String(is_state ? STATES.indexOf(value) : value);
  const present = is_state ? table.states : table.colors;
  for (const path of paths) {
    let [at, high] = range_of(table.paths, path);
    while (at < high && String(present[at]) === wanted) at++;
    if (at === high) continue;
    const last = made.at(-1);
    if (last?.path === path) made[made.length - 1] = {...last, [member]: value};
    else made.push({path, [member]: value});
  }
  apply_looks(table, made);
  return made;
}
/// The looks that give all regions a state, and keep their colours.
export const with_state_of_all = (table, looks, state) =>
  with_looks(table, without(looks, new Set(["/"]), "state"), ["/"], "state", state);
/// The paths that lead to no region.
export const lost_paths = ({paths}, given) => given.filter(path => {
  const [low, high] = range_of(paths, path);
  return low === high;
});
/// The looks without colours that concern a path.
export const without_colors = (looks, path) => looks.flatMap(({color, ...look}) =>
  !covers(path, look.path) && !covers(look.path, path) ? [color ? {...look, color} : look] : look.state ? [look] : []);
