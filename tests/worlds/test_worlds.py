"""What holds in every world: a table of invariants, each tried on random scenes of some kinds.

An invariant reads a scene and its seed. Where the pose is singular, or a way cannot be drawn in it, nothing is claimed;
but that is seldom: of each kind a share at least is regular.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from fractions import Fraction
from itertools import combinations, permutations, product

import numpy as np
import pytest
from apart import strays
from face import ran
from free_bodies import FreeBodies
from henneberg import henneberg_text, under_other_names
from random_loads import loaded
from random_mechanisms import GROUPS, mechanism
from reader import Reader
from transformations import Transformation, tables_of, text_of
from worlds import LOADED, MOVING, RUBBING, asking, scenes

import graphplan as gp
from graphplan.check.arithmetics import Exact
from graphplan.check.report import reference_solution
from graphplan.kernel.numbers import Floats, Fractions

METHODS = "", "trial", "auxiliary", "poles"
PAIRS = tuple(map(",".join, permutations(METHODS[1:], 2)))  # of velocities and of accelerations
MOTIONS = [{"plan": plan, "method": method}
           for plan, method in product(("orthogonal", "polar", ""), (*METHODS, *PAIRS))]
INERTIA = "couple", "shifted", "points", "percussion", "static"
FORCES = [{"plan": plan, "inertia": inertia} for plan, inertia in product(
    ("", "lever", "polygons", "polar", "polar,lever", "polar,polygons"), INERTIA)]
SHARE = 0.5  # of the scenes of a kind, at the least, of which an invariant is found to hold
ROUNDED, CLOSE = 1e-9, 1e-10
Invariant = Callable[[gp.Scene, int], None]


def over(*kinds: str, seeds: int = 12, share: float = SHARE) -> Callable[[Invariant], Callable[[str], None]]:
    """Makes an invariant a test on so many scenes of each of these kinds."""
    def made(invariant: Invariant) -> Callable[[str], None]:
        def test(kind: str) -> None:
            given = held = 0
            for seed, scene in scenes(kind, range(seeds)):
                given += 1
                try:
                    invariant(scene, seed)
                except (gp.SingularPose, gp.ConstructionError):
                    continue
                except Exception as failure:
                    failure.add_note(f"{kind} {seed}:\n{scene.text}")
                    raise
                held += 1
            assert held >= share * given > 0, f"of {given} scenes {held}"

        test.__name__, test.__doc__, test.__module__ = invariant.__name__, invariant.__doc__, __name__
        return pytest.mark.parametrize("kind", kinds)(test)

    return made


# ---- construction and solver -----------------------------------------------------------------------------------------


@over(*MOVING, *LOADED, seeds=12)
def test_the_construction_is_the_solver_in_fractions(scene: gp.Scene, seed: int) -> None:
    """All that is recorded of the first way to draw a scene, by any method and plan, is the solver's to the last
    digit; so is what `solve` prints."""
    styles = FORCES if scene.loads else MOTIONS
    for style in (styles[seed % len(styles)], *([] if scene.loads else [styles[(7 * seed + 3) % len(styles)]])):
        drawing = gp.construct(scene, checked=False, **style)
        results = drawing.read(Fractions())
        truth = reference_solution(scene, Exact()).truth(results)
        assert {(kind, name) for kind, named in results.items() for name, value in named.items()
                if value != truth[kind][name]} == set(), style
    assert not any(gp.solve(scene, exact=True, **style).check.values()), style


@pytest.mark.parametrize("group", sorted(GROUPS))
def test_every_group_is_constructed_in_every_way(group: str) -> None:
    """Dyads of all modifications, triads, class IV and Rosenauer's groups, hung on a crank, by every method, pair of
    methods and plan, with loads and without, exactly; drawn movement by movement they give the same marks."""
    tried = 0
    for seed in range(3):
        scene = mechanism([group], seed)
        try:
            for style in ({}, {"method": "trial"}, {"method": "auxiliary"}, {"plan": "polar"},
                          *({"method": pair} for pair in PAIRS[seed::3])):
                found = gp.solve(scene, exact=True, **style)
                assert not any(found.check.values())
                assert {*found.velocity} == {*scene.find.velocity}
            assert gp.solve(loaded(scene, seed), exact=True).check["force"] == 0
            drawing = gp.construct(scene)
        except gp.SingularPose:
            continue
        tried += 1
        for wanted, index in zip(drawing.program.wanted, drawing.drawn.wanted, strict=True):
            size = 1 + max(abs(number) for number in drawing.truth[wanted])
            assert drawing.values[index] == pytest.approx(drawing.truth[wanted], rel=0, abs=1e-5 * size)
    assert tried > 0


@over("linkage", "gearing", seeds=10)
def test_poles_and_paths_are_the_solvers_in_fractions(scene: gp.Scene, seed: int) -> None:
    """All poles, and all centres of curvature, inflection circles and acceleration centres of what moves, by any of
    their constructions."""
    assert not any(gp.solve(asking(scene, poles="all"), exact=True).check.values())
    moved = gp.solve(asking(scene), exact=True)
    fixed = scene.links.get("frame", ())
    points = [f"{point} on {link}" for link in scene.moving for point in scene.links[link]
              if point not in fixed and any(moved.velocity[point])]
    turning = [link for link in scene.moving if moved.omega[link]]
    method = ("", "euler-savary", "bobillier", "hartmann", "accelerations")[seed % 5]
    if points or turning:
        asked = asking(scene, curvature=points, inflection=turning, acceleration_centres=turning)
        assert not any(gp.solve(asked, exact=True, method=method).check.values())


@over("linkage", seeds=10)
def test_curvature_at_rest_is_that_of_pivots_and_guides(scene: gp.Scene, seed: int) -> None:
    """Where all rests, points about pivots have these as centres and those of sliding links straight paths; all others
    are left out, each with the reason."""
    still = gp.parse(re.sub("(omega|speed) = .*", r"\1 = 0", scene.text), scene.name)
    fixed = {*scene.links.get("frame", ())}
    turning = {link for link, points in scene.links.items() if fixed & {*points}}
    sliding = {link for slide in scene.slides if "frame" in slide.links for link in slide.links}
    at = {f"{point} on {link}": {*scene.links_of[point]} for link in scene.moving for point in scene.links[link]
          if point not in fixed}
    found = gp.solve(asking(still, velocity="all", curvature=[*at]), exact=True).json()
    left_out = found.get("reasons", {}).get("curvature", {})
    assert {*left_out} == {name for name, links in at.items() if not links & (turning | sliding)}
    for name, path in found.get("curvature", {}).items():
        pivots = [[*map(str, scene.points[p])] for link in at[name] & turning for p in fixed & {*scene.links[link]}]
        assert not path or not path["centre"] or path["centre"] in pivots


@over("gearing", *LOADED, seeds=5)
def test_floats_are_as_good_as_their_bounds(scene: gp.Scene, seed: int) -> None:
    """In floats every number is that in fractions, beside the largest of its kind, and differs from the solver's by
    less than is proven."""
    found, exact = gp.solve(scene), gp.solve(scene, exact=True)
    bounds = found.json()["bounds"]
    assert all(gap <= max(bounds[kind], 1e-15) for kind, gap in found.check.items())
    for kind in ("velocity", "acceleration", "reactions"):
        floats, true = getattr(found, kind), getattr(exact, kind)
        size = max((abs(z) for z in floats.values()), default=0.0)
        assert all(abs(z - complex(*map(float, true[name]))) <= ROUNDED * size for name, z in floats.items())


# ---- forces ----------------------------------------------------------------------------------------------------------


def free_bodies(scene: gp.Scene, exact: bool) -> FreeBodies:
    """What acts on the links of a scene, by what is printed of it; singular where a force has no line of action."""
    asked = asking(scene)
    told = gp.solve(asked, exact=exact).json()
    if any(gear.direction is None and not sum(gear.factors) for gear in scene.gears):
        raise gp.SingularPose(scene.name, "the force of a belt over equal wheels is a couple")
    return FreeBodies(asked, told, exact)


@over(*LOADED, "rubbing slides", seeds=12)
def test_each_link_is_in_balance_and_so_is_the_power(scene: gp.Scene, seed: int) -> None:
    """Loads, inertia, reactions and balances that are printed hold each link, and loads and balances give together the
    power that friction takes, which is never negative: all in fractions."""
    bodies = free_bodies(scene, exact=True)
    assert not any(any(bodies.unbalanced(link)) for link in scene.moving)
    lost = bodies.power("load", "balance")
    assert lost == -bodies.power("slide") >= 0
    assert bodies.power("at", "gear", "contact") == 0
    assert scene.loads.frictions or lost == 0


@pytest.mark.costly
@over("rubbing", "rolling", "sleeve", seeds=16)
def test_friction_leans_and_turns_against_the_motion(scene: gp.Scene, seed: int) -> None:
    """With the couples f R r of journals and k N of rolling, against their turning, each link is in balance; a slide's
    force is against its sliding, f times the normal force, or more where it is pressed at its edges."""
    bodies = free_bodies(scene, exact=False)
    assert all(abs(part) <= ROUNDED * bodies.size for link in scene.moving for part in bodies.unbalanced(link))
    fast = max((abs(complex(*bodies.of_point(point, "velocity"))) for point in scene.points), default=0.0)
    rough = {frozenset(rub.links): rub for rub in scene.loads.frictions if rub.slide}
    for one in bodies.actions:
        rub = rough.get(frozenset((one.on, one.of))) if one.kind == "slide" else None
        slip = complex(*bodies.slip(one))
        if rub is None or abs(slip) <= ROUNDED * fast:
            continue
        drag, normal = complex(*one.force) * slip.conjugate() / abs(slip), float(rub.coefficient)
        edges = max(abs(drag.imag), 2 * abs(one.couple) / float(rub.length)) if rub.length else abs(drag.imag)
        assert drag.real == pytest.approx(-normal * edges, rel=1e-9, abs=ROUNDED * bodies.size)
    given, lost = bodies.power("load", "balance"), -bodies.power("slide", "contact", "friction")
    assert given == pytest.approx(lost, rel=1e-7, abs=ROUNDED * bodies.size * max(fast, 1.0))
    assert lost >= -ROUNDED * bodies.size * max(fast, 1.0)


@pytest.mark.costly
@over("lossy", seeds=24)
def test_balances_give_what_teeth_lose(scene: gp.Scene, seed: int) -> None:
    """Of what the driving wheel gives on the arm the share is lost that its efficiency leaves."""
    bodies = free_bodies(scene, exact=False)
    shares = {frozenset(rub.links): float(1 - rub.coefficient) for rub in scene.loads.frictions}
    lost = sum(lost_in_teeth(bodies, gear, shares[frozenset(gear.links)]) for gear in scene.gears)
    size = max(abs(bodies.power("load")), abs(bodies.power("balance")))
    assert bodies.power("load", "balance") == pytest.approx(lost, rel=1e-7, abs=ROUNDED * size)


def lost_in_teeth(bodies: FreeBodies, gear: object, efficiency: float) -> float:
    """The power that a gear loses, by the force between its teeth and the turning of the first wheel on the arm."""
    tooth = next(one for one in bodies.actions if one.pair == gear.name)
    arm = complex(*tooth.at) - complex(*bodies.at[gear.centres[0]])
    moment = (arm.conjugate() * complex(*tooth.force)).imag * (1 if tooth.on == gear.links[0] else -1)
    turning, k = bodies.rate(gear.links[0]) - bodies.rate(gear.links[1]), float("inf")
    if gear.direction is None:
        k1, k2 = map(float, gear.factors)
        turning, k = turning * k2 / (k1 + k2), k2 / k1
    power = moment * turning
    if power < 0:
        return abs(power) * (1 - efficiency) * ((1 + k) / (1 + efficiency * k) if k != float("inf") else 1 / efficiency)
    return abs(power) * (1 - efficiency) * ((1 + k) / (efficiency + k) if k != float("inf") else 1)


@over(*RUBBING, seeds=10)
def test_friction_is_drawn_until_it_stands(scene: gp.Scene, seed: int) -> None:
    """Drawing and solver agree with friction, by every plan, and after the last round the balances no longer change."""
    style = {"plan": ("", "lever", "polygons", "polar", "polar,lever")[seed % 5]}
    found = gp.solve(scene, **style).json()
    assert max(found["check"].values()) < 1e-9
    if "friction" in found:
        told = found["balance"] if isinstance(found["balance"], list) else [found["balance"]]
        for one, stands in zip(told, found["friction"]["stands"]["balance"], strict=True):
            kind = "moment" if "moment" in one else "force"
            assert one[kind] == pytest.approx(stands[kind], rel=1e-8, abs=1e-8)


@pytest.mark.costly
@over("loaded groups", seeds=10)
def test_a_single_reaction_is_found_by_freeing_its_pair(scene: gp.Scene, seed: int) -> None:
    """By levers alone one reaction, of a joint or a slide, is found without any force plan; at rest a lever serves,
    too, and balances as the force plans do."""
    pairs = [*scene.joints, *(slide.name for slide in scene.slides)]
    asked = asking(scene, reactions=[pairs[seed % len(pairs)]])
    found = gp.solve(asked, exact=True, plan="lever")
    assert found.check["force"] == 0
    assert len(found.reactions) >= 1
    program = gp.construct(asked, plan="lever").program
    assert not [step for step in program.steps if step.panel.startswith("force plan")]
    still = gp.parse(re.sub("(omega|alpha) = .*", r"\1 = 0", scene.text), scene.name)
    assert gp.solve(still, exact=True, plan="lever").balances == gp.solve(still, exact=True, plan="polygons").balances


@over(*LOADED, seeds=6)
def test_loads_are_superposed(scene: gp.Scene, seed: int) -> None:
    """Balances of all loads are the sums of those of inertia and weight, and of the given loads."""
    tables = tables_of(scene.text)
    for gear in tables.get("gears", []):
        gear.pop("pressure_angle", None)
        gear |= {} if "belt" in gear else {"pressure_angle": {"tangent": Fraction(0)}}  # else flanks push apart
    parts = [{key: value for key, value in tables.items() if key not in left_out}
             for left_out in ((), ("forces", "moments"), ("masses", "gravity"))]
    every, *others = (gp.solve(gp.parse(text_of(part), "part"), exact=True).balances for part in parts)
    assert [np.array(value, dtype=object).tolist() for value in every] == [
        np.sum([np.array(part, dtype=object) for part in pair], axis=0).tolist() if isinstance(pair[0], tuple)
        else sum(pair) for pair in zip(*others, strict=True)]


# ---- what is asked, and how it is written ----------------------------------------------------------------------------


@over(*MOVING, *LOADED, *RUBBING, seeds=5)
def test_what_is_asked_is_answered(scene: gp.Scene, seed: int) -> None:
    """The command gives every number that is asked for or says why there is none, or that the pose is singular."""
    done = ran("solve", "-", "-q", given=asking(scene).text)
    assert "Traceback" not in done.err
    assert done.status in (0, 3), done.err
    if done.status == 3:
        raise gp.SingularPose(scene.name, done.err)
    told, asked = done.json, asking(scene)
    moving = [name for name in scene.points if "frame" not in scene.links_of[name] and name in told["points"]]
    assert all(told["points"][name][kind] is not None or "reasons" in told for name in moving
               for kind in ("velocity", "acceleration"))
    assert {*told["links"]} >= {*scene.moving} or "reasons" in told
    assert not scene.loads or len({*map(str, told["reactions"])}) >= len(asked.joints)


@over("linkage", "gearing", seeds=10)
def test_the_order_of_writing_draws_nothing_else(scene: gp.Scene, seed: int) -> None:
    """Links, points, slides and drives in another order give the same steps with the same letters."""
    tables = Transformation(order=seed).scene(tables_of(scene.text))
    assert gp.construct(gp.parse(text_of(tables), scene.name)).sentences() == gp.construct(scene).sentences()


@pytest.mark.parametrize("parted", [0.3, 0.6])
@pytest.mark.parametrize("links", [12, 24, 40])
def test_other_names_give_the_same_steps(links: int, parted: float) -> None:
    """A linkage is drawn by the same steps from the same marks whatever its links and points are called; poles, too."""
    def steps(text: str) -> object:
        try:
            return [(step.op.name, step.args) for step in gp.construct(gp.parse(text), checked=False).program.steps]
        except gp.Refused:
            return "refused"

    text = henneberg_text(links, links, parted)
    poles = ", ".join(f'"{link} frame"' for link in gp.parse(text).moving)
    asking_for_poles = f"{text.partition('[find]')[0]}[find]\npoles = [{poles}]\n"
    for asked in (text, *[asking_for_poles] * (links == 12)):
        one, other = (steps(under_other_names(asked, naming)) for naming in range(2))
        assert one == other


@over("linkage", "gearing", "loaded linkage", seeds=5)
def test_protocols_can_be_executed_on_paper(scene: gp.Scene, seed: int) -> None:
    """A reader with ruler and compasses finds every mark of the printed steps where the sheet has it."""
    done = ran("steps", "-", "--json", "-q", given=scene.text)
    if done.status:
        raise gp.SingularPose(scene.name, done.err)
    assert Reader.of(done.json["steps"]).faults == []


@over(*MOVING, "loaded linkage", "loaded gearing", seeds=10)
def test_each_plan_moves_as_a_whole(scene: gp.Scene, seed: int) -> None:
    """Wherever a plan is begun its marks move along, and no others: as recorded in fractions, and as drawn."""
    style = FORCES[seed % len(FORCES)] if scene.loads else MOTIONS[seed % len(MOTIONS)]
    try:
        drawing = gp.construct(scene, **style)
    except gp.Refused as refused:
        raise gp.SingularPose(scene.name, str(refused)) from None
    assert strays(drawing.program, Fractions(), Fraction(scene.extent)) == []
    assert strays(drawing.drawn, Floats(), float(scene.extent), 1e-6) == []
    assert all(drawing.drawn.steps[arrow.start].panel == drawing.drawn.steps[arrow.end].panel
               for arrow in drawing.arrows)


# ---- other poses -----------------------------------------------------------------------------------------------------


@over("linkage", seeds=40, share=0.4)
def test_linkages_are_followed_up_to_their_limits(scene: gp.Scene, seed: int) -> None:
    """Links keep their figures in every pose, and only at a limit and beyond it there is none."""
    if not scene.drives[0].rate:
        raise gp.SingularPose(scene.name, "its first drive leads no others")
    turn = gp.follow(scene, 24, (-90.0, 120.0))
    given = {name: complex(*map(float, at)) for name, at in scene.points.items()}
    pairs = [pair for own in scene.links.values() for pair in combinations(own, 2)]
    reach = max(abs(one - other) for one in given.values() for other in given.values()) or 1.0
    for one, other in pairs:
        change = np.abs(turn.points[one] - turn.points[other]) - abs(given[one] - given[other])
        assert np.nanmax(np.abs(change), initial=0) < CLOSE * reach
    assert all("limit position" in why or "change point" in why for why in turn.faults.values())


@over("machine", seeds=8)
def test_cycles_close(scene: gp.Scene, seed: int) -> None:
    """After a full turn of a crank all is as it was, and so it is backwards."""
    extent = float(scene.extent)
    for span in ((0.0, 360.0), (-360.0, 0.0)):
        poses = gp.follow(scene, 9, span)
        assert not poses.faults
        assert all(abs(z[0] - z[-1]) < 1e-9 * extent for z in poses.points.values())


@over("linkage", "gearing", "loaded linkage", seeds=8)
def test_every_pose_of_a_cycle_is_checked(scene: gp.Scene, seed: int) -> None:
    """Around the cycle construction and solver agree; poses that are not had have their reasons."""
    done = ran("cycle", "-", "--positions", "9", "--from", "-6", "--to", "8", "-q", given=scene.text)
    if done.status in (2, 3):
        raise gp.SingularPose(scene.name, done.err)
    assert done.status == 0, done.err


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("seed", [2022, 2073, 2084, 2009])
def test_a_singular_pose_is_told_as_such(seed: int) -> None:
    """Where velocities have no or many solutions, poles are left out with the reason, and so is each pose of a small
    cycle; numpy is silent."""
    (_, scene), = scenes("linkage", range(seed, seed + 1))
    asked = asking(scene, poles="all").text
    done = ran("solve", "-", "-q", given=asked)
    assert done.status == 3 or done.json["reasons"]["poles"]
    assert ran("cycle", "-", "--positions", "3", "--from", "0", "--to", "1", "-q", given=asked).status == 3


@pytest.mark.parametrize("seed", [0, 3, 11, 13, 27])
def test_what_rounding_leaves_of_zero_is_no_difference(seed: int) -> None:
    """No pose of a cycle is wrong for what rounding leaves: points of a link in one place, and what stands still beside
    what moves; a pose in which points lie apart that coincide in the given one is said to be drawn otherwise."""
    (_, scene), = scenes("linkage", range(seed, seed + 1))
    assert ran("cycle", "-", "--positions", "12", "--from", "-3", "--to", "120", given=scene.text).status == 0


def test_a_pose_to_which_one_step_does_not_lead_is_walked_to() -> None:
    """Near a limit smaller steps lead to a pose that one step misses."""
    (_, scene), = scenes("linkage", range(154, 155))
    poses = gp.follow(scene, 48)
    assert not poses.faults
    assert poses.travel[2] == pytest.approx(15)


@pytest.mark.costly
@over("changing loads", seeds=10, share=0.2)
def test_each_pose_has_its_loads(scene: gp.Scene, seed: int) -> None:
    """Where loads change over travel and speed, or springs pull, forces agree with the solver in each pose; in the
    given pose they are the scene's own."""
    done = ran("cycle", "-", "--positions", "5", "--from", "-4", "--to", "4", "-q", given=scene.text)
    if done.status in (2, 3):
        raise gp.SingularPose(scene.name, done.err)
    assert done.status == 0, done.err
    head, *rows = [row.split(",") for row in done.out.splitlines()]
    told = [rows[2][column] for column, name in enumerate(head)
            if name.startswith("balance ") and not re.search(r"\.(size|direction) ", name)]
    own = [part for value in gp.solve(scene).balances
           for part in ((value.real, value.imag) if isinstance(value, complex) else (value,))]
    assert not all(told) or sorted(map(float, told)) == pytest.approx(sorted(own), rel=1e-7, abs=1e-7)


