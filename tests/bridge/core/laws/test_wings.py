"""Hold the core's files apart: imports run one way, and each field of the state has one writer."""

from __future__ import annotations

import ast
import dataclasses
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path

from bridge import core
from bridge.core.state import BridgeState

ROOT = Path(core.__file__).parent


@cache
def trees() -> dict[str, ast.Module]:
    """Return each module of the core, by its dotted name below bridge.core."""
    return {
        ".".join(path.relative_to(ROOT).with_suffix("").parts): ast.parse(path.read_text("utf-8"))
        for path in sorted(ROOT.rglob("*.py"))
        if path.name != "__init__.py"
    }


def imports_of(tree: ast.Module) -> set[str]:
    """Return the modules of the core that a module imports, under TYPE_CHECKING too."""
    found: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("bridge.core"):
            below = (node.module or "").removeprefix("bridge.core").removeprefix(".")
            for name in (below, *(f"{below}.{alias.name}".lstrip(".") for alias in node.names)):
                if name in trees():
                    found.add(name)
    return found


def test_no_two_files_import_each_other_and_no_more_do_so_in_a_circle() -> None:
    graph = {name: imports_of(tree) for name, tree in trees().items()}
    assert sum(map(len, graph.values())) > 100
    TopologicalSorter(graph).prepare()  # raises CycleError, with the circle


WRITERS = {
    "bad_bucket": "authority.message_limits",
    "buttons": "sensing.stop_inputs",
    "command_seq": "motion.wheel_command",
    "drive": "sensing.sensor_update",
    "epoch_no": "authority.epoch",
    "external": "authority.external_velocity",
    "fault": "modes.transition",
    "fence_asked": "authority.requests",
    "flood": "authority.message_limits",
    "gate": "motion.motion_gates",
    "grants": "authority.ownership",
    "held": "authority.epoch",
    "learnt": "motion.braking",
    "leg": "authority.leg_tracking",
    "lidar": "sensing.sensor_update",
    "loop": "sensing.sensor_update",
    "marks": "authority.marks",
    "mode": "modes.transition",
    "mode_since_s": "modes.transition",
    "motion": "motion.wheel_command",
    "motion.bound_by": "motion.motion_gates motion.wheel_command",
    "motion.free_m": "motion.motion_gates motion.wheel_command",
    "now_s": "step",
    "odometry": "sensing.sensor_update",
    "operator": "authority.requests",
    "ownership": "authority.ownership",
    "pose": "sensing.sensor_update",
    "ramp": "motion.braking",
    "rows": "faults.fault_latch",
    "selftest": "modes.selftest",
    "source": "modes.transition",
    "stick": "authority.stick",
    "stopping": "modes.transition",
    "tick": "step",
    "trail": "sensing.sensor_update",
    "voice": "reporting.report",
    "waits_since_s": "modes.mode_logic",
    "watch": "faults.detect_motion faults.detectors",
    "watch.outside": "motion.motion_gates",
}
"""Each field of the state, and the one module that assigns to it. Where two are named they are one
wing and work in turns: the gates narrow the bound that the command began with, and each detector
fills windows of its own. ``braking_trouble`` and ``started_s`` are set before the first tick."""


def chain_of(node: ast.expr) -> list[str]:
    """Return the names of an attribute chain, outermost first; none where it is no chain."""
    names: list[str] = []
    while isinstance(node, ast.Attribute):
        names.append(node.attr)
        node = node.value
    return [node.id, *reversed(names)] if isinstance(node, ast.Name) else []


def targets_of(node: ast.AST) -> list[ast.expr]:
    """Return what a statement assigns to, tuples taken apart."""
    if isinstance(node, ast.Assign):
        groups = node.targets
    elif isinstance(node, ast.AugAssign | ast.AnnAssign):
        groups = [node.target]
    else:
        return []
    return [one for group in groups for one in getattr(group, "elts", [group])]


def pairs_of(node: ast.AST) -> list[tuple[ast.expr, ast.expr]]:
    """Return targets beside their values, tuples taken apart where both sides are some."""
    if not isinstance(node, ast.Assign):
        return []
    found = []
    for target in node.targets:
        if isinstance(target, ast.Tuple) and isinstance(node.value, ast.Tuple):
            found += list(zip(target.elts, node.value.elts, strict=True))
        else:
            found.append((target, node.value))
    return found


def fields_written(function: ast.FunctionDef) -> set[str]:
    """Return the state's fields that a function assigns to, through local names, too."""
    known = {"tick": ["tick"], "self": ["tick"]}
    for node in ast.walk(function):
        for target, value in pairs_of(node):
            names = chain_of(value)
            if isinstance(target, ast.Name) and names and names[0] in known:
                known[target.id] = [*known[names[0]], *names[1:]]
    if function.name == "step":
        known["s"] = ["tick", "s"]
    found: set[str] = set()
    for node in ast.walk(function):
        for target in targets_of(node):
            names = chain_of(target)
            if len(names) > 1 and names[0] in known:
                names = [*known[names[0]], *names[1:]]
                if names[:2] == ["tick", "s"] and len(names) > 2:
                    found.add(".".join(names[2:4]))
    return found


def writers() -> dict[str, set[str]]:
    """Return the modules that assign to each field of the state, read from their sources."""
    found: dict[str, set[str]] = {}
    for name, tree in trees().items():
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef):
                for field in fields_written(node):
                    known = field if field in WRITERS else field.partition(".")[0]
                    found.setdefault(known, set()).add(name)
    return found


def test_each_field_of_the_state_has_one_writer() -> None:
    assert writers() == {field: set(names.split()) for field, names in WRITERS.items()}


def test_the_table_of_writers_names_every_field() -> None:
    fields = {field.name for field in dataclasses.fields(BridgeState)}
    before_the_first_tick = {"braking_trouble", "started_s"}
    assert {name for name in WRITERS if "." not in name} | before_the_first_tick == fields
