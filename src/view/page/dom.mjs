// Elements of the page, and the bar that has its messages.
import {clamp} from "./numbers.mjs";
import {name_pieces} from "./search.mjs";

export const by = id => document.getElementById(id);
export const is_focused = element => document.activeElement === element;
/// An element. Texts from the model go through textContent or append(), never through innerHTML.
export function el(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}
/// The element of a name that is cut short in its middle, with a match from `from` to `to` marked.
export function named(name, from, to) {
  const {head, tail} = name_pieces(name, from, to);
  const part = (className, pieces) => el("span", {className}, ...pieces.map(([text, is_match]) =>
    is_match ? el("mark", {textContent: text}) : text));
  return el("span", {className: "name", title: name}, part("head", head), part("tail", tail));
}
export function svg(tag, attributes = {}) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}
/// Makes the buttons of a group one stop of the Tab key.
export function rove(group) {
  [...group.querySelectorAll("button")].forEach((button, i) => { button.tabIndex = i ? -1 : 0; });
}
/// Moves the focus within a group of buttons by arrows, Home and End.
export function rove_by_key(event) {
  const buttons = [...event.currentTarget.querySelectorAll("button")], at = buttons.indexOf(event.target);
  const last = buttons.length - 1;
  const step = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1, Home: -at, End: last - at}[event.key];
  if (at < 0 || step === undefined || event.ctrlKey || event.metaKey || event.shiftKey) return;
  event.preventDefault();
  event.stopPropagation();
  const next = buttons[clamp(at + step, 0, last)];
  buttons[at].tabIndex = -1;
  next.tabIndex = 0;
  next.focus();
}
/// A new size clears a canvas: only another size is set.
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
