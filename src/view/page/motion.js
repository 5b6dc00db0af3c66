// SPDX-License-Identifier: GPL-3.0-or-later
// Where particles are between two snapshots: a cubic through both positions, whose slopes are the velocities
// where these lead from one to the other, else differences of positions.
const far = 0.1;  // disagreement beyond which velocities are not believed

// Last snapshot at or before t, and the part of the way to the next.
function placeInTime(c, t) {
  const times = c.times;
  let low = 0, high = times.length - 1;
  if (t <= times[0]) return {k: 0, s: 0};
  if (t >= times[high]) return {k: high, s: 0};
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle; else high = middle;
  }
  return {k: low, s: (t - times[low]) / (times[high] - times[low])};
}

// For every particle of snapshot k its place in snapshot `next`, -1 where it has none; null where all keep
// theirs. Ids ascend in both.
function matches(c, k, next) {
  const a = c.snapshots[k], b = c.snapshots[next];
  if (a.id === b.id) return null;
  const from = numbers(a.id), to = numbers(b.id), match = new Int32Array(from.length).fill(-1);
  for (let i = 0, j = 0; i < from.length; ++i) {
    while (j < to.length && to[j] < from[i]) ++j;
    if (j < to.length && to[j] === from[i]) match[i] = j;
  }
  return match;
}

// What of x1 - x0 is nearest to `expected` among the images of a periodic axis.
function nearestImage(d, expected, length) {
  return length > 0 ? d - length * Math.round((d - expected) / length) : d;
}

function lengthOf(s, axis) { return s.periodic[axis] ? s.high[axis] - s.low[axis] : 0; }

// x(s) = x0 + h10 m0 + h01 d + h11 m1, an array of dims * n each.
function makeInterval(c, k) {
  const a = c.snapshots[k], b = c.snapshots[k + 1], n = a.n, dt = b.t - a.t;
  const x0 = numbers(a.points.position), x1 = numbers(b.points.position);
  const v0 = numbers(a.points.velocity), v1 = numbers(b.points.velocity);
  const match = matches(c, k, k + 1);
  const d = new Float32Array(dims * n), m0 = new Float32Array(dims * n), m1 = new Float32Array(dims * n);
  let wrong = 0, all = 0;
  for (let axis = 0; axis < dims; ++axis) {
    const length = lengthOf(a, axis), at = axis * n, to = axis * b.n;
    for (let i = 0; i < n; ++i) {
      const j = match ? match[i] : i;
      m0[at + i] = dt * v0[at + i];
      if (j < 0) {  // split, merged or removed on the way: straight on until others take its place
        d[at + i] = m1[at + i] = m0[at + i];
        continue;
      }
      m1[at + i] = dt * v1[to + j];
      const expected = (m0[at + i] + m1[at + i]) / 2;
      d[at + i] = nearestImage(x1[to + j] - x0[at + i], expected, length);
      wrong += (d[at + i] - expected) ** 2;
      all += (m0[at + i] ** 2 + m1[at + i] ** 2) / 2;
    }
  }
  const hermite = wrong <= far * far * all;
  if (!hermite) slopesFromPositions(c, k, match, x0, x1, d, m0, m1);
  return {k, hermite, match, x0, d, m0, m1};
}

// Slopes of the parabola through three snapshots, or the way itself where one is missing or particles change.
function slopesFromPositions(c, k, match, x0, x1, d, m0, m1) {
  const at = c.snapshots, n = at[k].n, dt = at[k + 1].t - at[k].t;
  for (let axis = 0; axis < dims; ++axis) {
    const length = lengthOf(at[k], axis);
    for (let i = axis * n; i < (axis + 1) * n; ++i) {
      if (match && match[i - axis * n] < 0) d[i] = 0;  // nothing says where to: it stays until it vanishes
      if (!match) d[i] = nearestImage(x1[i] - x0[i], 0, length);
      m0[i] = m1[i] = d[i];
    }
    if (match) continue;
    const slope = (other, from, to, m) => {
      if (!at[other] || at[other].id !== at[k].id) return;
      const x = numbers(at[other].points.position), sign = other < k ? 1 : -1;
      const near = Math.abs(at[other].t - (sign > 0 ? at[k].t : at[k + 1].t));
      for (let i = axis * n; i < (axis + 1) * n; ++i) {
        const e = nearestImage(sign * (from[i] - x[i]), 0, length);
        m[i] = (e * dt * dt + d[i] * near * near) / (near * (near + dt));
      }
    };
    slope(k - 1, x0, x1, m0);
    slope(k + 2, x1, x0, m1);
  }
}

// A frame of a case: n, position (dims * n), place in time, and how it came about. Buffers are used again.
function frameOf(c, t, between) {
  let {k, s} = placeInTime(c, t);
  if (!between && s > 0.5) ++k;
  if (!between) s = 0;
  const snapshot = c.snapshots[k], n = snapshot.n;
  if (s === 0) return {k, s, n, x: numbers(snapshot.points.position), how: 'computed', match: null};
  if (!c.interval || c.interval.k !== k) c.interval = makeInterval(c, k);
  const {x0, d, m0, m1, hermite, match} = c.interval, total = dims * n;
  if (!c.buffer || c.buffer.length < total) c.buffer = new Float32Array(total);
  const x = c.buffer, s2 = s * s, s3 = s2 * s;
  const h10 = s3 - 2 * s2 + s, h01 = 3 * s2 - 2 * s3, h11 = s3 - s2;
  for (let i = 0; i < total; ++i) x[i] = x0[i] + h10 * m0[i] + h01 * d[i] + h11 * m1[i];
  for (let axis = 0; axis < dims; ++axis) {
    const length = lengthOf(snapshot, axis), low = snapshot.low[axis], high = snapshot.high[axis];
    if (!(length > 0)) continue;
    for (let i = axis * n; i < (axis + 1) * n; ++i)
      x[i] = x[i] < low ? x[i] + length : x[i] >= high ? x[i] - length : x[i];
  }
  return {k, s, n, x, how: hermite ? 'velocities' : 'positions', match};
}

// A field in a frame, linear in time; null where there is none.
function valuesOf(c, frame, name, holder) {
  const a = fieldOf(c, frame.k, name, holder);
  if (!a || frame.s === 0) return a;
  const next = c.snapshots[frame.k + 1];
  if (holder === 'cells' && next.corners !== c.snapshots[frame.k].corners) return a;
  const b = fieldOf(c, frame.k + 1, name, holder);
  if (!b) return a;
  const key = holder === 'cells' ? 'cellValues' : 'values', match = holder === 'cells' ? null : frame.match;
  if (!c[key] || c[key].length !== a.length) c[key] = new Float32Array(a.length);
  const out = c[key], s = frame.s;
  if (match) for (let i = 0; i < a.length; ++i) out[i] = match[i] < 0 ? a[i] : a[i] + s * (b[match[i]] - a[i]);
  else for (let i = 0; i < a.length; ++i) out[i] = a[i] + s * (b[i] - a[i]);
  return out;
}
