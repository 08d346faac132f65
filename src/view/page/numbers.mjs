// Numbers, points and boxes: nothing here knows the page.

export const clamp = (v, low, high) => Math.min(high, Math.max(low, v));
export const radians = degrees => degrees * Math.PI / 180;
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const minus = (a, b) => a.map((v, i) => v - b[i]);
export const along = (p, d, t) => p.map((v, i) => v + t * d[i]);
export const cross = (a, b) =>
  [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const unit = v => v.map(x => x / Math.hypot(...v));
export const number = (v, digits = 7) => v == null ? "open" : String(+v.toPrecision(digits));
export const numbers = (v, digits = 7) => v.map(x => number(x, digits)).join("  ");
export const css = rgb => `rgb(${rgb.map(v => Math.round(255 * v)).join(" ")})`;
export const hex = rgb => "#" + rgb.map(v => Math.round(255 * v).toString(16).padStart(2, "0")).join("");
/// Black or white: what is read better on a colour.
export function ink_on(rgb) {
  const [r, g, b] = rgb.map(v => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b > 0.179 ? "#000" : "#fff";
}
export const from_hex = text => [1, 3, 5].map(i => parseInt(text.slice(i, i + 2), 16) / 255);

export const corners = ({low, high}) =>
  [0, 1, 2, 3, 4, 5, 6, 7].map(i => [0, 1, 2].map(k => (i >> k & 1 ? high : low)[k]));
export const middle_of = ({low, high}) => low.map((v, i) => (v + high[i]) / 2);
