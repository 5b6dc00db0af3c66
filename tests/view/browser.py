# SPDX-License-Identifier: GPL-3.0-or-later
# The pages of runs in headless browsers, with and without WebGL, in windows of three sizes, light and dark: a frame
# within a second, no request but for the page itself, nothing on the console, particles where and in the colours that
# their values say, controls that work.
# browser.py <spam-view> <rotating_hexagon> <free_expansion> <ball_plate> <taylor_bar> <work folder>; exit status 77: no browser.
import array
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import time

sys.dont_write_bytecode = True
from browsers import Chromium, Firefox  # noqa: E402

first_frame = 1000  # milliseconds that a page may take
# WebGL, width, height, dark.
rounds = [(True, 1440, 900, False), (False, 800, 500, False), (False, 1920, 1200, True)]


def array_of(file, name):
    """An array of a snapshot, read anew from its bytes."""
    raw = file.read_bytes()
    cut = raw.index(b'<AppendedData encoding="raw">\n_') + len(b'<AppendedData encoding="raw">\n_')
    found = re.search(rb'type="(\w+)" Name="' + name + rb'" NumberOfComponents="(\d)" format="appended" offset="(\d+)"', raw)
    kind, components, offset = found[1], int(found[2]), cut + int(found[3])
    length = struct.unpack_from("<Q", raw, offset)[0]
    numbers = array.array("q" if kind == b"Int64" else "d")
    numbers.frombytes(raw[offset + 8:offset + 8 + length])
    return [numbers[i:i + components] for i in range(0, len(numbers), components)]


def open_page(browser, page, address=""):
    """Milliseconds from asking for the page to its second frame."""
    browser.open("about:blank")  # else a new address of the same page would not load it
    browser.open(page.as_uri() + address)
    return browser.wait_for_frame()


def check_first_frame(browser, page):
    """Within its time, at the third opening at the latest, for the machine may have other work."""
    times = [open_page(browser, page)]
    while times[-1] >= first_frame and len(times) < 3:
        times.append(open_page(browser, page))
    print(f"  first frame after {min(times):.0f} ms (of {', '.join(f'{t:.0f}' for t in times)})", flush=True)
    assert min(times) < first_frame, times


def check_quiet(browser, folder):
    said = browser.console()
    assert not said, said
    asked = [url for url in browser.requests() if url != "about:blank"]
    strangers = [url for url in asked if not re.match(re.escape(folder.as_uri()) + r"/\w+/view\.html(#.*)?$|data:|blob:", url)]
    assert asked and not strangers, strangers


def pixel(browser, x, y):
    return pixels(browser, "canvas", [(x, y)])[0]


def pixels(browser, name, places):
    """Their colours, from one copy: reading the canvas itself often would make a browser complain and change how it draws."""
    return browser.script("const from = document.getElementById(arguments[0]);"
                          "const copy = document.createElement('canvas').getContext('2d', {willReadFrequently: true});"
                          "copy.canvas.width = from.width; copy.canvas.height = from.height; copy.drawImage(from, 0, 0);"
                          "return arguments[1].map(([x, y]) => [...copy.getImageData(x, y, 1, 1).data].slice(0, 3))",
                          name, [[round(x), round(y)] for x, y in places])


def drawn(browser):
    """A number that is another one where another picture is shown."""
    return browser.script("return spam.panels.raster.pixels.reduce((a, b) => (a * 31 + b) >>> 0, 7)")


