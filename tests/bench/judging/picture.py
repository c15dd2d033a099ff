"""Scans and photos of the printed handout on which a student has drawn in pencil, with notes, smudges and rubbed-out
strokes."""

from __future__ import annotations

import cmath
import math
import random
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory

import cv2
import numpy as np
import pypdfium2

from graphplan.commands import main
from judging.faults import faulty
from judging.hand import Sketch
from judging.task import Task
from judging.vector import Ink, inked, inside, shown

NOTES = ("v = w r", "a = v2/r", "k = 20", "ok?", "see 4", "12,5 : 3 = 4,17", "Group 2", "v /l", "27.3 mm", "Student 1")
Grey = np.ndarray


@lru_cache(maxsize=8)
def handout(scene: str, options: tuple[str, ...], dpi: int) -> Grey:
    """The printed task sheet, as grey values."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "handout.pdf"
        status = main(["handout", scene, "--only", "task", "-q", "-o", str(path), *options])
        assert status == 0
        document = pypdfium2.PdfDocument(path.read_bytes())
        return document[0].render(scale=dpi / 72, grayscale=True).to_numpy().reshape(
            round(document[0].get_height() * dpi / 72 + 0.499), -1).astype(np.float32)


class Paper:
    """A sheet under the pencil: darkness is taken off from white paper."""

    def __init__(self, task: Task, chance: random.Random, dpi: int) -> None:
        self.page = handout(task.scene, task.options, dpi).copy()
        self.chance, self.per, self.size = chance, dpi / 25.4, task.size
        self.dark = chance.uniform(70, 165)  # of 255, in the middle of a stroke
        self.wide = chance.uniform(0.28, 0.5)  # mm
        rng = np.random.default_rng(chance.randrange(2**32))
        coarse = rng.normal(1.0, 0.16, tuple(max(2, side // 12) for side in self.page.shape)).astype(np.float32)
        self.grain = np.clip(cv2.resize(coarse, self.page.shape[::-1], interpolation=cv2.INTER_CUBIC), 0.35, 1.5)
        self.rng = rng

    def at(self, z: complex) -> tuple[float, float]:
        """Pixels of a place in mm, y upward."""
        return z.real * self.per, (self.size[1] - z.imag) * self.per

    def rubbed(self, paths: list[np.ndarray], dark: float, wide: float, blur: float = 0.0) -> None:
        """Pencil along these paths, in pixels."""
        ink = np.zeros(self.page.shape, np.uint8)
        shift = 4
        thick = max(1, round(wide * self.per))
        for path in paths:
            cv2.polylines(ink, [np.round(path * 2**shift).astype(np.int32)], False, 255, thick, cv2.LINE_AA, shift)
        soft = cv2.GaussianBlur(ink, (0, 0), 0.35 + blur * self.per).astype(np.float32) / 255
        self.page -= np.minimum(soft * dark * self.grain, self.page * 0.85)

    def stroke(self, points: list[complex]) -> np.ndarray:
        """A stroke through these points by a hand that is never quite steady."""
        path = np.array([self.at(z) for z in points])
        return path + self.rng.normal(0, 0.02 * self.per, path.shape)

    def text(self, middle: complex, words: str, height: float) -> None:
        """Words written by hand, a low letter after an underscore."""
        main_part, _, low = words.partition("_")
        font = self.chance.choice((cv2.FONT_HERSHEY_SIMPLEX, cv2.FONT_HERSHEY_SIMPLEX, cv2.FONT_HERSHEY_DUPLEX))
        x, y = self.at(middle)
        layer = np.zeros(self.page.shape, np.uint8)
        for part, size, down in ((main_part, height, 0.0), (low, 0.65 * height, 0.45 * height)):
            scale = size * self.per / 22
            wide = cv2.getTextSize(part, font, scale, 1)[0][0]
            if part == main_part:
                x -= wide * (1 + 0.5 * bool(low)) / 2
            corner = round(x + self.chance.uniform(-1, 1)), round(y + (0.5 * height + down) * self.per)
            cv2.putText(layer, part, corner, font, scale, 255, max(1, round(0.3 * self.per)), cv2.LINE_AA)
            x += wide + 0.2 * self.per
        lean = self.chance.gauss(0, 8)
        turn = cv2.getRotationMatrix2D(self.at(middle), lean, 1.0)
        layer = cv2.warpAffine(layer, turn, layer.shape[::-1])
        soft = cv2.GaussianBlur(layer, (0, 0), 0.5).astype(np.float32) / 255
        self.page -= np.minimum(soft * self.dark * self.grain, self.page * 0.85)

    def smudge(self) -> None:
        """Graphite wiped over the paper."""
        layer = np.zeros(self.page.shape, np.float32)
        x, y = self.at(complex(self.chance.uniform(20, self.size[0] - 20), self.chance.uniform(20, self.size[1] - 20)))
        axes = round(self.chance.uniform(5, 25) * self.per), round(self.chance.uniform(2, 6) * self.per)
        cv2.ellipse(layer, (round(x), round(y)), axes, self.chance.uniform(0, 180), 0, 360, 1.0, -1)
        soft = cv2.GaussianBlur(layer, (0, 0), 2.0 * self.per)
        self.page -= np.minimum(soft * self.chance.uniform(12, 40), self.page * 0.5)


def pencilled(sketch: Sketch, seed: int, dpi: int) -> tuple[Grey, set[int]]:
    """The handout drawn upon, and which steps it shows."""
    chance = random.Random(f"pencil {seed}")
    paper, ink = Paper(sketch.task, chance, dpi), inked(sketch, chance, sketch.task.size, numbers=False)
    size = sketch.task.size
    by_hand = {step.index for step in sketch.task.steps if step.args}  # the rest is printed
    if chance.random() < 0.6:
        _rubbed_out(paper, sketch, seed, chance)
    groups: dict[float, list[np.ndarray]] = {}
    for path in _paths(paper, ink, sketch.task, size):
        groups.setdefault(chance.choice((0.75, 0.9, 1.0, 1.15)), []).append(path)
    for dark, paths in groups.items():
        paper.rubbed(paths, dark * paper.dark, paper.wide)
    for index, at in ink.dots:
        if index in by_hand and inside(at, size, -2):
            paper.rubbed([paper.stroke([at, at + cmath.rect(0.15, k)]) for k in range(3)], 1.2 * paper.dark, 0.7)
    for index, middle, words in ink.letters:
        if index in by_hand and chance.random() < 0.97:
            paper.text(middle, words, chance.uniform(2.6, 3.8))
    for _ in range(chance.choice((0, 1, 2, 4))):
        spot = complex(chance.uniform(30, size[0] - 40), chance.uniform(22, size[1] - 22))
        if min(abs(spot - at) for _, at in ink.dots) > 12:
            paper.text(spot, chance.choice(NOTES), chance.uniform(3, 4.5))
    for _ in range(chance.choice((0, 0, 1, 3))):
        paper.smudge()
    seen = shown(ink) - {index for index, at in ink.dots if not inside(at, size, -2)}
    return paper.page, seen


def _paths(paper: Paper, ink: Ink, task: Task, size: tuple[float, float]) -> list[np.ndarray]:
    """Strokes and arcs, as far as they lie on the paper."""
    found = []
    for _, start, end in ink.strokes:
        steps = max(2, round(abs(end - start) / 3))
        points = [start + (end - start) * k / steps for k in range(steps + 1)]
        kept = [z for z in points if inside(z, size, -10)]
        if len(kept) > 1:
            found.append(paper.stroke(kept))
    for _, centre, radius, sweep in ink.arcs:
        low, high = sweep or (0.0, math.tau)
        steps = max(8, round((high - low) * radius))
        points = [centre + cmath.rect(radius, low + (high - low) * k / steps) for k in range(steps + 1)]
        kept = [z for z in points if inside(z, size, -10)]
        if len(kept) > 1:
            found.append(paper.stroke(kept))
    return found


def _rubbed_out(paper: Paper, sketch: Sketch, seed: int, chance: random.Random) -> None:
    """A stroke or two that were drawn wrongly first, and rubbed out."""
    try:
        wrong = faulty(sketch.task, seed + 7_000_000)
    except LookupError:
        return
    assert wrong.fault is not None
    ink = inked(wrong, chance, sketch.task.size)
    at = wrong.fault.index
    for one in (*ink.strokes, *ink.arcs):
        if one[0] == at or at in sketch.task.steps[one[0]].args:
            part = Ink(strokes=[one]) if len(one) == 3 else Ink(arcs=[one])
            paths = _paths(paper, part, sketch.task, sketch.task.size)
            paper.rubbed(paths, chance.uniform(12, 35), paper.wide, 0.08)


def scan(sketch: Sketch, seed: int) -> tuple[bytes, str, set[int]]:
    """A page from a scanner at 150 or 200 dpi: a little turned, grey paper, noise."""
    chance = random.Random(f"scan {seed}")
    dpi = chance.choice((150, 200))
    page, seen = pencilled(sketch, seed, dpi)
    high, wide = page.shape
    turn = cv2.getRotationMatrix2D((wide / 2, high / 2), chance.gauss(0, 0.6), 1.0)
    turn[:, 2] += chance.uniform(-6, 6), chance.uniform(-6, 6)
    page = cv2.warpAffine(page, turn, (wide, high), flags=cv2.INTER_CUBIC, borderValue=255)
    page = np.clip(page, 0, 255) * chance.uniform(0.92, 1.0)
    page += np.random.default_rng(seed).normal(0, chance.uniform(1, 5), page.shape)
    if chance.random() < 0.1:
        page = page[::-1, ::-1]
    suffix, how = chance.choice(((".png", []), (".jpg", [cv2.IMWRITE_JPEG_QUALITY, chance.randint(75, 95)])))
    return _encoded(page, suffix, how), suffix, seen


def photo(sketch: Sketch, seed: int) -> tuple[bytes, str, set[int]]:
    """A photo from the hand: in perspective, unevenly lit, on a table."""
    chance = random.Random(f"photo {seed}")
    page, seen = pencilled(sketch, seed, 200)
    high, wide = page.shape
    table = float(chance.uniform(60, 150))
    corners = np.float32([[0, 0], [wide, 0], [wide, high], [0, high]])
    margin = 0.05 * wide
    seen_at = corners + margin + np.float32([[chance.uniform(-0.03, 0.03) * wide, chance.uniform(-0.03, 0.03) * wide]
                                             for _ in range(4)])
    view = cv2.getPerspectiveTransform(corners, seen_at)
    size = round(wide + 2 * margin), round(high + 2 * margin)
    page = cv2.warpPerspective(np.clip(page, 0, 255), view, size, flags=cv2.INTER_CUBIC, borderValue=table)
    x, y = np.meshgrid(np.linspace(-1, 1, size[0]), np.linspace(-1, 1, size[1]))
    towards = chance.uniform(0, math.tau)
    light = 0.85 + chance.uniform(0.03, 0.14) * (x * math.cos(towards) + y * math.sin(towards))
    page = cv2.GaussianBlur(page, (0, 0), chance.uniform(0.5, 0.9)) * light
    page += np.random.default_rng(seed).normal(0, chance.uniform(1.5, 5), page.shape)
    return _encoded(page, ".jpg", [cv2.IMWRITE_JPEG_QUALITY, chance.randint(80, 95)]), ".jpg", seen


def _encoded(page: np.ndarray, suffix: str, how: list[int]) -> bytes:
    done, data = cv2.imencode(suffix, np.clip(page, 0, 255).astype(np.uint8), how)
    assert done
    return bytes(data)
