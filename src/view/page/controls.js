// SPDX-License-Identifier: GPL-3.0-or-later
// What the reader of the page can choose, the address that remembers it, and the words about it.
const byId = id => document.getElementById(id);
const state = {
  t: firstTime, playing: false, speed: 1, between: true, field: firstField(), map: '', percent: '0.01',
  range: [0, 1], table: null, shaded: null, size: 1, crosses: false, box: true, pick: null,
  x: 0, y: 0, zoom: 1, turn: turnedBy([1, 0, 0, 0, 1, 0, 0, 0, 1], -1.1, 0.5), curves: firstCurves(),
  dark: window.matchMedia?.('(prefers-color-scheme: dark)').matches || false,
};
const startTurn = state.turn;

function clamp(value, low, high) { return Math.max(low, Math.min(high, value)); }

function option(value, text) {
  const element = document.createElement('option');
  element.value = value;
  element.textContent = text;
  return element;
}

// --- colours

function setMap() {
  const signed = fieldTable.get(state.field)?.signed;
  const map = state.map || (signed ? 'blue to red' : 'viridis');
  state.table = tableOf(map);
  state.shaded = shadedTable(state.table);
  byId('map').value = map;
  const g = byId('legend').getContext('2d'), image = new ImageData(256, 1);
  new Uint32Array(image.data.buffer).set(state.table);
  g.putImageData(image, 0, 0);
}

function setRange() {
  if (state.percent !== 'typed') {
    const part = Number(state.percent);
    let [low, high] = percentiles(state.field, [part, 1 - part]);
    // Colours of what has a sign are symmetric about zero.
    if (fieldTable.get(state.field)?.signed && low < 0 && high > 0) [low, high] = [-1, 1].map(s => s * Math.max(-low, high));
    // Round-off is no pattern.
    if (high - low < 1e-6 * Math.max(Math.abs(low), Math.abs(high))) low = high = (low + high) / 2;
    state.range = [low, high];
  }
  byId('percent').value = state.percent;
  byId('low').value = shortNumber(state.range[0]);
  byId('high').value = shortNumber(state.range[1]);
}

function setField(name) {
  if (!fieldTable.has(name)) return;
  state.field = name;
  byId('field').value = name;
  setMap();
  setRange();
  changed();
}

function typedRange() {
  const ends = ['low', 'high'].map(id => Number(byId(id).value.replace('−', '-').replace(',', '.')));
  if (ends.every(Number.isFinite) && byId('low').value.trim() && byId('high').value.trim()) {
    state.percent = 'typed';
    state.range = ends;
  }
  setRange();
  changed();
}

function changeCurves(keys) {
  state.curves = keys;
  fillAddCurve();
  curves.build();
  changed();
  window.dispatchEvent(new Event('resize'));
}

function fillAddCurve() {
  const select = byId('addCurve');
  select.textContent = '';
  select.append(option('', 'add a curve'));
  for (const [key, label] of curveNames) if (!state.curves.includes(key)) select.append(option(key, label));
  select.hidden = curveNames.size === 0;
}

function setDark(dark) {
  state.dark = dark;
  document.documentElement.classList.toggle('dark', dark);
  curves.build();
  changed();
}

// --- words

const units = cases.map(c => c.statistics?.units).find(u => u && typeof u === 'object') || {};
const unit = kind => typeof units[kind] === 'string' ? ' ' + units[kind].slice(0, 200) : '';

function describeRun() {
  byId('title').textContent = page.problem.replace(/_/g, ' ');
  const counted = c => [...new Set([Math.min, Math.max].map(most => most(...c.snapshots.map(s => s.n)).toLocaleString('en')))];
  const counts = [...new Set(cases.map(c => counted(c).join(' to ')))].join(', ');
  byId('subtitle').textContent = [counts + ' particles', dims + 'D', cases.length > 1 ? cases.length + ' cases' : '',
    page.version ? 'spam ' + page.version : ''].filter(Boolean).join(' · ');
  const shots = cases.map(c => c.snapshots.length === c.written ? c.written : c.snapshots.length + ' of ' + c.written);
  const words = [`Snapshots: ${[...new Set(shots)].join(', ')}.`, page.thinning[0].toUpperCase() + page.thinning.slice(1) + '.'];
  for (const c of cases) if (c.invariants?.every > 1) { words.push(`Curves: every ${c.invariants.every}. row.`); break; }
  for (const c of cases) if (c.statistics?.stopped) words.push(`${c.label || 'The run'} was stopped: ${c.statistics.stopped}.`);
  if (unit('reduced')) words.push(`Reduced units:${unit('reduced')}.`);
  if (unit('time')) words.push(`Units:${['length', 'mass', 'time', 'stress'].map(unit).join(',')}.`);
  if (page.checks === null) words.push('The run had not ended when this page was made.');
  byId('about').textContent = words.join(' ');
  byId('options').textContent = page.options || 'case.toml is missing';
}

