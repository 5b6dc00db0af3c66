// SPDX-License-Identifier: GPL-3.0-or-later
// The page at work: one clock for all, keys and pointers, and a frame where something has changed.
readAddress();
const panels = new Panels(byId('canvas'));
const curves = new Curves(byId('curves'), setTime);
const wholeRun = 12;  // seconds, at speed 1
const costs = [];     // milliseconds of the last frames
let dirty = true, before = 0, writeAddress = 0;

function changed() {
  dirty = true;
  clearTimeout(writeAddress);
  writeAddress = setTimeout(() => {
    try { history.replaceState(null, '', address()); } catch { /* a page in a frame may not */ }
  }, 300);
}

function setTime(t) {
  state.t = clamp(t, firstTime, lastTime);
  changed();
}

function play(on) {
  state.playing = on;
  if (on && state.t >= lastTime) state.t = firstTime;
  byId('play').textContent = on ? '❚❚' : '▶';
  changed();
}

function step(direction, fine) {
  const times = [...new Set(cases.flatMap(c => c.times))].sort((a, b) => a - b), room = 1e-9 * (lastTime - firstTime);
  play(false);
  if (fine) return setTime(state.t + direction * (lastTime - firstTime) / 100);
  const next = direction > 0 ? times.find(t => t > state.t + room) : times.filter(t => t < state.t - room).pop();
  if (next !== undefined) setTime(next);
}

function frame(now) {
  if (state.playing) {
    const seconds = Math.min(0.1, (now - before) / 1000);
    state.t += seconds * state.speed * (lastTime - firstTime) / wholeRun;
    if (state.t >= lastTime) { state.t = lastTime; play(false); }
    dirty = true;
  }
  before = now;
  if (dirty) {
    dirty = false;
    const begin = performance.now();
    panels.draw();
    curves.show();
    describeTime(panels.how);
    if (!state.playing || costs.length % 6 === 0) describeParticle();
    costs.push(performance.now() - begin);
    if (costs.length > 600) costs.splice(0, 300);
  }
  requestAnimationFrame(frame);
}

// --- pointers

const pixels = event => {
  const box = byId('canvas').getBoundingClientRect();
  return [(event.clientX - box.left) * panels.ratio, (event.clientY - box.top) * panels.ratio];
};

function zoom(factor, px, py) {
  const p = panels.at(px, py) || panels.panels[0], [cx, cy] = panels.centre(p);
  const now = clamp(state.zoom * factor, 0.1, 400), old = panels.scale();
  const x = state.x + (px - cx) / old, y = state.y - (py - cy) / old;
  state.zoom = now;
  state.x = x - (px - cx) / panels.scale();
  state.y = y + (py - cy) / panels.scale();
  changed();
}

function connectPointers() {
  const canvas = byId('canvas'), down = new Map();
  let moved = 0;
  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), ...pixels(event));
  }, {passive: false});
  canvas.addEventListener('pointerdown', event => {
    canvas.setPointerCapture(event.pointerId);
    down.set(event.pointerId, pixels(event));
    moved = 0;
  });
  canvas.addEventListener('pointermove', event => {
    const old = down.get(event.pointerId), now = pixels(event);
    if (!old) return;
    const [dx, dy] = [now[0] - old[0], now[1] - old[1]];
    moved += Math.abs(dx) + Math.abs(dy);
    if (down.size === 2) {
      const other = [...down].find(([id]) => id !== event.pointerId)[1], far = q => Math.hypot(q[0] - other[0], q[1] - other[1]);
      if (far(old) > 1) zoom(far(now) / far(old), ...other);
    } else if (dims === 3 && !event.shiftKey && event.buttons !== 2) {
      state.turn = turnedBy(state.turn, dy * 0.008 / panels.ratio, dx * 0.008 / panels.ratio);
    } else {
      state.x -= dx / panels.scale();
      state.y += dy / panels.scale();
    }
    down.set(event.pointerId, now);
    changed();
  });
  const up = event => {
    if (event.type === 'pointerup' && down.size === 1 && moved < 4 * panels.ratio) {
      state.pick = panels.particleAt(...pixels(event));
      changed();
    }
    down.delete(event.pointerId);
  };
  canvas.addEventListener('pointerup', up);
  canvas.addEventListener('pointercancel', up);
  canvas.addEventListener('contextmenu', event => event.preventDefault());
}

// --- keys and buttons

function whole() {
  Object.assign(state, {x: 0, y: 0, zoom: 1, turn: startTurn});
  changed();
}

function toggle(name) {
  state[name] = !state[name];
  byId(name).checked = state[name];
  changed();
}

function nextField(direction) {
  const names = [...fieldTable.keys()];
  setField(names[(names.indexOf(state.field) + direction + names.length) % names.length]);
}

