// Rates: how coarse frames are while something moves, and whether pixels come compressed.

export const DIVISORS = [1, 2, 4, 8];
const SLOW_MS = 55, QUICK_MS = 45, FULL_MS = 25;  // 15 frames/s with the browser's own work; 40 for full size
const REQUEST_MS = 4;                             // of a frame's time, what does not depend on its pixels

/// Notes that a coarse frame of a divisor took so many ms, and chooses the divisor of the next.
/// `pace` is {divisor, wall, wall_of}.
export function adapt(pace, divisor, wall) {
  pace.wall = pace.wall_of === divisor ? 0.6 * pace.wall + 0.4 * wall : wall;
  pace.wall_of = divisor;
  const finer = 4 * (pace.wall - REQUEST_MS) + REQUEST_MS, at = DIVISORS.indexOf(divisor);
  if (pace.wall > (divisor === 1 ? 1.4 * FULL_MS : SLOW_MS)) pace.divisor = DIVISORS[Math.min(at + 1, 3)];
  else if (at > 0 && finer < (at === 1 ? FULL_MS : QUICK_MS)) pace.divisor = DIVISORS[at - 1];
}
const TELLING_BYTES = 65536, TELLING_MS = 20, SLOW_BODY_MS = 60;
const best_of = rates => Math.max(0, ...rates);
/// Notes that a body took so many ms. Pixels come compressed while the link carries less than 100 MB/s, and raw again
/// from 150 MB/s on. The best of the last three bodies tells what the link carries: a busy machine only makes it look
/// slower. A body that takes long tells at once that a link is slow. `link` is {rates, deflate}.
export function note_rate(link, bytes, ms) {
  if (bytes < TELLING_BYTES && !(ms > TELLING_MS && bytes > TELLING_BYTES / 16)) return;
  link.rates = [...link.rates.slice(-2), bytes / 1000 / Math.max(ms, 0.05)];
  const best = best_of(link.rates);
  if (best < 100 && (link.rates.length === 3 || ms > SLOW_BODY_MS)) link.deflate = true;
  if (best > 150) link.deflate = false;
}
/// Compressed bodies are too small to tell that a link is quick: now and then a full picture comes raw, unless the
/// link is known to be slow.
export function encoding_of(link, job, number) {
  const probes = !job.coarse && job.samples === 1 && number % 8 === 0 && best_of(link.rates) > 20;
  return link.deflate && !probes ? "deflate" : "raw";
}
