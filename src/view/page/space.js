// SPDX-License-Identifier: GPL-3.0-or-later
// Particles in space: turned, drawn from the farthest to the nearest, darker behind.
const levels = 32;  // of brightness
const noStep = 256, shades = noStep + 1;  // of a table: what is no number has one of its own

function turnedBy(turn, angleX, angleY) {
  const cx = Math.cos(angleX), sx = Math.sin(angleX), cy = Math.cos(angleY), sy = Math.sin(angleY);
  const step = [cy, 0, sy, sx * sy, cx, -sx * cy, -cx * sy, sx, cx * cy];
  return product(step, turn);
}

function product(a, b) {
  const out = new Array(9).fill(0);
  for (let i = 0; i < 3; ++i)
    for (let j = 0; j < 3; ++j)
      for (let k = 0; k < 3; ++k) out[3 * i + j] += a[3 * i + k] * b[3 * k + j];
  return out;
}

// Order from the farthest to the nearest by counting: depths are put into 1024 drawers.
function order(depth, n, low, high, keep) {
  if (!keep.order || keep.order.length < n) keep.order = new Uint32Array(n);
  const count = keep.count || (keep.count = new Uint32Array(1025)), out = keep.order;
  const scale = high > low ? 1023.99 / (high - low) : 0;
  const drawer = i => Math.max(0, Math.min(1023, (depth[i] - low) * scale | 0));
  count.fill(0);
  for (let i = 0; i < n; ++i) ++count[drawer(i) + 1];
  for (let k = 0; k < 1024; ++k) count[k + 1] += count[k];
  for (let i = 0; i < n; ++i) out[count[drawer(i)]++] = i;
  return out;
}

// A colour at every brightness.
function shadedTable(table) {
  const out = new Uint32Array(levels * shades);
  for (let l = 0; l < levels; ++l) {
    const light = 0.25 + 0.75 * (l + 1) / levels;
    for (let i = 0; i < shades; ++i) {
      const c = i === noStep ? nowhere : table[i];
      out[l * shades + i] = word((c & 255) * light, ((c >> 8) & 255) * light, ((c >> 16) & 255) * light);
    }
  }
  return out;
}

const bodyShaded = shadedTable(bodyTable);

// Pixels of a sphere about its middle, and how bright the normal makes each.
function sphereMask(radius, width) {
  const rows = Math.max(0, Math.min(4000, Math.round(radius - 0.25))), right = [], down = [], light = [];
  for (let r = -rows; r <= rows; ++r)
    for (let s = -rows; s <= rows; ++s) {
      const q = (r * r + s * s) / Math.max(radius * radius, 0.25);
      if (q > 1.05) continue;
      right.push(s);
      down.push(r);
      light.push(0.45 + 0.55 * Math.sqrt(Math.max(0, 1 - q)) - 0.12 * (r + s) / (2 * rows + 1));
    }
  return {rows, right, down, light: Float32Array.from(light), offset: Int32Array.from(right, (s, k) => down[k] * width + s)};
}

// Spheres from the farthest to the nearest; brightness follows the normal and the depth. steps: colours as numbers
// from 0 to 255.
function spheres(raster, x, y, depth, n, radius, steps, shaded, low, high, keep) {
  const {pixels, width, left, top, right, bottom} = raster, mask = sphereMask(radius, width);
  const {rows, light, offset} = mask, count = light.length, last = levels - 1;
  const scale = high > low ? 0.4 / (high - low) : 0, drawn = order(depth, n, low, high, keep);
  for (let k = 0; k < n; ++k) {
    const i = drawn[k], px = Math.floor(x[i]), py = Math.floor(y[i]);
    if (px + rows < left || px - rows >= right || py + rows < top || py - rows >= bottom) continue;
    const near = (0.65 + (depth[i] - low) * scale) * levels, step = steps[i], at = py * width + px;
    const inside = px - rows >= left && px + rows < right && py - rows >= top && py + rows < bottom;
    for (let m = 0; m < count; ++m) {
      if (!inside && !raster.holds(px + mask.right[m], py + mask.down[m])) continue;
      const level = near * light[m] | 0;
      pixels[at + offset[m]] = shaded[(level > last ? last : level) * shades + step];
    }
  }
}
