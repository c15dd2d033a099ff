"""The board's server: whom it answers, what it refuses, how it stops what takes long, and what it leaves: nothing."""

from __future__ import annotations

import asyncio
import http.client
import json
import time
from collections.abc import Coroutine, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, TypeVar

import pytest
from drawn_board import Server, served

import graphplan as gp
from graphplan.board.server import BoardState, application

testclient = pytest.importorskip("starlette.testclient")
T = TypeVar("T")
HOST, TOKEN = "127.0.0.1:8000", "secret-of-this-test"


@pytest.fixture(scope="module")
def board() -> Iterator[BoardState]:
    """A board that begins with a packaged scene."""
    state = BoardState(TOKEN, gp.load("four-bar").text)
    yield state
    state.stop()


@pytest.fixture(scope="module")
def client(board: BoardState) -> Iterator[Any]:
    """Who asks it, in one loop of events."""
    with testclient.TestClient(application(board, HOST), base_url=f"http://{HOST}") as found:
        yield found


@pytest.mark.parametrize("path", ["/", "/?token=", "/?token=another", "/edit", "/another/edit", "/page/board.js",
                                  f"/x{TOKEN}/page/board.js"])
def test_without_the_token_nothing_is_answered(client: Any, path: str) -> None:
    """A request without the token, or with another, is refused, whatever it asks for."""
    assert client.get(path).status_code == 403
    assert client.post(path, json={"text": ""}).status_code == 403


@pytest.mark.parametrize("host", ["evil.example", "127.0.0.1", "127.0.0.1:8001", "evil.example:8000", ""])
def test_another_host_is_refused(client: Any, host: str) -> None:
    """What was addressed to another host, as a page of the internet may have it, is refused in spite of the token."""
    assert client.get(f"/?token={TOKEN}", headers={"Host": host}).status_code == 400


def test_a_page_of_another_origin_is_refused(client: Any) -> None:
    """A question that another page asks is refused in spite of the token."""
    answer = client.post(f"/{TOKEN}/edit", json={"text": ""}, headers={"Origin": "http://evil.example"})
    assert answer.status_code == 403


@pytest.mark.parametrize("path", [f"/?token={TOKEN}", f"/{TOKEN}/edit", f"/{TOKEN}/save"])
def test_a_large_body_is_refused(client: Any, path: str) -> None:
    """More than a megabyte is refused, with its length told or not."""
    body = b"x" * 1_000_001
    assert client.post(path, content=body).status_code == 413
    assert client.post(path, content=(body[k:k + 9999] for k in range(0, len(body), 9999))).status_code == 413


@pytest.mark.parametrize("path", [f"/?token={TOKEN}", f"/{TOKEN}/page/board.js", f"/{TOKEN}/words/de", "/"])
def test_every_answer_has_a_policy(client: Any, path: str) -> None:
    """Scripts come from the board's own files alone: none in a page, none made of text."""
    policy = client.get(path).headers["content-security-policy"]
    assert "script-src 'self'" in policy
    assert "unsafe" not in policy


@pytest.mark.parametrize("name", ["server.py", "..%2Fserver.py", "%2E%2E/words/de.toml", "nothing.js", "results.toml"])
def test_only_files_of_the_page_are_served(client: Any, name: str) -> None:
    """Other files of the package, or of the computer, are not there."""
    assert client.get(f"/{TOKEN}/page/{name}").status_code == 404


@pytest.mark.parametrize("body", [b"", b"{", b"[]", b"null", b'{"text": 3, "operations": [3, null]}', b"\xff\xfe",
                                  b'{"operations": {}}', b'{"text": "a", "operations": [{"do": "nothing"}]}',
                                  b'{"text": "", "operations": [{"do": "point"}]}'])
def test_a_malformed_question_is_answered(client: Any, body: bytes) -> None:
    """What is no question, or asks for what there is not, gets an answer; the next one is answered as ever."""
    assert client.post(f"/{TOKEN}/edit", content=body).status_code == 200
    answer = client.post(f"/{TOKEN}/edit", json={"text": "", "operations": [{"do": "point", "at": [1, 2]}]}).json()
    assert answer["text"] == "[points]\nA = [1, 2]\n"


@pytest.mark.parametrize("text", ["[points", "points = 3", "[points]\nA = 3\n[links]\n1 = 4", "\x00",
                                  "a = " + "[" * 999,
                                  "[points]\nA = [1e999, 2]\n",
                                  "[links]\n1 = 'A B'\n[[drive]]\nlink = 1\n[find]\nx = 1"])
def test_a_malformed_text_has_faults(client: Any, text: str) -> None:
    """A text that is no scene has faults and no results, in all answers."""
    assert client.post(f"/{TOKEN}/edit", json={"text": text}).json()["faults"]
    for question in ("numbers", "sheet", "motion"):
        assert client.post(f"/{TOKEN}/{question}", json={"text": text}).json()["faults"]


def test_numbers_are_those_of_the_command(client: Any) -> None:
    """The results are what `graphplan solve` prints."""
    answer = client.post(f"/{TOKEN}/numbers", json={"text": gp.load("four-bar").text}).json()
    assert answer["results"] == gp.solve(gp.load("four-bar")).json()


