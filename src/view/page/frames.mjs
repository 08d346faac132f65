// Frames: what is asked for next, the request that is under way, and the pixels that it brings.
import {remember} from "./acts.mjs";
import {keep_address} from "./address.mjs";
import {ask_hover} from "./ask.mjs";
import {size} from "./camera.mjs";
import {draw_display} from "./display.mjs";
import {by, resize, say} from "./dom.mjs";
import {draw_legend} from "./legend.mjs";
import {load_model} from "./main.mjs";
import {ask_marks} from "./marks.mjs";
import {wheel} from "./mouse.mjs";
import {decompressed, page_id, post, report} from "./net.mjs";
import {adapt, encoding_of, note_rate} from "./rates.mjs";
import {ended, model, view} from "./state.mjs";

export const MOST_SIDE = 8192;
const REST_MS = 60, BUSY_MS = 300;
/// `asking` counts questions about parts, whose answers may change the view.
export const loop = {revision: 0, job: null, number: 0, failed: -1, moving: false, rest: 0, divisor: 4, wall: 0,
                     wall_of: 0, deflate: false, rates: [], inputs: [], last_input: 0, waiting: [], asking: 0,
                     shown: {revision: -1, divisor: 0, samples: 0, camera: null}};
/// The hook is what tests look at. `latencies`: from an input to its pixels, ms; `fulls`: from the last input to the
/// full picture; `answers`: from a click to its answer; `samples`: the most rays a pixel.
export const hook = window.csgrt = {
  get view() { return view; },
  get model() { return model; },
  get size() { return size; },
  frames: 0, first: null, lastFrame: null, latencies: [], fulls: [], answers: [], samples: 64,
  /// Resolves when the present view is shown in full, with so many samples a pixel, or all that there will be.
  idle: (samples = 1) => new Promise(done => {
    loop.waiting.push({samples, done});
    wake();
    pump();
  }),
};
export function keep(list, value) {
  list.push(value);
  list.splice(0, list.length - 200);
}
/// Work that runs when the browser has painted what was drawn till now.
export const when_painted = run => requestAnimationFrame(() => setTimeout(run));
/// Pictures of colours alone have more than one ray a pixel.
const samples_wanted = () => view.show === "color" ? hook.samples : 1;
const is_current = () => loop.shown.revision === loop.revision && loop.shown.full_width === size.width &&
  loop.shown.full_height === size.height;
