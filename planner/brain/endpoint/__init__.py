"""Ask a model over HTTP for a plan. The only place of the planner that knows httpx."""

from planner.brain.endpoint.address import Address
from planner.brain.endpoint.brain import EndpointBrain
from planner.brain.endpoint.judge import Unusable, judge
from planner.brain.endpoint.looker import EndpointLooker
from planner.brain.endpoint.reading import MAX_REPLY_BYTES
from planner.brain.endpoint.warm import warm_up

__all__ = [
    "MAX_REPLY_BYTES",
    "Address",
    "EndpointBrain",
    "EndpointLooker",
    "Unusable",
    "judge",
    "warm_up",
]
