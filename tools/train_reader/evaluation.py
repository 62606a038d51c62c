"""Judge a network on sentences of writers that it never met."""

from __future__ import annotations

from collections import Counter, defaultdict
from dataclasses import dataclass
from typing import TYPE_CHECKING

from planner.language.semantic_parser.decoding import decode_plans
from planner.language.semantic_parser.normal_plan import normalise_plan
from planner.language.semantic_parser.plan_grammar import LabelledPlan, PlanNode

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from planner.language.semantic_parser.network import PointerNetwork
    from tools.train_reader.examples import PlanExample

DRIVES = frozenset(
    {"go", "approach", "stand", "back", "home", "turn", "move", "patrol", "inspect", "explore"}
    | {"look", "count", "follow", "find", "check", "resume", "again", "more", "less", "other"}
    | {"skip", "also", "also_thing", "change_place", "change_thing", "faster"}
)
"""Forms that may set wheels in motion."""
_PLAIN = frozenset(
    {"the", "a", "an", "my", "our", "your", "his", "her", "their", "this", "that", "some", "any"}
)
DRAFTS = 3
"""Written side by side, as the planner does."""
_WHOLE_SLOTS = frozenset({"go", "patrol", "inspect", "turn", "move"})


@dataclass(frozen=True, slots=True)
class Verdict:
    """Hold what was read of an example."""

    example: PlanExample
    read: LabelledPlan
    confidence: float

    @property
    def is_exact(self) -> bool:
        """Return whether it is the plan that was meant; articles aside."""
        return bare(self.read) == bare(self.example.plan)

    @property
    def same_motion(self) -> bool:
        """Return whether the steps that drive are those that were meant, at the same places."""
        return list(motions(self.read)) == list(motions(self.example.plan))


def bare(plan: LabelledPlan) -> LabelledPlan:
    """Return a plan with its words in small letters and without articles around them."""

    def words(text: str) -> str:
        parts = text.casefold().strip(" .,!?。，！？").split()
        while len(parts) > 1 and parts[0] in _PLAIN:
            parts = parts[1:]
        return " ".join(parts)

    def plain(node: PlanNode) -> PlanNode:
        slots = tuple(tuple(map(words, value)) for value in node.slots)
        blocks = tuple(bare(block) for block in node.blocks)
        return PlanNode(node.form, slots, bare(node.condition), blocks)

    return tuple(map(plain, plan))


def motions(plan: LabelledPlan) -> Iterator[tuple[object, ...]]:
    """Yield what drives in a plan, with where and under which condition."""
    for node in plan:
        if node.form in DRIVES:
            words = node.slots if node.form in _WHOLE_SLOTS else node.slots[1:2]
            yield node.form, words
        elif node.condition or node.blocks:
            yield node.form, tuple(part.form for part in node.condition), bool(node.blocks)
        yield from motions(node.condition)
        for number, block in enumerate(node.blocks):
            yield from [("else",)] * number
            yield from motions(block)


def judge(network: PointerNetwork, examples: Sequence[PlanExample]) -> list[Verdict]:
    """Return what the network reads of each example."""
    verdicts = []
    for example in examples:
        surest = next(iter(decode_plans(network, example.said, DRAFTS)), None)
        plan = normalise_plan(surest.plan) if surest else ()
        verdicts.append(Verdict(example, plan, surest.confidence if surest else 0.0))
    return verdicts


def _share(verdicts: Iterable[Verdict], holds: Callable[[Verdict], bool]) -> str:
    all_ = list(verdicts)
    right = sum(map(holds, all_))
    return f"{100 * right / max(1, len(all_)):5.1f} % ({right} of {len(all_)})"


def report(verdicts: Sequence[Verdict], tell: Callable[[str], None]) -> None:
    """Tell shares by language, by category, and wrong motions by threshold."""
    tell(f"exact {_share(verdicts, lambda v: v.is_exact)}")
    tell(f"same motion {_share(verdicts, lambda v: v.same_motion)}")
    groups: dict[str, list[Verdict]] = defaultdict(list)
    for verdict in verdicts:
        groups[verdict.example.writer[:2]].append(verdict)
        groups["category " + verdict.example.category].append(verdict)
    for name, of_group in sorted(groups.items()):
        exact = _share(of_group, lambda v: v.is_exact)
        tell(f"  {name:28} exact {exact}  motion {_share(of_group, lambda v: v.same_motion)}")
    tell("threshold: acted on, exact among them, wrong motions of all sentences")
    for least in (0.0, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95, 0.98, 0.99):
        acted = [v for v in verdicts if v.confidence >= least and any(motions(v.read))]
        wrong = sum(not v.same_motion for v in acted)
        right = sum(v.is_exact for v in acted)
        tell(f"  {least:4}: {len(acted)}, {right}, {wrong} ({100 * wrong / len(verdicts):.2f} %)")
    confused = Counter(
        (v.example.plan[0].form, v.read[0].form if v.read else "")
        for v in verdicts
        if not v.is_exact
    )
    tell("confused: " + ", ".join(f"{a}>{b} {n}" for (a, b), n in confused.most_common(20)))
