# SPDX-License-Identifier: GPL-3.0-or-later
"""Chromium and Firefox, headless, behind the same few functions: what a test of a page asks of a browser."""
import json
import shutil

import marionette

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
except ImportError:
    webdriver = None


class Browser:
    """What both do alike. A browser has open, script, script_later (which calls its last argument when it has ended),
    resize, prefer_dark, act, console, requests and quit."""

    def wait_for_frame(self):
        """Two frames: what was asked for before is drawn. Returns milliseconds since the page was asked for."""
        return self.script_later("const done = arguments[0];"
                                 "requestAnimationFrame(() => requestAnimationFrame(() => done(performance.now())))")

    def resize(self, width, height):
        """Makes the part of the window that shows the page so large."""
        for _ in range(3):
            dx, dy = self.script("return [arguments[0] - innerWidth, arguments[1] - innerHeight]", width, height)
            if not dx and not dy:
                return
            self.resize_window(dx, dy)
            self.wait_for_frame()
        raise AssertionError(f"{self.name} makes no window of {width}x{height}")

    def middle(self, selector):
        return self.script("const b = document.querySelector(arguments[0]).getBoundingClientRect();"
                           "return [b.left + b.width / 2, b.top + b.height / 2].map(Math.round)", selector)

    def point(self, *steps):
        """Steps of the mouse: a place to go to, 'down' or 'up'."""
        actions = [{"type": "pointer" + step.capitalize(), "button": 0} if isinstance(step, str) else
                   {"type": "pointerMove", "x": round(step[0]), "y": round(step[1]), "origin": "viewport", "duration": 20}
                   for step in steps]
        self.act({"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": actions})

    def click(self, place):
        """Clicks a place of the page, or the middle of what a selector finds."""
        self.point(self.middle(place) if isinstance(place, str) else place, "down", "up")
        self.wait_for_frame()

    def drag(self, place, dx, dy):
        x, y = place
        self.point(place, "down", (x + dx / 2, y + dy / 2), (x + dx, y + dy), "up")
        self.wait_for_frame()

    def wheel(self, place, dy):
        self.act({"type": "wheel", "id": "wheel", "actions": [
            {"type": "scroll", "x": place[0], "y": place[1], "deltaX": 0, "deltaY": dy, "origin": "viewport"}]})
        self.wait_for_frame()

    def key(self, value):
        self.act({"type": "key", "id": "keys", "actions": [{"type": "keyDown", "value": value},
                                                           {"type": "keyUp", "value": value}]})
        self.wait_for_frame()