def check_particles(browser, folder, case, number, snapshot):
    """The pixel at the middle of particles has the colour that the legend has at their density."""
    file = folder / f"snapshot_{snapshot:04d}.vtp"
    t = float(re.findall(r'timestep="([^"]+)"', (folder / "snapshots.pvd").read_text())[snapshot])
    browser.script("spam.setField(arguments[1]); spam.state.percent = 'typed'; spam.state.range = arguments[2];"
                   "spam.state.size = Math.max(0.5, 3.6 / spam.panels.scale()); spam.state.box = false; spam.setTime(arguments[0])",
                   t, "density", [0.5, 2.0])
    browser.wait_for_frame()
    legend = pixels(browser, "legend", [(k, 0) for k in range(256)])
    left, top, right, bottom, head, scale, mx, my = browser.script(
        "const q = spam.panels, p = q.panels[arguments[0]], low = [1e9, 1e9], high = [-1e9, -1e9];"
        "for (const c of spam.cases) for (const s of c.snapshots) for (const a of [0, 1]) {"
        "  low[a] = Math.min(low[a], s.low[a]); high[a] = Math.max(high[a], s.high[a]); }"
        "return [p.left, p.top, p.right, p.bottom, q.head, q.scale(), (low[0] + high[0]) / 2, (low[1] + high[1]) / 2]", number)
    reach = max(0.25 * scale, 1.8) + 1.5  # of a disc with its soft edge, and the half of a pixel
    places, densities = array_of(file, b"Points"), array_of(file, b"density")
    on_canvas = [((left + right) / 2 + (x[0] - mx) * scale, (top + head + bottom) / 2 - (x[1] - my) * scale) for x in places]
    free = [i for i, (x, y) in enumerate(on_canvas)
            if left + 9 < x < right - 9 and top + 40 < y < bottom - 9 and
            all(j == i or (x - u) ** 2 + (y - v) ** 2 > reach ** 2 for j, (u, v) in enumerate(on_canvas))][:20]
    assert len(free) >= 5, (case, free)
    for i, seen in zip(free, pixels(browser, "canvas", [map(int, on_canvas[i]) for i in free])):
        # Half-way between two colours either may be right.
        at = min(255.999, max(0.0, (densities[i][0] - 0.5) / 1.5 * 255.999))
        near = [legend[k] for k in {int(max(0, at - 0.02)), int(min(255, at + 0.02))}]
        assert seen in near, (case, i, at, near, seen)


def check_borders(browser):
    """Half-way between snapshots particles are inside the periodic box and near where they were: none crosses all of it."""
    wrong, crossing = browser.script(
        "const c = spam.cases[0]; let wrong = 0, crossing = 0;"
        "for (let k = 0; k + 1 < c.times.length; ++k) {"
        "  const s = c.snapshots[k], x0 = spam.numbers(s.points.position), x1 = spam.numbers(c.snapshots[k + 1].points.position);"
        "  const side = s.high[0] - s.low[0], reach = 1.5 * (c.times[k + 1] - c.times[k]);"
        "  const x = spam.frameOf(c, (c.times[k] + c.times[k + 1]) / 2, true).x;"
        "  for (let i = 0; i < 2 * s.n; ++i) {"
        "    const d = Math.abs(x[i] - x0[i]);"
        "    if (x[i] < s.low[0] || x[i] > s.high[0] || Math.min(d, side - d) > reach) ++wrong;"
        "    if (Math.abs(x1[i] - x0[i]) > side / 2) ++crossing;"
        "  } }"
        "return [wrong, crossing]")
    assert crossing > 20 and wrong == 0, (wrong, crossing)


def check_layout(browser):
    """All controls are in the window, none over another, and there is room for particles and for curves."""
    outside, over, width, height, curves = browser.script(
        "const boxes = [...document.querySelectorAll('nav button, #transport > *, #curves figure, aside')]"
        "  .map(e => [e.id || e.tagName, e.getBoundingClientRect()]).filter(([, b]) => b.width);"
        "const outside = boxes.filter(([, b]) => b.left < 0 || b.top < 0 || b.right > innerWidth + 0.5 || b.bottom > innerHeight + 0.5);"
        "const over = []; for (const [m, a] of boxes) for (const [n, b] of boxes)"
        "  if (m < n && a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1) over.push([m, n]);"
        "const stage = document.getElementById('stage').getBoundingClientRect();"
        "return [outside.map(([name]) => name), over, stage.width, stage.height,"
        "        [...document.querySelectorAll('#curves .u-over')].map(e => [e.clientWidth, e.clientHeight])]")
    assert not outside and not over, (outside, over)
    assert width > 300 and height > 200, (width, height)
    assert curves and all(w > 60 and h > 50 for w, h in curves), curves
    # Names are whole, or end in an ellipsis; those of panels end before the panel does.
    cut = browser.script("return [...document.querySelectorAll('h1, nav button, #transport *, #curves figcaption')].filter(e =>"
                         "  e.tagName !== 'OPTION' && e.scrollHeight > e.clientHeight + 2 && e.clientHeight).map(e => e.textContent)")
    assert not cut, cut
    for right, row in browser.script("const q = spam.panels; return q.panels.map(p => [p.right, p.top + 15 * q.ratio])"):
        edge = pixels(browser, "canvas", [(right - 6 + k, row) for k in range(5)])
        assert edge == edge[:1] * 5, (right, edge)


