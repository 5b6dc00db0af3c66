# SPDX-License-Identifier: GPL-3.0-or-later
# The pages of two runs in a headless Chromium, without WebGL: no request but for the page itself, nothing on the
# console, particles where and in the colours that their values say, controls that work.
# browser.py <spam-view> <rotating_hexagon> <free_expansion> <ball_plate> <taylor_bar> <work folder>; exit status 77: no browser.
import array
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import time

chromium = shutil.which("chromium") or shutil.which("chromium-browser")
driver_program = shutil.which("chromedriver")
try:
    from selenium import webdriver
    from selenium.webdriver import ActionChains
    from selenium.webdriver.chrome.service import Service
except ImportError:
    print("python3-selenium is not installed (Debian: chromium, chromium-driver, python3-selenium)")
    sys.exit(77)
if not chromium or not driver_program:
    print("chromium or its driver is not installed (Debian: chromium, chromium-driver)")
    sys.exit(77)


def browser(width, height, *more):
    options = webdriver.ChromeOptions()
    options.binary_location = chromium
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-3d-apis", "--disable-dev-shm-usage",
                     "--force-device-scale-factor=1", f"--window-size={width},{height}", *more):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(service=Service(driver_program), options=options)


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


def wait_for_frame(driver):
    """Two frames: what was asked for before is drawn."""
    driver.execute_async_script("requestAnimationFrame(() => requestAnimationFrame(arguments[0]))")


def check_quiet(driver, page):
    lines = [line for line in driver.get_log("browser")]
    assert not lines, lines
    asked = re.findall(r'"url":"([^"]+)"', "".join(entry["message"] for entry in driver.get_log("performance")
                                                   if "Network.requestWillBeSent" in entry["message"]))
    strangers = [url for url in asked if not url.startswith((page.as_uri(), "data:", "blob:"))]
    assert asked and not strangers, strangers


def pixel(driver, x, y):
    return read_canvas(driver, "canvas", x, y, 1)


def read_canvas(driver, name, x, y, width):
    """Pixels of a row, from a copy: reading the canvas itself often would make the browser complain and change how it draws."""
    rgba = driver.execute_script("const copy = document.createElement('canvas').getContext('2d', {willReadFrequently: true});"
                                 "copy.canvas.width = arguments[3]; copy.canvas.height = 1;"
                                 "copy.drawImage(document.getElementById(arguments[0]), -arguments[1], -arguments[2]);"
                                 "return [...copy.getImageData(0, 0, arguments[3], 1).data]", name, x, y, width)
    return [channel for k, channel in enumerate(rgba) if k % 4 < 3]


def check_particles(driver, folder, case, number, snapshot):
    """The pixel at the middle of particles has the colour that the legend has at their density."""
    file = folder / f"snapshot_{snapshot:04d}.vtp"
    t = float(re.findall(r'timestep="([^"]+)"', (folder / "snapshots.pvd").read_text())[snapshot])
    driver.execute_script("spam.setField(arguments[1]); spam.state.percent = 'typed'; spam.state.range = arguments[2];"
                          "spam.state.size = Math.max(0.5, 3.6 / spam.panels.scale()); spam.state.box = false; spam.setTime(arguments[0])", t, "density", [0.5, 2.0])
    wait_for_frame(driver)
    legend = read_canvas(driver, "legend", 0, 0, 256)
    left, top, right, bottom, head, scale, mx, my = driver.execute_script(
        "const q = spam.panels, p = q.panels[arguments[0]], low = [1e9, 1e9], high = [-1e9, -1e9];"
        "for (const c of spam.cases) for (const s of c.snapshots) for (const a of [0, 1]) {"
        "  low[a] = Math.min(low[a], s.low[a]); high[a] = Math.max(high[a], s.high[a]); }"
        "return [p.left, p.top, p.right, p.bottom, q.head, q.scale(), (low[0] + high[0]) / 2, (low[1] + high[1]) / 2]", number)
    reach = max(0.25 * scale, 1.8) + 1.5  # of a disc with its soft edge, and the half of a pixel
    places, densities = array_of(file, b"Points"), array_of(file, b"density")
    on_canvas = [((left + right) / 2 + (x[0] - mx) * scale, (top + head + bottom) / 2 - (x[1] - my) * scale) for x in places]
    checked = 0
    for i, (x, y) in enumerate(on_canvas):
        alone = all(j == i or (x - u) ** 2 + (y - v) ** 2 > reach ** 2 for j, (u, v) in enumerate(on_canvas))
        if not alone or checked == 20 or not (left + 9 < x < right - 9 and top + 40 < y < bottom - 9):
            continue
        # Half-way between two colours either may be right.
        at = min(255.999, max(0.0, (densities[i][0] - 0.5) / 1.5 * 255.999))
        near = [legend[3 * k:3 * k + 3] for k in {int(max(0, at - 0.02)), int(min(255, at + 0.02))}]
        assert pixel(driver, int(x), int(y)) in near, (case, i, at, near, pixel(driver, int(x), int(y)))
        checked += 1
    assert checked >= 5, (case, checked)


