// Save: files and commands that the view leads to, and saved views.
import {set_view, write_address} from "./address.mjs";
import {copy} from "./ask.mjs";
import {size} from "./camera.mjs";
import {by, el} from "./dom.mjs";
import {canvas, loop} from "./frames.mjs";
import {csv} from "./measure.mjs";
import {ask, attempt, post} from "./net.mjs";
import {overlay} from "./overlay.mjs";
import {model, regions, view} from "./state.mjs";

function download(blob, name) {
  const link = el("a", {href: URL.createObjectURL(blob), download: name});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}
const file_name = end => model.name.replace(/\.\w+$/, "").replace(/[^\w.-]+/g, "_") + end;
const full_size = () => ({width: size.width, height: size.height});
/// The picture as shown: on its ground, and with what is drawn over it.
async function with_marks() {
  const made = el("canvas", {width: canvas.width, height: canvas.height}), on = made.getContext("2d");
  const ground = on.createLinearGradient(0, 0, 0, made.height), copy = overlay.cloneNode(true), image = new Image();
  const value = name => getComputedStyle(overlay).getPropertyValue(name).trim();
  ["--ground-top", "--ground-bottom"].forEach((name, i) => ground.addColorStop(i, value(name)));
  on.fillStyle = ground;
  on.fillRect(0, 0, made.width, made.height);
  on.drawImage(canvas, 0, 0);
  if (!by("mask").hidden) on.drawImage(by("mask"), 0, 0);
  for (const handle of copy.querySelectorAll(".handle")) handle.remove();
  for (const name of ["--ink", "--accent", "--chosen", "--ground-bottom"]) copy.style.setProperty(name, value(name));
  for (const name of ["width", "height"]) copy.setAttribute(name, made[name]);
  copy.setAttribute("fill", "none");
  image.src = "data:image/svg+xml," + encodeURIComponent(new XMLSerializer().serializeToString(copy));
  await image.decode();
  on.drawImage(image, 0, 0);
  return made;
}
export const save = {
  png: async () => (by("save-marks").checked ? await with_marks() : canvas)
    .toBlob(blob => download(blob, file_name(".png"))),
  csv: () => download(new Blob([csv()], {type: "text/csv"}), file_name("-measurements.csv")),
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
