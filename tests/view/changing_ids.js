// SPDX-License-Identifier: GPL-3.0-or-later
// The program of a page, without a browser, on a run whose particles are split and merged: every snapshot has its own
// ids. Between two of them those that stay go from one place to the other, those that end go straight on; fields, paths
// and the one that is chosen are those of an id.
// changing_ids.js <folder of the page's scripts> <spam-view> <gas_cloud> <work folder>
'use strict';
const assert = require('node:assert/strict');
const {execFileSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');
const vm = require('node:vm');

const [scripts, view, cloud, work] = process.argv.slice(2);
fs.rmSync(work, {recursive: true, force: true});
fs.mkdirSync(work, {recursive: true});
const words = '--dimension 2 --size 5 --rezone --return --time 1.6 --snapshot-every 0.5 --no-plots --quiet --out o';
execFileSync(cloud, words.split(' '), {cwd: work});
execFileSync(view, ['o'], {cwd: work});

const html = fs.readFileSync(path.join(work, 'o/view.html'), 'utf8');
const scriptsOf = html.matchAll(/<script type="[^"]+" id="(\w+)">([\s\S]*?)<\/script>/g);
const elements = new Map([...scriptsOf].map(m => [m[1], m[2]]));
const source = ['arrays', 'fields', 'motion', 'overlay'].map(
  name => fs.readFileSync(path.join(scripts, name + '.js'), 'utf8'));
const state = {between: true};
const {cases, dims, numbers, frameOf, valuesOf, placeOf, pathOf} = vm.runInNewContext(
  source.join('\n') + ';({cases, dims, numbers, frameOf, valuesOf, placeOf, pathOf})',
  {document: {getElementById: id => ({textContent: elements.get(id)})}, word: () => 0, state, atob, Intl});

const c = cases[0], shots = c.snapshots, sizes = shots.map(s => s.n), ids = shots.map(s => numbers(s.id));
const most = sizes.indexOf(Math.max(...sizes));
assert(sizes[most] > 1.5 * sizes[0], 'nothing was split');
assert(sizes.at(-1) < sizes[most], 'nothing was merged');
shots.forEach((s, k) => {
  assert.equal(ids[k].length, s.n);
  assert(ids[k].every((id, i) => i === 0 || id > ids[k][i - 1]), 'ids ascend');
  const frame = frameOf(c, s.t, true);
  assert.equal(frame.n, s.n);
  assert.deepEqual([...frame.x.slice(0, dims * s.n)], [...numbers(s.points.position)]);
});

let stay = 0, end = 0;
for (let k = 0; k + 1 < shots.length; ++k) {
  const a = shots[k], b = shots[k + 1], dt = b.t - a.t;
  const [x0, x1, v0] = [numbers(a.points.position), numbers(b.points.position), numbers(a.points.velocity)];
  const then = new Map([...ids[k + 1]].map((id, j) => [id, j]));
  for (const s of [0.25, 0.5, 1 - 1e-9]) {
    const frame = frameOf(c, a.t + s * dt, true), values = valuesOf(c, frame, 'density', 'points');
    assert.equal(frame.n, a.n);
    assert.equal(values.length, a.n);
    const [rho0, rho1] = [numbers(a.points.density), numbers(b.points.density)];
    for (let i = 0; i < a.n; ++i) {
      const j = then.get(ids[k][i]);
      for (let axis = 0; axis < dims; ++axis) {
        const x = frame.x[axis * a.n + i], from = x0[axis * a.n + i];
        if (j === undefined && frame.how === 'velocities')
          assert(Math.abs(x - from - s * dt * v0[axis * a.n + i]) < 1e-4, 'straight on');
        else if (j !== undefined && s > 0.9)
          assert(Math.abs(x - x1[axis * b.n + j]) < 1e-4, 'to where it is next');
      }
      const wanted = j === undefined ? rho0[i] : rho0[i] + s * (rho1[j] - rho0[i]);
      assert(Math.abs(values[i] - wanted) < 1e-6, 'densities of one id');
      j === undefined ? ++end : ++stay;
    }
    // On the way back two that were made of more have the ids of the first of them, and jump: no velocity says so.
    if (b.t <= c.times.at(-1) / 2) assert.equal(frame.how, 'velocities');
  }
}
assert(stay > 1000 && end > 100, `${stay} stay and ${end} end`);

// A child has no path before it is there, and its parent none behind; where an id is not, nothing is drawn.
const child = ids[most].at(-1), born = ids.findIndex(one => one.includes(child));
assert(born > 0);
assert.equal(placeOf(c, born - 1, child), -1);
assert.equal(ids[born][placeOf(c, born, child)], child);
const alive = ids.map((one, k) => one.includes(child) ? k : -1).filter(k => k >= 0);
const points = pathOf(c, child).flat();
assert(points.length >= alive.length && points.flat().every(Number.isFinite));
const start = numbers(shots[born].points.position), at = placeOf(c, born, child);
assert.deepEqual([points[0][0], points[0][1]], [start[at], start[shots[born].n + at]]);
console.log(`${sizes[0]} to ${sizes[most]} particles, at the end ${sizes.at(-1)}; ${stay} go to where they are next, `
            + `${end} straight on`);
