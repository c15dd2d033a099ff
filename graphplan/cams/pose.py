"""The cam in one pose as a scene: profiles that touch, by their centres of curvature, and the cam as the drive.

The scene has the velocity and the acceleration of the follower in that pose exactly; in others it is the mechanism in
which the profile goes on as the circle of curvature that it has here. Where pieces of the law meet it is that of the
piece that begins.
"""

from __future__ import annotations

from collections.abc import Iterator

from graphplan.cams.follower import FlatOscillating, Oscillating, Translating
from graphplan.cams.profile import Cam
from graphplan.cams.tolerances import ZERO_LENGTH
from graphplan.mechanism.numbers import shown

CAM, FOLLOWER = "1", "2"
CENTRE, PIVOT, PROFILE, END, TOUCHED = "O", "B", "C", "A", "K"  # letters of points
STRAIGHT = 1e12  # of the base circle's radius: a profile so little curved is straight


def scene_text(cam: Cam, angle: float) -> str:
    """The scene of a cam that has turned by an angle in degrees, as TOML."""
    touch, pair = cam.touch([angle]), cam.pair
    point, centre, end = (complex(spot[0]) for spot in (touch.point, touch.centre, touch.roller))
    tangent = 1j * complex(touch.normal[0])
    straight = not abs(touch.radius[0]) < STRAIGHT * pair.base
    points = {CENTRE: 0j, TOUCHED: point}
    own, touching = _follower(cam, points, end)
    middle = "" if straight else CENTRE if abs(centre) < ZERO_LENGTH * pair.base else PROFILE
    if middle == PROFILE:
        points[PROFILE] = centre
    profile = f'"{middle}"' if middle else _vector(tangent)
    body = f"{CENTRE} {PROFILE}" if middle == PROFILE else f"{CENTRE} K{CAM}"
    points |= {} if middle == PROFILE else {f"K{CAM}": point}
    lines = [*_head(cam, angle), "", "[points]", *(f"{name} = {_vector(spot)}" for name, spot in points.items()),
             "", "[links]", f'{CAM} = "{body}"', *own, "", "[[contacts]]", f'links = ["{CAM}", "{FOLLOWER}"]',
             f'at = "{TOUCHED}"', f"centres = [{profile}, {touching if touching else _vector(tangent)}]",
             "", "[[drive]]", f'link = "{CAM}"', f"omega = {pair.sense * cam.task.cam.omega!r}", *_asked(cam)]
    return "\n".join(lines) + "\n"


def _head(cam: Cam, angle: float) -> Iterator[str]:
    """Title, source and units."""
    title = cam.task.title or "Cam"
    yield f"title = {_quoted(f'{title}: at {shown(angle)} degrees')}"
    if cam.task.source:
        yield f"source = {_quoted(cam.task.source)}"
    yield from ("", "[units]", f'length = "{cam.task.units.length}"')


def _follower(cam: Cam, points: dict[str, complex], end: complex) -> tuple[list[str], str]:
    """The lines of the follower and of what holds it, and its centre of curvature if it has one; its points are added.
    """
    pair, flat = cam.pair, cam.task.follower.flat
    if isinstance(pair, Oscillating | FlatOscillating):
        points |= {PIVOT: complex(pair.distance), END: end}
        return [f'{FOLLOWER} = "{PIVOT} {END}"', f'frame = "{CENTRE} {PIVOT}"'], "" if flat else f'"{END}"'
    across = pair.sense * pair.offset if isinstance(pair, Translating) else 0.0
    points[END] = complex(across, end.imag)
    held = [f'{FOLLOWER} = "{END}"', f'frame = "{CENTRE}"', "", "[[slides]]", f'link = "{FOLLOWER}"',
            'along = "frame"', f'at = "{END}"', "direction = [0, 1]"]
    return held, "" if flat else f'"{END}"'


def _asked(cam: Cam) -> Iterator[str]:
    """What is asked for: the motion of the follower."""
    yield from ("", "[find]", f'velocity = ["{END}"]', f'acceleration = ["{END}"]')
    if cam.task.follower.oscillates:
        yield f'links = ["{FOLLOWER}"]'


def _vector(z: complex) -> str:
    """Two numbers as TOML, each as near as a float is."""
    return f"[{z.real + 0.0!r}, {z.imag + 0.0!r}]"


def _quoted(text: str) -> str:
    """A text as TOML."""
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def motion(cam: Cam, angle: float) -> tuple[float, float]:
    """What the law says of the follower there: velocity and acceleration of its point, or its omega and alpha."""
    rate, change = (float(cam.law.at([angle], order)[0]) * cam.task.cam.omega**order for order in (1, 2))
    return (-rate, -change) if cam.task.follower.oscillates else (rate, change)
