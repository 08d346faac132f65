// Marks of the picture at rest: the selected parts with their outline, and the hatch of faces that planes cut.
import {size} from "./camera.mjs";
import {by, resize} from "./dom.mjs";
import {inflated, loop, read_frame} from "./frames.mjs";
import {listed_ranges} from "./looks.mjs";
import {attempt, page_id, post} from "./net.mjs";
import {from_hex} from "./numbers.mjs";
import {draw_overlay} from "./overlay.mjs";
import {model, range, regions, selection, view} from "./state.mjs";

/// `seen`: the pixels of selected parts. Parts of which none is seen have their boxes.
export const marked = {number: 0, seen: 0};
/// Takes the marks away, and asks for those of the picture that is shown, if it is at rest.
export async function ask_marks() {
  const number = ++marked.number, {width, height} = size;
  marked.seen = 0;
  by("mask").hidden = true;
  draw_overlay();
  if (loop.moving || loop.shown.divisor !== 1 || !selection.length && !(view.hatch && view.clip.length)) return;
  const asked = {page: page_id + "marks", number, width, height, samples: 1, encoding: loop.deflate ? "deflate" : "raw",
                 view: {...view, show: "marks"}, selected: listed_ranges(regions, selection.map(range))};
  const made = await attempt("marks", async () => read_frame(await post("frame", asked)));
  if (!made?.head.width || made.head.generation !== model.generation) return;
  const bytes = made.head.encoding === "deflate" ? await inflated(made.pixels) : made.pixels;
  if (number === marked.number) draw_marks(bytes, width, height);
}
/// Red of a pixel is how much it shows of selected parts; green is the hatch.
function draw_marks(bytes, width, height) {
  const image = new ImageData(width, height), {data} = image;
  const chosen = from_hex(getComputedStyle(by("picture")).getPropertyValue("--chosen").trim()).map(v => 255 * v);
  for (let i = 0; i < data.length; i += 4) {
    if (bytes[i]) {
      data.set(chosen, i);
      data[i + 3] = bytes[i];
      marked.seen++;
    }
    if (bytes[i + 1] && view.hatch && bytes[i] < 255) data.set([0, 0, 0, 150], i);
  }
  resize(by("mask"), width, height);
  by("mask").getContext("2d").putImageData(image, 0, 0);
  by("mask").hidden = false;
  draw_overlay();
}
