# SPDX-License-Identifier: GPL-3.0-or-later
"""How fast a page plays in Chromium: frames.py PAGE. Says frames a second and milliseconds of work a frame; on a machine
with other work the first says little. Needs chromium, chromium-driver and python3-selenium."""
import pathlib
import sys

from selenium import webdriver
from selenium.webdriver.chrome.service import Service

PLAY = """
const done = arguments[0], begin = performance.now();
let frames = 0;
spam.costs.length = 0;
function count() {
  frames += 1;
  if (!spam.state.playing) { spam.setTime(0); spam.play(true); }
  const passed = performance.now() - begin;
  if (passed < 6000) return requestAnimationFrame(count);
  const work = [...spam.costs].sort((a, b) => a - b);
  done([1000 * frames / passed, work[work.length >> 1], work[Math.floor(0.9 * work.length)]]);
}
requestAnimationFrame(count);
"""

options = webdriver.ChromeOptions()
for word in ("--headless=new", "--no-sandbox", "--window-size=1440,900"):
    options.add_argument(word)
options.binary_location = "/usr/bin/chromium"
driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
try:
    driver.get(pathlib.Path(sys.argv[1]).resolve().as_uri())
    driver.set_script_timeout(60)
    frames, median, most = driver.execute_async_script(PLAY)
    print(f"{frames:.1f} frames a second; work of a frame {median:.2f} ms, nine in ten below {most:.2f} ms")
finally:
    driver.quit()
