"""Hand drawings as a scanner or a phone sees them: on the printed task, by pencil, with all that spoils a picture.

One number decides everything, so that a picture is the same in every run. Strokes are chains of spots in mm of the
sheet with a pencil's width and darkness.
"""

from __future__ import annotations

import cmath
import math
import random
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import cv2
import numpy as np
import pypdfium2
from drawing_board import Board, Fault, Places, Task, Unfit
from drawing_tasks import MAKERS
from face import ran
from hand_drawings import Drawing, scene_file, steps_of
from numpy.typing import NDArray

PHONE = 4032, 3024  # pixels: 12 megapixels
INCH, FINE = 25.4, 8.0  # mm; the page is drawn in so many pixels per mm before anyone looks at it
WOBBLE, OVERSHOOT, SMUDGES = (0.03, 0.08), 1.5, 3  # mm of a hand, mm at the ends of lines, and how many are left
BEYOND_MM = 3.0  # of a line, beyond its end
MARGINS_MM = 7.8, 17.5, 7.0  # of the printed task, in which its corner marks stand: above and below, left, right
PICTURED = [name for name, (_, plan) in MAKERS.items() if plan in ("polar", "orthogonal")]
Image = NDArray[np.float32]
Grey = NDArray[np.uint8]
Stroke = tuple[Sequence[tuple[float, float]], float, float]  # spots in mm, the pencil's width in mm, its darkness 0..1


@dataclass(frozen=True)
class Paper:
    """A page before it is drawn upon: its size in mm, and its lightness 0..1, `FINE` pixels per mm."""

    width: float
    height: float
    page: Image

    def without(self, *corners: int) -> Paper:
        """The same with the marks of some corners covered, counted from the lower left counter-clockwise."""
        page, (high, left, right) = self.page.copy(), (round(mm * FINE) for mm in MARGINS_MM)
        for corner in corners:
            rows = slice(-high, None) if corner < 2 else slice(high)
            page[rows, slice(-right, None) if corner in (1, 2) else slice(left)] = 0.8
        return Paper(self.width, self.height, page)


@lru_cache(maxsize=2)  # a page takes 30 MB
def printed(scene: str, *options: str) -> Paper:
    """The task of a scene from the printer, a little soft."""
    with TemporaryDirectory() as folder:
        done = ran("handout", scene, "--only", "task", "-q", "-o", f"{folder}/task.pdf", *options)
        assert done.status == 0, done.err
        return page_of(Path(folder) / "task.pdf")


def page_of(document: Path, number: int = 1) -> Paper:
    """A page of a document from the printer."""
    with pypdfium2.PdfDocument(document) as pages:
        width, height = (side / 72 * INCH for side in pages[number - 1].get_size())
        grey = pages[number - 1].render(scale=FINE * INCH / 72, grayscale=True).to_numpy()
    return Paper(width, height, cv2.GaussianBlur(grey.reshape(grey.shape[:2]).astype(np.float32) / 255, (0, 0), 0.5))


def drawn(paper: Paper, strokes: Sequence[Stroke], seed: int) -> Image:
    """The page with its strokes, lightness 0..1, `FINE` pixels per mm."""
    chance, page = np.random.default_rng(seed), paper.page.copy()
    pencil = np.zeros_like(page)
    for spots, width, dark in strokes:
        _stroke(pencil, _wobbling(np.asarray(spots, float), chance), width, dark, paper.height, chance)
    grain = cv2.GaussianBlur(chance.standard_normal(page.shape, np.float32), (0, 0), 0.8)
    pencil *= np.clip(1 + 0.9 * grain, 0, 1)  # graphite stays on the hills of the paper
    for _ in range(SMUDGES):
        _smudge(pencil, chance)
    page *= 1 - np.clip(pencil, 0, 1)
    page += 0.012 * grain
    return page


def scan(paper: Paper, strokes: Sequence[Stroke], seed: int, *, dpi: float = 200.0, quarters: int = 0) -> Grey:
    """The page on a flatbed: a little askew, stretched by the feed, turned by quarters of a full turn."""
    chance = np.random.default_rng([seed, 1])
    fine, scale = drawn(paper, strokes, seed), dpi / INCH
    width, height = round(paper.width * scale), round(paper.height * scale)
    askew, feed = math.radians(chance.uniform(-0.8, 0.8)), 1 + chance.uniform(-0.002, 0.002)
    shift = chance.uniform(-0.7, 0.7, 2) * scale
    turn = np.array([[scale * math.cos(askew), -scale * math.sin(askew), 0.0],
                     [scale * feed * math.sin(askew), scale * feed * math.cos(askew), 0.0], [0, 0, 1]])
    turn[:2, 2] = np.array([width, height]) / 2 - (turn[:2, :2] @ [paper.width / 2, paper.height / 2]) + shift
    image = _looked_at(fine, turn, (width, height), 0.0, 0.97)
    image = cv2.GaussianBlur(image, (0, 0), chance.uniform(0.5, 0.8))
    image = _noisy(image * _shade(image.shape, chance, 0.04), chance, 0.012)
    return _stored(np.rot90(image, quarters), 88)


