"""Show the decisions that would differ, what validation would have refused, and the rest."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from pons.evals.journal.recorded import RecordedDecisions
from pons.evals.journal.think import SecondThought, plan_line
from pons.evals.model_access import Spending

LIMITS = (
    "Sentences were thought about with the site's own places as they are now; nothing was driven."
)
LIMITS_ZH = "重新思考时使用场地现有的地点；机器人没有行驶。"


def verdict(again: SecondThought) -> str:
    """Name the fate that the model's decision would have had."""
    if again.relation == "none":
        return "the offline brain would have answered"
    if again.refused:
        return f"refused by validation ({again.refused}): nothing would have moved"
    if again.relation != "differs":
        return ""
    return "valid, and moves; not driven here" if again.moves else "valid, and moves nothing"


def table(
    recorded: RecordedDecisions, found: Sequence[SecondThought], cost: Spending, model: str
) -> str:
    """Return the comparison for a terminal."""
    lines = []
    for again in found:
        if again.relation == "same":
            continue
        lines.append(f"{again.relation:<8} {again.decision.text}")
        lines.append(f"  {again.decision.brain}: {plan_line(again.decision.plan)}")
        lines.append(f"  {model}: {again.made}")
        if said := verdict(again):
            lines.append(f"  -> {said}")
    lines.append(_summary(recorded, found, cost))
    lines += [_summary_zh(found, cost), LIMITS, LIMITS_ZH]
    return "\n".join(lines)


def content(
    recorded: RecordedDecisions, found: Sequence[SecondThought], cost: Spending, model: str
) -> str:
    """Return the comparison as JSON."""
    record: dict[str, Any] = {
        "model": model,
        "counts": _counts(found),
        "without_plan": recorded.without,
        "unreadable": recorded.unreadable,
        "cost": {**asdict(cost), "left": _count_left(recorded, found)},
        "limits": LIMITS,
        "decisions": [
            {
                "goal": again.decision.goal,
                "text": again.decision.text,
                "relation": again.relation,
                "recorded": {"brain": again.decision.brain, "plan": plan_line(again.decision.plan)},
                "made": again.made,
                "refused": again.refused,
                "verdict": verdict(again),
            }
            for again in found
        ],
    }
    return json.dumps(record, ensure_ascii=False, indent=1)


def _count_left(recorded: RecordedDecisions, found: Sequence[SecondThought]) -> int:
    """Return how many sentences were not thought about: the budget was up."""
    return len(recorded.decisions) - len(found)


def _counts(found: Sequence[SecondThought]) -> dict[str, int]:
    counts = Counter(again.relation for again in found)
    return {
        "same": counts["same"],
        "words": counts["words"],
        "differs": counts["differs"],
        "none": counts["none"],
        "refused_by_validation": sum(bool(again.refused) for again in found),
        "moves": sum(again.moves for again in found),
    }


def _summary(recorded: RecordedDecisions, found: Sequence[SecondThought], cost: Spending) -> str:
    n = _counts(found)
    thought = (
        f"{len(found)} sentences: {n['same']} the same, {n['words']} in words alone, "
        f"{n['differs']} differ, {n['none']} without a plan"
    )
    stopped = f"{n['refused_by_validation']} refused by validation, {n['moves']} valid and moving"
    spent = f"{cost.calls} calls, {cost.prompt_tokens} tokens sent, {cost.reply_tokens} written"
    parts = [thought, stopped, spent]
    if left := _count_left(recorded, found):
        parts.append(f"{left} not thought about: the budget is up")
    if recorded.without or recorded.unreadable:
        parts.append(
            f"{recorded.without} goals had no plan of a brain, {recorded.unreadable} records can't "
            "be read"
        )
    return "\n".join(parts)


def _summary_zh(found: Sequence[SecondThought], cost: Spending) -> str:
    n = _counts(found)
    return (
        f"{len(found)} 条指令：{n['same']} 条相同，{n['words']} 条仅措辞不同，"
        f"{n['differs']} 条不同，{n['none']} 条没有计划；"
        f"{n['refused_by_validation']} 条会被校验拒绝，"
        f"{n['moves']} 条有效且会移动；共 {cost.calls} 次调用"
    )
