// SPDX-License-Identifier: GPL-3.0-or-later
// Maps from numbers to colours: 256 steps between given colours.
const maps = {
  viridis: ['440154', '482878', '3e4a89', '31688e', '26828e', '1f9e89', '35b779', '6ece58', 'b5de2b', 'fde725'],
  inferno: ['160b39', '420a68', '6a176e', '932667', 'bc3754', 'dd513a', 'f37819', 'fca50a', 'f6d746', 'fcffa4'],
  'blue to red': ['1f4fa8', '4a86d8', '8fb8ea', 'c9dbee', 'e6e3df', 'f0c8b4', 'e8967a', 'd2543f', 'a3172b'],
  grey: ['2b2b2b', 'f2f2f2'],
};
const caseColours = ['#3b7dd8', '#e07b39', '#2fa37c', '#b04fc4', '#c9a227', '#d64550', '#5b6fd6', '#6f8f2f'];
const bodyColours = ['3b7dd8', 'e07b39', '2fa37c', 'b04fc4', 'c9a227', 'd64550', '50b7c9', '8a6d5a'];
const nowhere = 0xff999999;  // colour of what is no number

function parts(hex) { return [0, 2, 4].map(at => parseInt(hex.slice(at, at + 2), 16)); }

// Words of 32 bits as an ImageData holds them: red in the lowest byte.
function word(r, g, b) { return (0xff000000 | (b << 16) | (g << 8) | r) >>> 0; }

function tableOf(map) {
  const steps = maps[map].map(parts), out = new Uint32Array(256);
  for (let i = 0; i < 256; ++i) {
    const at = i / 255 * (steps.length - 1), k = Math.min(Math.floor(at), steps.length - 2), s = at - k;
    const mix = c => Math.round(steps[k][c] + s * (steps[k + 1][c] - steps[k][c]));
    out[i] = word(mix(0), mix(1), mix(2));
  }
  return out;
}

const bodyTable = Uint32Array.from({length: 256}, (_, i) => word(...parts(bodyColours[i % bodyColours.length])));

function css(w) { return `rgb(${w & 255},${(w >> 8) & 255},${(w >> 16) & 255})`; }

// A colour for each of n values; `out` is used again where it is long enough.
function coloursOf(values, n, low, high, table, out) {
  const scale = high > low ? 255.999 / (high - low) : 0, middle = high > low ? 0 : 128;
  for (let i = 0; i < n; ++i) {
    const at = (values[i] - low) * scale + middle;
    out[i] = at >= 0 ? table[at > 255 ? 255 : at | 0] : at < 0 ? table[0] : nowhere;
  }
  return out;
}

// Short, and exact enough to be typed again.
function shortNumber(value) {
  if (!Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) return value.toExponential(2).replace(/\.?0+e/, 'e');
  return String(Number(value.toPrecision(4)));
}