def photo(paper: Paper, strokes: Sequence[Stroke], seed: int, *, tilt: float = 15.0, around: float = 8.0,
          size: tuple[int, int] = PHONE) -> Grey:
    """The page on a table before a phone: tilted, turned, bent by the lens, a shadow across it."""
    chance = np.random.default_rng([seed, 2])
    fine = drawn(paper, strokes, seed)
    turn = _view(paper, size, chance, tilt, around)
    image = _looked_at(fine, turn, size, chance.uniform(-0.02, 0.012), 0.45)
    image = cv2.GaussianBlur(image, (0, 0), chance.uniform(0.7, 1.2))
    image *= _shade(image.shape, chance, 0.18) * _shadow(image.shape, chance)
    return _stored(_noisy(0.9 * image, chance, 0.018), 85)


# ---- what is drawn where ---------------------------------------------------------------------------------------------


def on_printed_task(task: Task, seed: int, fault: Fault | None, *options: str) -> tuple[Drawing, Paper]:
    """A drawing on the task's paper: where it has the plans, and from the marks that are printed there."""
    scene, options = scene_file(task), (*task.options, *options)
    paper, board = printed(scene, *options), Board(random.Random(seed), fault)
    task.draw(task, board, given_places(task, paper.height, scene, *options))
    for step in steps_of(scene, *options):
        at = board.marks.get(("second", step["makes"]))
        if step["operation"] == "begin" and step["plan"] == "N-plan" and at is not None:
            off = on_page(step, paper.height) - at  # a student goes on from the printed mark
            moved = {z: z + off for (plan, _), z in board.marks.items() if plan == "second"}
            board.marks |= {key: moved[z] for key, z in board.marks.items() if key[0] == "second"}
            board.strokes = [(moved.get(one, one), moved.get(other, other)) for one, other in board.strokes]
    if not all(0 < z.real < paper.width and 0 < z.imag < paper.height for z in board.marks.values()):
        raise Unfit("off the paper")
    return Drawing(task, board, fault), paper


def on_page(step: dict[str, Any], height: float) -> complex:
    """Where a step's mark is on its page, in mm, y upward."""
    x, y = step["paper"]
    return complex(x, height - y)


def given_places(task: Task, height: float, scene: str, *options: str) -> Places:
    """Where the task's paper has the plans, and at which scales."""
    at = {(step["plan"], step["makes"]): on_page(step, height) for step in steps_of(scene, *options)
          if step["kind"] == "point"}
    O, A, crank = at["mechanism", "O"], at["mechanism", "A"], abs(task.points["A"])
    k = abs(A - O) / crank
    if task.plan == "polar":
        p, pi = at["velocity plan", "p"], at["acceleration plan", "pi"]
        k_v, k_a = abs(at["velocity plan", "a"] - p), abs(at["acceleration plan", "a'"] - pi)
        return Places(O, p, pi, k, k_v / abs(task.omega) / crank, k_a / task.omega**2 / crank)
    a = at["N-plan", "a"]
    v_a = abs(at.get(("mechanism", "v_a"), O) - A)  # v_A may end in O
    times = abs(at["N-plan", "A_1"] - a) * crank * k / v_a**2
    return Places(O, 0j, a, k, v_a / abs(task.omega) / crank, times)


def pencilled(board: Board) -> list[Stroke]:
    """What a pencil leaves of a drawing: strokes beyond their ends, and dots."""
    lines = [(one, other + BEYOND_MM * (other - one) / abs(other - one)) for one, other in board.strokes
             if other != one]
    dots = [[z + cmath.rect(0.25, 1.5 * k) for k in range(5)] for z in board.marks.values()]
    return [*(([(z.real, z.imag) for z in line], 0.3, 0.7) for line in lines),
            *(([(z.real, z.imag) for z in dot], 0.5, 0.9) for dot in dots)]


# ---- the pencil ------------------------------------------------------------------------------------------------------


