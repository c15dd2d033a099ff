"""Presses, drags, keys, undos and malformed text at random, as a curious hand makes them."""

from __future__ import annotations

from collections.abc import Callable
from random import Random

from drawn_board import Page

import graphplan as gp
from graphplan.mechanism.scene import packaged_names

TOOLS = "Select", "Point", "Link", "Fixed pivot", "Slide", "Drive", "Ask", "Load", "Erase"
KEYS = ("Enter", "Escape", "Delete", "ArrowLeft", "ArrowUp", "Tab", " ", "v", "p",
        "l", "f", "s", "d", "a", "o", "e", "g",
        "0", "+", "-", "x", "Control+z", "Control+y", "Control+Shift+z")
PIECES = ("[", "]", "=", '"', "A", "[points]\n", "[[drive]]\n", "1 = \"A B\"\n", "{", "}", "# ", "\n", "9e999",
         "\x00", "é", "\\",
          '<img src=x onerror="document.title=1">', "A = [1, 2]\n", "find = 3\n", "frame = \"A\"\n")


class WildHand:
    """A hand that does something at random on a page of the board."""

    def __init__(self, board: Page, seed: int):
        self.board, self.random = board, Random(seed)
        self.deeds: dict[Callable[[], None], int] = {
            self.take: 6, self.press: 20, self.drag: 10, self.key: 10, self.undo: 5, self.type: 4, self.load: 1,
            self.zoom: 2, self.look: 3, self.settle: 2}

    def act(self) -> None:
        """One deed."""
        self.random.choices([*self.deeds], [*self.deeds.values()])[0]()

    def place(self) -> tuple[float, float]:
        """A place on the drawing, in pixels: near a point as often as anywhere."""
        box = self.board.page.evaluate("(({x, y, width, height}) => [x, y, width, height])"
                                       "(document.getElementById('drawing').getBoundingClientRect())")
        joints = self.board.page.evaluate(
            "[...document.querySelectorAll('.joint, .mark')].map(one => { const box = one.getBoundingClientRect();"
            " return [box.x + box.width / 2, box.y + box.height / 2]; })")
        inside = [(x, y) for x, y in joints if box[0] < x < box[0] + box[2] and box[1] < y < box[1] + box[3]]
        if inside and self.random.random() < 0.6:
            return self.random.choice(inside)
        return box[0] + box[2] * self.random.random(), box[1] + box[3] * self.random.random()

    def take(self) -> None:
        self.board.tool(self.random.choice(TOOLS))

    def press(self) -> None:
        self.board.page.mouse.click(*self.place())

    def drag(self) -> None:
        mouse = self.board.page.mouse
        mouse.move(*self.place())
        mouse.down(button=self.random.choice(("left", "left", "left", "middle")))
        for _ in range(self.random.randint(1, 4)):
            mouse.move(*self.place())
        mouse.up(button="left")
        mouse.up(button="middle")

    def key(self) -> None:
        self.board.page.keyboard.press(self.random.choice(KEYS))

    def undo(self) -> None:
        self.board.page.keyboard.press("Escape")
        self.board.page.evaluate("document.activeElement.blur()")
        for _ in range(self.random.randint(1, 5)):
            self.board.page.keyboard.press(self.random.choice(("Control+z", "Control+z", "Control+y")))

    def type(self) -> None:
        page = self.board.page
        page.get_by_role("tab", name="Scene").click()
        text = page.evaluate("board.scene()")
        at = self.random.randint(0, len(text))
        end = min(len(text), at + self.random.choice((0, 0, 1, 5, 40)))
        page.locator("#text").fill(text[:at] + self.random.choice(PIECES).replace("\x00", "") + text[end:])

    def load(self) -> None:
        text = gp.load(self.random.choice(packaged_names()[:12])).text if self.random.random() < 0.7 else ""
        self.board.page.evaluate("text => board.load(text)", text)

    def zoom(self) -> None:
        self.board.page.mouse.move(*self.place())
        self.board.page.mouse.wheel(0, self.random.choice((-400, -100, 100, 400)))

    def look(self) -> None:
        self.board.page.get_by_role("tab", name=self.random.choice(("Sheet", "Steps", "Results", "Scene"))).click()

    def settle(self) -> None:
        self.board.settle()
