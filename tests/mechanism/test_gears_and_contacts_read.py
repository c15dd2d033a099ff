"""Gears and contacts as they are read: faults, names, mobility, groups, and what special geometry makes redundant."""

from __future__ import annotations

from fractions import Fraction

import higher
import pytest
from higher import DRIVE, TEXTS, contact, gear, slide

from graphplan import solver as analytic
from graphplan.errors import Refused, SceneError
from graphplan.mechanism.scene import parse
from graphplan.mechanism.structure import mobility, structure

# --- faults ----------------------------------------------------------------------------------------------------------

ARM = "gears.1.centres: nothing holds the centres O and B apart; an arm: a link with a joint at each"
ON_NORMAL = "a point of contact on the common normal"
SIZES = "the ring, which is the second, is no larger than the gear in it"
FAULTS: list[tuple[str, str, str, str]] = [  # scene, what is written, what in its place, the fault
    ("planet", "teeth = [30, 20]", "", "gears.1: neither teeth nor radii; teeth = [24, 36], or radii = [48, 72]"),
    ("planet", "teeth = [30, 20]", "teeth = [30, 20]\nradii = [25, 25]",
     "gears.1.radii: the radii 25 and 25 are not as the teeth 30 and 20; radii in the ratio of the teeth, or teeth "
     "alone"),
    ("planet", "teeth = [30, 20]", "teeth = [30, 20.5]", "gears.1.teeth: 20.5 teeth; whole numbers such as [24, 36]"),
    ("planet", "teeth = [30, 20]", "teeth = [0, 20]",
     "gears.1.teeth: the number of teeth 0 is not positive; a number of teeth above 0"),
    ("planet", "teeth = [30, 20]", "teeth = 30",
     "gears.1.teeth: the number 30 where two teeth are wanted; two numbers such as [24, 36]"),
    ("planet", "['O', 'B']", "['B', 'B']", "gears.1.centres: B is not a point of link 1; one of O"),
    ("planet", "['O', 'B']", "['O']", "gears.1.centres: 1 centre; the centre of each link's pitch circle"),
    ("planet", "['O', 'B']", "'O B'",
     'gears.1.centres: the string "O B" where centres are wanted; points such as ["B", "C"]'),
    ("planet", "['1', '2']", "['2', '2']", "gears.1: link 2 is geared with itself; two different links"),
    ("planet", "'3' = 'O B'", "'3' = 'O M'", ARM),
    ("planet", "[30, 40]", "[0, 0]", "gears.1.centres: the centres O and B coincide; centres that lie apart"),
    ("planet", DRIVE.format("1"), gear("2 1", "B O", "teeth = [3, 2]"),
     "gears.2: a second gear between links 2 and 1; one about two centres"),
    ("ring", "[30, 20]", "[30, 21]", "gears.1.radii: the distance 50 of the centres O and B is not the sum 51 of the "
     "radii; radii whose sum is the distance, or teeth"),
    ("ring", "[20, 70]", "[20, 71]", "gears.2.radii: the distance 50 of the centres B and O is not the difference 51 "
     "of the radii; radii whose difference is the distance, or teeth"),
    ("ring", "[20, 70]", "[70, 20]", f"gears.2.radii: {SIZES}: 70 and 20; a ring that is larger"),
    ("ring", "[20, 70]", "[20, 20]", f"gears.2.radii: {SIZES}: 20 and 20; a ring that is larger"),
    ("ring", "true", "'yes'",
     'gears.2.internal: the string "yes" where true or false is wanted; true or false, without quotes'),
    ("belt", "[7, 20]", "[70, 20]", "gears.1.radii: the distance 50 of the centres O and B is no more than the "
     "difference of the radii = 50: the belt cannot be laid; centres further apart"),
    ("crossed belt", "[7, 20]", "[30, 20]", "gears.1.radii: the distance 50 of the centres O and B is no more than "
     "r_1 + r_2 = 50: the belt cannot be laid; centres further apart"),
    ("belt", "'open'", "'opne'", 'gears.1.belt: the string "opne" is not known here; perhaps open'),
    ("rack", "43\ndirection = [4, 3]", "43\ndirection = [4, 2]",
     "gears.1.centres: B can leave the pitch line; a pin, or a slide along it"),
    ("rack", "centres = ['B']", "centres = ['B', 'S']",
     "gears.1.centres: 2 centres; the gear's centre alone: a rack has none"),
    ("cam", "[12, 16]", "[12, 17]", "contacts.1.at: K is not in line with the centres B and C; "
     f'{ON_NORMAL}, such as K = {{ on = "B C", distance = ... }}'),
    ("cam", '["B", "C"]', '["B", "K"]', "contacts.1.centres: K is not a point of link 2; one of C, M"),
    ("cam", "C = [90, 120]", "C = [30, 40]",
     "contacts.1.centres: the centres B and C coincide: two profiles of the same curvature; centres that lie apart"),
    ("cam", '["B", "C"]', '["B"]', "contacts.1.centres: a list of 1 where two centres are wanted; two centres such as "
     '["C2", "C3"], or a direction in the place of one'),
    ("cam", "['1', '2']", "['1', '1']", "contacts.1: link 1 touches itself; two different links"),
    ("cam", DRIVE.format("1"), contact("2 1", "K", '["C", "B"]'),
     "contacts.2: a second contact of links 2 and 1 at K; one where two links touch"),
    ("flat follower", "[4, -3]", "[4, -2]", f"contacts.1.at: K and B are not square to the direction; {ON_NORMAL}"),
    ("flat follower", '"B"]', "[4, -3]]",
     "contacts.1.centres: both profiles are straight; [[slides]] for two lines that slide"),
    ("wheel on a wheel", "K = [12, 16]", "K = [30, 40]",
     "contacts.1.centres: B is the centre and the point of contact: a corner does not roll; rolling = false"),
]