class Chromium(Browser):
    name = "Chromium"
    program = shutil.which("chromium") or shutil.which("chromium-browser")
    driver_program = shutil.which("chromedriver")

    @classmethod
    def absent(cls):
        """Why it cannot be used here; None where it can."""
        if not webdriver:
            return "python3-selenium is not installed (Debian: chromium, chromium-driver, python3-selenium)"
        if not cls.program or not cls.driver_program:
            return "chromium or its driver is not installed (Debian: chromium, chromium-driver)"
        return None

    def __init__(self, webgl):
        options = webdriver.ChromeOptions()
        options.binary_location = self.program
        without = ["--disable-gpu", "--disable-3d-apis"]
        for argument in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--force-device-scale-factor=1",
                         *(["--enable-unsafe-swiftshader"] if webgl else without)):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service(self.driver_program), options=options)

    def open(self, url):
        self.driver.get(url)

    def script(self, source, *arguments):
        return self.driver.execute_script(source, *arguments)

    def script_later(self, source, *arguments):
        return self.driver.execute_async_script(source, *arguments)

    def resize_window(self, dx, dy):
        size = self.driver.get_window_size()
        self.driver.set_window_size(size["width"] + dx, size["height"] + dy)

    def prefer_dark(self, dark):
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [
            {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]})

    def act(self, *devices):
        self.driver.execute("actions", {"actions": list(devices)})

    def console(self):
        """Lines since it was asked for them the last time."""
        return [line["message"] for line in self.driver.get_log("browser")]

    def requests(self):
        """Addresses since it was asked for them the last time."""
        asked = (json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance"))
        return [one["params"]["request"]["url"] for one in asked if one["method"] == "Network.requestWillBeSent"]

    def quit(self):
        self.driver.quit()


class Firefox(Browser):
    name = "Firefox"
    program = shutil.which("firefox-esr") or shutil.which("firefox")
    # Nothing leaves the machine, whatever Firefox itself would like to ask for.
    preferences = {"network.proxy.type": 1, "network.proxy.http": "127.0.0.1", "network.proxy.http_port": 9,
                   "network.proxy.ssl": "127.0.0.1", "network.proxy.ssl_port": 9, "app.normandy.enabled": False,
                   "browser.startup.page": 0, "layout.css.devPixelsPerPx": "1.0", "ui.useOverlayScrollbars": 0}
    # Channels that a page opens, not those of Firefox itself: these belong to no tab and are its own wish.
    watch = """
        globalThis.asked = [];
        globalThis.watcher = {observe(channel) {
            channel.QueryInterface(Ci.nsIChannel);
            const about = channel.loadInfo, by = about?.triggeringPrincipal;
            if (!about || about.browsingContextID || !by || !by.isSystemPrincipal) asked.push(channel.URI.spec);
        }};
        for (const topic of ['http-on-opening-request', 'file-channel-opened', 'data-channel-opened'])
            Services.obs.addObserver(watcher, topic);"""

    @classmethod
    def absent(cls):
        """Why it cannot be used here; None where it can."""
        return None if cls.program else "firefox is not installed (Debian: firefox-esr)"

    def __init__(self, webgl):
        self.firefox = marionette.Firefox(self.program, {**self.preferences, "webgl.disabled": not webgl})
        try:
            self.firefox.as_chrome(self.watch)
        except BaseException:
            self.quit()
            raise

    def open(self, url):
        self.firefox.call("WebDriver:Navigate", {"url": url})

    def script(self, source, *arguments):
        return self.firefox.call("WebDriver:ExecuteScript", {"script": source, "args": list(arguments)})

    def script_later(self, source, *arguments):
        return self.firefox.call("WebDriver:ExecuteAsyncScript",
                                 {"script": source, "args": list(arguments)})

    def resize_window(self, dx, dy):
        now = self.firefox.call("WebDriver:GetWindowRect")
        self.firefox.call("WebDriver:SetWindowRect", {"width": now["width"] + dx, "height": now["height"] + dy})

    def prefer_dark(self, dark):
        self.firefox.as_chrome("Services.prefs.setIntPref('layout.css.prefers-color-scheme.content-override', arguments[0])",
                               0 if dark else 1)

    def act(self, *devices):
        self.firefox.call("WebDriver:PerformActions", {"actions": list(devices)})

    def console(self):
        """Lines since it was asked for them the last time: what the page has said by console, kept in its own process,
        and errors and warnings of scripts, styles and rules of security, kept in Firefox's."""
        own = r"/^(chrome|resource):/"
        said = self.firefox.call("WebDriver:ExecuteScript", {"sandbox": "system", "args": [], "script": f"""
            const store = Components.classes['@mozilla.org/consoleAPI-storage;1']
                                    .getService(Components.interfaces.nsIConsoleAPIStorage);
            const lines = store.getEvents().filter(e => !{own}.test(e.filename))
                               .map(e => e.level + ': ' + e.arguments.map(String).join(' '));
            store.clearEvents();
            return lines;"""})
        return said + self.firefox.as_chrome(f"""
            const lines = [];
            for (const message of Services.console.getMessageArray()) {{
                if (!(message instanceof Ci.nsIScriptError)) continue;
                if (message.isFromChromeContext || {own}.test(message.sourceName)) continue;
                lines.push(message.errorMessage + ' (' + message.sourceName + ')');
            }}
            Services.console.reset();
            return lines;""")

    def requests(self):
        """Addresses since it was asked for them the last time."""
        return self.firefox.as_chrome("return asked.splice(0)")

    def quit(self):
        self.firefox.quit()
