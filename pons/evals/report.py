"""Show how a brain did on a suite: a table for people, one JSON object for programs."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from pons.evals.score import SentenceVerdict

GOAL = 0.95
"""Of the sentences of a suite, with no wrong motion at all."""
ALL = "all"
_KINDS = ("plan", "clarify", "refuse", "answer")


@dataclass(frozen=True, slots=True)
class GuardCount:
    """Count what the guard would do with a model's plans that hold motion."""

    moving: int
    needs_yes: int
    """Of these, a person is asked before they are walked."""
    wrong: int
    """Of these, with a motion that the sentence does not name."""
    walked_unasked: int
    """Of the wrong ones, walked without a yes: 0 is the goal."""


def guard_count(verdicts: Sequence[SentenceVerdict]) -> GuardCount:
    """Count the plans that are held to the guard; the grammar's own are not."""
    held = [verdict for verdict in verdicts if verdict.needs_yes is not None]
    return GuardCount(
        len(held),
        sum(verdict.needs_yes is True for verdict in held),
        sum(bool(verdict.wrong) for verdict in held),
        sum(verdict.walked_unasked for verdict in held),
    )


def _no_decisions(verdicts: Sequence[SentenceVerdict]) -> Counter[str]:
    return Counter(verdict.no_decision for verdict in verdicts if verdict.no_decision)


def _model_rows(verdicts: Sequence[SentenceVerdict]) -> list[str]:
    """Return what is told of a model alone: why it decided nothing, and the guard's word."""
    rows, why, guard = [], _no_decisions(verdicts), guard_count(verdicts)
    if why:
        told = ", ".join(f"{code} {count}" for code, count in why.most_common())
        rows.append(f"no decision: {told}")
    if guard.moving:
        rows.append(
            f"the guard: of {guard.moving} plans that move {guard.needs_yes} wait for a yes; "
            f"of {guard.wrong} that move wrongly {guard.walked_unasked} do not"
        )
    return rows


def sum_up(verdicts: Sequence[SentenceVerdict]) -> list[dict[str, Any]]:
    """Return one line for each group and split, then the sums."""
    groups = sorted({verdict.case.group for verdict in verdicts})
    splits = sorted({verdict.case.split for verdict in verdicts}, reverse=True)
    found = []
    for group in (*groups, ALL):
        for split in (*splits, ALL) if len(splits) > 1 else (ALL,):
            mine = [
                v for v in verdicts if group in (ALL, v.case.group) and split in (ALL, v.case.split)
            ]
            outcomes = {kind: sum(v.made.kind == kind for v in mine) for kind in _KINDS}
            line = {"group": group, "split": split, "count": len(mine)}
            line |= {"right": sum(v.right for v in mine)}
            line |= {"wrong_motions": sum(bool(v.wrong) for v in mine), "outcomes": outcomes}
            found += [line] if mine else []
    return found


def has_passed(verdicts: Sequence[SentenceVerdict], left: int = 0) -> bool:
    """Tell whether a suite reaches the goal: all asked, enough right, nothing moved wrongly."""
    right = sum(verdict.right for verdict in verdicts)
    enough = right >= GOAL * len(verdicts) and not any(verdict.wrong for verdict in verdicts)
    return enough and left == 0


def table(name: str, brain: str, verdicts: Sequence[SentenceVerdict], left: int = 0) -> str:
    """Return the table of a suite, with every sentence that went wrong."""
    not_asked = f", {left} more not asked" if left else ""
    rows = [f"{name}: {len(verdicts)} sentences, planned by {brain}{not_asked}", ""]
    rows.append(
        f"{'group':18}{'split':10}{'n':>5}{'right':>7}{'':>8}{'wrong motion':>14}  plan/ask/no/tell"
    )
    rows += map(_row, sum_up(verdicts))
    p50, p99 = _times_ms(verdicts)
    rows += ["", f"seconds a sentence: p50 {p50 / 1e3:.4f}, p99 {p99 / 1e3:.4f}"]
    offered = [verdict.after_yes for verdict in verdicts if verdict.after_yes is not None]
    if offered:
        told = f"{sum(offered)} of {len(offered)} would be right by one of the offers"
        rows += [f"of those not right: {told}"]
    rows += _model_rows(verdicts)
    faults = [verdict for verdict in verdicts if not verdict.right]
    rows += ["", "not right:"] if faults else []
    rows += [
        f"  {v.case.group}: {v.case.full_text}\n    {v.kind_and_code}; {v.explanation}"
        for v in faults
    ]
    return "\n".join(rows)


def content(
    name: str, brain: str, verdicts: Sequence[SentenceVerdict], left: int = 0
) -> dict[str, Any]:
    """Return the same as plain data."""
    p50, p99 = _times_ms(verdicts)
    return {
        "suite": name,
        "brain": brain,
        "passed": has_passed(verdicts, left),
        "not_asked": left,
        "calls": sum(verdict.calls for verdict in verdicts),
        "offered": sum(verdict.after_yes is not None for verdict in verdicts),
        "right_after_yes": sum(verdict.after_yes is True for verdict in verdicts),
        "tokens": sum(verdict.tokens for verdict in verdicts),
        "no_decision": dict(_no_decisions(verdicts)),
        "guard": asdict(guard_count(verdicts)),
        "ms": {"p50": round(p50, 3), "p99": round(p99, 3)},
        "groups": sum_up(verdicts),
        "failures": [_failure(verdict) for verdict in verdicts if not verdict.right],
    }


def as_json(results: Iterable[dict[str, Any]]) -> str:
    """Write results for a program."""
    return json.dumps({"suites": list(results)}, ensure_ascii=False, indent=2)


def _row(line: dict[str, Any]) -> str:
    kinds = "/".join(map(str, line["outcomes"].values()))
    count, right = line["count"], line["right"]
    return (
        f"{line['group']:18}{line['split']:10}{count:5}{right:7}{right / count:8.1%}"
        f"{line['wrong_motions']:14}  {kinds}"
    )


def _failure(verdict: SentenceVerdict) -> dict[str, Any]:
    return {
        "text": verdict.case.full_text,
        "group": verdict.case.group,
        "made": verdict.made.model_dump(mode="json"),
        "why": verdict.explanation,
        "wrong_motions": list(verdict.wrong),
    }


def _times_ms(verdicts: Sequence[SentenceVerdict]) -> tuple[float, float]:
    times = sorted(verdict.seconds * 1e3 for verdict in verdicts)
    if not times:
        return 0.0, 0.0
    return times[len(times) // 2], times[min(len(times) - 1, int(len(times) * 0.99))]
