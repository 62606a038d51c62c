"""A graph spreads a loop's error over the chain, and false loops move nothing."""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from localization.mapping.keyframes import pose_after, pose_between
from localization.mapping.pose_graph import PoseEdge, PoseGraph

Floats = NDArray[np.float64]
SIGMA_M, SIGMA_RAD = 0.02, 0.01
LAPS, STEPS = 3, 40


def laps(count: int = LAPS) -> Floats:
    """Return poses along laps of a rounded course, 0.5 m apart."""
    angle = np.linspace(0.0, 2 * np.pi * count, count * STEPS, endpoint=False)
    radius_m = 0.5 * STEPS / (2 * np.pi)
    x_m, y_m = radius_m * np.sin(angle), radius_m * (1.0 - np.cos(angle))
    return np.column_stack((x_m, y_m, np.arctan2(np.sin(angle), np.cos(angle))))


def drifting(true: Floats, seed: int, *, scale: float = 1.0) -> PoseGraph:
    """Return the chain of a robot whose steps are off by noise."""
    random, graph = np.random.default_rng(seed), PoseGraph()
    graph.add_first(true[0])
    for last, pose in pairwise(true):
        off = scale * random.normal(0.0, (SIGMA_M, SIGMA_M, SIGMA_RAD))
        graph.add_next(pose_between(last, pose) + off, SIGMA_M, SIGMA_RAD)
    return graph


def loop(true: Floats, origin: int, to: int) -> PoseEdge:
    return PoseEdge(origin, to, pose_between(true[origin], true[to]), 0.02, 0.006)


def worst_m(graph: PoseGraph, true: Floats) -> float:
    return float(np.hypot(*(graph.poses[:, :2] - true[:, :2]).T).max())


def tied(true: Floats, seed: int, false: int = 0) -> tuple[PoseGraph, Floats]:
    """Return an optimized graph with a loop at each second pose, and each loop's weight."""
    graph, random = drifting(true, seed), np.random.default_rng(seed)
    for to in range(STEPS, len(true), 2):
        graph.add_loop(loop(true, to - STEPS, to))
    for _ in range(false):
        origin, to = np.sort(random.choice(len(true), 2, replace=False)).tolist()
        wrong = np.array((*random.uniform(-5.0, 5.0, 2), random.uniform(-3.0, 3.0)))
        graph.add_loop(PoseEdge(origin, to, wrong, 0.02, 0.006))
    return graph, graph.optimize()


def test_a_loop_closes_a_chain_that_drifted() -> None:
    true = laps()
    alone = drifting(true, 5)
    graph, weights = tied(true, 5)
    assert worst_m(alone, true) > 0.7, "or there is nothing to close"
    ends = graph.poses[STEPS::2] - graph.poses[:-STEPS:2]
    assert np.hypot(ends[:, 0], ends[:, 1]).max() < 0.05, "each lap lies on the one before"
    assert worst_m(graph, true) < 0.5 * worst_m(alone, true)
    assert weights.min() > 0.5


@pytest.mark.parametrize("seed", range(4))
def test_one_false_loop_in_five_moves_nothing(seed: int) -> None:
    true = laps()
    clean, weights = tied(true, seed)
    spoilt, doubted = tied(true, seed, false=len(weights) // 4)
    gap = spoilt.poses[:, :2] - clean.poses[:, :2]
    assert np.hypot(gap[:, 0], gap[:, 1]).max() < 0.05
    assert doubted[len(weights) :].max() < 0.3 < doubted[: len(weights)].min()


def test_the_step_is_the_minimum_of_the_whole_sum() -> None:
    """Against the plain normal equations of a small graph, by differences."""
    true = laps(1)[:9]
    graph = drifting(true, 3)
    graph.add_loop(loop(true, 0, 8))
    graph.add_loop(loop(true, 2, 7))
    graph.optimize()
    poses, table = graph.poses, graph.table()

    def cost(free: Floats) -> float:
        at = np.vstack((poses[:1], free.reshape(-1, 3)))
        off = pose_between(pose_after(at[table[:, 0].astype(int)], table[:, 2:5]),
                           at[table[:, 1].astype(int)])  # fmt: skip
        return float((off / table[:, [5, 5, 6]] ** 1.0).__pow__(2).sum())

    best, free = cost(poses[1:].ravel()), poses[1:].ravel()
    for index in range(len(free)):
        for nudge in (-2e-3, 2e-3):
            moved = free.copy()
            moved[index] += nudge
            assert cost(moved) > best


@cache
def tied_at_home() -> PoseGraph:
    return tied(laps(2), 7)[0]


@settings(max_examples=15)
@given(x_m=st.floats(-50, 50), y_m=st.floats(-50, 50), yaw=st.floats(-3, 3))
def test_where_the_frame_lies_does_not_matter(x_m: float, y_m: float, yaw: float) -> None:
    true = laps(2)
    frame = np.array((x_m, y_m, yaw))
    moved = pose_after(frame, true)
    there, _ = tied(moved, 7)
    assert pose_after(frame, tied_at_home().poses)[:, :2] == pytest.approx(
        there.poses[:, :2], abs=5e-3
    )


def test_a_chain_without_loops_stays_and_a_table_gives_it_back() -> None:
    true = laps(2)
    graph = drifting(true, 1)
    before = graph.poses
    assert not len(graph.optimize())
    assert (graph.poses == before).all()
    graph.add_loop(loop(true, 0, 50))
    again = PoseGraph.of_table(graph.poses, graph.table())
    assert again.loops == 1
    assert (again.table() == graph.table()).all()
    with pytest.raises(ValueError, match="chain"):
        PoseGraph.of_table(graph.poses[:-1], graph.table()[:-5])
    with pytest.raises(ValueError, match="no spread"):
        PoseGraph.of_table(graph.poses, graph.table() * 0.0)
    with pytest.raises(ValueError, match="columns"):
        PoseGraph.of_table(graph.poses, graph.table()[:, :5])


@pytest.mark.parametrize(("origin", "to"), [(3, 3), (5, 2), (-1, 4), (0, 99)])
def test_a_loop_ties_two_that_exist(origin: int, to: int) -> None:
    graph = drifting(laps(1), 1)
    with pytest.raises(ValueError, match="among"):
        graph.add_loop(PoseEdge(origin, to, np.zeros(3), 0.02, 0.006))


def test_drift_grows_with_the_chain() -> None:
    graph = drifting(laps(1), 1)
    spreads = [graph.spread_m(0, to) for to in (0, 1, 10, 20)]
    assert spreads == sorted(spreads)
    assert spreads[0] == 0.0
