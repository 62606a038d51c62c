"""Ask as the planner does: meter, prompt, call, judgement, validation, the fallback behind it.

Run as ``python -m tools.bench.peers.ours FACTS`` in our own environment.
"""

from __future__ import annotations

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from planner.brain import FallbackBrain, OfflineBrain
from planner.brain.endpoint import EndpointBrain, warm_up
from planner.budget import Ledger, Purse
from planner.mission import AskBrain
from planner.mission.plan_request import thinker
from planner.plan import Language
from planner.settings import BudgetSettings, DayLimits, GoalLimits, ModelSettings
from planner.site import Site
from planner.site.site_view import vocabulary_of
from tools.bench.peers.loop import take_turns
from tools.bench.peers.shape import PeerFacts

MANY = 1_000_000_000
UNBOUND = BudgetSettings(
    goal=GoalLimits(calls=MANY, prompt_tokens=MANY, reply_tokens=MANY, seconds=1e9),
    day=DayLimits(calls=MANY, prompt_tokens=MANY, reply_tokens=MANY, seconds=1e9),
)


def main(path: str, home: Path) -> None:
    """Take turns with the bench."""
    facts, count = PeerFacts.load(path), 0
    warm_up()
    purse = Purse(UNBOUND, Ledger.in_home(home), most_reply=1000)
    model = EndpointBrain(ModelSettings(url=facts.url, name="pons"), home, meter=purse)
    words = vocabulary_of(Site.load(Path(facts.site)))
    think = thinker(FallbackBrain(model, OfflineBrain()), words)

    async def plan_once() -> None:
        nonlocal count
        count += 1
        planned = await think(AskBrain(f"goal-{count}", facts.said, Language.EN))
        if planned.plan is None or planned.brain != model.tag:
            raise RuntimeError(f"the model did not plan: {planned}")

    take_turns("pons", {}, plan_once)
    purse.close()


if __name__ == "__main__":
    with TemporaryDirectory(prefix="pb-") as folder:
        main(sys.argv[1], Path(folder))
