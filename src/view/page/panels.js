// SPDX-License-Identifier: GPL-3.0-or-later
// A panel for every case, all in one scale: where things are on the canvas, and drawing them.
const bounds = {low: [Infinity, Infinity, Infinity], high: [-Infinity, -Infinity, -Infinity]};
for (const c of cases)
  for (const s of c.snapshots)
    for (let a = 0; a < 3; ++a) {
      bounds.low[a] = Math.min(bounds.low[a], s.low[a]);
      bounds.high[a] = Math.max(bounds.high[a], s.high[a]);
    }
const middle = bounds.low.map((low, a) => (low + bounds.high[a]) / 2);
const extent = bounds.low.map((low, a) => bounds.high[a] - low);
const largestRadius = Math.max(...cases.map(c => c.radius));
// What must be seen of the world: a turned body of any side, a line with a graph of its field above it.
function worldSize() {
  if (dims === 3) { const d = 0.92 * Math.hypot(...extent) + 2 * largestRadius; return [d, d]; }
  if (dims === 1) return [extent[0] + 2 * largestRadius, extent[0] * 0.45];
  return [extent[0] + 3 * largestRadius, extent[1] + 3 * largestRadius];
}

// Elements that are not broken, and the particles that are no corner of any of them.
function wholeElements(c, k) {
  c.whole ||= [];
  if (c.whole[k]) return c.whole[k];
  const s = c.snapshots[k], corners = numbers(s.corners), broken = numbers(s.cells.broken);
  const list = [], corner = new Uint8Array(s.n), alone = [];
  for (let e = 0; e < corners.length / 4; ++e)
    if (!broken || broken[e] < 0.5) list.push(e);
  const kept = Uint32Array.from(list.flatMap(e => [...corners.subarray(4 * e, 4 * e + 4)]));
  for (const i of kept) corner[i] = 1;
  for (let i = 0; i < s.n; ++i) if (!corner[i]) alone.push(i);
  return c.whole[k] = {corners: kept, list, alone};
}

