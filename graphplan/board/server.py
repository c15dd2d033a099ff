"""The board's server: one page on this computer alone, which asks for edits, numbers and sheets.

Whoever asks must know the secret token, which stands in the address that the command prints: as `?token=` of the page,
and as the first part of all other addresses. A request that was addressed to another host is refused, so that no page
of the internet reaches the board by a name of its own, and so is a large body.
"""

from __future__ import annotations

import json
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass, field
from hmac import compare_digest
from importlib.resources import files
from typing import Any
from urllib.parse import parse_qs

from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import HTMLResponse, JSONResponse, PlainTextResponse, Response
from starlette.routing import Mount, Route
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from graphplan.app.files import write
from graphplan.board.texts import page_language, words_in
from graphplan.board.worker import LIMIT, Answer, OutOfTime, Superseded, Worker, WorkerDied
from graphplan.errors import GraphplanError
from graphplan.mechanism.scene import packaged_names, source_text

MAX_BODY = 1_000_000  # bytes of a request
MAX_DRAINED = 64_000_000  # bytes of a body that is refused: they are read and dropped, so that the refusal arrives
POLICY = ("default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'; "
          "form-action 'self'; base-uri 'none'; frame-ancestors 'none'")
# A live page's scripts stand in it; it is of an origin of its own, so that they reach nothing of the board.
LIVE_POLICY = ("sandbox allow-scripts allow-downloads allow-modals; default-src 'none'; img-src data: blob:; font-src "
               "data:; style-src 'unsafe-inline'; script-src 'unsafe-inline' 'unsafe-eval'; frame-ancestors 'none'")
TYPES = {"js": "text/javascript", "css": "text/css", "svg": "image/svg+xml"}
HEADERS = {"Cache-Control": "no-store", "Referrer-Policy": "same-origin", "X-Content-Type-Options": "nosniff",
           "Cross-Origin-Resource-Policy": "same-origin"}


@dataclass
class BoardState:
    """What the server knows: the secret token, the file that may be saved, if any, and the text that it begins with.

    `workers` answer, each by its own process, so that nobody waits for a sheet who wants a number.
    """

    token: str
    text: str = ""
    name: str = "scene"
    file: str = ""
    limit: float = LIMIT
    workers: dict[str, Worker] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.on_disk = self.text
        self.workers = {name: Worker(self.limit) for name in ("edit", "numbers", "sheet")}

    def start(self) -> None:
        """Start all processes, which load meanwhile what they need."""
        for worker in self.workers.values():
            worker.start()

    def stop(self) -> None:
        """End all processes."""
        for worker in self.workers.values():
            worker.stop()

    async def answer(self, question: str, key: str = "", **values: Any) -> Answer:
        """What a worker answers, or why it does not."""
        worker = self.workers.get(question) or self.workers["sheet"]
        try:
            return await worker.ask(question, f"{question} {key}" if key else "", **values)
        except Superseded:
            return {"superseded": True, "faults": []}
        except OutOfTime:
            return {"faults": [f"scene: stopped after {self.limit:g} s without an answer; a smaller scene, or another "
                               "pose"], "stopped": True}
        except WorkerDied:
            return {"faults": ["scene: the process that computes it ended without an answer; a smaller scene"]}


def application(board: BoardState, host: str) -> Starlette:
    """The server of a board, which is reached at this host, such as 127.0.0.1:8000, alone."""
    routes = [
        Route("/edit", _asker(board, _edit), methods=["POST"]),
        Route("/numbers", _asker(board, _numbers), methods=["POST"]),
        Route("/sheet", _asker(board, _sheet), methods=["POST"]),
        Route("/motion", _asker(board, _motion), methods=["POST"]),
        Route("/open", _asker(board, _open), methods=["POST"]),
        Route("/save", _asker(board, _save), methods=["POST"]),
        Route("/words/{language}", _asker(board, _words)),
        Route("/import/{file:path}", _asker(board, _import), methods=["POST"]),
        Route("/pdf", _asker(board, _pdf), methods=["POST"]),
        Route("/live", _asker(board, _live), methods=["POST"]),
        Route("/page/{file}", _asker(board, _file)),
    ]
    guard = Middleware(Guard, token=board.token, host=host)
    return Starlette(routes=[Route("/", _asker(board, _page)), Mount(f"/{board.token}", routes=routes)],
                     middleware=[guard], exception_handlers={500: _internal_error})


