// SPDX-License-Identifier: GPL-3.0-or-later
// What is drawn over the particles with lines and letters: box, label, principal stresses, path, the chosen one.
const themes = {
  light: {ground: word(0xfb, 0xfb, 0xfa), text: '#1d2126', soft: '#c9ccd1', plate: 'rgba(251,251,250,.82)', mark: '#111'},
  dark: {ground: word(0x15, 0x18, 0x1d), text: '#e8eaed', soft: '#3b414a', plate: 'rgba(21,24,29,.8)', mark: '#fff'},
};

function drawOver(panels, p, theme) {
  const g = panels.context;
  g.save();
  g.beginPath();
  g.rect(p.left, p.top, p.right - p.left, p.bottom - p.top);
  g.clip();
  drawEdges(panels, p, g, theme);
  if (state.box) drawBox(panels, p, g, theme);
  if (state.crosses && dims === 2) drawCrosses(panels, p, g);
  if (state.pick !== null) drawPick(panels, p, g, theme);
  drawLabel(panels, p, g, theme);
  g.restore();
  g.strokeStyle = theme.soft;
  g.lineWidth = 1;
  if (p.left > 0) line(g, [[p.left + 0.5, p.top], [p.left + 0.5, p.bottom]]);
  if (p.top > 0) line(g, [[p.left, p.top + 0.5], [p.right, p.top + 0.5]]);
}

function line(g, points) {
  g.beginPath();
  points.forEach(([x, y], k) => k ? g.lineTo(x, y) : g.moveTo(x, y));
  g.stroke();
}

function drawBox(panels, p, g, theme) {
  const s = p.c.snapshots[p.frame.k];
  if (dims === 1 || !s.periodic.some(Boolean)) return;
  const end = (bit, a) => bit ? s.high[a] : s.low[a];
  g.strokeStyle = theme.text;
  g.lineWidth = panels.ratio;
  g.setLineDash([5 * panels.ratio, 4 * panels.ratio]);
  const corner = k => panels.project(p, [0, 1, 2].map(a => end(k >> a & 1, a)));
  for (let k = 0; k < 1 << dims; ++k)
    for (let a = 0; a < dims; ++a)
      if (!(k >> a & 1)) line(g, [corner(k), corner(k | 1 << a)]);
  g.setLineDash([]);
}

// Of elements, where they are large enough.
function drawEdges(panels, p, g, theme) {
  if (p.c.snapshots[p.frame.k].corners === undefined || panels.discRadius(p) < 3 * panels.ratio) return;
  const {corners} = wholeElements(p.c, p.frame.k);
  g.strokeStyle = theme.plate;
  g.lineWidth = panels.ratio;
  g.beginPath();
  for (let k = 0; k < corners.length; k += 4)
    for (let a = 0; a <= 4; ++a) {
      const i = corners[k + a % 4];
      if (a) g.lineTo(p.x[i], p.y[i]); else g.moveTo(p.x[i], p.y[i]);
    }
  g.stroke();
}

function drawLabel(panels, p, g, theme) {
  if (cases.length < 2) return;
  const r = panels.ratio, x = p.left + 9 * r, y = p.top + 8 * r;
  g.font = `600 ${12.5 * r}px system-ui, sans-serif`;
  g.textBaseline = 'middle';
  const room = p.right - x - 26 * r, width = Math.min(room, g.measureText(p.c.label).width);
  g.fillStyle = theme.plate;
  g.fillRect(x - 4 * r, y - 3 * r, width + 24 * r, 19 * r);
  g.fillStyle = caseColours[p.c.number % caseColours.length];
  g.fillRect(x, y + 3.5 * r, 11 * r, 6 * r);
  g.fillStyle = theme.text;
  g.fillText(p.c.label, x + 17 * r, y + 7 * r, room);  // narrower letters, not fewer of them: two names may begin alike
}

