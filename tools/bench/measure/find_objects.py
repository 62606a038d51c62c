"""Say "find the …" in homes drawn by seed, in lockstep, and judge the answer by the truth.

Each picture is drawn and looked at with the default model. ``PONS_BENCH_EYES=truth`` reads the
simulator's truth with a detector's faults instead, in a tenth of the time.
"""

from __future__ import annotations

import os
from dataclasses import asdict, dataclass
from functools import partial
from itertools import count
from math import hypot
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from planner.language.object_classes import kind_of
from planner.language.object_names import name_object
from planner.plan import Code, GoalState
from sim.camera.materials import PAINTS, USUAL
from sim.site.objects import furniture_class
from sim.site.plan import furniture_shape
from tools.bench.detector_run import Counting, DrawnFinder
from tools.bench.object_visibility import in_sight
from tools.bench.report import ReportRow, row_of
from tools.lockstep import LockstepWorld, TooLong
from tools.lockstep.homes import site_of
from tools.lockstep.truth_detector import TruthFinder
from tools.train.homes import drawn_home
from wire import CameraConfig

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from sim.site import Home
    from tools.bench.context import BenchLab

NAME = "find_objects"
TITLE = "find the … in homes that nobody has seen"
LONG_ONLY = False
HOMES, QUICK_HOMES = 50, 2
LIMIT_S = 900.0
FAR_M = 0.5
"""What is told to be farther from every such thing than this, and its own size, is something else.
"""
SOUGHT = frozenset({"cup", "bottle", "ball", "book", "box", "plant", "chair"})
LEAVES = "plant"
"""Green whatever its home says: the colour that is declared of one is painted nowhere, so a plant
is asked for without."""
WOOD = "brown"
"""What cardboard and every wood are called."""
EYES = "PONS_BENCH_EYES"


@dataclass(frozen=True, slots=True)
class SearchResult:
    """Tell what became of one order."""

    seed: int
    words: str
    rooms: int
    verdict: str
    """``found``, ``wrong``, or why it was not found."""
    note: str
    seconds: float
    metres: float
    off_m: float | None


def by_truth() -> bool:
    """Tell whether eyes read the truth; processes of a run inherit what was asked."""
    return os.environ.get(EYES) == "truth"


def choose_target(
    home: Home, random: Random, shows: Callable[[Sequence[str]], bool]
) -> tuple[str, str | None] | None:
    """Return the label and colour of something to look for, or None where there is nothing.

    Shows: whether any picture shows one of these objects of the home.
    """
    things = sorted(
        {(it.class_id, it.color) for it in home.objects.values() if it.class_id in SOUGHT
         and it.color is not None}
    )  # fmt: skip
    while things:
        label, color = random.choice(things)
        alike = [
            name for name, it in home.objects.items() if (it.class_id, it.color) == (label, color)
        ]
        if shows(alike):
            return label, None if label == LEAVES else color
        things.remove((label, color))
    return None


def places(home: Home, label: str, color: str | None) -> list[tuple[float, float]]:
    """Return where such things stand; furniture of the class counts as well."""
    found = [
        it.at
        for it in home.objects.values()
        if it.class_id == label and color in (None, color_name(label, it.color))
    ]
    boxes = [
        furniture_shape(it).bounds
        for name, it in home.furniture.items()
        if furniture_class(name, it) == label and color in (None, color_name(label, it.color))
    ]
    return found + [((box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2) for box in boxes]


def color_name(class_id: str, color: str | None) -> str:
    """Return what people call the colour that a thing has in the simulator's plain look.

    What declares none has a usual one: a cup is then red, a carton or a chair of wood brown.
    """
    if color is not None:
        return color
    usual = USUAL[class_id][0]
    return next((name for name, paint in PAINTS.items() if paint == usual), WOOD)


def trial(index: int) -> dict[str, object]:
    """Look for one thing in one home of several rooms."""
    seed, home, wanted = next(
        (seed, home, wanted)
        for seed in count(1_000 * index + 7)
        if len((home := drawn_home("unseen", seed)).rooms) > 1
        and (wanted := choose_target(home, Random(f"sought {seed}"), partial(_shows, home)))
        is not None
    )
    with TemporaryDirectory(prefix="pons-") as folder:
        return asdict(_look_for(home, seed, wanted, site_of(Path(folder), home)))


def _shows(home: Home, names: Sequence[str]) -> bool:
    return in_sight(home, names, CameraConfig(), Random(0))


def _look_for(home: Home, seed: int, wanted: tuple[str, str | None], site: Path) -> SearchResult:
    label, color = wanted
    world = LockstepWorld(site=site, seed=seed)
    eyes = world.open_eyes()
    camera = world.scene.robot.camera
    if not by_truth():
        drawn = DrawnFinder(world.sim, camera)
        eyes.classes, finder = drawn.classes, Counting(drawn, label, color)
    else:
        finder = Counting(TruthFinder(camera, seed), label, color)
    eyes.look_with(finder)
    name = name_object(label, color)
    words = f"find the {name.en}" if seed % 2 else f"找{name.zh}"
    began_s, goal = world.now_s, world.say(words)
    late = False
    try:
        world.run_until(lambda _: goal.has_ended, LIMIT_S)
    except TooLong:
        late = True
    record = goal.record
    outcome, plan = record.outcome, record.plan
    found = plan.steps[-1].found if plan is not None and plan.steps else None
    off_m = None
    if found is not None:
        off_m = min(hypot(x - found.x_m, y - found.y_m) for x, y in places(home, label, color))
    if goal.state is GoalState.SUCCEEDED and off_m is not None:
        verdict = "found" if off_m <= FAR_M + kind_of(label).reach_m else "wrong"
    else:
        code = outcome.code if outcome is not None else Code.OUT_OF_BUDGET
        verdict = "time up" if late else f"{code.value} ({record.reason})"
    note = (
        f"in {finder.looks} looks seen {finder.seen} times, in another colour {finder.other_color}"
    )
    metres = outcome.metres if outcome is not None and outcome.metres is not None else 0.0
    took_s = world.now_s - began_s
    return SearchResult(seed, words, len(home.rooms), verdict, note, took_s, metres, off_m)


def measure(lab: BenchLab) -> list[ReportRow]:
    """Look for one thing in each home."""
    eyes, kind = ("truth's eyes", "told") if by_truth() else ("drawn, default model", "drawn")
    trials = list(lab.side_by_side(kind, lab.count(QUICK_HOMES, HOMES), trial))
    number = max(1, len(trials))
    right = [one for one in trials if one["verdict"] == "found"]
    wrong = [one for one in trials if one["verdict"] == "wrong"]
    rows = [
        ReportRow("found", "%", ">= 90", value=f"{100 * len(right) / number:.0f}",
            note=f"{len(right)} of {len(trials)} homes; {eyes}"),
        ReportRow("wrong object", "%", "<= 2", value=f"{100 * len(wrong) / number:.0f}",
            note=", ".join(f"{one['words']} ({one['seed']})" for one in wrong)),
        row_of("until it was told", "s", "", [float(one["seconds"]) for one in right]),
        row_of("driven", "m", "", [float(one["metres"]) for one in right]),
        row_of("off the thing's middle", "m", "", [float(one["off_m"]) for one in right]),
    ]  # fmt: skip
    failed = [one for one in trials if one["verdict"] not in ("found", "wrong")]
    return rows + [
        ReportRow(f"home {one['seed']}: {one['words']}", "", "", value=str(one["verdict"]),
            note=str(one["note"]))
        for one in failed
    ]  # fmt: skip
