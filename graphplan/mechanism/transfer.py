"""Transfer: in which order motion passes through a mechanism, and what must be solved together.

Each equation is given one freedom to determine (a matching); a thing then depends on all others in the equations of
its freedoms; things that depend on each other in a ring are solved together. Nothing here recurses: chains are long.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping, Sequence
from typing import TypeVar

from graphplan.mechanism.equations import System, Thing, Unknown

K = TypeVar("K", bound=Hashable)


def stages(system: System) -> list[tuple[Thing, ...]]:
    """The things that are solved together, those that others depend on first."""
    owner = matching([tuple(equation.terms) for equation in system.equations])
    depends: dict[Thing, dict[Thing, None]] = {thing: {} for thing, _ in system.unknowns}
    for (thing, _), i in owner.items():
        depends[thing].update((other, None) for other, _ in system.equations[i].terms if other != thing)
    return list(rings({thing: tuple(others) for thing, others in depends.items()}))


def matching(options: Sequence[Sequence[Unknown]]) -> dict[Unknown, int]:
    """For as many equations as possible an unknown of their own: the unknowns, each with its equation."""
    owner: dict[Unknown, int] = {}
    waiting = list(range(len(options)))
    while waiting:  # in one round nothing is visited twice, so each round costs one reading of the equations
        seen: set[Unknown] = set()
        left = [i for i in waiting if not _augment(i, options, owner, seen)]
        if len(left) == len(waiting):
            break
        waiting = left
    return owner


def _augment(start: int, options: Sequence[Sequence[Unknown]], owner: dict[Unknown, int], seen: set[Unknown]) -> bool:
    """Find equation `start` an unknown, moving others to free ones along a path of exchanges."""
    path: list[tuple[int, Iterator[Unknown]]] = [(start, iter(options[start]))]
    taken: list[Unknown] = []
    while path:
        unknown = next((u for u in path[-1][1] if u not in seen), None)
        if unknown is None:
            path.pop()
            del taken[-1:]
            continue
        seen.add(unknown)
        taken.append(unknown)
        if unknown not in owner:
            owner.update((u, i) for (i, _), u in zip(path, taken, strict=True))
            return True
        path.append((owner[unknown], iter(options[owner[unknown]])))
    return False


def rings(depends: Mapping[K, Sequence[K]]) -> Iterator[tuple[K, ...]]:
    """The strongly connected components (Tarjan 1972), each after all that it depends on."""
    index: dict[K, int] = {}
    low: dict[K, int] = {}
    stack: list[K] = []
    done: set[K] = set()
    for root in depends:
        path = [] if root in index else [(root, iter(depends[root]))]
        while path:
            node, others = path[-1]
            if node not in index:
                index[node] = low[node] = len(index)
                stack.append(node)
            other = next((o for o in others if o not in done), None)
            if other is None:
                path.pop()
                if path:
                    low[path[-1][0]] = min(low[path[-1][0]], low[node])
                if low[node] == index[node]:
                    ring = tuple(stack[stack.index(node) :]) if stack[-1] != node else (node,)
                    del stack[-len(ring) :]
                    done.update(ring)
                    yield ring
            elif other in index:
                low[node] = min(low[node], index[other])
            else:
                path.append((other, iter(depends[other])))
