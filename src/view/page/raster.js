// SPDX-License-Identifier: GPL-3.0-or-later
// Discs and quadrilaterals filled into the pixels of an image. No WebGL: without a graphics card that is slower.
class Raster {
  constructor(width, height) {
    this.width = width;
    this.height = height;
    this.image = new ImageData(width, height);
    this.pixels = new Uint32Array(this.image.data.buffer);
    this.bounds(0, 0, width, height);
  }
  clear(colour) { this.pixels.fill(colour); }
  bounds(left, top, right, bottom) { Object.assign(this, {left, top, right, bottom}); }

  holds(col, row) { return col >= this.left && col < this.right && row >= this.top && row < this.bottom; }

  // n discs about (x, y) in pixels. Large ones have soft edges, small ones are whole pixels: discs of parts of a
  // pixel would leave a lattice full of specks.
  discs(x, y, n, radius, colours) {
    if (radius < 0.75) this.dots(x, y, n, colours);
    else if (n < 20000 || (radius > 2.5 && n * radius * radius < 3e6)) this.softDiscs(x, y, n, radius, colours);
    else this.hardDiscs(x, y, n, radius, colours);
  }

  dots(x, y, n, colours) {
    const {pixels, width, left, top, right, bottom} = this;
    for (let i = 0; i < n; ++i) {
      const px = Math.floor(x[i]), py = Math.floor(y[i]);
      if (px >= left && px < right && py >= top && py < bottom) pixels[py * width + px] = colours[i];
    }
  }

  hardDiscs(x, y, n, radius, colours) {
    const {pixels, width, left, top, right, bottom} = this;
    const rows = Math.ceil(radius), half = new Int32Array(2 * rows + 1);
    for (let r = -rows; r <= rows; ++r)
      half[r + rows] = Math.abs(r) <= radius ? Math.round(Math.sqrt(radius * radius - r * r)) : -1;
    for (let i = 0; i < n; ++i) {
      const px = Math.floor(x[i]), py = Math.floor(y[i]);
      if (px + rows < left || px - rows >= right || py + rows < top || py - rows >= bottom) continue;
      const colour = colours[i];
      for (let r = -rows; r <= rows; ++r) {
        const row = py + r, w = half[r + rows];
        if (w < 0 || row < top || row >= bottom) continue;
        const begin = px - w < left ? left : px - w, end = px + w >= right ? right - 1 : px + w;
        for (let p = row * width + begin, last = row * width + end; p <= last; ++p) pixels[p] = colour;
      }
    }
  }

  softDiscs(x, y, n, radius, colours) {
    for (let i = 0; i < n; ++i) this.softDisc(x[i], y[i], radius, colours[i]);
  }

  softDisc(cx, cy, radius, colour) {
    const {pixels, width, left, top, right, bottom} = this;
    const outer = radius + 0.5, inner = radius - 0.5;
    const first = Math.max(top, Math.floor(cy - outer)), last = Math.min(bottom - 1, Math.floor(cy + outer));
    for (let row = first; row <= last; ++row) {
      const dy = row + 0.5 - cy, o2 = outer * outer - dy * dy;
      if (o2 <= 0) continue;
      const wide = Math.sqrt(o2), i2 = inner * inner - dy * dy, full = i2 > 0 ? Math.sqrt(i2) : -1;
      const begin = Math.max(left, Math.floor(cx - wide)), end = Math.min(right - 1, Math.floor(cx + wide));
      for (let col = begin, p = row * width + begin; col <= end; ++col, ++p) {
        const dx = col + 0.5 - cx;
        if (dx < full && -dx < full) pixels[p] = colour;
        else {
          const part = outer - Math.sqrt(dx * dx + dy * dy);
          if (part > 0) pixels[p] = part >= 1 ? colour : mixed(pixels[p], colour, part);
        }
      }
    }
  }

  // Quadrilaterals: two triangles each. corners: 4 places in x, y for each.
  quadrilaterals(x, y, corners, colours) {
    for (let e = 0, k = 0; k < corners.length; ++e, k += 4) {
      const a = corners[k], b = corners[k + 1], c = corners[k + 2], d = corners[k + 3];
      this.triangle(x[a], y[a], x[b], y[b], x[c], y[c], colours[e]);
      this.triangle(x[a], y[a], x[c], y[c], x[d], y[d], colours[e]);
    }
  }

  triangle(x0, y0, x1, y1, x2, y2, colour) {
    const {pixels, width, left, right} = this;
    const first = Math.max(this.top, Math.ceil(Math.min(y0, y1, y2) - 0.5));
    const last = Math.min(this.bottom - 1, Math.ceil(Math.max(y0, y1, y2) - 0.5) - 1);
    for (let row = first; row <= last; ++row) {
      const y = row + 0.5;
      let begin = Infinity, end = -Infinity;
      const cut = (xa, ya, xb, yb) => {
        if ((ya <= y) === (yb <= y)) return;
        const at = xa + (y - ya) / (yb - ya) * (xb - xa);
        if (at < begin) begin = at;
        if (at > end) end = at;
      };
      cut(x0, y0, x1, y1);
      cut(x1, y1, x2, y2);
      cut(x2, y2, x0, y0);
      const from = Math.max(left, Math.ceil(begin - 0.5)), to = Math.min(right - 1, Math.ceil(end - 0.5) - 1);
      for (let p = row * width + from, stop = row * width + to; p <= stop; ++p) pixels[p] = colour;
    }
  }
}

function mixed(below, above, part) {
  const k = part * 256 | 0, rest = 256 - k;
  const pair = ((below & 0xff00ff) * rest + (above & 0xff00ff) * k) >>> 8 & 0xff00ff;
  const green = ((below & 0xff00) * rest + (above & 0xff00) * k) >>> 8 & 0xff00;
  return (0xff000000 | pair | green) >>> 0;
}
