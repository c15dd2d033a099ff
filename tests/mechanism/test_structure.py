"""The structure of mechanisms: mobility, groups in the order of motion transfer, their class, and bad bracing."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphplan.errors import SceneError
from graphplan.mechanism.model import FRAME, Find, Motion, Scene, Slide, SlidingDrive, TurningDrive, Units
from graphplan.mechanism.structure import loop_lengths, mobility, roman, structure


def chain(links: str, slides: str = "", drives: str = "1", motions: str = "") -> Scene:
    """A scene from a graph in short: `1=OA 2=AB frame=OB`, slides `3/2@B`, drives `1` (to the frame), `3:2`, `3/2`."""
    named = {name: tuple(points) for name, points in (link.split("=") for link in links.split())}
    points = dict.fromkeys(p for link in named.values() for p in link)
    pairs = [slide.replace("/", "@").split("@") for slide in slides.split()]
    rest = Fraction(0)
    return Scene(
        title="",
        source="",
        name="chain",
        units=Units(),
        points=dict.fromkeys(points, (rest, rest)),
        placements={},
        links=named,
        written=(*(Slide(link, along, at, (Fraction(1), rest)) for link, along, at in pairs),
                 *(drive(text) for text in drives.split())),
        motions={p: Motion((rest, rest), (rest, rest)) for p in motions},
        find=Find((), ()),
    )


def drive(text: str) -> TurningDrive | SlidingDrive:
    """`3/2` is an actuator of link 3 along link 2, `3:2` turns 3 relative to 2, `3` relative to the frame."""
    if "/" in text:
        link, _, along = text.partition("/")
        return SlidingDrive(link, along, Fraction(1), Fraction(0))
    link, _, base = text.partition(":")
    return TurningDrive(link, base or FRAME, Fraction(1), Fraction(0))


Case = tuple[str, Scene, list[str]]

GROUPS: list[Case] = [
    ("four-bar", chain("1=OA 2=AB 3=BC frame=OC"), ["class II group, order 2: links 2 3 (dyad RRR, modification 1)"]),
    (
        "slider-crank",
        chain("1=OA 2=AB 3=B frame=O", "3/frame@B"),
        ["class II group, order 2: links 2 3 (dyad RRP, modification 2)"],
    ),
    (
        "slotted link",
        chain("1=OA 2=A 3=CE frame=OC", "2/3@A"),
        ["class II group, order 2: links 2 3 (dyad RPR, modification 3)"],
    ),
    (
        "swinging block",
        chain("1=OA 2=AB 3=C frame=OC", "3/2@C"),
        ["class II group, order 2: links 2 3 (dyad RPR, modification 3)"],
    ),
    (
        "crank with a slide on its coupler, and a block on the frame",
        chain("1=OA 2=B 3=B frame=O", "2/1@B 3/frame@B"),
        ["class II group, order 2: links 2 3 (dyad PRP, modification 4)"],
    ),
    (
        "sine mechanism",
        chain("1=OA 2=A 3=E frame=O", "2/3@A 3/frame@E"),
        ["class II group, order 2: links 2 3 (dyad RPP, modification 5)"],
    ),
    (
        "triad",
        chain("1=OA 2=AE 3=EFG 4=FC 5=GD frame=OCD"),
        ["class III group, order 3: links 2 3 4 5 (triad)"],
    ),
    (
        "triangle of three bars, the same as a triad's ternary link",
        chain("1=OA 2=AE 3=EF 4=FG 5=GE 6=FC 7=GD frame=OCD"),
        ["class III group, order 3: links 2 3 4 5 6 7"],
    ),
    (
        "two ternary links joined by two bars",
        chain("1=OA 2=ADF 3=BGE 4=DG 5=FE frame=OB"),
        ["class IV group, order 2: links 2 3 4 5"],
    ),
    (
        "Rosenauer's eight-link chain without four-bar loops",
        chain("1=OFG 2=FB 3=ABC 4=AN 5=GE 6=CDE 7=DM frame=ONM"),
        ["class III group, order 4: links 2 3 4 5 6 7"],
    ),
    (
        "the Stephenson link",
        chain("1=FDE 2=DC 3=CAB 4=EB 5=AG frame=FG"),
        ["class III group, order 3: links 2 3 4 5 (triad)"],
    ),
    (
        "two dyads on one joint of the crank",
        chain("1=OA 2=AB 3=BC 4=AD 5=DE frame=OCE"),
        [
            "class II group, order 2: links 2 3 (dyad RRR, modification 1)",
            "class II group, order 2: links 4 5 (dyad RRR, modification 1)",
        ],
    ),
    (
        "a second dyad hung on the double joint inside the first",
        chain("1=OA 4=BD 5=DE 2=AB 3=BC frame=OCE"),
        [
            "class II group, order 2: links 2 3 (dyad RRR, modification 1)",
            "class II group, order 2: links 4 5 (dyad RRR, modification 1)",
        ],
    ),
    (
        "an excavator's cylinder: barrel and rod held by the drive are one body",
        chain("2=OAB 3=C 4=DA frame=OC", "4/3@D", "4/3"),
        ["class II group, order 2: links 2 3 4 (dyad RRR, modification 1)"],
    ),
    (
        "a four-bar driven at its coupler is of class III",
        chain("1=OA 2=AB 3=BC frame=OC", drives="2"),
        ["class III group, order 3: links 1 2 3 (triad)"],
    ),
    ("a robot arm", chain("1=OA 2=AB 3=BC frame=O", drives="1 2:1 3"), []),
    (
        "an open chain with given motions: the basic case of two ternary links",
        chain("1=ABC 2=CDE 3=AK 4=BL 5=DM 6=EN", drives="", motions="KLMN"),
        ["class III group, order 4: links 1 2 3 4 5 6"],
    ),
]


def test_groups() -> None:
    """Each mechanism falls apart into the groups that the textbooks name, in the order of motion transfer."""
    for name, scene, lines in GROUPS:
        assert [group.line for group in structure(scene).groups] == lines, name


def test_mobility_counts_multiple_joints_once_less() -> None:
    """A joint of k links is k - 1 pairs, so the count equals what the drives prescribe in every sound mechanism."""
    for name, scene, _ in GROUPS:
        assert mobility(scene) == structure(scene).mobility == len(scene.drives) + 2 * len(scene.motions), name


def test_driving_links_are_no_groups() -> None:
    """Links that a drive holds alone are class I, and come before what they drive."""
    found = structure(chain("3=BC 2=AB 1=OA frame=OC"))
    assert found.driving == ("1",)
    assert found.lines()[0] == "class I: driving link 1"
    assert found.lines()[-1] == "mechanism of class II, mobility 1"
    assert structure(chain("1=OA 2=AB 3=BC frame=O", drives="1 2:1 3")).driving == ("1", "2", "3")


def test_the_class_depends_on_the_driver() -> None:
    """Driven at link 7 instead of link 1, a class III mechanism is one of class II."""
    links = "1=OA 2=AE 3=EFG 4=FC 5=GD frame=OCD"
    assert structure(chain(links)).class_ == 3
    assert structure(chain(links, drives="4")).class_ == 2


UNSOUND = [
    ("a brace in the frame's truss, a loose four-bar", "1=OA 2=AB 3=BC 4=AE 5=EF 6=EC frame=OCF 7=FG", ""),
    ("two links that share two joints, carried by two bars", "1=OA 2=DEP 3=DEQ 4=PA 5=QC frame=OC", ""),
    ("a ring of slides", "1=OA 2=B 3=C frame=O", "2/1@B 3/2@C 3/frame@C"),
]


def test_bad_bracing_is_refused_though_the_count_may_be_right() -> None:
    """A part held twice while another is loose has no structure: an error, not a wrong answer."""
    for name, links, slides in UNSOUND:
        with pytest.raises(SceneError, match="loose"):
            structure(chain(links, slides))
            pytest.fail(name)


def long_chain(dyads: int) -> str:
    """A crank and as many dyads, one behind the other, points named by single characters."""
    point = iter(chr(c) for c in range(0x4E00, 0x9FFF))
    origin, joint = next(point), next(point)
    links, fixed = [f"1={origin}{joint}"], origin
    for i in range(dyads):
        b, c, tip = next(point), next(point), next(point)
        links += [f"c{i}={joint}{b}", f"r{i}={b}{c}{tip}"]
        fixed, joint = fixed + c, tip
    return " ".join([*links, f"frame={fixed}"])


def test_long_chains_are_analysed() -> None:
    """A chain of a thousand links falls apart into its dyads, driven at either end."""
    for driver in ("1", "r499"):
        assert len(structure(chain(long_chain(500), drives=driver)).groups) == 500


@given(st.sampled_from(GROUPS), st.randoms(use_true_random=False))
def test_the_order_in_which_links_are_written_does_not_matter(case: Case, chance: random.Random) -> None:
    """However the links are shuffled, the same groups are found."""
    _, scene, _ = case
    links = list(scene.links.items())
    chance.shuffle(links)
    found = [structure(s).groups for s in (scene, replace(scene, links=dict(links)))]
    written, shuffled = ({(frozenset(group.links), group.kind, group.order) for group in groups} for groups in found)
    assert written == shuffled


@given(st.lists(st.tuples(st.integers(0, 99), st.integers(0, 99)), min_size=1, max_size=20))
def test_what_is_built_of_dyads_falls_apart_into_them(attached: list[tuple[int, int]]) -> None:
    """Dyads hung one after another on any points of what moves already, or of the frame, are found again."""
    point = iter(chr(c) for c in range(0x4E00, 0x9FFF))
    origin, tip = next(point), next(point)
    links, moving, fixed, dyads = [f"1={origin}{tip}"], [tip], origin, []
    for i, (one, other) in enumerate(attached):
        inner, pivot, end = next(point), next(point), next(point)
        first = moving[one % len(moving)]
        second = pivot if other % 3 else moving[other % len(moving)]
        if second in (pivot, first):
            second, fixed = pivot, fixed + pivot
        links += [f"a{i}={first}{inner}", f"b{i}={inner}{second}{end}"]
        moving += [inner, end]
        dyads.append({f"a{i}", f"b{i}"})
    found = [set(group.links) for group in structure(chain(" ".join([*links[::-1], f"frame={fixed}"]))).groups]
    assert sorted(found, key=sorted) == sorted(dyads, key=sorted)


def test_smallest_loops() -> None:
    """A cube has five independent loops of four edges; a tree has none; two loops with a common path are told apart."""
    cube = {v: frozenset(v ^ bit for bit in (1, 2, 4)) for v in range(8)}
    assert loop_lengths(cube) == [4] * 5
    assert loop_lengths({0: frozenset({1}), 1: frozenset({0, 2}), 2: frozenset({1})}) == []
    theta: dict[int, set[int]] = {0: {1, 2, 3}, 1: {0, 4}, 2: {0, 4}, 3: {0, 5}, 5: {3, 4}, 4: {1, 2, 5}}
    assert loop_lengths({v: frozenset(others) for v, others in theta.items()}) == [4, 5]


def test_roman() -> None:
    """Classes are written in Roman numerals."""
    numerals = {1: "I", 2: "II", 3: "III", 4: "IV", 9: "IX", 14: "XIV", 40: "XL", 99: "XCIX"}
    assert {number: roman(number) for number in numerals} == numerals
