"""Be the planner's HTTP face: routes, events, health, and the guard that stands before them."""

from planner.api.access import Access
from planner.api.app_factory import build, warm_up
from planner.api.interfaces import Goals, Robot, Services

__all__ = ["Access", "Goals", "Robot", "Services", "build", "warm_up"]