@pytest.mark.parametrize(("name", "written", "instead", "told"), FAULTS, ids=[fault[3] for fault in FAULTS])
def test_each_fault_is_told_in_a_line(name: str, written: str, instead: str, told: str) -> None:
    """What is wrong with a gear or a contact is told where it stands, with what would be right."""
    assert written in TEXTS[name]
    with pytest.raises(SceneError) as error:
        parse(TEXTS[name].replace(written, instead), "f.toml")
    assert f"f.toml: {told}" in error.value.lines


def test_an_arm_may_be_anything_that_holds() -> None:
    """Centres are held by a link, by pins in the frame, or by a coupler's joints under other names; not by a slide
    that is square to the line of centres in this pose alone."""
    train = {"1": "O", "2": "B M", "frame": "O B"}
    parse(higher.text(train, gear("1 2", "O B", "teeth = [3, 2]"), DRIVE.format("1")), "pins")
    named = higher.text({"1": "O", "2": "B N", "3": "O B", "frame": "O"}, gear("1 2", "O N", "teeth = [3, 2]"),
                        DRIVE.format("1"), DRIVE.format("3"))
    parse(named.replace("[points]", "[points]\nN = [30, 40]"), "by another name")
    slid = higher.text({"1": "O", "2": "B M", "3": "B", "frame": "O"}, slide("3", "B", "[-4, 3]"),
                       gear("1 2", "O B", "teeth = [3, 2]"), DRIVE.format("1"), DRIVE.format("2"))
    with pytest.raises(SceneError, match="nothing holds the centres O and B apart"):
        parse(slid, "square")


# --- numbers and names -----------------------------------------------------------------------------------------------


def test_what_is_irrational_is_told() -> None:
    """A rack along a direction of irrational length is no task for fractions; a contact at an irrational place is,
    unless its profiles roll."""
    text = TEXTS["rack"].replace("[4, 3]", "[1, 1]")
    with pytest.raises(Refused, match=r"gears\.1: a rack along a direction of irrational length"):
        analytic.solve(parse(text, "rack"), exact=True)
    place = 'K = { on = "B C", distance = 7 }'
    cam = TEXTS["cam"].replace("C = [90, 120]", "C = [90, 100]").replace("K = [12, 16]", place)
    assert analytic.solve(parse(cam, "cam"), exact=True).omega["2"] == Fraction(-42, 65)
    rolls = parse(cam.replace("['1', '2']\nat", "['1', '2']\nrolling = true\nat")
                  .replace("'frame' = 'A M'", "'frame' = 'A'") + DRIVE.format("2"), "cam")
    with pytest.raises(Refused, match=r"points\.K: on-line placement"):
        analytic.solve(rolls, exact=True)