def text(browser, id):
    return browser.script("return document.getElementById(arguments[0]).textContent", id)


def check_controls(browser, page):
    number = lambda: browser.script("return spam.state.t")
    browser.script("spam.setTime(0)")
    browser.wait_for_frame()
    before = drawn(browser)
    browser.click("#play")
    time.sleep(0.5)
    playing = drawn(browser)
    browser.click("#play")
    stopped = number()
    assert stopped > 0 and playing != before, "playing moves nothing"
    assert "cubic" in text(browser, "how") or "positions" in text(browser, "how"), text(browser, "how")
    browser.wait_for_frame()
    assert number() == stopped, "it plays on"
    browser.click("#between")
    assert text(browser, "how") == "computed states", text(browser, "how")
    # The field, by the keys of the list and by the page's own.
    for press in ("ArrowDown", "f"):
        before = browser.script("document.getElementById('field').focus(); return spam.state.field"), drawn(browser)
        if press == "f":
            browser.script("document.activeElement.blur()")
        browser.key("\ue015" if press == "ArrowDown" else press)
        after = browser.script("return spam.state.field"), drawn(browser)
        assert before[0] != after[0] and before[1] != after[1], (press, before, after)
        assert browser.script("return document.getElementById('field').value") == after[0]
    # A click on a curve sets the time.
    x, y, width = browser.script("const b = document.querySelector('#curves .u-over').getBoundingClientRect();"
                                 "return [b.left, b.top + b.height / 2, b.width]")
    browser.click((x + 0.75 * width, y))
    end = browser.script("return Math.max(...spam.cases[0].times)")
    assert abs(number() - 0.75 * end) < 0.03 * end, (number(), end)
    # A particle in the middle of a panel, its values, and the address.
    browser.script("spam.setTime(0)")
    browser.wait_for_frame()
    browser.click(browser.script("const p = spam.panels.panels[0], b = spam.panels.canvas.getBoundingClientRect();"
                                 "return [b.left + p.x[3], b.top + p.y[3]]"))
    picked = browser.script("return [spam.state.pick, spam.numbers(spam.cases[0].snapshots[0].id)[3]]")
    assert picked[0] == picked[1], picked
    assert f"id {picked[0]}" in text(browser, "particle")
    # Dragging moves, the wheel magnifies.
    look = lambda: browser.script("return [spam.state.x, spam.state.zoom]") + [drawn(browser)]
    before = look()
    browser.drag(browser.middle("#canvas"), 60, 10)
    moved = look()
    assert moved[0] != before[0] and moved[1] == before[1] and moved[2] != before[2], (before, moved)
    browser.wheel(browser.middle("#canvas"), -300)
    near = look()
    assert near[1] > moved[1] and near[2] != moved[2], (moved, near)
    length = browser.script("return spam.picture().toDataURL().length")
    assert length > 5000, length
    # The address leads back to what is shown.
    time.sleep(0.5)
    shown = browser.script("return location.hash")
    assert f"pick={picked[0]}" in shown and "zoom" not in shown, shown
    open_page(browser, page, shown)
    assert browser.script("return spam.address()") == shown


def check_dark(browser, page, dark):
    """As the system prefers, in the page and under the particles, until the button is pressed."""
    open_page(browser, page)
    grounds = lambda: [min(pixel(browser, 2, browser.script("return spam.panels.canvas.height") - 2)),
                       browser.script("return Number(getComputedStyle(document.body).backgroundColor.match(/\\d+/)[0])")]
    is_dark = lambda: [ground < 60 for ground in grounds()]
    assert is_dark() == [dark, dark], grounds()
    browser.click("#theme")
    assert is_dark() == [not dark, not dark], grounds()


