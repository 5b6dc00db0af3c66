// SPDX-License-Identifier: GPL-3.0-or-later
// Columns of invariants.csv against time, and their drifts: changes in units of their scales, less what externals
// have given. One cursor for all; a click sets the time.
const given = {momentum: ['impulse'], 'angular momentum': ['angular_impulse'], energy: ['work', 'heat'], mass: []};
const nothingBelow = 1e-18;  // uPlot's logarithmic axis fails where a curve spans too many decades
const endings = ['', '_x', '_y', '_z'];

function columnOf(c, name) {
  const at = c.invariants ? c.invariants.names.indexOf(name) : -1;
  return at < 0 ? null : numbers(c.invariants.columns[at]);
}

// Null where the case has no such invariant or no scale of it.
function driftOf(c, name) {
  const scale = c.statistics?.invariants?.[name]?.scale, column = name.replace(' ', '_');
  if (!(scale > 0)) return null;
  let out = null;
  for (const ending of endings) {
    const v = columnOf(c, column + ending);
    if (!v) continue;
    const from = (given[name] || []).map(g => columnOf(c, g + ending)).filter(Boolean);
    out = out || new Float64Array(v.length);
    for (let k = 0; k < v.length; ++k) {
      let change = v[k] - v[0];
      for (const g of from) change -= g[k] - g[0];
      out[k] = Math.max(out[k], Math.abs(change) / scale);
    }
  }
  return out;
}

// Of rows and snapshots; never empty, which uPlot would not bear.
const timeRange = (() => {
  const times = cases.flatMap(c => { const t = columnOf(c, 't'); return t && t.length ? [t[0], t[t.length - 1]] : []; });
  const low = Math.min(firstTime, ...times), high = Math.max(lastTime, ...times);
  return [low, high > low ? high : low + 1];
})();

const curveNames = new Map();  // key -> label
for (const name of Object.keys(given))
  if (cases.some(c => driftOf(c, name))) curveNames.set('drift:' + name, 'drift of ' + name);
for (const c of cases)
  for (const name of c.invariants?.names || []) if (name !== 't') curveNames.set(name, name.replace(/_/g, ' '));

function valuesOfCurve(c, key) {
  const values = key.startsWith('drift:') ? driftOf(c, key.slice(6)) : columnOf(c, key);
  if (!values) return null;
  const log = key.startsWith('drift:');
  return Array.from(values, v => !Number.isFinite(v) || (log && v === 0) ? null : log ? Math.max(v, nothingBelow) : v);
}

function firstCurves() {
  const usual = /^(t|dt|mass|momentum_.|angular_momentum(_.)?|kinetic|internal|energy|closest_pair|impulse.*|angular_impulse.*|work|heat)$/;
  const keys = [...curveNames.keys()].filter(isPromised), own = keys.filter(k => !k.startsWith('drift:') && !usual.test(k));
  const wanted = ['drift:angular momentum', 'drift:energy', own[0], 'kinetic', 'internal', 'drift:momentum'];
  return wanted.filter(k => keys.includes(k)).slice(0, 3);
}

// A drift that no case promises to keep small is not what one looks at first.
function isPromised(key) {
  return !key.startsWith('drift:') || cases.some(c => c.statistics?.invariants?.[key.slice(6)]?.kept != null);
}

class Curves {
  constructor(element, setTime) {
    this.element = element;
    this.setTime = setTime;
    this.plots = [];
  }

  build() {
    for (const plot of this.plots) plot.u?.destroy();
    this.element.textContent = '';
    this.plots = state.curves.map(key => this.make(key));
    this.resize();
  }

  make(key) {
    const holder = document.createElement('figure'), title = document.createElement('figcaption');
    const name = document.createElement('span'), close = document.createElement('button');
    name.textContent = name.title = curveNames.get(key);
    close.textContent = '×';
    close.title = 'remove this curve';
    close.onclick = () => changeCurves(state.curves.filter(k => k !== key));
    title.append(name, close);
    holder.append(title);
    this.element.append(holder);
    const tables = [], series = [{}];
    for (const c of cases) {
      const y = valuesOfCurve(c, key);
      if (!y || y.every(v => v === null)) continue;
      tables.push([Array.from(columnOf(c, 't')), y]);
      series.push({label: c.label || key, stroke: caseColours[c.number % caseColours.length], width: 1.6, points: {show: false}});
    }
    const plot = {key, holder, cursor: document.createElement('div')};
    if (!tables.length) {
      holder.append('zero at all times');
      return plot;
    }
    const log = key.startsWith('drift:'), style = getComputedStyle(document.body);
    const decades = log ? everyDecade : (u, at) => at;
    const ink = style.getPropertyValue('--soft-text'), grid = {stroke: style.getPropertyValue('--line'), width: 1};
    const sparse = {...grid, filter: decades};
    const axis = {stroke: ink, grid, ticks: grid, font: '11px system-ui, sans-serif'};
    plot.u = new uPlot({
      width: 300, height: 140, legend: {show: false}, series,
      scales: {x: {time: false, range: timeRange}, y: log ? {distr: 3} : {range: roomFor}},
      cursor: {drag: {x: false, y: false}, sync: {key: 'spam'}, points: {size: 5}},
      axes: [{...axis, size: 24, space: 60, values: (u, at) => at.map(shortNumber)},
             {...axis, grid: sparse, ticks: sparse, filter: decades, size: 58, space: 22,
              values: (u, at) => at.map(v => v === null ? '' : log ? '1e' + Math.round(Math.log10(v)) : shortNumber(v))}],
    }, uPlot.join(tables), holder);
    plot.cursor.className = 'now';
    plot.u.over.append(plot.cursor);
    const set = event => {
      const box = plot.u.over.getBoundingClientRect();
      this.setTime(plot.u.posToVal(event.clientX - box.left, 'x'));
    };
    plot.u.over.addEventListener('pointerdown', set);
    plot.u.over.addEventListener('pointermove', event => { if (event.buttons & 1) set(event); });
    return plot;
  }

  resize() {
    for (const {u, holder} of this.plots)
      u?.setSize({width: Math.max(120, holder.clientWidth), height: Math.max(80, holder.clientHeight - 22)});
    this.show();
  }

  show() {
    for (const {u, cursor} of this.plots)
      if (u) cursor.style.transform = `translateX(${u.valToPos(state.t, 'x').toFixed(1)}px)`;
  }
}

// A column that changes by round-off only is a line, not its noise.
function roomFor(u, low, high) {
  if (low === null) return [0, 1];
  const size = Math.max(Math.abs(low), Math.abs(high)), room = Math.max(0.08 * (high - low), 1e-9 * size, 1e-300);
  return [low - room, high + room];
}

// Of the marks of a logarithmic axis the powers of ten, five or six of them at most; null hides one.
function everyDecade(u, at) {
  const decades = Math.log10(u.scales.y.max / u.scales.y.min), every = Math.max(1, Math.ceil(decades / 5));
  return at.map(v => {
    const p = Math.log10(v), whole = Math.round(p);
    return Math.abs(p - whole) < 1e-6 && whole % every === 0 ? v : null;
  });
}
