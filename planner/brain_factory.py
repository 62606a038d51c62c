"""Choose who plans, as the owner's settings say: a model of theirs, or the built-in rules alone."""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING

from planner.brain import Brain, FallbackBrain, OfflineBrain
from planner.brain.model_replies import ReplyCollector
from planner.settings import list_keys

if TYPE_CHECKING:
    from pathlib import Path

    from planner.brain.endpoint import EndpointBrain
    from planner.brain.usage_meter import Meter
    from planner.settings import Settings
    from planner.tool_servers import ToolDesk

log = logging.getLogger(__name__)


def collector_of(settings: Settings) -> ReplyCollector:
    """Return the keeper of what a model writes; it keeps nothing unless the owner has set it."""
    most_goals = 0 if settings.model is None else settings.model.keep_replies
    return ReplyCollector(most_goals, list_keys(settings))


def model_of(
    settings: Settings,
    home: Path,
    meter: Meter,
    replies: ReplyCollector | None = None,
    tools: ToolDesk | None = None,
) -> EndpointBrain | None:
    """Return the brain of the model that the owner has set, if one is; ``tools``: it may ask."""
    if settings.model is None:
        return None
    from planner.brain.endpoint import EndpointBrain, warm_up  # httpx costs 0.1 s: not for nothing

    logging.getLogger("httpx").setLevel(logging.WARNING)  # a line for each call is too much
    offered = (lambda: tools.tools) if tools is not None else tuple
    model = EndpointBrain(settings.model, home, meter=meter, replies=replies, tools=offered)
    warm_up()
    log.info("plans come from %s at %s", model.tag.name, model.address.host)
    return model


def brain_of(model: EndpointBrain | None, settings: Settings) -> Brain:
    """Return who plans: the model with the built-in rules behind it, or these alone."""
    if model is None or settings.model is None:
        return OfflineBrain(servers=tuple(settings.tools))
    return FallbackBrain(model, OfflineBrain(), rest_s=settings.model.rest_s)