def test_a_drawing_of_another_program_is_imported(client: Any, tmp_path: Path) -> None:
    """A file that graphplan exported gives its scene; one that is none, a fault without the folder it lay in."""
    from graphplan.commands import main

    assert main(["export", "four-bar", "-q", "-o", str(tmp_path / "four-bar.ggb")]) == 0
    data = (tmp_path / "four-bar.ggb").read_bytes()
    assert client.post(f"/{TOKEN}/import/four-bar.ggb", content=data).json()["text"] == gp.load("four-bar").text
    faults = client.post(f"/{TOKEN}/import/..%2Fno.ggb", content=b"PKno").json()["faults"]
    assert faults
    assert "/tmp" not in faults[0]


def test_sheets_and_live_pages_are_sent_as_files(client: Any) -> None:
    """A form gets the sheet as PDF, and the live page, whose scripts are of no origin that reaches the board."""
    fields = {"text": gp.load("four-bar").text, "language": "en"}
    assert client.post(f"/{TOKEN}/pdf", data=fields).content.startswith(b"%PDF")
    live = client.post(f"/{TOKEN}/live", data=fields)
    assert "<!DOCTYPE html>" in live.text
    assert live.headers["content-security-policy"].startswith("sandbox")
    assert "allow-same-origin" not in live.headers["content-security-policy"]


def test_only_the_named_file_is_saved(client: Any, board: BoardState, tmp_path: Path) -> None:
    """Without a file on the command line nothing is saved; a file that another program changed is kept at first."""
    assert client.post(f"/{TOKEN}/save", json={"text": "a = 1\n"}).json()["faults"]
    path = tmp_path / "scene.toml"
    board.file, board.on_disk = str(path), ""
    assert client.post(f"/{TOKEN}/save", json={"text": "a = 1\n"}).json()["faults"] == []
    path.write_text("a = 2\n")
    assert "another program" in client.post(f"/{TOKEN}/save", json={"text": "a = 3\n"}).json()["faults"][0]
    assert path.read_text() == "a = 2\n"
    assert client.post(f"/{TOKEN}/save", json={"text": "a = 3\n"}).json()["faults"] == []
    assert path.read_text() == "a = 3\n"
    board.file = ""


# ---- workers ---------------------------------------------------------------------------------------------------------


def run_apart(question: Coroutine[Any, Any, T]) -> T:
    """Run a coroutine in a thread of its own: a browser driven by the same process has a loop in this one."""
    with ThreadPoolExecutor(1) as thread:
        return thread.submit(asyncio.run, question).result()


def test_what_takes_long_is_stopped_and_said() -> None:
    """A question beyond the limit is stopped, and the next one answered."""
    async def ask() -> tuple[Any, Any]:
        state = BoardState(TOKEN, limit=0.05)
        try:
            slow = await state.answer("sheet", text=gp.load("class-four-loaded").text, name="scene", language="en")
            for worker in state.workers.values():
                worker.limit = 60
            return slow, await state.answer("sheet", text="", name="scene", language="en")
        finally:
            state.stop()

    slow, following = run_apart(ask())
    assert slow["stopped"]
    assert "stopped after 0.05 s" in slow["faults"][0]
    assert "it is empty" in following["faults"][0]


def test_the_latest_edit_wins() -> None:
    """Of questions that one page asks in a row the last is answered, those that still waited are not; another page's
    are."""
    text = gp.load("four-bar").text

    async def ask() -> list[Any]:
        state = BoardState(TOKEN)
        asked = [state.answer("numbers", page, text=text, name="scene") for page in ("a", "a", "a", "b", "a")]
        try:
            return await asyncio.gather(*asked)
        finally:
            state.stop()

    _, *middle, other, last = run_apart(ask())
    assert [answer.get("superseded") for answer in middle] == [True, True]
    assert other["results"] == last["results"]
    assert last["results"]["points"]


def test_no_process_is_left(tmp_path: Path) -> None:
    """Pages that are loaded over and over, and the end of the command by Ctrl-C, leave no process behind."""
    server = Server(tmp_path / "new.toml")
    host, port = server.host.split(":")
    for _ in range(20):
        connection = http.client.HTTPConnection(host, int(port), timeout=60)
        connection.request("GET", f"/?token={server.token}")
        assert connection.getresponse().status == 200
        connection.request("POST", f"/{server.token}/numbers", json.dumps({"text": gp.load("four-bar").text}))
        connection.close()  # as a page does that is loaded anew
    children = family(server.process.pid)
    assert 0 < len(children) <= 6
    assert server.end() == 130
    for _ in range(100):
        if not any(Path(f"/proc/{child}").exists() for child in children):
            break
        time.sleep(0.1)
    assert [child for child in children if Path(f"/proc/{child}").exists()] == []


def test_a_server_that_is_killed_leaves_no_process(tmp_path: Path) -> None:
    """Workers end by themselves where the server has no time to end them."""
    with served() as server:
        connection = http.client.HTTPConnection(*server.host.split(":"), timeout=60)
        connection.request("POST", f"/{server.token}/edit", "{}")
        assert connection.getresponse().status == 200
        children = family(server.process.pid)
        server.process.kill()
        for _ in range(100):
            if not any(Path(f"/proc/{child}").exists() for child in children):
                break
            time.sleep(0.1)
        assert [child for child in children if Path(f"/proc/{child}").exists()] == []


def family(parent: int) -> list[int]:
    """All processes that a process started, and that these did."""
    if not Path("/proc/self/stat").exists():
        pytest.skip("processes are not listed here")
    parents = dict[int, int]()
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = path.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        parents[int(path.parent.name)] = int(fields[1])
    found = [parent]
    for process in found:
        found += [child for child, above in parents.items() if above == process]
    return found[1:]
