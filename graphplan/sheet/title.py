"""The title block in the lower right corner, after ISO 7200: what the sheet shows, whence, how large, who drew it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from graphplan.phrases import said
from graphplan.sheet.display import Item, Polyline, Rect, Text
from graphplan.sheet.lettering import SIZE, Runs, sentence_runs, wrap
from graphplan.sheet.pens import BORDER, FAINT, FRAME, LETTERS
from graphplan.sheet.scales import digits
from graphplan.words.tongue import ENGLISH, Tongue

TITLE, FOOT, PAD, HEADING = 3.5, 9.0, 2.0, 1.8
MILLIMETRES = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4, "ft": 304.8}


@dataclass(frozen=True)
class TitleBlock:
    """The words of the title block; its height follows from its width."""

    title: str
    source: str
    tongue: Tongue = ENGLISH

    def lines(self, wide: float) -> list[tuple[Runs, float, bool]]:
        """The wrapped title and source with their sizes."""
        room = wide - 2 * PAD
        title = [(runs, TITLE, True) for runs in wrap(sentence_runs(self.title), TITLE, room, bold=True)]
        source = [(runs, SIZE, False) for runs in wrap(sentence_runs(self.source), SIZE, room)]
        return title + source

    def height(self, wide: float) -> float:
        return FOOT + 2 * PAD + sum(1.45 * size for _, size, _ in self.lines(wide))

    def items(self, rect: Rect, paper: str, scale: str) -> Iterator[Item]:
        """The block in its rectangle."""
        foot = rect.bottom + FOOT
        yield _stroke((rect.left, rect.bottom), (rect.left, rect.top), FRAME.width)
        yield _stroke((rect.left, rect.top), (rect.right, rect.top), FRAME.width)
        yield _stroke((rect.left, foot), (rect.right, foot))
        y = rect.top - PAD
        for runs, size, bold in self.lines(rect.width):
            y -= 1.45 * size
            yield Text(LETTERS, "text", None, (rect.left + PAD, y + 0.45 * size), runs, size, "start", bold)
        words = ((said("Scale"), scale), (said("Sheet"), paper), (said("Drawn by"), "graphplan"))
        for i, (heading, word) in enumerate(words):
            x = rect.left + i * rect.width / len(words)
            if i:
                yield _stroke((x, rect.bottom), (x, foot))
            head = sentence_runs(self.tongue(heading))
            yield Text(FAINT, "text", None, (x + PAD, foot - HEADING - 1.0), head, HEADING)
            yield Text(LETTERS, "text", None, (x + PAD, rect.bottom + 1.9), sentence_runs(word), SIZE)


def _stroke(start: tuple[float, float], end: tuple[float, float], width: float = BORDER.width) -> Polyline:
    return Polyline(FRAME if width == FRAME.width else BORDER, "paper", None, (start, end))


def ratio(k_s: float, length: str) -> str:
    """The drawing scale as it is written in a title block, such as 1 : 5."""
    size = k_s * MILLIMETRES.get(length, 1.0)
    return f"1 : {digits(size)}" if size >= 1 else f"{digits(1 / size)} : 1"
