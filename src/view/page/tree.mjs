// The tree of the parts: only the rows in sight have elements.
import {act} from "./acts.mjs";
import {select, toggle_selected} from "./ask.mjs";
import {by, el, is_focused, named} from "./dom.mjs";
import {STATES, covers, last_leg} from "./looks.mjs";
import {clamp, from_hex, hex} from "./numbers.mjs";
import {found_in} from "./search.mjs";
import {range, regions, selected, selection} from "./state.mjs";

const ROW = 26, WORDS = [...STATES, "partly shown"], MARKS = "\u25cf\u25d0\u25cb\u25d2";
let anchor = null;  // where a range of rows begins
let root = null, rows = [], pool = [], search = {};
const new_node = (path, depth, low, high, leaf) => ({path, depth, low, high, leaf, open: false, children: null});
/// Children are found when a node is opened for the first time: each skips its whole range. Children stand in the
/// order that their first regions have in the model.
function children_of(node) {
  if (node.children) return node.children;
  node.children = [];
  for (let i = node.low; i < node.high;) {
    const end = regions.paths[i].indexOf("/", node.path.length + 1);
    const path = end < 0 ? regions.paths[i] : regions.paths[i].slice(0, end);
    const is_alone = !regions.paths[i + 1]?.startsWith(path), high = is_alone ? i + 1 : Math.max(range(path)[1], i + 1);
    let first = Infinity;
    for (let k = i; k < high; k++) first = Math.min(first, regions.ids[k]);
    node.children.push(Object.assign(new_node(path, node.depth + 1, i, high, end < 0), {first}));
    i = high;
  }
  node.children.sort((a, b) => a.first - b.first);
  node.children.forEach((child, i, all) => Object.assign(child, {place: i + 1, of: all.length}));
  return node.children;
}
/// Opens what was open before; at first two levels.
export function build_tree() {
  const opened = new Set();
  const remember = node => {
    if (!node.open) return;
    opened.add(node.path);
    node.children?.forEach(remember);
  };
  if (root) remember(root);
  root = new_node("", -1, 0, regions.paths.length, false);
  const reopen = node => {
    if (node.leaf || (opened.size ? !opened.has(node.path) : node.depth > 0)) return;
    node.open = true;
    children_of(node).forEach(reopen);
  };
  reopen(root);
  list_rows();
}
/// Lists the rows: the open part of the tree, or what the search finds.
export function list_rows() {
  const wanted = by("search").value.toLowerCase();
  rows = [];
  const add = node => {
    rows.push(node);
    if (node.open) children_of(node).forEach(add);
  };
  (wanted ? found(wanted) : children_of(root)).forEach(add);
  by("matches").textContent = wanted ? `${rows.length} found` : `${regions.paths.length} regions`;
  draw_tree();
}
function found(text) {
  if (search.text === text && search.paths === regions.paths) return search.nodes;
  const nodes = found_in(regions.paths, text).map(({path, leaf, at}, i, {length}) =>
    ({place: i + 1, of: length, ...new_node(path, 0, ...range(path), leaf), match: [at, at + text.length]}));
  search = {text, paths: regions.paths, nodes};
  return search.nodes;
}
/// A state by number: 0 shown, 1 ghost, 2 hidden, 3 some of each.
const state_of = ({low, high}) =>
  regions.states.subarray(low, high).every(state => state === regions.states[low]) ? regions.states[low] : 3;