def check_address(browser, page):
    # Names that every object of JavaScript has are no settings.
    open_page(browser, page, "#constructor=1&map=toString&t=3&field=speed&range=0,7&dark=1&between=0")
    seen = browser.script("const s = spam.state; return [s.t, s.field, ...s.range, s.dark, s.between]")
    assert seen == [3, "speed", 0, 7, True, False], seen
    ground = pixel(browser, 2, browser.script("return spam.panels.canvas.height") - 2)
    assert max(ground) < 60, ground


def check_elements(browser, folder):
    """Elements are filled with the colour of their own values; discs only where a particle belongs to none."""
    browser.script("spam.setField('energy'); spam.setTime(spam.cases[0].times[0] + 1e-9)")
    browser.wait_for_frame()
    ground = pixel(browser, 2, 2)
    centres = browser.script(
        "const p = spam.panels.panels[0], q = spam.numbers(spam.cases[0].snapshots[0].corners), out = [];"
        "for (let k = 0; k < q.length; k += 4) out.push([p.x, p.y].map(v => (v[q[k]] + v[q[k + 1]] + v[q[k + 2]] + v[q[k + 3]]) / 4));"
        "return out")
    assert len(centres) == len(array_of(folder / "snapshot_0000.vtp", b"energy"))
    filled = sum(seen != ground for seen in pixels(browser, "canvas", [map(int, c) for c in centres[::7]]))
    assert filled == len(centres[::7]), (filled, len(centres))


def check_turning(browser):
    state = lambda: [browser.script("return spam.state.turn"), drawn(browser)]
    before = state()
    browser.drag(browser.middle("#canvas"), 80, 30)
    after = state()
    assert before[0] != after[0] and before[1] != after[1]
    length = sum(v * v for v in after[0])
    assert abs(length - 3) < 1e-9, length  # still a rotation


def check_all(browser, webgl, width, height, dark, pages):
    browser.open("about:blank")
    has_webgl = browser.script("return document.createElement('canvas').getContext('webgl') !== null")
    assert webgl or not has_webgl
    print(f"{browser.name}, {width}x{height}, {'dark' if dark else 'light'}, {'with' if has_webgl else 'without'} WebGL", flush=True)
    browser.resize(width, height)
    browser.prefer_dark(dark)
    browser.console(), browser.requests()
    hexagon, gas, plate, bar = (pages[name] for name in ("hexagon", "gas", "plate", "bar"))
    check_first_frame(browser, hexagon)
    check_layout(browser)
    check_particles(browser, hexagon.parent / "plain", "plain", 3, 1)
    check_quiet(browser, hexagon.parents[1])
    open_page(browser, gas)
    check_particles(browser, gas.parent, "gas", 0, 5)
    check_borders(browser)
    check_quiet(browser, gas.parents[1])
    open_page(browser, hexagon)
    check_controls(browser, hexagon)
    open_page(browser, plate)
    check_elements(browser, plate.parent)
    open_page(browser, bar)
    check_turning(browser)
    check_dark(browser, hexagon, dark)
    check_address(browser, hexagon)
    check_quiet(browser, hexagon.parents[1])


def main():
    spam_view, hexagon, expansion, plate, bar, work = sys.argv[1:]
    absent = {kind: kind.absent() for kind in (Chromium, Firefox)}
    for why in filter(None, absent.values()):
        print(why)
    if all(absent.values()):
        sys.exit(77)
    work = pathlib.Path(work).absolute()
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    pages = {}
    for name, program, more in (("hexagon", hexagon, ["--turns", "0.02", "--snapshot-every", "1"]),
                                ("gas", expansion, ["--cells", "16", "--t-end", "20", "--snapshot-every", "4"]),
                                ("plate", plate, ["--model", "elements", "--smoke"]), ("bar", bar, ["--smoke"])):
        ran = subprocess.run([program, *more, "--no-plots", "--quiet", "--out", name], cwd=work, capture_output=True, text=True)
        assert (work / name / "result.json").exists(), ran.stderr
        subprocess.run([spam_view, name], cwd=work, check=True)
        pages[name] = work / name / "view.html"
        assert pages[name].stat().st_size < 1e6
    for kind in (kind for kind, why in absent.items() if not why):
        for with_webgl in (True, False):
            browser = kind(with_webgl)
            try:
                for webgl, width, height, dark in rounds:
                    if webgl == with_webgl:
                        check_all(browser, webgl, width, height, dark, pages)
            finally:
                browser.quit()


main()
