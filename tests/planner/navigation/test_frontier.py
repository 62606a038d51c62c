"""Frontiers: what borders on the unknown, from where it is looked at, and what is in vain."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from maps import FREE, OCCUPIED, UNKNOWN, GridMap
from maps.cell_array import cell_array
from planner.navigation import RouteFailure, RouteLimits, RouteRequest, RouteResult
from planner.navigation.costmap import static_costmap
from planner.navigation.frontier import (
    KEEP_M,
    MOST_TRIES,
    MOST_VISITS,
    Frontier,
    FrontierMemory,
    border_cells,
    find_frontiers,
    known_m2,
)
from planner.navigation.router import Router
from planner.navigation.start_and_goal import Cell
from planner.site import Site
from tests.planner.navigation.floors import drawn
from wire import Pose2
from wire.fence import Outline

MARKS = {"#": OCCUPIED, ".": FREE, "?": UNKNOWN}


def sketched(*rows: str, square_m: float = 0.25, keep_outs: tuple[Outline, ...] = ()) -> Site:
    """Make a site from rows of '#', '.' and '?', the first row at the top."""
    site, per = drawn(*rows, square_m=square_m, keep_outs=keep_outs), round(square_m / 0.05)
    cells = b"".join(
        bytes(MARKS[mark] for mark in row for _ in range(per)) * per for row in reversed(rows)
    )
    return replace(site, grid=replace(site.grid, cells=cells))


ROOM = ("##########", *["#........#"] * 8, "##########")
"""2 m by 2 m of floor, and a wall all round."""
DOOR = tuple(row if not 3 <= at <= 6 else row[:-1] + "." for at, row in enumerate(ROOM))
HALF_KNOWN = tuple(row + "?" * 10 for row in DOOR)
"""The same with a door of 1 m, behind which nothing is known."""
BEHIND_WALL = tuple(row + "?" * 10 for row in ROOM)


def explore(
    site: Site, x_m: float = 1.25, y_m: float = 1.25, memory: FrontierMemory | None = None
) -> RouteResult:
    """Return the answer to one who explores, at a point."""
    here = Pose2(x_m, y_m, 0.0)
    request = RouteRequest(here, here, explore=True)
    return Router(site, RouteLimits()).route(request, frontiers=memory)


def test_a_closed_room_is_explored() -> None:
    found = explore(sketched(*ROOM))
    assert found.floor is not None
    assert found.floor.known_m2 == pytest.approx(4.0)
    assert found.floor.explored
    assert [(p.x_m, p.y_m) for p in found.points] == [(1.25, 1.25)], "the robot stays"
    assert explore(sketched(*BEHIND_WALL)).floor == found.floor, "no wall is a frontier"


def test_an_open_door_is_looked_through_and_not_driven_through() -> None:
    found = explore(sketched(*HALF_KNOWN), 0.7, 2.0)
    assert found.floor is not None
    assert not found.floor.explored
    end = found.points[-1]
    assert end.x_m < 2.25, "on this side of the door"


def test_to_a_frontier_behind_a_fence_there_is_no_way() -> None:
    corridor = ("#" * 40, *["." * 28 + "?" * 12] * 6, "#" * 40)
    across: Outline = ((3.0, -0.5), (3.5, -0.5), (3.5, 2.5), (3.0, 2.5))
    free, fenced = sketched(*corridor), sketched(*corridor, keep_outs=(across,))
    assert explore(free, 0.75, 1.0).points[-1].x_m > 3.5
    with pytest.raises(RouteFailure, match="no_route"):
        explore(fenced, 0.75, 1.0)


def test_who_stands_in_the_door_does_not_make_what_lies_behind_it_explored() -> None:
    """The frontier is far down a corridor, and something shuts the corridor."""
    corridor = sketched("#" * 32, *["." * 20 + "?" * 12] * 6, "#" * 32)
    here = Pose2(0.75, 1.0, 0.0)
    crate = tuple((2.0, 0.05 * at) for at in range(40))
    router = Router(corridor, RouteLimits())
    free = router.route(RouteRequest(here, here, explore=True))
    assert free.points[-1].x_m > 2.5
    with pytest.raises(RouteFailure, match="no_route"):
        router.route(RouteRequest(here, here, obstacles=crate, explore=True))


@given(st.lists(st.sampled_from("#.?"), min_size=36, max_size=36))
def test_a_border_is_floor_beside_the_unknown_and_nothing_else(marks: list[str]) -> None:
    rows = ["".join(marks[at : at + 6]) for at in range(0, 36, 6)]
    grid = sketched(*rows).grid
    cells, border = cell_array(grid), border_cells(grid)
    padded = np.pad(cells == UNKNOWN, 1, constant_values=True)
    beside = padded[:-2, 1:-1] | padded[2:, 1:-1] | padded[1:-1, :-2] | padded[1:-1, 2:]
    assert not (border & ~((cells == FREE) & beside)).any()


def test_gaps_between_beams_are_no_frontier() -> None:
    grid = sketched(*ROOM).grid
    cells = cell_array(grid).copy()
    cells[12:40, 14:40:5] = UNKNOWN
    assert not border_cells(replace(grid, cells=cells.tobytes())).any()


def frontiers_of(site: Site) -> list[Frontier]:
    costmap = static_costmap(site, RouteLimits().radius_m)

    def way_m(cell: Cell) -> float:
        return 1.0 if costmap.free[cell[1], cell[0]] else float("inf")

    return find_frontiers(site.grid, costmap, way_m)


def test_a_frontier_behind_a_wall_is_not_looked_at_from_this_side() -> None:
    """Floor seen through the door of another room: the nearest spot is across the wall."""
    rows = [row + "..????????" if 1 <= at <= 8 else row + "#" * 10 for at, row in enumerate(ROOM)]
    assert frontiers_of(sketched(*rows)) == []


def test_a_long_frontier_is_looked_at_part_by_part() -> None:
    rows = ["." * 40] * 8 + ["?" * 40] * 8
    found = frontiers_of(sketched(*rows))
    assert len(found) == 4
    assert all(1.5 < one.length_m < 2.8 for one in found)
    assert all(one.gain_m2 > 4.0 for one in found)


def test_floor_is_counted_by_its_cells() -> None:
    assert known_m2(sketched(*ROOM).grid) == pytest.approx(4.0)
    assert known_m2(GridMap(2, 1, 0.05, 0.0, 0.0, bytes((FREE, UNKNOWN)))) == pytest.approx(0.0025)


def a_map() -> GridMap:
    """Return a map that was just drawn."""
    return GridMap(1, 1, 0.05, 0.0, 0.0, bytes(1))


def one(x_m: float, way_m: float, gain_m2: float = 0.0) -> Frontier:
    """Return a frontier at a place, looked at from a metre before it."""
    return Frontier((x_m, 0.0), 1.0, (0, 0), (x_m - 1.0, 0.0), way_m, gain_m2)


def test_the_nearest_is_chosen_unless_another_shows_more() -> None:
    assert FrontierMemory().choose([one(5.0, 4.0), one(9.0, 3.0)]) == one(9.0, 3.0)
    much = one(5.0, 4.0, gain_m2=6.0)
    assert FrontierMemory().choose([much, one(9.0, 3.0)]) == much


def test_the_choice_is_kept_unless_another_is_much_better() -> None:
    memory = FrontierMemory()
    memory.choose([one(5.0, 4.0 + KEEP_M)])
    assert memory.choose([one(5.2, 4.0 + KEEP_M), one(9.0, 4.1)]) == one(5.2, 4.0 + KEEP_M)
    assert memory.choose([one(5.2, 4.0 + KEEP_M), one(9.0, 3.9)]) == one(9.0, 3.9)


def test_where_the_robot_stood_it_does_not_look_again() -> None:
    memory, frontier = FrontierMemory(), one(5.0, 4.0)
    memory.choose([frontier])
    memory.note_start(frontier.stand, a_map())
    assert memory.choose([frontier]) is None
    memory.forget()
    assert memory.choose([frontier]) == frontier


def test_a_look_counts_once_the_map_shows_it() -> None:
    memory, frontier, before = FrontierMemory(), one(5.0, 4.0), a_map()
    memory.note_start((0.0, 0.0), before)
    memory.choose([frontier])
    memory.note_start(frontier.stand, before)
    assert memory.choose([frontier]) == frontier
    memory.note_start(frontier.stand, a_map())
    assert memory.choose([frontier]) is None


def test_a_room_behind_what_stands_is_left_out_and_a_nook_is_not() -> None:
    memory, room = FrontierMemory(), one(5.0, 4.0, gain_m2=3.0)
    assert memory.leaves_out([room])
    assert not memory.leaves_out([one(5.0, 4.0, gain_m2=1.0)])
    memory.choose([room])
    memory.note_start(room.stand, a_map())
    assert not memory.leaves_out([room]), "it was looked at, and stays what it is"


def test_a_frontier_that_is_never_reached_is_given_up() -> None:
    memory, frontier = FrontierMemory(), one(5.0, 4.0)
    memory.note_start((0.0, 0.0), a_map())
    for _ in range(MOST_TRIES):
        assert memory.choose([frontier]) == frontier
        memory.note_start((0.0, 0.0), a_map())
    assert memory.choose([frontier]) is None


def test_a_robot_that_comes_nearer_asks_as_often_as_it_likes() -> None:
    memory, frontier = FrontierMemory(), one(9.0, 4.0)
    for at in range(3 * MOST_TRIES):
        memory.note_start((0.5 * at, 1.0), a_map())
        assert memory.choose([frontier]) == frontier


def test_a_frontier_is_looked_at_from_other_sides_only_so_often() -> None:
    memory = FrontierMemory()
    for at in range(MOST_VISITS):
        seen = replace(one(5.0, 4.0), stand=(4.0, float(at)))
        assert memory.choose([seen]) == seen
        memory.note_start(seen.stand, a_map())
    assert memory.choose([replace(one(5.0, 4.0), stand=(4.0, 9.0))]) is None


def test_an_exploration_ends_whatever_the_map_shows() -> None:
    """A frontier that no look changes, as behind glass, is left after some looks."""
    site, memory, at = sketched(*HALF_KNOWN), FrontierMemory(), (1.25, 1.25)
    for _ in range(10):
        found = explore(site, *at, memory)
        assert found.floor is not None
        if found.floor.explored:
            break
        at = (found.points[-1].x_m, found.points[-1].y_m)
    else:
        pytest.fail("it looks for ever")