/// The state that a click leads to: some of each become shown.
const next_state = node => STATES[(state_of(node) + 1) % 4 % 3];
/// The word for what regions of several ranges have in common.
export function state_word(ranges) {
  const states = new Set(ranges.map(([low, high]) => state_of({low, high})));
  return WORDS[states.size > 1 ? 3 : [...states][0]];
}
/// The parts that a control of a row means: the row's part, or all selected parts where the row is selected.
const meant = ({path}) => selection.includes(path) ? selection : [path];
function make_row() {
  const row = el("div", {className: "row", role: "treeitem"});
  const on_node = run => event => {
    event.stopPropagation();
    run(row.node, event);
  };
  row.twist = el("button", {className: "twist", tabIndex: -1, onclick: on_node(open_close)});
  const change = (node, event) => act.state(meant(node), next_state(node), event);
  row.state = el("button", {tabIndex: -1, onclick: on_node(change)});
  row.text = el("span", {className: "names"});
  row.only = el("button", {className: "only", tabIndex: -1, textContent: "only", title: "Isolate: hide all others",
                           onclick: on_node((node, event) => act.isolate(meant(node), event))});
  const color = (node, event) => act.color(meant(node), from_hex(row.color.value), event);
  row.color = el("input", {type: "color", tabIndex: -1, onclick: event => event.stopPropagation(),
                           oninput: on_node(color)});
  row.append(row.twist, row.state, row.text, row.only, row.color);
  row.onclick = event => select_row(row.node.path, event);
  row.ondblclick = event => act.fit(meant(row.node), event);
  return row;
}
/// The last leg comes first; where the search found it, the legs before follow.
function name_row(row, {path, match = [0, 0]}, name) {
  const start = path.length - name.length, from = match.map(at => Math.max(at - start, 0));
  row.text.replaceChildren(named(name, ...from));
  if (match[1]) row.text.append(named(path.slice(0, start - 1), ...match.map(at => Math.min(at, start - 1))));
  row.text.title = path;
}
export function draw_tree() {
  const tree = by("tree"), count = Math.ceil(tree.clientHeight / ROW) + 6;
  by("rows").style.height = rows.length * ROW + "px";
  while (pool.length < count) by("rows").append(pool[pool.push(make_row()) - 1]);
  while (pool.length > count) pool.pop().remove();
  const first = clamp(Math.floor(tree.scrollTop / ROW) - 3, 0, Math.max(0, rows.length - count));
  let active = "";
  for (let i = first; i < first + count; i++) {
    // An element, and so the focus, stays on its row while the tree scrolls.
    const row = pool[i % count], node = rows[i];
    row.hidden = !node;
    if (!node) continue;
    const state = state_of(node), name = last_leg(node.path);
    Object.assign(row, {node, id: "row-" + i, ariaLevel: String(node.depth + 1),
      ariaSelected: String(selection.includes(node.path)), ariaExpanded: node.leaf ? null : String(node.open),
      ariaSetSize: String(node.of), ariaPosInSet: String(node.place)});
    row.dataset.path = node.path;
    row.style.top = i * ROW + "px";
    row.style.paddingLeft = 2 + 14 * node.depth + "px";
    row.classList.toggle("off", state === 2);
    Object.assign(row.twist, {textContent: node.leaf ? "" : node.open ? "\u25be" : "\u25b8", disabled: node.leaf,
                              ariaLabel: `Open or close ${name}`});
    Object.assign(row.state, {textContent: MARKS[state], ariaLabel: `${name} is ${WORDS[state]}: change`,
                              title: `${WORDS[state]}; a click makes it ${next_state(node)}`});
    name_row(row, node, name);
    row.only.ariaLabel = `Isolate ${name}`;
    row.color.ariaLabel = row.color.title = `Colour of ${name}`;
    if (!is_focused(row.color)) row.color.value = hex(regions.colors[node.low]);
    if (node.path === selected) active = row.id;
  }
  if (active) tree.setAttribute("aria-activedescendant", active);
  else tree.removeAttribute("aria-activedescendant");
}
/// Selects a row. With Ctrl its part is selected besides the others, with Shift all from the row selected before.
function select_row(path, {shiftKey, ctrlKey, metaKey}) {
  if (shiftKey && selected !== null) {
    const [from, to] = [anchor, path].map(wanted => rows.findIndex(node => node.path === wanted));
    const between = from < 0 ? [] : rows.slice(Math.min(from, to), Math.max(from, to) + 1);
    return select(between.map(node => node.path).filter(other => other !== path), path);
  }
  anchor = path;
  if (ctrlKey || metaKey) toggle_selected(path);
  else select(path);
}
function open_close(node, _event, open = !node.open) {
  if (node.leaf || node.open === open) return;
  node.open = open;
  list_rows();
}
/// Opens the tree down to a path, and scrolls there.
export function reveal(path) {
  if (!rows.some(node => node.path === path)) {
    by("search").value = "";
    for (let node = root; node && node.path !== path;) {
      node.open = true;
      node = children_of(node).find(child => covers(child.path, path));
    }
    list_rows();
  }
  const tree = by("tree"), at = rows.findIndex(node => node.path === path);
  if (at * ROW < tree.scrollTop || (at + 1) * ROW > tree.scrollTop + tree.clientHeight)
    tree.scrollTop = Math.max(0, at * ROW - tree.clientHeight / 2);
}
export function tree_key(event) {
  const at = rows.findIndex(node => node.path === selected), node = rows[at], page = pool.length - 7;
  const go = i => rows.length && select_row(rows[clamp(i, 0, rows.length - 1)].path, event);
  const go_up = () => go(Math.max(0, rows.findLastIndex((n, i) => i < at && n.depth < node.depth)));
  const run = {
    ArrowDown: () => go(at + 1), ArrowUp: () => go(at - 1), Home: () => go(0), End: () => go(rows.length - 1),
    PageDown: () => go(at + page), PageUp: () => go(at - page),
    ArrowRight: () => node && (node.open || node.leaf ? go(at + 1) : open_close(node, event, true)),
    ArrowLeft: () => node && (node.open ? open_close(node, event, false) : go_up()),
    " ": () => node && act.state(selection, next_state(node), event),
    Enter: () => node && act.fit(selection, event),
  }[event.key];
  if (event.target !== by("tree") || !run || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  event.stopPropagation();
  run();
}