def _wobbling(spots: NDArray[np.float64], chance: np.random.Generator) -> NDArray[np.float64]:
    """Spots every 0.05 mm along the stroke, drawn past its ends, off to its side by a slow wobble."""
    if len(spots) < 2 or (math.dist(spots[0], spots[-1]) < 1e-9 and len(spots) == 2):
        return spots
    if len(spots) == 2:
        along = (spots[1] - spots[0]) / math.dist(*spots)
        spots = spots + np.outer(chance.uniform(0, OVERSHOOT, 2) * [-1, 1], along)
    legs = np.hypot(*np.diff(spots, axis=0).T)
    way = np.concatenate([[0.0], np.cumsum(legs)])
    at = np.arange(0.0, way[-1], 0.05)
    path = np.column_stack([np.interp(at, way, spots[:, i]) for i in range(2)])
    knots = chance.standard_normal(int(way[-1] / 12) + 4) * chance.uniform(*WOBBLE)
    side = np.interp(at, np.arange(len(knots)) * 12.0 - 12.0, knots)
    side = np.convolve(np.pad(side, 60, "edge"), np.ones(121) / 121, "valid")
    heading = np.gradient(path, axis=0)
    heading /= np.maximum(np.hypot(*heading.T), 1e-12)[:, None]
    return path + side[:, None] * np.column_stack([-heading[:, 1], heading[:, 0]])


def _stroke(page: Image, path: NDArray[np.float64], width: float, dark: float, height: float,
            chance: np.random.Generator) -> None:
    """Lead along a path: the darkness of each spot spread over the pixels about it."""
    radius = width / 2 * FINE
    reach = math.ceil(radius + 1)
    x, y = path[:, 0] * FINE - 0.5, (height - path[:, 1]) * FINE - 0.5
    uneven = np.convolve(chance.standard_normal(len(x) + 40), np.ones(41) / 6.4, "valid")
    press = dark * np.clip(1 + 0.15 * uneven, 0, 1)
    column, row = np.rint(x).astype(int), np.rint(y).astype(int)
    for i in range(-reach, reach + 1):
        for j in range(-reach, reach + 1):
            off = np.hypot(column + i - x, row + j - y)
            lead = press * np.clip(radius + 0.5 - off, 0, 1)
            inside = (lead > 0) & (row + j >= 0) & (row + j < page.shape[0]) & (column + i >= 0) & (
                column + i < page.shape[1])
            np.maximum.at(page, (row[inside] + j, column[inside] + i), lead[inside].astype(np.float32))


