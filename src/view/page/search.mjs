// The search for parts, and names that are cut short in the middle.

/// The shortest paths whose last leg ends what is searched for: a combination stands for its parts. `text` is in lower
/// case. Each path has `leaf`, whether it is a region, and `at`, where the match begins.
export function found_in(paths, text) {
  const found = new Map();
  for (const path of paths) {
    const at = path.toLowerCase().indexOf(text), end = at < 0 ? -1 : path.indexOf("/", at + text.length);
    const whole = end < 0 ? path : path.slice(0, end);
    if (at >= 0 && !found.has(whole)) found.set(whole, {path: whole, leaf: end < 0, at});
  }
  return [...found.values()];
}
const TAIL = 6;
/// A name in pieces [text, whether it is part of the match from `from` to `to`]: the head, which is cut short where
/// room is scarce, and the tail, which stays in sight.
export function name_pieces(name, from = 0, to = 0) {
  const cut = name.length > 2 * TAIL ? name.length - TAIL : name.length;
  const pieces = (low, high) => [[low, from, false], [from, to, true], [to, high, false]]
    .map(([begin, end, is_match]) => [name.slice(Math.max(low, begin), Math.min(high, end)), is_match])
    .filter(([text]) => text);
  return {head: pieces(0, cut), tail: pieces(cut, name.length)};
}
