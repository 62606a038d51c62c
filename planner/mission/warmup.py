"""Work out before the start what the first search would hold the mission loop up for.

From where rooms are looked through follows from their outlines alone and is kept once known. Over a
home of seven rooms it took 52 ms of a processor in one reduction, more than the event loop may take
(docs/adr/0026). The patterns by which words are read as things took 54 ms; those for a detector's
own names are made when it says them (wording.py).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.object_names import prepare
from planner.mission.skills.viewpoints import near_spot, spots_in

if TYPE_CHECKING:
    from planner.mission.state import SiteView


def warm_up(facts: SiteView, classes: tuple[str, ...] = ()) -> None:
    """Work out the spots of every room, and how to read words: in these classes, and in all.

    Takes long: call it off the event loop.
    """
    prepare(())
    prepare(classes)
    for target in facts.targets.values():
        if target.room:
            spots_in(target)
            near_spot(target)
