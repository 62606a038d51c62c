"""Ask a model over HTTP for a plan. The only place of the planner that knows httpx."""

from planner.brain.endpoint.image_client import EndpointLooker
from planner.brain.endpoint.model_brain import EndpointBrain
from planner.brain.endpoint.preload import warm_up
from planner.brain.endpoint.reply_validation import Unusable, judge
from planner.brain.endpoint.response_reader import MAX_REPLY_BYTES
from planner.brain.endpoint.url_policy import Address

__all__ = [
    "MAX_REPLY_BYTES",
    "Address",
    "EndpointBrain",
    "EndpointLooker",
    "Unusable",
    "judge",
    "warm_up",
]
