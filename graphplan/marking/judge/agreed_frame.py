"""The frame of a plan on which most lettered marks agree, where each letter may be that of several spots."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np

from graphplan.marking.judge import measures
from graphplan.marking.traces import PlanFrame


class Candidates(NamedTuple):
    """A mark of a plan, and the spots on the sheet that may be it, with what speaks against each."""

    at: complex
    spots: list[tuple[complex, float]]


def agreed_frame(marks: Sequence[Candidates], units: Sequence[complex], within: float, usual: float,
                 any_unit: bool = True
           ) -> PlanFrame | None:
    """The frame on which most marks agree, by one of their spots each; None where no two do.

    It has one of some `units`, or where it may have `any_unit`, another that more agree on; of equals that is taken
    which is nearer to the `usual` scale, and upright.
    """
    if not marks:
        return None
    owner = np.concatenate([np.full(len(mark.spots), k) for k, mark in enumerate(marks)])
    at = np.array([mark.at for mark in marks])
    spots = np.array([spot for mark in marks for spot, _ in mark.spots])
    costs = np.array([cost for mark in marks for _, cost in mark.spots])
    starts = np.flatnonzero(np.diff(owner, prepend=-1))

    weights = 1.0 - measures.SPOT_COST_SHARE * np.clip(costs, 0.0, measures.MAX_SPOT_COST)

    def score(unit: Any, origin: Any) -> Any:
        """How many marks have a spot in each frame."""
        off = np.abs(origin[:, None] + unit[:, None] * at[owner][None, :] - spots[None, :]) / within
        votes_per_spot = np.clip(1.0 - off**2, 0.0, None) * weights
        return np.maximum.reduceat(votes_per_spot, starts, axis=1).sum(axis=1)

    tied, free = _propose_frames(at, owner, spots, units)
    best: tuple[float, complex, complex] | None = None
    for unit, origin in (tied, free) if any_unit else (tied,):
        if len(unit):
            taste = measures.RESCALED_VOTES * np.abs(np.log(np.abs(unit) / usual)) + measures.TURNED_VOTES * np.abs(
                np.angle(unit))
            votes = score(unit, origin) - taste
            top = int(votes.argmax())
            if (best is None or votes[top] > measures.OTHER_FRAME_LETTERS
                + (1 + measures.OTHER_FRAME_SHARE * len(spots) / len(marks)) * best[0]):
                best = float(votes[top]), complex(unit[top]), complex(origin[top])
    if best is None or best[0] < min(measures.MIN_FRAME_VOTES, len(marks)) - 0.5:
        return None
    return _refine_frame(at, owner, spots, best[1], best[2], within)


def _propose_frames(at: Any, owner: Any, spots: Any, units: Sequence[complex]
                    ) -> tuple[tuple[Any, Any], tuple[Any, Any]]:
    """Units and origins of frames: with the expected unit through every spot, and any through two of two marks."""
    tied = np.repeat(np.array(units, dtype=complex), len(spots))
    origins = np.tile(spots, len(units)) - tied * np.tile(at[owner], len(units))
    near = np.flatnonzero(np.concatenate([np.arange(count) < measures.SPOTS_PER_MARK for count in np.bincount(owner)]))
    near = near[:: max(1, len(near) // measures.MAX_FRAME_SPOTS)]
    pairs = sorted(((i, j) for i, j in combinations(near.tolist(), 2) if at[owner[i]] != at[owner[j]]
                    and spots[i] != spots[j]),
                   key=lambda ij: -abs(at[owner[ij[0]]] - at[owner[ij[1]]]))[:measures.MAX_FRAMES]
    i, j = np.array(pairs, dtype=int).reshape(-1, 2).T
    free = (spots[j] - spots[i]) / (at[owner[j]] - at[owner[i]])
    return (tied, origins), (free, spots[i] - free * at[owner[i]])


def _refine_frame(at: Any, owner: Any, spots: Any, unit: complex, origin: complex, within: float) -> PlanFrame:
    """The frame of least squares through the spots that a frame holds, of each mark the nearest; marks that lie close
    together turn and stretch nothing."""
    off = np.abs(origin + unit * at[owner] - spots)
    nearest = [place for place in np.lexsort((off, owner)) if off[place] < within]
    held_places = [place for k, place in enumerate(nearest) if not k or owner[place] != owner[nearest[k - 1]]]
    marks, held_spots = at[owner[held_places]], spots[held_places]
    if float(np.var(marks)) * abs(unit) ** 2 > within**2:
        return PlanFrame.least_squares(marks, held_spots)
    return PlanFrame(complex(np.mean(held_spots - unit * marks)), unit)
