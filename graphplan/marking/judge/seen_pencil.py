"""The pencil that a drawing shows: how unsteady the hand is that drew it, and how finely its marks were read.

Every step whose mark is there is a sample of both: what it is off beside the student's own earlier marks comes from the
hand at this step and from the reading of all these marks, each carried through the scales of its plan and through what
is laid off. A vector that is drawn five times as long shows errors of reading five times as large; so the two can be
told apart. Samples are normal, but for some that are mistakes and lie anywhere. What is stated, and what is usual, is
the prior: a drawing of few marks is judged by it. The spread of what is left of both is in the sizes that are given.
"""

from __future__ import annotations

import math
import statistics
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from graphplan.accuracy.hand import Pencil, SeenPencil
from graphplan.kernel.kinds import Movement
from graphplan.marking.judge import measures
from graphplan.marking.judge.matching import Matching
from graphplan.marking.tolerances import VARIANCE_FLOOR
from graphplan.marking.traces import Submission

SCALES_TRIED, READINGS_TRIED, SHARES_TRIED = (np.geomspace(*tried) for tried in (
    measures.HAND_SCALES, measures.READINGS_MM, measures.STATED_SHARES))
Sample = tuple[Any, Any, Any]  # how far off, the covariance from the hand, and from reading


def assumed_pencil(stated: Pencil, submission: Submission) -> SeenPencil:
    """The stated pencil, and the reading that is usual where nobody states how finely marks were measured."""
    return SeenPencil(stated, 1.0, measures.RULER_MM if submission.measured and not submission.stated else 0.0)


def seen_pencil(matching: Matching, now: SeenPencil, submission: Submission) -> SeenPencil | None:
    """The pencil that a drawing shows, from a way through it that was judged by another; None where too few marks tell
    it."""
    samples = list(_pencil_samples(matching))
    if len(samples) < measures.MIN_SAMPLES:
        return None
    rounding = max(0.0, min((trace.blur**2 for trace in submission.traces), default=0.0))
    read, stated_shares, reading_ratios = np.zeros(1), np.ones(1), np.ones(1)
    odds = -np.log(SCALES_TRIED)[:, None] ** 2 / (2 * measures.HAND_SCALE_SIGMA**2)
    if submission.measured and submission.stated:
        stated_shares, reading_ratios = SHARES_TRIED, (SHARES_TRIED / now.share_shown) ** 2
        odds = odds - np.log(SHARES_TRIED)[None, :] ** 2 / (2 * measures.STATED_SHARE_SIGMA**2)
    if now.reading:
        read, reading_ratios = READINGS_TRIED, (READINGS_TRIED**2 + rounding) / (now.reading**2 + rounding)
        odds = odds - np.log(READINGS_TRIED / measures.RULER_MM)[None, :] ** 2 / (2 * measures.READING_SIGMA**2)
    for width in (1, 2, 3):
        odds = odds + _sample_likelihood([sample for sample in samples if len(sample[0]) == width],
                                         SCALES_TRIED / now.scale,
                                         reading_ratios)
    weights = np.exp(odds - odds.max())
    weights /= weights.sum()
    scale, reading, share = (math.sqrt(float(np.sum(weights * tried_sizes**2)))
                             for tried_sizes in (SCALES_TRIED[:, None], read[None, :], stated_shares[None, :]))
    return SeenPencil(now.stated, scale, reading, len(samples), share)


def _sample_likelihood(samples: Sequence[Sample], scales: Any, reads: Any) -> Any:
    """The logarithm of how likely these samples are, by every scale of the hand and every part of reading."""
    if not samples:
        return 0.0
    off, hand, reading = (np.array(column) for column in zip(*samples, strict=True))
    wide = off.shape[1]
    covariance = (scales**2)[:, None, None, None, None] * hand + reads[:, None, None, None] * reading[None]
    covariance = covariance + VARIANCE_FLOOR * np.eye(wide)
    squares = np.einsum("...i,...i", off, np.linalg.solve(covariance, np.broadcast_to(
        off[..., None], (*covariance.shape[:-1], 1)))[..., 0])
    density = np.exp(-squares / 2) / np.sqrt((2 * math.pi) ** wide * np.linalg.det(covariance))
    return np.sum(np.log((1 - measures.MISTAKE_SHARE) * density
                         + measures.MISTAKE_SHARE / measures.MISTAKE_SPREAD_MM**wide), axis=-1)


def _pencil_samples(matching: Matching) -> Iterator[Sample]:
    """What the marks are off, with what the hand and the reading of a unit each add to it."""
    sheet, sampled_places = matching.sheet, set[int]()
    for match in matching.matches:
        residual = match.residual
        if (residual is None or match.place is None or match.place in sampled_places
            or match.step.op.movement is Movement.BEGUN):
            continue
        if residual.covariance.max() > measures.MISTAKE_SPREAD_MM**2:  # it may be anywhere
            continue
        sampled_places.add(match.place)
        partials = residual.partials
        read = partials[:, sheet.reading_errors[:partials.shape[1]]]
        reading = read @ read.T
        yield residual.off, residual.covariance - reading, reading


def with_measured_points(pencil: Pencil, submission: Submission) -> Pencil:
    """The pencil with points as far off as they are when they have been measured."""
    blurs = [trace.blur for trace in submission.traces] if submission.measured else []
    return replace(pencil, point=math.hypot(pencil.point, statistics.median(blurs))) if blurs else pencil


def blur_marks(submission: Submission, hand: SeenPencil) -> Submission:
    """The marks of a drawing as finely as they were read, beside how they were rounded."""
    if not hand.reading and hand.share_shown == 1.0:
        return submission
    return replace(submission, traces=tuple(
        replace(trace, blur=math.hypot(hand.share_shown * trace.blur, hand.reading)) for trace in submission.traces))
