"""A headless Chromium that a test drives: what a reader does and sees, with nothing but the standard
library. Speaks the DevTools protocol through a pair of pipes, so that no port is opened.
"""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile

NAMES = ("chromium", "chromium-browser", "google-chrome")


def find_browser():
    """The path of a Chromium, or None."""
    return next(filter(None, map(shutil.which, NAMES)), None)


class Browser:
    """One tab. Keeps what the page reports: `errors` (console, exceptions, refused by policy) and
    `requests` (all addresses that were asked for)."""

    def __init__(self, limit_s=120):
        self.limit_s = limit_s
        self.errors, self.requests = [], []
        self._number, self._waiting, self._rest = 0, {}, b""
        self._profile = tempfile.mkdtemp(prefix="gene-clocks-browser-")
        to_browser, self._write = os.pipe()
        self._read, from_browser = os.pipe()
        command = [find_browser(), "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run",
                   "--disable-background-networking", "--disable-extensions", "--hide-scrollbars",
                   "--force-color-profile=srgb", "--remote-debugging-pipe",
                   f"--user-data-dir={self._profile}", "about:blank"]

        def take_pipes():  # the protocol's: it reads from 3 and writes to 4
            os.dup2(to_browser, 103)  # by way of others, for the pipes may be 3 or 4 themselves
            os.dup2(from_browser, 104)
            os.dup2(103, 3)
            os.dup2(104, 4)

        self._process = subprocess.Popen(command, preexec_fn=take_pipes, close_fds=False,
                                         stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                         stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self._session = None
        targets = self.send("Target.getTargets")["targetInfos"]
        tab = next(target["targetId"] for target in targets if target["type"] == "page")
        self._session = self.send("Target.attachToTarget", targetId=tab, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network", "Audits"):
            self.send(f"{domain}.enable")

    def close(self):
        os.close(self._write)
        os.close(self._read)
        self._process.terminate()
        self._process.wait()
        shutil.rmtree(self._profile, ignore_errors=True)

    def _receive(self):
        while b"\0" not in self._rest:
            if not select.select([self._read], [], [], self.limit_s)[0]:
                raise TimeoutError("the browser does not answer")
            part = os.read(self._read, 1 << 20)
            if not part:
                raise ConnectionError("the browser has ended")
            self._rest += part
        message, self._rest = self._rest.split(b"\0", 1)
        message = json.loads(message)
        self._note(message.get("method"), message.get("params", {}))
        return message

    def _note(self, method, event):
        if method == "Runtime.exceptionThrown":
            details = event["exceptionDetails"]
            self.errors.append(details.get("exception", {}).get("description", details["text"]))
        elif method == "Runtime.consoleAPICalled" and event["type"] in ("error", "warning", "assert"):
            self.errors.append(str(event["args"]))
        elif method == "Log.entryAdded" and event["entry"]["level"] in ("error", "warning"):
            self.errors.append(event["entry"]["text"])
        elif method == "Audits.issueAdded":
            self.errors.append(json.dumps(event["issue"]))
        elif method == "Network.requestWillBeSent":
            self.requests.append(event["request"]["url"])

    def send(self, method, **parameters):
        """Sends a command and returns its result."""
        self._number += 1
        message = {"id": self._number, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._write, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._receive()
            if answer.get("id") == self._number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']['message']}")
                return answer["result"]

    def wait_for(self, method):
        while self._receive().get("method") != method:
            pass

    def open(self, address, width=1280, height=900, dark=False, scale=1):
        """Opens a page in a window of that size and waits until it is loaded."""
        self.send("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=scale, mobile=width < 600)
        self.send("Emulation.setEmulatedMedia", features=[
            {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])
        self.send("Page.navigate", url="about:blank")
        self.wait_for("Page.loadEventFired")
        self.errors.clear()
        self.requests.clear()
        self.send("Page.navigate", url=address)
        self.wait_for("Page.loadEventFired")

    def evaluate(self, expression):
        """The value of a JavaScript expression, promises awaited."""
        result = self.send("Runtime.evaluate", expression=expression, returnByValue=True,
                           awaitPromise=True)
        if "exceptionDetails" in result:
            raise AssertionError(result["exceptionDetails"]["exception"].get("description"))
        return result["result"].get("value")

    def frame(self):
        """Lets the page draw once."""
        self.evaluate("new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)))")

    def middle_of(self, selector):
        """The middle of an element, which is scrolled into view."""
        place = self.evaluate(
            f"(() => {{ const e = document.querySelector({json.dumps(selector)});"
            " e.scrollIntoView({block: 'center', behavior: 'instant'});"
            " const r = e.getBoundingClientRect();"
            " return [r.x, r.y, r.width, r.height]; })()")
        return place[0] + place[2] / 2, place[1] + place[3] / 2

    def mouse(self, kind, x, y, buttons=0):
        self.send("Input.dispatchMouseEvent", type=kind, x=x, y=y, buttons=buttons,
                  button="none" if kind == "mouseMoved" and not buttons else "left",
                  clickCount=0 if kind == "mouseMoved" else 1)

    def drag(self, from_place, to_place):
        self.mouse("mouseMoved", *from_place)
        self.mouse("mousePressed", *from_place, buttons=1)
        self.mouse("mouseMoved", *to_place, buttons=1)
        self.mouse("mouseReleased", *to_place)
        self.frame()  # the browser hands moves on once for each frame

    def click(self, x, y):
        self.drag((x, y), (x, y))

    def click_on(self, selector):
        self.click(*self.middle_of(selector))

    def press(self, key, text=None, shift=False):
        event = {"key": key, "code": key if len(key) > 1 else "", "modifiers": 8 if shift else 0}
        self.send("Input.dispatchKeyEvent", type="keyDown", **event, **({"text": text} if text else {}))
        self.send("Input.dispatchKeyEvent", type="keyUp", **event)

    def screenshot(self, path, selector=None, whole_page=False):
        """Writes a PNG of what is on the screen, of one element or of the page from top to bottom."""
        clip = {}
        if selector:
            clip = {"clip": self.evaluate(
                f"(() => {{ const r = document.querySelector({json.dumps(selector)}).getBoundingClientRect();"
                " return {x: r.x + scrollX, y: r.y + scrollY, width: r.width, height: r.height, scale: 1}; })()")}
        picture = self.send("Page.captureScreenshot",
                            captureBeyondViewport=whole_page or selector is not None, **clip)
        with open(path, "wb") as file:
            file.write(base64.b64decode(picture["data"]))
