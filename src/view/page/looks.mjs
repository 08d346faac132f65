// Looks: states and colours of the parts below paths. Regions are sorted by path, so that all below a path are a range.

export const STATES = ["shown", "ghost", "hidden"];

export const covers = (path, other) => other === path || other.startsWith(path + "/");
export const last_leg = path => path.slice(path.lastIndexOf("/") + 1);

/// A table of regions as the server lists them: {path, state, color, low, high}, with `id`, their place in the list.
export function region_table(list) {
  const sorted = list.map((region, id) => Object.assign(region, {id}))
    .sort((a, b) => a.path < b.path ? -1 : a.path > b.path ? 1 : 0);
  const rank = new Uint32Array(list.length);
  sorted.forEach((region, i) => { rank[region.id] = i; });
  const own_states = Uint8Array.from(sorted, region => Math.max(0, STATES.indexOf(region.state)));
  const own_colors = sorted.map(region => region.color);
  return {sorted, paths: sorted.map(region => region.path), rank, own_states, own_colors,
          states: own_states, colors: own_colors};
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
/// Which of the sorted paths a path means: all below it, or itself.
export function range_of(paths, path) {
  const low = lower_bound(paths, path + "/"), high = lower_bound(paths, path + "0");  // 0 comes after /
  if (low < high) return [low, high];
  const at = lower_bound(paths, path);
  return [at, at + (paths[at] === path)];
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
/// The looks with one more, if it changes anything. It replaces the looks at its path and below, so that the list
/// stays short. `member` is "state" or "color". The table gets the result.
export function with_look(table, looks, path, member, value) {
  const kept = looks.flatMap(look => {
    if (!covers(path, look.path) || look[member] === undefined) return [look];
    const {[member]: _, ...others} = look;
    return Object.keys(others).length > 1 ? [others] : [];
  });
  apply_looks(table, kept);
  const [low, high] = range_of(table.paths, path), is_state = member === "state";
  const wanted = String(is_state ? STATES.indexOf(value) : value);
  const present = is_state ? table.states : table.colors;
  if (present.slice(low, high).every(v => String(v) === wanted)) return kept;
  const last = kept.at(-1);
  const made = last?.path === path ? [...kept.slice(0, -1), {...last, [member]: value}]
                                   : [...kept, {path, [member]: value}];
  apply_looks(table, made);
  return made;
}
/// The looks without colours that concern a path.
export const without_colors = (looks, path) => looks.flatMap(({color, ...look}) =>
  !covers(path, look.path) && !covers(look.path, path) ? [color ? {...look, color} : look] : look.state ? [look] : []);