function picture() {
  const {canvas, ratio} = panels, out = document.createElement('canvas'), foot = 34 * ratio;
  out.width = canvas.width;
  out.height = canvas.height + foot;
  const g = out.getContext('2d'), theme = themes[state.dark ? 'dark' : 'light'], y = canvas.height + foot / 2;
  g.fillStyle = css(theme.ground);
  g.fillRect(0, 0, out.width, out.height);
  g.drawImage(canvas, 0, 0);
  g.imageSmoothingEnabled = false;
  g.font = `${12 * ratio}px system-ui, sans-serif`;
  g.textBaseline = 'middle';
  g.fillStyle = theme.text;
  g.fillText(`${page.problem.replace(/_/g, ' ')}, ${byId('time').textContent}`, 10 * ratio, y);
  const [low, high] = state.range.map(shortNumber), label = fieldTable.get(state.field)?.label || '';
  let x = out.width - 10 * ratio - g.measureText(high).width;
  g.fillText(high, x, y);
  x -= 166 * ratio;
  g.drawImage(byId('legend'), x, y - 6 * ratio, 160 * ratio, 12 * ratio);
  g.textAlign = 'right';
  g.fillText(`${label}  ${low}`, x - 6 * ratio, y);
  return out;
}

function savePicture() {
  picture().toBlob(blob => {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = `${page.problem}_t${Number(state.t.toPrecision(5))}.png`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  });
}

const keys = {
  ' ': () => play(!state.playing), ArrowLeft: e => step(-1, e.shiftKey), ArrowRight: e => step(1, e.shiftKey),
  Home: () => setTime(firstTime), End: () => setTime(lastTime), 0: whole,
  '+': () => zoom(1.25, ...panels.centre(panels.panels[0])), '-': () => zoom(0.8, ...panels.centre(panels.panels[0])),
  f: () => nextField(1), F: () => nextField(-1), i: () => toggle('between'), s: () => toggle('crosses'), b: () => toggle('box'),
  d: () => setDark(!state.dark), p: savePicture, h: () => byId('keys').showModal(), '?': () => byId('keys').showModal(),
  Escape: () => { state.pick = null; changed(); },
};

// Controls and colours show the state, whatever has changed it.
function showState() {
  byId('size').value = state.size;
  for (const name of ['between', 'crosses', 'box']) byId(name).checked = state[name];
  setDark(state.dark);
  setField(state.field);
}

function connect() {
  for (const field of fieldTable.values()) byId('field').append(option(field.name, field.label));
  for (const name of Object.keys(maps)) byId('map').append(option(name, name));
  byId('field').onchange = event => setField(event.target.value);
  byId('map').onchange = event => { state.map = event.target.value; setMap(); changed(); };
  byId('percent').onchange = event => { state.percent = event.target.value; setRange(); changed(); };
  byId('low').onchange = byId('high').onchange = typedRange;
  byId('size').oninput = event => { state.size = Number(event.target.value); changed(); };
  for (const name of ['between', 'crosses', 'box']) {
    byId(name).onchange = () => { state[name] = byId(name).checked; changed(); };
  }
  byId('crossesLabel').hidden = !(dims === 2 && cases.some(c => c.snapshots[0].points.stress !== undefined));
  byId('boxLabel').hidden = !cases.some(c => c.snapshots.some(s => s.periodic.some(Boolean)));
  byId('speed').value = '1';
  byId('speed').onchange = event => { state.speed = Number(event.target.value); };
  byId('play').onclick = () => play(!state.playing);
  byId('slider').oninput = event => setTime(firstTime + event.target.value * (lastTime - firstTime));
  byId('theme').onclick = () => setDark(!state.dark);
  byId('png').onclick = savePicture;
  byId('help').onclick = () => byId('keys').showModal();
  byId('addCurve').onchange = event => { if (event.target.value) changeCurves([...state.curves, event.target.value]); };
  document.addEventListener('keydown', event => {
    const typing = event.target.type === 'text' || event.target.tagName === 'SELECT' || byId('keys').open;
    if (typing || event.ctrlKey || event.metaKey || event.altKey || !keys[event.key]) return;
    event.preventDefault();
    event.target.blur?.();
    keys[event.key](event);
  });
  window.addEventListener('resize', () => { panels.resize(); curves.resize(); changed(); });
  window.addEventListener('hashchange', () => { readAddress(); fillAddCurve(); showState(); });
}

describeRun();
describeChecks();
fillAddCurve();
connect();
connectPointers();
showState();
panels.resize();
frame(performance.now());  // with the page, not after it
dirty = true;              // curves know their places only now
// For tests, and for who writes more into the page by hand.
window.spam = {page, cases, state, panels, curves, costs, setTime, setField, play, picture, numbers, frameOf, address};