def _internal_error(request: Request, error: Exception) -> Response:
    return JSONResponse({"faults": [f"board: {type(error).__name__}; reload the page"]}, 500, HEADERS)


def _asker(board: BoardState, answer: Callable[[BoardState, Request], Awaitable[Response]]) -> Callable[[Request], Any]:
    """The end point that answers for a board."""
    async def endpoint(request: Request) -> Response:
        return await answer(board, request)

    return endpoint


class Guard:
    """What stands before all else: the host, the token, the size of the body, and the headers of every answer."""

    def __init__(self, app: ASGIApp, token: str, host: str):
        self.app, self.token, self.host = app, token, host

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            return await self.app(scope, receive, send)
        headers = {key: value.decode("latin-1") for key, value in scope["headers"]}
        if headers.get(b"host", "") != self.host:
            return await _refuse(400, "this board is reached as 127.0.0.1 alone", scope, receive, send)
        if not self._knows_token(scope):
            return await _refuse(403, "the address has no token, or another; the command printed it", scope, receive,
                                 send)
        origin = headers.get(b"origin", "")
        if origin not in ("", f"http://{self.host}"):
            return await _refuse(403, "a page of another origin asks", scope, receive, send)
        body = await _body(receive, headers.get(b"content-length", ""))
        if body is None:
            return await _refuse(413, "the request is larger than 1 MB", scope, receive, send)
        sent = False

        async def receive_again() -> Message:
            nonlocal sent
            if sent:
                return await receive()
            sent = True
            return {"type": "http.request", "body": body, "more_body": False}

        await self.app(scope, receive_again, send)

    def _knows_token(self, scope: Scope) -> bool:
        token = parse_qs(scope["query_string"].decode("latin-1")).get("token", [""])[0]
        first = scope["path"].removeprefix("/").partition("/")[0]
        return any(compare_digest(words.encode(), self.token.encode()) for words in (token, first))


async def _body(receive: Receive, length: str) -> bytes | None:
    """The body of a request; None of one that is too large, of which as much is read as anybody may send by mistake."""
    size, chunks, more = 0, list[bytes](), True
    if length.isdecimal() and int(length) > MAX_DRAINED:
        return None
    while more:
        message = await receive()
        if message["type"] == "http.disconnect":
            break
        chunk, more = message.get("body", b""), message.get("more_body", False)
        size += len(chunk)
        if size <= MAX_BODY:
            chunks.append(chunk)
        elif size > MAX_DRAINED:
            return None
    return b"".join(chunks) if size <= MAX_BODY else None


async def _refuse(status: int, why: str, scope: Scope, receive: Receive, send: Send) -> None:
    headers = {**HEADERS, "Content-Security-Policy": POLICY}
    await PlainTextResponse(f"{why}\n", status, headers)(scope, receive, send)


# ---- the page and its files ------------------------------------------------------------------------------------------


def _html(text: str, policy: str = POLICY) -> Response:
    return HTMLResponse(text, headers={**HEADERS, "Content-Security-Policy": policy})


async def _page(board: BoardState, request: Request) -> Response:
    language = page_language(request.headers.get("accept-language", ""))
    text = files(__package__).joinpath("board.html").read_text("utf-8")
    return _html(text.replace("{{base}}", board.token).replace("{{language}}", language))


async def _file(board: BoardState, request: Request) -> Response:
    name = request.path_params["file"]
    kind = TYPES.get(name.rpartition(".")[2], "")
    source = files(__package__).joinpath(name)
    if not kind or "/" in name or not source.is_file():
        return PlainTextResponse("there is no such file\n", 404, HEADERS)
    return Response(source.read_bytes(), media_type=kind, headers={**HEADERS, "Content-Security-Policy": POLICY})


