# SPDX-License-Identifier: GPL-3.0-or-later
"""A headless Firefox, driven by the protocol Marionette that every Firefox speaks on a port of its own: messages in
JSON, each behind its length, [0, number, command, parameters] there and [1, number, error, result] back."""
import json
import pathlib
import shutil
import socket
import subprocess
import tempfile
import time

patience = 120.0  # seconds for Firefox to start, and for any answer


class Refused(Exception):
    """Firefox answered a command with an error."""


class Firefox:
    """A Firefox with an empty profile and a session. `preferences`: name -> value, as in about:config."""

    def __init__(self, program, preferences):
        self.profile = pathlib.Path(tempfile.mkdtemp(prefix="spam-firefox-"))
        self.process = self.socket = None
        self.number, self.received = 0, b""
        # 0: a free port, which Firefox writes into the profile.
        lines = [f"user_pref({json.dumps(name)}, {json.dumps(value)});\n"
                 for name, value in {"marionette.port": 0, **preferences}.items()]
        (self.profile / "user.js").write_text("".join(lines), encoding="utf-8")
        self.output = open(self.profile / "output", "w+b")
        try:
            self.process = subprocess.Popen(
                [program, "--headless", "--no-remote", "--marionette", "--remote-allow-system-access",
                 "--profile", self.profile], stdout=self.output, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
            self.connect()
            self.call("WebDriver:NewSession", {"capabilities": {"alwaysMatch": {"acceptInsecureCerts": True}}})
        except BaseException:
            self.quit()
            raise

    def connect(self):
        end, port = time.monotonic() + patience, self.profile / "MarionetteActivePort"
        while not (port.is_file() and port.read_text().strip()):
            if self.process.poll() is not None or time.monotonic() > end:
                raise Refused("Firefox did not start: " + self.printed()[-2000:])
            time.sleep(0.05)
        self.socket = socket.create_connection(("127.0.0.1", int(port.read_text())), timeout=patience)
        greeting = self.receive()
        if greeting.get("marionetteProtocol") != 3:
            raise Refused(f"Firefox speaks another protocol: {greeting}")

    def receive(self):
        while True:
            length, colon, rest = self.received.partition(b":")
            if colon and len(rest) >= int(length):
                self.received = rest[int(length):]
                return json.loads(rest[:int(length)])
            more = self.socket.recv(1 << 20)
            if not more:
                raise Refused("Firefox has closed the connection: " + self.printed()[-2000:])
            self.received += more

    def call(self, command, parameters=None):
        self.number += 1
        message = json.dumps([0, self.number, command, parameters or {}]).encode()
        self.socket.sendall(b"%d:%s" % (len(message), message))
        _, number, error, result = self.receive()
        if error or number != self.number:
            raise Refused(f"{command}: {error}")
        return result["value"] if isinstance(result, dict) and "value" in result else result

    def as_chrome(self, source, *arguments):
        """Runs a script with the rights of Firefox itself, whose variables stay for the next one."""
        self.call("Marionette:SetContext", {"value": "chrome"})
        try:
            return self.call("WebDriver:ExecuteScript", {"script": source, "args": list(arguments), "sandbox": "spam",
                                                         "newSandbox": False})
        finally:
            self.call("Marionette:SetContext", {"value": "content"})

    def printed(self):
        """What Firefox has written to its output and its errors so far."""
        return (self.profile / "output").read_text(encoding="utf-8", errors="replace")

    def quit(self):
        try:
            if self.socket:
                self.call("Marionette:Quit", {"flags": ["eForceQuit"]})
                self.socket.close()
            elif self.process:
                self.process.kill()
            if self.process:
                self.process.wait(patience)
        except (OSError, Refused, subprocess.TimeoutExpired):
            self.process.kill()
            self.process.wait()
        finally:
            self.output.close()
            shutil.rmtree(self.profile, ignore_errors=True)
