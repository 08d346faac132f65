// The page's state: what several modules read. `hold` alone changes these names.
import {range_of} from "./looks.mjs";

export let model = null, view = null, ended = false;
/// The paths of the parts that are selected; the last of them, or null.
export let selection = [], selected = null;
/// The regions sorted, with the states and colours that the view's looks lead to: a table of looks.mjs.
export let regions = null;
export function hold(names) {
  ({model, view, ended, selection, regions} = {model, view, ended, selection, regions, ...names});
  selected = selection.at(-1) ?? null;
}
/// The model's box; a metre where nothing is bounded.
export const bounds = () => model.bounds ?? {low: [-500, -500, -500], high: [500, 500, 500]};
export const path_of = id => model.paths[id] ?? "?";
export const color_of = id => regions.colors[regions.rank[id]];
export const range = path => range_of(regions.paths, path);