function describeChecks() {
  const list = byId('checks');
  const add = (good, mark, name, detail, source) => {
    const row = document.createElement('div'), sign = document.createElement('b'), text = document.createElement('span');
    row.className = 'check' + (good === true ? ' good' : good === false ? ' bad' : '');
    sign.textContent = mark;
    text.textContent = name.replace(/_/g, ' ') + ' ' + detail;
    row.title = source || '';
    row.append(sign, text);
    list.append(row);
  };
  for (const check of page.checks || []) {
    const claimed = check.expected !== undefined && check.expected !== null, value = shortNumber(check.value ?? NaN);
    add(claimed ? check.holds === true : null, claimed ? (check.holds === true ? '✓' : '✗') : '·', check.name,
        claimed ? `${value} (${shortNumber(check.expected)} ± ${shortNumber(check.tolerance)})` : value, check.source);
  }
  if (!list.childElementCount) list.textContent = 'none';
}

function describeParticle() {
  const element = byId('particle');
  element.textContent = '';
  if (state.pick === null) { element.textContent = 'click one'; return; }
  const table = document.createElement('table');
  const row = (name, values) => {
    const tr = document.createElement('tr');
    for (const text of [name, ...values]) {
      const td = document.createElement(text === name && !tr.childElementCount ? 'th' : 'td');
      td.textContent = text;
      tr.append(td);
    }
    table.append(tr);
  };
  row('id ' + state.pick, cases.length > 1 ? cases.map((c, k) => (k + 1) + '.') : []);
  const at = cases.map(c => {
    const frame = frameOf(c, state.t, state.between), i = placeOf(c, frame.k, state.pick);
    return {c, frame, i, x: i < 0 ? null : axes.slice(0, dims).map((_, a) => frame.x[a * frame.n + i])};
  });
  for (let a = 0; a < dims; ++a) row(axes[a], at.map(p => p.x ? shortNumber(p.x[a]) : '–'));
  for (const field of fieldTable.values())
    if (at.some(p => fieldOf(p.c, p.frame.k, field.name, 'points')))
      row(field.label.replace(/ \(.*/, ''), at.map(p => {
        const values = p.i < 0 ? null : valuesOf(p.c, p.frame, field.name, 'points');
        return values ? shortNumber(values[p.i]) : '–';
      }));
  element.append(table);
}

const ways = {
  computed: 'computed states', velocities: 'cubic from positions and velocities',
  positions: 'curve through positions: velocities do not lead along it',
};

function describeTime(how) {
  byId('time').textContent = 't = ' + (Math.abs(state.t) < 1e-12 * (lastTime - firstTime) ? 0 : Number(state.t.toPrecision(5))) + unit('time');
  byId('slider').value = (state.t - firstTime) / (lastTime - firstTime || 1);
  const words = [...how].map(h => ways[h]);
  const text = how.size > 1 && how.has('velocities') ? 'cubic; where velocities do not lead along it, through positions' : words.join('; ');
  if (byId('how').textContent !== text) byId('how').textContent = byId('how').title = text;
}

// --- the address

const remembered = {
  t: [() => Number(state.t.toPrecision(8)), v => { state.t = clamp(Number(v) || 0, firstTime, lastTime); }],
  field: [() => state.field, v => { if (fieldTable.has(v)) state.field = v; }],
  map: [() => state.map, v => { if (Object.hasOwn(maps, v)) state.map = v; }],
  range: [() => state.percent === 'typed' ? state.range.join(',') : state.percent, v => {
    const ends = v.split(',').map(Number);
    if (ends.length === 2 && ends.every(Number.isFinite)) Object.assign(state, {percent: 'typed', range: ends});
    else if (['0', '0.01', '0.05'].includes(v)) state.percent = v;
  }],
  view: [() => [state.x, state.y, state.zoom].map(v => Number(v.toPrecision(5))).join(','), v => {
    const [x, y, zoom] = v.split(',').map(Number);
    if ([x, y, zoom].every(Number.isFinite) && zoom > 0) Object.assign(state, {x, y, zoom});
  }],
  turn: [() => dims === 3 ? state.turn.map(v => Number(v.toFixed(4))).join(',') : '', v => {
    const m = v.split(',').map(Number);
    if (m.length === 9 && m.every(Number.isFinite)) state.turn = m;
  }],
  size: [() => state.size, v => { state.size = clamp(Number(v) || 1, 0.2, 3); }],
  between: [() => Number(state.between), v => { state.between = v !== '0'; }],
  crosses: [() => Number(state.crosses), v => { state.crosses = v === '1'; }],
  box: [() => Number(state.box), v => { state.box = v !== '0'; }],
  pick: [() => state.pick ?? '', v => { if (/^\d+$/.test(v)) state.pick = Number(v); }],
  curves: [() => state.curves.join('|'), v => { state.curves = v.split('|').filter(k => curveNames.has(k)); }],
  dark: [() => Number(state.dark), v => { state.dark = v === '1'; }],
};

function address() {
  const words = new URLSearchParams();
  for (const [key, [get]] of Object.entries(remembered)) if (get() !== '') words.set(key, get());
  return '#' + words;
}

function readAddress() {
  for (const [key, value] of new URLSearchParams(location.hash.slice(1)))
    if (Object.hasOwn(remembered, key)) remembered[key][1](value);
}