// Principal stresses as crosses: tension red, compression blue; the 95th percentile of a panel is as long as a
// spacing.
function drawCrosses(panels, p, g) {
  const {c, frame} = p, s = c.snapshots[frame.k], ref = s.points.stress;
  if (ref === undefined || panels.discRadius(p) < 2) return;
  const n = frame.n, [xx, xy, yy] = ['sxx', 'sxy', 'syy'].map(name => fieldOf(c, frame.k, name, 'points'));
  const sizes = new Float32Array(n), arms = new Float32Array(3 * n);
  for (let i = 0; i < n; ++i) {
    const mean = (xx[i] + yy[i]) / 2, half = (xx[i] - yy[i]) / 2, r = Math.hypot(half, xy[i]);
    arms.set([mean + r, mean - r, 0.5 * Math.atan2(xy[i], half)], 3 * i);
    sizes[i] = Math.abs(mean) + r;
  }
  const top = Float32Array.from(sizes).sort()[Math.floor(0.95 * (n - 1))];
  if (!(top > 0)) return;
  const long = p.c.radius * panels.scale() / top;
  g.lineWidth = Math.max(1, 0.12 * p.c.radius * panels.scale());
  for (const [colour, sign] of [['#d62728', 1], ['#2b6fd6', -1]]) {
    g.strokeStyle = colour;
    g.beginPath();
    for (let i = 0; i < n; ++i)
      for (let k = 0; k < 2; ++k) {
        const value = arms[3 * i + k], angle = arms[3 * i + 2] + k * Math.PI / 2;
        if (value * sign <= 0) continue;
        const half = Math.min(Math.abs(value), 2 * top) * long, dx = Math.cos(angle) * half, dy = -Math.sin(angle) * half;
        g.moveTo(p.x[i] - dx, p.y[i] - dy);
        g.lineTo(p.x[i] + dx, p.y[i] + dy);
      }
    g.stroke();
  }
}

// Place of an id in a snapshot, -1 where there is none.
function placeOf(c, k, id) {
  const ids = numbers(c.snapshots[k].id);
  let low = 0, high = ids.length;
  while (low < high) {
    const m = (low + high) >> 1;
    if (ids[m] < id) low = m + 1; else high = m;
  }
  return ids[low] === id ? low : -1;
}

// The way of a particle through all snapshots, in parts: a new one begins where it crosses the box.
function pathOf(c, id) {
  if (c.path?.id === id && c.path.between === state.between) return c.path.parts;
  const parts = [[]], fine = state.between ? 12 : 1;
  let before = null;
  for (let k = 0; k < c.times.length; ++k)
    for (let f = 0; f < (k + 1 < c.times.length ? fine : 1); ++f) {
      const t = c.times[k] + (f ? f / fine * (c.times[k + 1] - c.times[k]) : 0);
      const frame = frameOf(c, t, state.between), i = placeOf(c, frame.k, id);
      if (i < 0) continue;
      const point = [0, 1, 2].map(a => a < dims ? frame.x[a * frame.n + i] : 0), s = c.snapshots[k];
      if (before && point.some((v, a) => lengthOf(s, a) > 0 && Math.abs(v - before[a]) > lengthOf(s, a) / 2)) parts.push([]);
      parts[parts.length - 1].push(point);
      before = point;
    }
  c.path = {id, between: state.between, parts};
  return parts;
}

function drawPick(panels, p, g, theme) {
  const {c, frame} = p, i = placeOf(c, frame.k, state.pick), r = panels.ratio;
  if (dims > 1) {
    const paths = pathOf(c, state.pick);
    p.frame = frameOf(c, state.t, state.between);  // the path has used its buffers
    g.strokeStyle = theme.mark;
    g.lineWidth = 1.3 * r;
    g.globalAlpha = 0.65;
    for (const part of paths) line(g, part.map(point => panels.project(p, point)));
    g.globalAlpha = 1;
  }
  if (i < 0) return;
  g.strokeStyle = theme.mark;
  g.lineWidth = 2.2 * r;
  g.beginPath();
  g.arc(p.x[i], p.y[i], Math.max(panels.discRadius(p), 4 * r) + 2 * r, 0, 2 * Math.PI);
  g.stroke();
}
