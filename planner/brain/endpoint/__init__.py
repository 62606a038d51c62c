"""Ask a model over HTTP for a plan. The only place of the planner that knows httpx."""

from planner.brain.endpoint.http_client import warm_up
from planner.brain.endpoint.image_client import EndpointLooker
from planner.brain.endpoint.model_brain import EndpointBrain
from planner.brain.endpoint.plan_reply import Unusable, judge
from planner.brain.endpoint.response import MAX_REPLY_BYTES

__all__ = [
    "MAX_REPLY_BYTES",
    "EndpointBrain",
    "EndpointLooker",
    "Unusable",
    "judge",
    "warm_up",
]