def _smudge(pencil: Image, chance: np.random.Generator) -> None:
    """A finger's mark: broad, soft and faint."""
    high, wide = pencil.shape
    patch = np.zeros((high // 16 + 1, wide // 16 + 1), np.float32)
    centre = int(chance.uniform(0, patch.shape[1])), int(chance.uniform(0, patch.shape[0]))
    axes = int(chance.uniform(2, 6) * FINE / 16 + 1), int(chance.uniform(4, 15) * FINE / 16 + 1)
    cv2.ellipse(patch, centre, axes, chance.uniform(0, 180), 0, 360, chance.uniform(0.04, 0.12), -1)
    pencil += cv2.resize(cv2.GaussianBlur(patch, (0, 0), 1.5), (wide, high))


# ---- how it is seen --------------------------------------------------------------------------------------------------


def _view(paper: Paper, size: tuple[int, int], chance: np.random.Generator, tilt: float,
          around: float) -> NDArray[np.float64]:
    """Mm of the sheet (y down) to pixels of a tilted camera that sees all of it."""
    pitch, yaw, roll = np.radians([*chance.uniform(-tilt, tilt, 2) / math.sqrt(2), chance.uniform(-around, around)])
    lean = cv2.Rodrigues(np.array([pitch, 0.0, 0.0]))[0] @ cv2.Rodrigues(np.array([0.0, yaw, 0.0]))[0]
    pose = lean @ cv2.Rodrigues(np.array([0.0, 0.0, roll]))[0]
    focal, far = 0.8 * size[0], 1.3 * max(paper.width, paper.height)
    corners = np.array([[0, 0], [paper.width, 0], [paper.width, paper.height], [0, paper.height]], float)
    centred = np.array([[1, 0, -paper.width / 2], [0, 1, -paper.height / 2], [0, 0, 1]])
    seen = np.column_stack([pose[:, 0], pose[:, 1], [0, 0, far]]) @ centred
    camera = np.array([[focal, 0, 0], [0, focal, 0], [0, 0, 1.0]]) @ seen
    flat = cv2.perspectiveTransform(corners.reshape(-1, 1, 2), camera).reshape(-1, 2)
    low, high = flat.min(axis=0), flat.max(axis=0)
    zoom = 0.95 * min(np.array(size) / (high - low))
    move = np.array(size) / 2 - zoom * (low + high) / 2
    return np.array([[zoom, 0, move[0]], [0, zoom, move[1]], [0, 0, 1]]) @ camera


def _bent(spots: NDArray[np.float64], shape: tuple[int, ...], bend: float) -> NDArray[np.float64]:
    """Pixels moved outwards (or inwards) by the square of their distance from the middle."""
    middle = np.array([shape[1], shape[0]]) / 2
    out = (spots - middle) / np.hypot(*middle)
    return middle + (spots - middle) * (1 + bend * (out**2).sum(axis=1, keepdims=True))


def _looked_at(fine: Image, turn: NDArray[np.float64], size: tuple[int, int], bend: float, table: float) -> Image:
    """The page through a camera; whatever is beside it has the lightness of the table."""
    step = 16
    x, y = np.meshgrid(np.arange(0, size[0] + step, step, float), np.arange(0, size[1] + step, step, float))
    seen = np.column_stack([x.ravel(), y.ravel()])
    flat = seen.copy()
    for _ in range(6):
        flat += seen - _bent(flat, (size[1], size[0]), bend)
    page = cv2.perspectiveTransform(flat.reshape(-1, 1, 2), np.linalg.inv(turn)).reshape(*x.shape, 2) * FINE - 0.5
    maps = [_interpolated(page[..., i], size, step) for i in range(2)]
    return cv2.remap(fine, *maps, cv2.INTER_LINEAR, borderMode=cv2.BORDER_CONSTANT, borderValue=table)


def _interpolated(coarse: NDArray[np.float64], size: tuple[int, int], step: int) -> Image:
    """Values at every pixel between those at every `step`th."""
    along = np.arange(size[0], dtype=np.float32) / step
    down = np.arange(size[1], dtype=np.float32) / step
    grid = np.meshgrid(along, down)
    return cv2.remap(coarse.astype(np.float32), *grid, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)


def _shade(shape: tuple[int, ...], chance: np.random.Generator, most: float) -> Image:
    """Light from one side, and uneven."""
    rough = 1 - most * chance.uniform(0, 1, (3, 4)).astype(np.float32)
    return cv2.resize(rough, (shape[1], shape[0]), interpolation=cv2.INTER_CUBIC)


def _shadow(shape: tuple[int, ...], chance: np.random.Generator) -> Image:
    """A shadow with a soft edge across the page."""
    angle = chance.uniform(0, 2 * math.pi)
    x, y = np.meshgrid(np.linspace(-1, 1, 160, dtype=np.float32), np.linspace(-1, 1, 120, dtype=np.float32))
    beyond = x * math.cos(angle) + y * math.sin(angle) - chance.uniform(0, 0.6)
    dark = 1 - chance.uniform(0.15, 0.35) / (1 + np.exp(-beyond / chance.uniform(0.03, 0.12)))
    return cv2.resize(dark.astype(np.float32), (shape[1], shape[0]))


def _noisy(image: Image, chance: np.random.Generator, noise: float) -> Image:
    return image + noise * chance.standard_normal(image.shape, np.float32)


def _stored(image: Image, quality: int) -> Grey:
    """Through JPEG and back."""
    coded = cv2.imencode(".jpg", np.clip(255 * image, 0, 255).astype(np.uint8), [cv2.IMWRITE_JPEG_QUALITY, quality])[1]
    return np.asarray(cv2.imdecode(coded, cv2.IMREAD_GRAYSCALE), np.uint8)


def as_document(*images: Grey) -> bytes:
    """Pictures of A4 or A3 as the pages of a PDF."""
    objects, kids = [b"<</Type/Catalog/Pages 2 0 R>>", b""], []
    for image in images:
        high, wide = image.shape
        data = cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, 92])[1].tobytes()
        box = (wide * 72 // 150, high * 72 // 150)
        content = b"q %d 0 0 %d 0 0 cm /I Do Q" % box
        number = len(objects) + 1
        kids.append(b"%d 0 R" % number)
        objects += [b"<</Type/Page/Parent 2 0 R/MediaBox[0 0 %d %d]/Contents %d 0 R"
                    b"/Resources<</XObject<</I %d 0 R>>>>>>" % (*box, number + 1, number + 2),
                    b"<</Length %d>>stream\n%b\nendstream" % (len(content), content),
                    b"<</Type/XObject/Subtype/Image/Width %d/Height %d/ColorSpace/DeviceGray/BitsPerComponent 8"
                    b"/Filter/DCTDecode/Length %d>>stream\n%b\nendstream" % (wide, high, len(data), data)]
    objects[1] = b"<</Type/Pages/Count %d/Kids[%b]>>" % (len(kids), b" ".join(kids))
    out, places = b"%PDF-1.4\n", []
    for number, body in enumerate(objects, 1):
        places.append(len(out))
        out += b"%d 0 obj\n%b\nendobj\n" % (number, body)
    table = b"".join(b"%010d 00000 n \n" % place for place in places)
    return out + b"xref\n0 %d\n0000000000 65535 f \n%btrailer<</Size %d/Root 1 0 R>>\nstartxref\n%d\n%%%%EOF" % (
        len(objects) + 1, table, len(objects) + 1, len(out))
