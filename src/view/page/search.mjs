// The search for parts.

/// The shortest paths whose last leg ends what is searched for: a combination stands for what is below it. `text` is in
/// lower case. Each path has `leaf`: whether it is a region.
export function found_in(paths, text) {
  const found = new Map();
  for (const path of paths) {
    const at = path.toLowerCase().indexOf(text), end = at < 0 ? -1 : path.indexOf("/", at + text.length);
    const whole = end < 0 ? path : path.slice(0, end);
    if (at >= 0 && !found.has(whole)) found.set(whole, {path: whole, leaf: end < 0});
  }
  return [...found.values()];
}
