// The server: its requests, and the sentences when they fail.
import {say} from "./dom.mjs";
import {ended} from "./state.mjs";

export const page_id = [...crypto.getRandomValues(new Uint8Array(12))]
  .map(b => b.toString(16).padStart(2, "0")).join("");
/// The response. Throws the server's sentence, or that there is no server.
export async function post(name, body, signal) {
  if (ended) throw new DOMException("csgrt has ended.", "AbortError");
  const request = {method: "POST", signal, headers: {"Content-Type": "application/json"}, body: JSON.stringify(body)};
  const response = await fetch("api/" + name, request).catch(error => {
    if (error.name === "AbortError") throw error;
    say("server", "csgrt does not answer: it may have ended, or the network may be down. The page shows what was " +
        "drawn last. A csgrt view that is started again prints a new address.");
    throw Object.assign(new Error("csgrt does not answer."), {gone: true});
  });
  if (response.ok) return response;
  const said = await response.json().catch(() => ({}));  // another program may stand in between
  throw new Error(said.error ?? `csgrt answered ${name} with status ${response.status}.`);
}
export const ask = async (name, body) => (await post(name, body)).json();
/// The response whose body is what a body in zlib's format holds.
export const decompressed = stream => new Response(stream.pipeThrough(new DecompressionStream("deflate")));
/// The model. Its table of parts comes compressed.
export const ask_model = async () => decompressed((await post("model", {encoding: "deflate"})).body).json();
/// Says in the bar what failed, but not what was cancelled. The bar says already that the server is gone.
export function report(key, error) {
  if (error.name !== "AbortError" && !error.gone) say(key, error.message);
}
/// What the work gives, or null if it failed.
export async function attempt(key, work) {
  try {
    const made = await work();
    say(key, "");
    return made;
  } catch (error) {
    report(key, error);
    return null;
  }
}
