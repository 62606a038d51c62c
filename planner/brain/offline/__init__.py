"""Plan without a model: English and Chinese orders, read by grammar in the site's own names."""

from planner.brain.offline.brain import VERSION, OfflineBrain
from planner.brain.offline.guard import MAX_CHARACTERS
from planner.brain.offline.reader import Context, plan

__all__ = ["MAX_CHARACTERS", "VERSION", "Context", "OfflineBrain", "plan"]