/// The picture to ask for next: coarse while moving, then full, then with more samples; null if there is none.
function next_picture() {
  if (loop.failed === loop.revision) return null;
  if (loop.moving || loop.shown.revision < 0)
    return is_current() ? null : {divisor: loop.divisor, samples: 1, coarse: true};
  if (!is_current() || loop.shown.divisor > 1) return {divisor: 1, samples: 1};
  return loop.shown.samples < samples_wanted() ? {divisor: 1, samples: loop.shown.samples * 4} : null;
}
/// Keeps one request under way. The next request is sent when the last is shown, and has the newest view.
export async function pump() {
  const job = model && !loop.job && !ended && !document.hidden && next_picture();
  if (!job) return;
  loop.job = Object.assign(job, {
    revision: loop.revision, abort: new AbortController(), camera: view.camera, inputs: loop.inputs.splice(0),
    full_width: size.width, full_height: size.height, sent: performance.now()});
  const busy = job.samples === 1 && setTimeout(() => { by("busy").hidden = false; }, BUSY_MS);
  await draw(job).then(() => say("frame", ""), error => {
    loop.inputs.unshift(...job.inputs);
    if (error.name !== "AbortError") loop.failed = job.revision;
    report("frame", error);
  });
  clearTimeout(busy);
  by("busy").hidden = true;
  loop.job = null;
  wake();
  pump();
}
async function draw(job) {
  // A coarse frame is scaled by its height. Its width is such that the picture is covered then.
  const height = Math.ceil(job.full_height / job.divisor);
  const width = job.divisor === 1 ? job.full_width : Math.ceil(job.full_width * height / job.full_height);
  const response = await post("frame", {page: page_id, number: ++loop.number, width, height, samples: job.samples,
                                        view: {...view, edges: view.edges && job.divisor === 1},
                                        encoding: encoding_of(loop, job, loop.number)}, job.abort.signal);
  const {head, pixels} = await read_frame(response);
  if (head.error) throw new Error(head.error);
  if (head.cancelled) return void loop.inputs.unshift(...job.inputs);
  show_frame(job, head, head.encoding === "deflate" ? await inflated(pixels) : pixels);
  if (head.generation !== model.generation) load_model();
}
/// The body has the length of a JSON text, the text, and the pixels. Its first part comes when the picture is drawn:
/// from then on the link is timed.
export async function read_frame(response) {
  const reader = response.body.getReader(), parts = [];
  let total = 0, begun = 0;
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    begun ||= performance.now();
    parts.push(part.value);
    total += part.value.length;
  }
  if (!total) return {head: {cancelled: true}};
  note_rate(loop, total - parts[0].length, performance.now() - begun);
  const bytes = new Uint8Array(total);
  for (let part = 0, at = 0; part < parts.length; at += parts[part++].length) bytes.set(parts[part], at);
  const start = 4 + new DataView(bytes.buffer).getUint32(0, true);
  return {head: JSON.parse(new TextDecoder().decode(bytes.subarray(4, start))), pixels: bytes.subarray(start)};
}
/// Pixels from zlib's format, four bytes at a time. Each byte has the byte four before it subtracted.
export async function inflated(bytes) {
  const words = new Uint32Array(await decompressed(new Blob([bytes]).stream()).arrayBuffer());
  for (let i = 1, a = words[0]; i < words.length; i++) {
    const b = words[i];
    words[i] = a = ((a & 0x7f7f7f7f) + (b & 0x7f7f7f7f)) ^ ((a ^ b) & 0x80808080);
  }
  return new Uint8Array(words.buffer);
}
export const canvas = by("canvas");
const paint = canvas.getContext("2d"), coarse = document.createElement("canvas");
function show_frame(job, head, {buffer, byteOffset, length}) {
  const image = new ImageData(new Uint8ClampedArray(buffer, byteOffset, length), head.width, head.height);
  resize(canvas, job.full_width, job.full_height);
  if (job.divisor === 1) {
    paint.putImageData(image, 0, 0);
  } else {
    resize(coarse, head.width, head.height);
    coarse.getContext("2d").putImageData(image, 0, 0);
    paint.globalCompositeOperation = "copy";
    const width = head.width * canvas.height / head.height;
    paint.drawImage(coarse, (canvas.width - width) / 2, 0, width, canvas.height);
  }
  const {revision, divisor, samples, camera, full_width, full_height} = job;
  const now = performance.now(), wall = now - job.sent;
  loop.shown = {revision, divisor, samples, camera, full_width, full_height};
  if (job.coarse) adapt(loop, divisor, wall);
  hook.frames++;
  hook.lastFrame = {number: head.number, width: head.width, height: head.height, samples, draw_ms: head.draw_ms,
                    wall_ms: wall, encoding: head.encoding, shown_at: now};
  by("device").textContent = head.device;
  by("time").textContent = `${head.draw_ms.toFixed(1)} ms drawn, ${wall.toFixed(0)} ms in all`;
  by("samples").textContent = `${samples} ${samples === 1 ? "sample" : "samples"}`;
  by("pixels").textContent = `${head.width} x ${head.height}`;
  ask_marks();
  draw_legend(head.range);
  const is_rest = divisor === 1 && !loop.moving && samples === 1, last_input = loop.last_input;
  when_painted(() => {
    const seen = performance.now();
    hook.first ??= seen;
    for (const time of job.inputs) keep(hook.latencies, seen - time);
    if (is_rest && last_input) keep(hook.fulls, seen - last_input);
  });
  if (is_rest) ask_hover();
}
export function wake() {
  if (!view || loop.moving || loop.asking || !is_current() || loop.shown.divisor > 1) return;
  loop.waiting = loop.waiting.filter(({samples, done}) =>
    loop.shown.samples < Math.min(samples, samples_wanted()) || done());
}
/// Draws the view, which has changed: coarse if it goes on moving.
export function changed(event = null, moving = false) {
  loop.revision++;
  loop.last_input = event?.timeStamp ?? performance.now();
  if (event) loop.inputs.push(event.timeStamp);
  if (moving) {
    loop.moving = true;
    clearTimeout(loop.rest);
    loop.rest = setTimeout(rest, REST_MS);
  }
  if (loop.job && !loop.job.coarse) loop.job.abort.abort();
  by("perspective").ariaPressed = String(view.camera.perspective > 0);
  by("show").value = view.show;
  draw_display();
  remember(moving);
  keep_address();
  pump();
}
export function set_camera(members, event) {
  wheel.place = null;
  view.camera = {...view.camera, ...members};
  changed(event);
  }
export function rest() {
  clearTimeout(loop.rest);
  loop.moving = false;
  wake();
  pump();
}