def check_borders(driver):
    """Half-way between snapshots particles are inside the periodic box and near where they were: none crosses all of it."""
    wrong, crossing = driver.execute_script(
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


def text(driver, id):
    return driver.execute_script("return document.getElementById(arguments[0]).textContent", id)


def check_controls(driver, seconds):
    number = lambda: driver.execute_script("return spam.state.t")
    driver.execute_script("spam.setTime(0)")
    driver.find_element("id", "play").click()
    time.sleep(seconds)
    driver.find_element("id", "play").click()
    assert number() > 0, "playing moves no time"
    assert "cubic" in text(driver, "how") or "positions" in text(driver, "how"), text(driver, "how")
    driver.find_element("id", "between").click()
    wait_for_frame(driver)
    assert text(driver, "how") == "computed states", text(driver, "how")
    # A click on a curve sets the time.
    over = driver.find_element("css selector", "#curves .u-over")
    ActionChains(driver).move_to_element_with_offset(over, over.size["width"] // 4, 0).click().perform()
    end = driver.execute_script("return Math.max(...spam.cases[0].times)")
    assert abs(number() - 0.75 * end) < 0.03 * end, (number(), end)
    # A particle in the middle of a panel, its values, and the address.
    canvas = driver.find_element("id", "canvas")
    driver.execute_script("spam.setTime(0)")
    wait_for_frame(driver)
    x, y = driver.execute_script("const p = spam.panels.panels[0], b = spam.panels.canvas.getBoundingClientRect();"
                                 "return [b.left + p.x[3], b.top + p.y[3]].map(Math.round)")
    ActionChains(driver).w3c_actions.pointer_action.move_to_location(x, y)
    chain = ActionChains(driver)
    chain.w3c_actions.pointer_action.move_to_location(x, y).click()
    chain.perform()
    wait_for_frame(driver)
    picked = driver.execute_script("return [spam.state.pick, spam.numbers(spam.cases[0].snapshots[0].id)[3]]")
    assert picked[0] == picked[1], picked
    assert f"id {picked[0]}" in text(driver, "particle")
    # Dragging moves, the wheel magnifies.
    before = driver.execute_script("return [spam.state.x, spam.state.zoom]")
    ActionChains(driver).drag_and_drop_by_offset(canvas, 60, 10).scroll_from_origin(
        webdriver.common.actions.wheel_input.ScrollOrigin.from_element(canvas), 0, -300).perform()
    after = driver.execute_script("return [spam.state.x, spam.state.zoom]")
    assert after[0] != before[0] and after[1] > before[1], (before, after)
    time.sleep(0.5)
    assert f"pick={picked[0]}" in driver.current_url and "zoom" not in driver.current_url, driver.current_url
    picture = driver.execute_script("return spam.picture().toDataURL().length")
    assert picture > 5000, picture


def check_address(driver, page):
    driver.get("about:blank")
    driver.get(page.as_uri() + "#t=3&field=speed&range=0,7&dark=1&between=0")
    wait_for_frame(driver)
    seen = driver.execute_script("const s = spam.state; return [s.t, s.field, ...s.range, s.dark, s.between]")
    assert seen == [3, "speed", 0, 7, True, False], seen
    ground = pixel(driver, 2, driver.execute_script("return spam.panels.canvas.height") - 2)
    assert max(ground) < 60, ground


def check_elements(driver, folder):
    """Elements are filled with the colour of their own values; discs only where a particle belongs to none."""
    driver.execute_script("spam.setField('energy'); spam.setTime(spam.cases[0].times[0] + 1e-9)")
    wait_for_frame(driver)
    ground = pixel(driver, 2, 2)
    centres = driver.execute_script(
        "const p = spam.panels.panels[0], q = spam.numbers(spam.cases[0].snapshots[0].corners), out = [];"
        "for (let k = 0; k < q.length; k += 4) out.push([p.x, p.y].map(v => (v[q[k]] + v[q[k + 1]] + v[q[k + 2]] + v[q[k + 3]]) / 4));"
        "return out")
    assert len(centres) == len(array_of(folder / "snapshot_0000.vtp", b"energy"))
    filled = sum(pixel(driver, int(x), int(y)) != ground for x, y in centres[::7])
    assert filled == len(centres[::7]), (filled, len(centres))


def check_turning(driver):
    canvas = driver.find_element("id", "canvas")
    state = lambda: driver.execute_script("return [spam.state.turn, spam.panels.raster.pixels.reduce((a, b) => (a * 31 + b) >>> 0, 7)]")
    wait_for_frame(driver)
    before = state()
    ActionChains(driver).drag_and_drop_by_offset(canvas, 80, 30).perform()
    wait_for_frame(driver)
    after = state()
    assert before[0] != after[0] and before[1] != after[1]
    length = sum(v * v for v in after[0])
    assert abs(length - 3) < 1e-9, length  # still a rotation


def main():
    spam_view, hexagon, expansion, plate, bar, work = sys.argv[1:]
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
    for width, height in ((1440, 900), (800, 500), (2560, 1440)):
        driver = browser(width, height)
        try:
            begin = time.time()
            driver.get(pages["hexagon"].as_uri())
            wait_for_frame(driver)
            print(f"{width}x{height}: first frame after {time.time() - begin:.2f} s")
            check_particles(driver, work / "hexagon/plain", "plain", 3, 1)
            driver.get(pages["gas"].as_uri())
            wait_for_frame(driver)
            check_particles(driver, work / "gas", "gas", 0, 5)
            check_borders(driver)
            check_quiet(driver, pages["gas"].parent.parent)
            if width == 1440:
                driver.get(pages["hexagon"].as_uri())
                check_controls(driver, 1.0)
                driver.get(pages["plate"].as_uri())
                check_elements(driver, work / "plate")
                driver.get(pages["bar"].as_uri())
                check_turning(driver)
                check_address(driver, pages["hexagon"])
                check_quiet(driver, pages["gas"].parent.parent)
        finally:
            driver.quit()


main()
