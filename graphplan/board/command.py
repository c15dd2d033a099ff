"""Draw a mechanism with the mouse, in a browser; its sheet, steps and results follow.

The page is served on this computer alone, at an address with a secret token, and fetches no other files. The drawing is
a scene, whose text can be edited, too; comments stay. Save writes the named file, also a new one; without a file, or
for a packaged scene, the page offers a download. Ctrl-C ends the command.

examples:
  graphplan board                        an empty board
  graphplan board scene.toml             a file, which the page saves
  graphplan board four-bar --port 8123   a packaged scene, at an address that stays the same but for its token
"""

from __future__ import annotations

import argparse
import os
import secrets
import socket
import sys

from graphplan.app.choices import count
from graphplan.app.files import kind
from graphplan.errors import Refused, missing_package
from graphplan.mechanism.scene import packaged_names, source_text

HOST = "127.0.0.1"
MAX_PORT = 65535
CLOSING = 1  # seconds that answers under way have when the board is ended


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("scene", metavar="SCENE", nargs="?", default="",
                         help="a scene file, which may be missing yet, or a packaged scene; without it an empty board")
    command.add_argument("--port", type=count("--port", 0, MAX_PORT), default=0, metavar="N",
                         help="the port of its address; without it a free one")
    command.add_argument("--no-browser", action="store_true", help="print the address, open no browser")


def run(options: argparse.Namespace) -> int:
    try:
        import uvicorn

        from graphplan.board.server import BoardState, application
    except ModuleNotFoundError as missing:
        raise missing_package("graphplan board", missing.name, "board") from None
    token = secrets.token_urlsafe(24)
    text, file = _start(options.scene)
    board = BoardState(token, text, options.scene or "scene", file)
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as bound:
        bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            bound.bind((HOST, options.port))
        except OSError as error:
            raise Refused(f"--port {options.port}", error.strerror or str(error), "another port, or none") from None
        port = bound.getsockname()[1]
        address = f"http://{HOST}:{port}/?token={token}"
        app = application(board, f"{HOST}:{port}")
        config = uvicorn.Config(app, log_level="warning", access_log=False, timeout_graceful_shutdown=CLOSING,
                                server_header=False, ws="none", lifespan="off")
        bound.listen()
        sys.stderr.write(f"graphplan board: {address}\n")
        sys.stderr.flush()
        try:
            board.start()
            if not options.no_browser:
                _open_browser(address)
            uvicorn.Server(config).run(sockets=[bound])
        finally:
            board.stop()
    raise KeyboardInterrupt  # a server ends by a signal alone, and may keep it to itself


def _start(scene: str) -> tuple[str, str]:
    """The text that the board begins with, and the file that it may save."""
    if not scene:
        return "", ""
    if os.path.exists(scene) or scene not in packaged_names():
        kind(scene, (".toml",), "scene")
        return source_text(scene, scene) if os.path.exists(scene) else "", scene
    return source_text(scene, scene), ""


def _open_browser(address: str) -> None:
    """Open the page in the user's browser, where there is one; one in the terminal is waited for by a thread alone."""
    import threading
    import webbrowser

    threading.Thread(target=webbrowser.open, args=(address,), daemon=True).start()