async def _words(board: BoardState, request: Request) -> Response:
    return _json(words_in(request.path_params["language"]))


def _json(data: Mapping[str, Any], status: int = 200) -> Response:
    headers = {**HEADERS, "Content-Security-Policy": POLICY}
    return Response(json.dumps(data, ensure_ascii=False), status, headers, "application/json")


# ---- what the page asks ----------------------------------------------------------------------------------------------


async def _question(request: Request) -> dict[str, Any]:
    """The question that a body has; an empty one where it is none."""
    try:
        data = json.loads(await request.body())
    except ValueError:
        data = None
    return data if isinstance(data, dict) else {}


def _text(asked: Mapping[str, Any]) -> dict[str, str]:
    """The text that is asked about, and in which language."""
    return {"text": str(asked.get("text", "")), "language": page_language(str(asked.get("language", "")))}


async def _edit(board: BoardState, request: Request) -> Response:
    question = await _question(request)
    operations = [values for values in question.get("operations", ()) if isinstance(values, dict)]
    return _json(await board.answer("edit", text=_text(question)["text"], name=board.name, operations=operations))


async def _numbers(board: BoardState, request: Request) -> Response:
    question = await _question(request)
    text, page = _text(question)["text"], str(question.get("page", ""))
    return _json(await board.answer("numbers", page, text=text, name=board.name))


async def _sheet(board: BoardState, request: Request) -> Response:
    question = await _question(request)
    return _json(await board.answer("sheet", str(question.get("page", "")), **_text(question), name=board.name))


async def _motion(board: BoardState, request: Request) -> Response:
    question = await _question(request)
    text, page = _text(question)["text"], str(question.get("page", ""))
    return _json(await board.answer("motion", page, text=text, name=board.name))


async def _open(board: BoardState, request: Request) -> Response:
    """The packaged scene of a name; without one the scene that the board began with, and what is known of it."""
    name = (await _question(request)).get("scene")
    if name is None:
        return _json({"text": board.text, "file": board.file, "scenes": packaged_names(), "faults": []})
    if name not in packaged_names():
        return _json({"faults": [f"scene {name}: there is no such packaged scene; graphplan list names them"]})
    return _json({"text": source_text(name, name), "faults": []})


async def _save(board: BoardState, request: Request) -> Response:
    """Write the file that the command line names, unless another program has changed it since; then a second save does.
    """
    text = str((await _question(request)).get("text", ""))
    if not board.file:
        return _json({"faults": ["save: the command line names no file; download it"]})
    try:
        on_disk = source_text(board.file, board.file)
    except GraphplanError:
        on_disk = ""
    if on_disk != board.on_disk:
        board.on_disk = on_disk
        return _json({"faults": [f"{board.file}: another program has changed the file; save again to overwrite it"]})
    try:
        write(text, board.file)
    except GraphplanError as error:
        return _json({"faults": [*error.lines]})
    board.on_disk = text
    return _json({"file": board.file, "faults": []})


async def _import(board: BoardState, request: Request) -> Response:
    return _json(await board.answer("import", file=request.path_params["file"], data=await request.body()))


async def _form(request: Request) -> dict[str, str]:
    """The fields of a form that was sent."""
    fields = parse_qs((await request.body()).decode("utf-8", "replace"), keep_blank_values=True)
    return _text({key: values[0] for key, values in fields.items()})


async def _pdf(board: BoardState, request: Request) -> Response:
    answer = await board.answer("pdf", **await _form(request), name=board.name)
    if "pdf" not in answer:
        return _json(answer, 422)
    headers = {**HEADERS, "Content-Disposition": 'attachment; filename="sheet.pdf"'}
    return Response(answer["pdf"], media_type="application/pdf", headers=headers)


async def _live(board: BoardState, request: Request) -> Response:
    """The live page, with a policy of its own: its script stands in it."""
    answer = await board.answer("live", **await _form(request), name=board.name)
    if "page" not in answer:
        return PlainTextResponse("\n".join(answer["faults"]) + "\n", 422, HEADERS)
    return _html(answer["page"], LIVE_POLICY)