class Panels {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
    this.resize();
  }

  resize() {
    const ratio = Math.min(window.devicePixelRatio || 1, 2), {canvas} = this;
    const box = canvas.parentElement.getBoundingClientRect();
    this.ratio = ratio;
    canvas.width = Math.max(50, Math.floor(box.width * ratio));
    canvas.height = Math.max(50, Math.floor(box.height * ratio));
    this.raster = new Raster(canvas.width, canvas.height);
    this.arrange();
  }

  // The division into rows and columns that makes the world largest.
  arrange() {
    const [worldX, worldY] = worldSize(), {width, height} = this.raster, head = 22 * this.ratio;
    let best = {fit: -1};
    for (let columns = 1; columns <= cases.length; ++columns) {
      const rows = Math.ceil(cases.length / columns), w = width / columns, h = height / rows;
      const fit = Math.min(w * 0.97 / worldX, (h - head) * 0.97 / worldY);
      if (fit > best.fit) best = {fit, columns, w, h};
    }
    this.fit = best.fit;
    this.head = head;
    this.panels = cases.map((c, k) => {
      const left = (k % best.columns) * best.w, top = Math.floor(k / best.columns) * best.h;
      return {c, left: Math.round(left), top: Math.round(top), right: Math.round(left + best.w),
              bottom: Math.round(top + best.h), x: new Float32Array(0)};
    });
  }

  scale() { return this.fit * state.zoom; }
  // Where the world's (view.x, view.y) is shown.
  centre(p) { return [(p.left + p.right) / 2, (p.top + this.head + p.bottom) / 2]; }
  at(px, py) { return this.panels.find(p => px >= p.left && px < p.right && py >= p.top && py < p.bottom); }

  // Coordinates of a frame on the canvas, kept in the panel; `values`: of particles, for the graph of a line.
  place(p, frame, values) {
    const n = frame.n, x = frame.x, scale = this.scale(), [cx, cy] = this.centre(p);
    if (p.x.length < n) for (const name of ['x', 'y', 'depth']) p[name] = new Float32Array(n);
    const ox = cx - state.x * scale, oy = cy + state.y * scale;
    if (dims === 3) return this.placeInSpace(p, frame, scale, ox, oy);
    const {x: px, y: py} = p;
    for (let i = 0; i < n; ++i) px[i] = (x[i] - middle[0]) * scale + ox;
    if (dims === 2) for (let i = 0; i < n; ++i) py[i] = oy - (x[n + i] - middle[1]) * scale;
    else {
      const [low, high] = state.range, up = 0.4 * extent[0] * scale / (high > low ? high - low : 1);
      for (let i = 0; i < n; ++i) py[i] = oy - (values && high > low ? values[i] - (low + high) / 2 : 0) * up;
    }
  }

  placeInSpace(p, frame, scale, ox, oy) {
    const n = frame.n, x = frame.x, m = state.turn, {x: px, y: py, depth} = p;
    for (let i = 0; i < n; ++i) {
      const a = x[i] - middle[0], b = x[n + i] - middle[1], c = x[2 * n + i] - middle[2];
      px[i] = (m[0] * a + m[1] * b + m[2] * c) * scale + ox;
      py[i] = oy - (m[3] * a + m[4] * b + m[5] * c) * scale;
      depth[i] = m[6] * a + m[7] * b + m[8] * c;
    }
  }

  // A point of the world on the canvas.
  project(p, point) {
    const scale = this.scale(), [cx, cy] = this.centre(p), m = state.turn;
    const d = point.map((v, a) => v - middle[a]);
    const u = dims === 3 ? m[0] * d[0] + m[1] * d[1] + m[2] * d[2] : d[0];
    const v = dims === 3 ? m[3] * d[0] + m[4] * d[1] + m[5] * d[2] : dims === 2 ? d[1] : 0;
    return [cx + (u - state.x) * scale, cy - (v - state.y) * scale];
  }

  discRadius(p) { return p.c.radius * this.scale() * state.size; }

  draw() {
    const theme = themes[state.dark ? 'dark' : 'light'], {raster, context} = this;
    raster.clear(theme.ground);
    this.how = new Set();
    for (const p of this.panels) {
      p.frame = frameOf(p.c, state.t, state.between);
      this.how.add(p.frame.how);
      raster.bounds(p.left, p.top, p.right, p.bottom);
      this.fill(p, p.frame);
    }
    context.putImageData(raster.image, 0, 0);
    for (const p of this.panels) drawOver(this, p, theme);
  }

  fill(p, frame) {
    const c = p.c, snapshot = c.snapshots[frame.k], table = state.field === 'body' ? bodyTable : state.table;
    const [low, high] = state.field === 'body' ? [0, 255.999] : state.range;
    const values = valuesOf(c, frame, state.field, 'points');
    this.place(p, frame, values);
    p.values = values;
    const n = frame.n;
    if (!p.colours || p.colours.length < n) p.colours = new Uint32Array(n);
    const radius = this.discRadius(p), colour = values || (p.nothing ||= new Float32Array(n).fill(NaN));
    if (dims === 3) {
      const far = 0.5 * Math.hypot(...extent), scale = high > low ? 255.999 / (high - low) : 0;
      for (let i = 0; i < n; ++i)
        p.colours[i] = colour[i] === colour[i] ? Math.max(0, Math.min(255, (colour[i] - low) * scale)) | 0 : noStep;
      const shaded = state.field === 'body' ? bodyShaded : state.shaded;
      spheres(this.raster, p.x, p.y, p.depth, n, radius, p.colours, shaded, -far, far, p);
      return;
    }
    coloursOf(colour, n, low, high, table, p.colours);
    if (snapshot.corners === undefined) return this.raster.discs(p.x, p.y, n, radius, p.colours);
    this.fillElements(p, frame, radius, low, high, table);
  }

  fillElements(p, frame, radius, low, high, table) {
    const {corners, list, alone} = wholeElements(p.c, frame.k), values = valuesOf(p.c, frame, state.field, 'cells');
    const colours = new Uint32Array(list.length).fill(nowhere), pick = from => Float32Array.from(alone, i => from[i]);
    if (values) coloursOf(Float32Array.from(list, e => values[e]), list.length, low, high, table, colours);
    this.raster.quadrilaterals(p.x, p.y, corners, colours);
    this.raster.discs(pick(p.x), pick(p.y), alone.length, radius, alone.map(i => p.colours[i]));
  }

  // Id of the particle under a place of the canvas, null where there is none.
  particleAt(px, py) {
    const p = this.at(px, py);
    if (!p || !p.frame) return null;
    const reach = Math.max(this.discRadius(p), 7 * this.ratio) ** 2;
    let best = -1, least = dims === 3 ? Infinity : reach;
    for (let i = 0; i < p.frame.n; ++i) {
      let d = (p.x[i] - px) ** 2 + (p.y[i] - py) ** 2;
      if (d > reach) continue;
      if (dims === 3) d = -p.depth[i];  // the nearest of those that are under it
      if (d < least) { least = d; best = i; }
    }
    return best < 0 ? null : numbers(p.c.snapshots[p.frame.k].id)[best];
  }
}
