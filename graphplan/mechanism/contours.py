"""Contours: the closed loops of a group, of which the largest gives its class."""

from __future__ import annotations

from collections import deque
from collections.abc import Hashable, Iterator, Mapping
from typing import TypeVar

N = TypeVar("N", bound=Hashable)

Graph = Mapping[N, frozenset[N]]
"""Each node with its neighbours."""


def loop_lengths(graph: Graph[N]) -> list[int]:
    """The numbers of edges of the loops in a smallest set of independent ones, shortest first (Horton 1987)."""
    core = _without_ends(graph)
    edges = {edge: i for i, edge in enumerate({frozenset((a, b)): None for a in core for b in core[a]})}
    found: list[int] = []
    independent: dict[int, int] = {}  # loops as sets of edges, in binary, by their highest edge
    for length, loop in sorted(_candidates(core, edges)):
        while loop and loop.bit_length() in independent:
            loop ^= independent[loop.bit_length()]
        if loop:
            independent[loop.bit_length()] = loop
            found.append(length)
    return found


def _candidates(core: Graph[N], edges: Mapping[frozenset[N], int]) -> Iterator[tuple[int, int]]:
    """From each branching node and each edge, the loop that two shortest paths close: length and edges."""
    branching = [node for node in core if len(core[node]) > 2]
    for root in branching or core:
        paths = {root: 0}
        queue = deque([root])
        while queue:
            node = queue.popleft()
            for other in core[node]:
                step = 1 << edges[frozenset((node, other))]
                if other not in paths:
                    paths[other] = paths[node] | step
                    queue.append(other)
        for edge, i in edges.items():
            a, b = edge
            if a in paths:
                loop = paths[a] ^ paths[b] ^ (1 << i)
                if loop:
                    yield loop.bit_count(), loop


def _without_ends(graph: Graph[N]) -> dict[N, frozenset[N]]:
    """The graph without the branches that lead nowhere: they are in no loop."""
    degree = {node: len(others) for node, others in graph.items()}
    ends = [node for node in graph if degree[node] < 2]
    gone = set(ends)
    while ends:
        for other in graph[ends.pop()] - gone:
            degree[other] -= 1
            if degree[other] < 2:
                gone.add(other)
                ends.append(other)
    return {node: others - gone for node, others in graph.items() if node not in gone}
