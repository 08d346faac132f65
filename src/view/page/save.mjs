// Save: files and commands that the view leads to, and saved views.
import {set_view, write_address} from "./address.mjs";
import {copy} from "./ask.mjs";
import {size} from "./camera.mjs";
import {by, el} from "./dom.mjs";
import {canvas, loop} from "./frames.mjs";
import {ask, attempt, post} from "./net.mjs";
import {model, regions, view} from "./state.mjs";

function download(blob, name) {
  const link = el("a", {href: URL.createObjectURL(blob), download: name});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}
const file_name = end => model.name.replace(/\.\w+$/, "").replace(/[^\w.-]+/g, "_") + end;
const full_size = () => ({width: size.width, height: size.height});
export const save = {
  png: () => canvas.toBlob(blob => download(blob, file_name(".png"))),
  exr: () => attempt("exr", async () =>
    download(await (await post("exr", {view, ...full_size()})).blob(), file_name(".exr"))),
  view: () => download(new Blob([JSON.stringify(view, null, 1) + "\n"], {type: "text/json"}), file_name("-view.json")),
  command: () => attempt("command", async () => {
    by("command").textContent = (await ask("command", {view, ...full_size(),
      samples: loop.shown.samples})).command;
    by("command-note").textContent = regions.states.includes(1) || view.show !== "color"
      ? "It draws colours, and ghosts are hidden." : "";
    by("command").hidden = by("copy-command").hidden = false;
  }),
};
export function copy_link(event) {
  write_address();
  by("link").textContent = location.href;
  by("link").hidden = false;
  copy("link", event.target);
}
export const open_view = file => file && attempt("view", async () => {
  const text = await file.text();
  try {
    set_view(JSON.parse(text));
  } catch (error) {
    throw new Error(`${file.name} is no view: ${error.message}.`);
  }
});
