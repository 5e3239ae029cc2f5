"""A browser over the WebDriver protocol (W3C WebDriver; Debian's chromium-driver), with no other package than the standard
library."""

import json
import re
import subprocess
import urllib.error
import urllib.request

PROGRAM = "/usr/bin/chromedriver"


class Browser:
    """Chromium without a window. Console and network go to logs that `console` and `requests` read."""

    def __init__(self, width, height):
        self.process = subprocess.Popen([PROGRAM, "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.base = None
        for line in self.process.stdout:
            if port := re.search(r"started successfully on port (\d+)", line):
                self.base = f"http://127.0.0.1:{port.group(1)}"
                break
        arguments = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run",
                     "--disable-background-networking", "--disable-component-update"]
        options = {"args": [*arguments, f"--window-size={width},{height}"]}
        if width < 600:
            options["mobileEmulation"] = {"deviceMetrics": {"width": width, "height": height, "pixelRatio": 2.0}}
        found = self._ask("POST", "/session", {"capabilities": {"alwaysMatch": {
            "browserName": "chrome", "goog:chromeOptions": options,
            "goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"}}}})
        self.session = f"/session/{found['sessionId']}"

    def _ask(self, method, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.base + path, data, {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=60) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise AssertionError(json.load(error)["value"]["message"]) from None

    def open(self, path):
        self._ask("POST", f"{self.session}/url", {"url": path.resolve().as_uri()})

    def run(self, script, *arguments):
        """Value of a function body in the page."""
        return self._ask("POST", f"{self.session}/execute/sync", {"script": script, "args": list(arguments)})

    def type(self, css, text):
        self._ask("POST", f"{self.session}/element/{self._element(css)}/value", {"text": text})

    def press(self, key):
        self._ask("POST", f"{self.session}/actions", {"actions": [{"type": "key", "id": "keyboard", "actions": [
            {"type": "keyDown", "value": key}, {"type": "keyUp", "value": key}]}]})

    def _element(self, css):
        return next(iter(self._ask("POST", f"{self.session}/element", {"using": "css selector", "value": css}).values()))

    @property
    def title(self):
        return self._ask("GET", f"{self.session}/title")

    def console(self):
        """Messages of warnings and errors since the last call."""
        return [m["message"] for m in self._ask("POST", f"{self.session}/se/log", {"type": "browser"})
                if m["level"] in ("SEVERE", "WARNING")]

    def requests(self):
        """Addresses that pages asked for since the last call."""
        events = [json.loads(m["message"])["message"] for m in self._ask("POST", f"{self.session}/se/log",
                {"type": "performance"})]
        return [e["params"]["request"]["url"] for e in events if e["method"] == "Network.requestWillBeSent"]

    def close(self):
        try:
            self._ask("DELETE", self.session)
        finally:
            self.process.terminate()
            self.process.wait(timeout=20)
            self.process.stdout.close()
