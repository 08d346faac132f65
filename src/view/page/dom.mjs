// Elements of the page, and the bar that has its messages.

export const by = id => document.getElementById(id);
export const is_focused = element => document.activeElement === element;
/// An element. Texts from the model go through textContent or append(), never through innerHTML.
export function el(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}
export function svg(tag, attributes = {}) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}
/// A canvas is cleared by a new size: it gets the size only where it differs.
export function resize(target, width, height) {
  if (target.width !== width || target.height !== height) Object.assign(target, {width, height});
}
export const notes = new Map();
const taken = new Map();
/// Shows a sentence in the bar until the same key says something else or the user takes it away.
export function say(key, text) {
  if ((notes.get(key) ?? "") === (text ?? "") || text && taken.get(key) === text) return;
  taken.delete(key);
  if (text) notes.set(key, text);
  else notes.delete(key);
  by("bar").replaceChildren(...[...notes].map(([k, t]) => el("div", {id: "note-" + k}, el("span", {textContent: t}),
    el("button", {textContent: "\u00d7", ariaLabel: "Take the message away", onclick: () => take_away(k, t)}))));
  by("bar").hidden = !notes.size;
}
function take_away(key, text) {
  say(key, "");
  taken.set(key, text);
}
