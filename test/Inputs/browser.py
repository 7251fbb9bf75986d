"""Headless Chromium, driven over a pipe by its DevTools protocol (JSON, each message ended by a zero byte)."""

import base64
import json
import os
import subprocess
import time


class Browser:
    """reaches: what Chromium may connect to, as its rules for names of hosts except from finding nothing; options: further ones of Chromium."""

    def __init__(self, folder, width=1200, height=900, reaches=("127.0.0.1", "localhost"), options=("--disable-gpu",)):
        theirs_in, self.ours_out = os.pipe()
        self.ours_in, theirs_out = os.pipe()
        # Offline: everything that would call out is off, and names resolve to nothing. Chromium reads the protocol from
        # descriptor 3 and writes it to 4; both may be in use here.
        command = ["chromium", "--headless", "--no-sandbox", *options, "--disable-quic", "--no-first-run",
                   "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage",
                   "--host-resolver-rules=" + ", ".join(["MAP * ~NOTFOUND", *(f"EXCLUDE {name}" for name in reaches)]),
                   f"--user-data-dir={folder}/user",
                   f"--window-size={width},{height}", "--remote-debugging-pipe", "about:blank"]
        self.process = subprocess.Popen(
            ["bash", "-c", f'exec 8<&{theirs_in} 9>&{theirs_out} && exec 3<&8 4>&9 8<&- 9>&- && exec "$@"', "chromium", *command],
            pass_fds=(theirs_in, theirs_out), stdin=subprocess.DEVNULL, stderr=open(os.path.join(folder, "browser.log"), "w", encoding="utf-8"))
        os.close(theirs_in)
        os.close(theirs_out)
        self.rest, self.count, self.session, self.complaints = b"", 0, None, []
        target = next(t for t in self.send("Target.getTargets")["targetInfos"] if t["type"] == "page")
        self.session = self.send("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.send(domain + ".enable")

    def send(self, method, **parameters):
        """The result of a command; what scripts complain about in the meantime is kept in complaints."""
        self.count += 1
        message = {"id": self.count, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.ours_out, json.dumps(message).encode() + b"\0")
        while True:
            while b"\0" not in self.rest:
                more = os.read(self.ours_in, 1 << 20)
                assert more, "Chromium has ended"
                self.rest += more
            text, self.rest = self.rest.split(b"\0", 1)
            said = json.loads(text)
            if said.get("id") == self.count:
                assert "error" not in said, said
                return said["result"]
            self.hear(said.get("method"), said.get("params"))

    def hear(self, method, parameters):
        """What the browser tells by itself."""
        if method == "Runtime.exceptionThrown":
            self.complaints.append(parameters["exceptionDetails"])
        elif method == "Log.entryAdded" and parameters["entry"]["level"] == "error":
            self.complaints.append(parameters["entry"])

    def open(self, address):
        self.send("Page.navigate", url=address)

    def value(self, expression):
        answer = self.send("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in answer, answer["exceptionDetails"]
        return answer["result"].get("value")

    def wait(self, expression, seconds=60):
        """Until the expression is true; gives its value."""
        end = time.monotonic() + seconds
        while not (value := self.value(f"document.body && ({expression})")):
            assert time.monotonic() < end, f"{expression} did not come true: " + self.value("document.body.innerText")[:2000]
            time.sleep(0.05)
        return value

    def key(self, key, down=True, up=True):
        for kind, wanted in (("keyDown", down), ("keyUp", up)):
            if wanted:
                self.send("Input.dispatchKeyEvent", type=kind, key=key, text=key if kind == "keyDown" and len(key) == 1 else "")

    def mouse(self, kind, x, y, **more):
        self.send("Input.dispatchMouseEvent", type=kind, x=x, y=y, button=more.pop("button", "left"), clickCount=1, **more)

    def touch(self, kind, *points):
        """Fingers at these places, (x, y) each; kind: touchStart, touchMove, touchEnd (with no finger left)."""
        self.send("Input.dispatchTouchEvent", type=kind, touchPoints=[{"x": x, "y": y, "id": n} for n, (x, y) in enumerate(points)])

    def shape(self, width, height, scheme="light", mobile=False):
        self.send("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=mobile)
        self.send("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])

    def screenshot(self, file):
        shot = self.send("Page.captureScreenshot", format="png")
        with open(file, "wb") as f:
            f.write(base64.b64decode(shot["data"]))

    def close(self):
        self.session = None
        self.send("Browser.close")
        self.process.wait()
