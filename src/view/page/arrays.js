// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of the page: base64 in elements of their own, decoded when they are first asked for.
const page = JSON.parse(document.getElementById('description').textContent);
const decoded = new Map();

function bytesOf(block) {
  const text = document.getElementById('b' + block).textContent;
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const raw = atob(text), bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return bytes;
}

function opened(packed, about) {
  const whole = about.type === 'u2' ? new Uint16Array(packed.buffer) : packed;
  const nothing = about.type === 'u2' ? 0xffff : 0xff;
  const out = new Float32Array(whole.length);
  for (let c = 0; c < about.c; ++c) {
    const low = about.low[c], step = about.step[c];
    for (let i = c * about.n, end = i + about.n; i < end; ++i)
      out[i] = whole[i] === nothing ? NaN : low + step * whole[i];
  }
  return out;
}

// Component after component; null where there is no such array.
function numbers(ref) {
  if (ref === undefined || ref === null) return null;
  if (decoded.has(ref)) return decoded.get(ref);
  const about = page.arrays[ref];
  let out;
  if (about.type === 'c') out = new Float32Array(about.c * about.n).fill(about.low);
  else {
    const bytes = bytesOf(about.b);
    out = about.type === 'f8' ? new Float64Array(bytes.buffer)
        : about.type === 'f4' ? new Float32Array(bytes.buffer)
        : about.type === 'u4' ? new Uint32Array(bytes.buffer) : opened(bytes, about);
  }
  decoded.set(ref, out);
  return out;
}

const dims = page.dimensions;
const byName = new Intl.Collator('en', {numeric: true});
const cases = page.cases.sort((a, b) => byName.compare(a.name, b.name)).map((one, number) => ({
  ...one, number, label: one.name.replace(/_/g, ' '), times: one.snapshots.map(s => s.t),
}));
const firstTime = Math.min(...cases.map(c => c.times[0]));
const lastTime = Math.max(...cases.map(c => c.times[c.times.length - 1]));
// Radius of a disc: half the spacing of the particles where they are written, else of a square lattice.
for (const c of cases) {
  const s = c.snapshots[0], spacing = numbers(s.points.particle_spacing);
  c.radius = spacing && spacing[0] > 0 ? spacing[0] / 2 : 0.5;
}