@over("linkage", seeds=12, share=0.2)
def test_a_pose_further_on_is_constructed(scene: gp.Scene, seed: int) -> None:
    """Where the drive has gone on the points are drawn by steps from the given pose, and lie where they are followed
    to; or no such steps are known."""
    try:
        told = gp.solve(gp.at(scene, 3))
    except gp.GraphplanError as error:
        raise gp.SingularPose(scene.name, str(error)) from None
    assert told.check["position"] < 1e-11


@over("linkage", seeds=10, share=0.2)
def test_errors_of_position_agree_with_differences(scene: gp.Scene, seed: int) -> None:
    """Every side of every bar off: construction, solver and closure give one coefficient, or the pose is singular."""
    sides = [f'"{own[0]} {own[1]}" = 0.1' for own in scene.links.values()
             if len(own) == 2 and scene.points[own[0]] != scene.points[own[1]]]
    turning = [link for link in scene.moving if len(scene.links[link]) > 1]
    if not sides or not turning:
        raise gp.SingularPose(scene.name, "no bars")
    scene = asking(scene, links=turning)
    try:
        found = gp.position_errors(gp.parse(f"{scene.text}[tolerances]\n" + "\n".join(sides) + "\n", scene.name))
    except gp.Refused as refused:
        raise gp.SingularPose(scene.name, str(refused)) from None
    assert max(found.json()["check"].values()) < 1e-6
