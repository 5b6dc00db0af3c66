// SPDX-License-Identifier: GPL-3.0-or-later
// What particles and elements can be coloured by: written fields, and what follows from them.
const axes = ['x', 'y', 'z'];
const fieldTable = new Map();  // name -> {label, from, make(array, n, out), signed}

function component(c) {
  return (a, n, out) => { for (let i = 0; i < n; ++i) out[i] = a[c * n + i]; };
}

// Places of sigma_ab in the upper triangle.
function triangle(a, b) { return a * dims - a * (a - 1) / 2 + b - a; }

function pressureOf(s, n, out) {
  out.fill(0);
  for (let a = 0; a < dims; ++a) {
    const at = triangle(a, a) * n;
    for (let i = 0; i < n; ++i) out[i] -= s[at + i] / dims;
  }
}

// The square root of half the square of the deviator; in the plane it is the largest shear stress.
function shearOf(s, n, out) {
  const mean = new Float32Array(n);
  pressureOf(s, n, mean);
  out.fill(0);
  for (let a = 0; a < dims; ++a)
    for (let b = a; b < dims; ++b) {
      const at = triangle(a, b) * n;
      for (let i = 0; i < n; ++i) {
        const d = s[at + i] + (a === b ? mean[i] : 0);
        out[i] += (a === b ? 0.5 : 1) * d * d;
      }
    }
  for (let i = 0; i < n; ++i) out[i] = Math.sqrt(out[i]);
}

function speedOf(v, n, out) {
  out.fill(0);
  for (let c = 0; c < dims; ++c) for (let i = 0; i < n; ++i) out[i] += v[c * n + i] ** 2;
  for (let i = 0; i < n; ++i) out[i] = Math.sqrt(out[i]);
}

function addField(name, label, from, make, signed) {
  if (!fieldTable.has(name)) fieldTable.set(name, {name, label, from, make, signed});
}

function addFieldsOf(name, components) {
  const words = name.replace(/_/g, ' ');
  if (name === 'position') return;
  if (name === 'velocity') {
    addField('speed', 'speed', name, speedOf, false);
    for (let c = 0; c < dims; ++c) addField('v' + axes[c], 'velocity ' + axes[c], name, component(c), true);
  } else if (components === 1) addField(name, words, name, component(0), false);
  else if (name === 'stress') {
    addField('pressure', 'pressure (mean of −σ)', name, pressureOf, true);
    if (dims > 1) addField('shear', 'shear stress', name, shearOf, false);
    for (let a = 0; a < dims; ++a)
      for (let b = a; b < dims; ++b)
        addField('s' + axes[a] + axes[b], 'stress σ' + axes[a] + axes[b], name, component(triangle(a, b)), true);
  } else
    for (let c = 0; c < components; ++c) addField(name + c, words + ' ' + c, name, component(c), true);
}

for (const c of cases)
  for (const s of c.snapshots)
    for (const holder of ['points', 'cells'])
      for (const [name, ref] of Object.entries(s[holder] || {}))
        if (page.arrays[ref].type !== 'c' || name === 'stress' || name === 'velocity')
          addFieldsOf(name, page.arrays[ref].c);

const madeFields = new Map();

// A field of a snapshot; null where it has not what the field is made of. `holder`: points or cells.
function fieldOf(c, k, name, holder) {
  const key = c.number + ' ' + k + ' ' + name + ' ' + holder;
  if (madeFields.has(key)) return madeFields.get(key);
  const field = fieldTable.get(name), s = c.snapshots[k];
  const source = field && s[holder] ? numbers(s[holder][field.from]) : null;
  let out = null;
  if (source) {
    const n = holder === 'points' ? s.n : numbers(s.corners).length / 4;
    out = new Float32Array(n);
    field.make(source, n, out);
  }
  if (!out && holder === 'cells' && s.corners !== undefined) out = meanOfCorners(c, k, name);
  madeFields.set(key, out);
  return out;
}

function meanOfCorners(c, k, name) {
  const values = fieldOf(c, k, name, 'points'), corners = numbers(c.snapshots[k].corners);
  if (!values) return null;
  const out = new Float32Array(corners.length / 4);
  for (let e = 0; e < corners.length; ++e) out[e >> 2] += values[corners[e]] / 4;
  return out;
}

// Of all cases and times, from so many values at most: numbers below which a part of them lies.
const sortedFields = new Map();
function percentiles(name, parts) {
  if (!sortedFields.has(name)) {
    let count = 0;
    for (const c of cases) for (const s of c.snapshots) count += s.n;
    const every = Math.max(1, Math.floor(count / 300000)), sample = [];
    let at = 0;
    for (const c of cases)
      for (let k = 0; k < c.snapshots.length; ++k) {
        const values = fieldOf(c, k, name, c.snapshots[k].cells ? 'cells' : 'points');
        if (!values) continue;
        for (; at < values.length; at += every) if (Number.isFinite(values[at])) sample.push(values[at]);
        at -= values.length;
      }
    sortedFields.set(name, Float32Array.from(sample).sort());
  }
  const sorted = sortedFields.get(name);
  if (!sorted.length) return parts.map(() => 0);
  return parts.map(p => sorted[Math.round(p * (sorted.length - 1))]);
}

function firstField() {
  const solid = fieldTable.has('pressure');
  for (const name of solid ? ['speed'] : ['density', 'speed', 'energy']) if (fieldTable.has(name)) return name;
  return fieldTable.keys().next().value || '';
}