CLOSED = higher.text({"1": "A B", "2": "M", "frame": "A"}, slide("2", "M", "[3, 4]"),
                     contact("1 2", "K", '["B", [4, -3]]'), contact("1 2", "L", '["B", [4, -3]]'), DRIVE.format("1"),
                     ).replace("[points]", "[points]\nL = [60, 80]")


def test_pairs_of_the_same_links_have_names_of_their_own() -> None:
    """Two contacts of two links are told apart by where these touch; in whichever order they are written."""
    names = {pair.name for pair in parse(CLOSED, "closed").contacts}
    assert names == {"1 2 at K", "1 2 at L"}
    assert [pair.name for pair in parse(TEXTS["cam"], "cam").contacts] == ["1 2"]


# --- mobility and groups ---------------------------------------------------------------------------------------------

STRUCTURES = {
    "planet": (2, ["class I: driving link 1", "class I: driving link 3",
                   "class II group, order 2: links 2 (dyad RRR, modification 1)"]),
    "rack": (2, ["class I: driving link 3", "class III group, order 3: links 2 4 (triad)"]),
    "ring": (1, ["class I: driving link 1", "class III group, order 3: links 2 3 (triad)"]),
    "cam": (1, ["class I: driving link 1", "class II group, order 2: links 2 (dyad RRR, modification 1)"]),
    "flat follower": (1, ["class I: driving link 1", "class II group, order 2: links 2 (dyad RPP, modification 5)"]),
    "turning flat follower": (1, ["class I: driving link 1",
                                  "class II group, order 2: links 2 (dyad RPR, modification 3)"]),
    "wheel on a rail": (1, ["class I: driving link 2"]),
}


@pytest.mark.parametrize("name", STRUCTURES)
def test_a_higher_pair_acts_as_a_link_between(name: str) -> None:
    """Gears and contacts take one freedom, rolling contacts two; in groups they act as the links that replace them."""
    scene, (freedoms, parts) = parse(TEXTS[name], name), STRUCTURES[name]
    assert mobility(scene) == freedoms
    assert {str(line) for line in structure(scene).lines()} >= {*parts}


# --- special geometry ------------------------------------------------------------------------------------------------

PLANETS = (
    "[points]\nO = [0, 0]\nB = [50, 0]\nC = [-30, 40]\nD = [-14, -48]\n[links]\n1 = 'O'\n2 = 'B'\n3 = 'C'\n4 = 'D'\n"
    "H = 'O B C D'\nframe = 'O'\n"
    + "".join(gear(f"1 {link}", f"O {centre}", "teeth = [30, 20]")
              + gear(f"{link} frame", f"{centre} O", "teeth = [20, 70]\ninternal = true")
              for link, centre in (("2", "B"), ("3", "C"), ("4", "D"))) + DRIVE.format("1"))
AXLE = higher.text({"2": "B M", "3": "B", "frame": "O"}, slide("3", "B", "[-4, 3]"),
                   contact("2 frame", "K", '["B", [-4, 3]]', "rolling = true"), DRIVE.format("2"))
REPEATED = {  # the scene, its count of freedoms, its redundant pairs, and what spoils it
    "three planets": (PLANETS, -1, 2, [("[30, 20]", "[31, 20]")]),
    "a wheel with an axle that slides": (AXLE, 0, 1, [("[-4, 3]\n", "[-4, 2]\n")]),
    "a cam between two faces": (CLOSED, 0, 1, [("L = [60, 80]", "L = [62, 64]"),
                                               ("'L'\ncentres = [\"B\", [4, -3]]", "'L'\ncentres = [\"B\", [3, -4]]")]),
}


@pytest.mark.parametrize("name", REPEATED)
def test_pairs_that_repeat_others_are_found(name: str) -> None:
    """Higher pairs may be redundant by special geometry: the links move beyond velocities, exactly as without them."""
    text, count, redundant, spoilt = REPEATED[name]
    scene = parse(text, name)
    assert (mobility(scene), structure(scene).mobility) == (count, 1)
    assert len(scene.redundant_pairs) == redundant
    exact, rounded = analytic.solve(scene, exact=True), analytic.solve(scene)
    for part in ("omega", "alpha"):
        for link, value in getattr(exact, part).items():
            assert getattr(rounded, part)[link] == pytest.approx(float(value), abs=1e-9)
    for written, instead in spoilt:
        assert written in text
        text = text.replace(written, instead, 1)
    with pytest.raises(SceneError, match="fewer pairs, or gears whose ratios agree"):
        parse(text, name)
