"""Own the record of how a goal ended: a stable code, a sentence in both languages, and figures.

"Arrived" is what odometry and the bridge say; the figures here are theirs, never a model's.
"""

from __future__ import annotations

from enum import StrEnum

from pydantic import Field

from planner.plan.base import Bilingual, Frozen


class Code(StrEnum):
    """Why a goal ended, or waits for a person."""

    # A code is never renamed. The sentence that a person reads stands in the catalogue under
    # ``outcome.<code>`` (planner/language/catalogue) and may be.

    # Understood or not: said before anything moves.
    EMPTY_GOAL = "empty_goal"
    TEXT_TOO_LONG = "text_too_long"
    BAD_TEXT = "bad_text"
    NOT_UNDERSTOOD = "not_understood"
    UNKNOWN_PLACE = "unknown_place"
    AMBIGUOUS = "ambiguous"
    INCOMPLETE = "incomplete"
    NEGATED = "negated"
    CONDITIONAL = "conditional"
    OUT_OF_SCOPE = "out_of_scope"
    NO_CAPABILITY = "no_capability"
    NO_CAMERA = "no_camera"
    NO_DETECTOR = "no_detector"
    NOT_MAPPING = "not_mapping"
    OBJECT_UNKNOWN = "object_unknown"
    UNSAFE = "unsafe"
    BAD_PLAN = "bad_plan"
    TOOLS_NEED_MODEL = "tools_need_model"
    MODEL_UNAVAILABLE = "model_unavailable"
    NOT_ARMED = "not_armed"
    PLACE_NOT_KEPT = "place_not_kept"
    NOT_KEPT = "not_kept"
    ORDER_NOT_KEPT = "order_not_kept"
    HINT_REFUSED = "hint_refused"
    SKILL_FAILED = "skill_failed"
    SKILL_NOT_KEPT = "skill_not_kept"
    # On the way.
    CONFIRM = "confirm"
    ASKED = "asked"
    NO_ANSWER = "no_answer"
    DECLINED = "declined"
    NO_ROOM = "no_room"
    NOT_REACHED = "not_reached"
    NO_ROUTE = "no_route"
    BLOCKED = "blocked"
    GOAL_OCCUPIED = "goal_occupied"
    BLIND = "blind"
    NOT_FOUND = "not_found"
    LOST_PERSON = "lost_person"
    POINT_REFUSED = "point_refused"
    PERSON_NEEDED = "person_needed"
    POINT_NOT_GIVEN = "point_not_given"
    POINT_OF_OTHER_MAP = "point_of_other_map"
    POINT_OUTSIDE_MAP = "point_outside_map"
    POINT_UNMAPPED = "point_unmapped"
    POINT_IN_OBSTACLE = "point_in_obstacle"
    POINT_IN_KEEP_OUT = "point_in_keep_out"
    POINT_OUTSIDE_FENCE = "point_outside_fence"
    POINT_UNREACHABLE = "point_unreachable"
    POINT_UNCHECKED = "point_unchecked"
    UNSURE = "unsure"
    UNMET = "unmet"
    TIME_PAST = "time_past"
    STOPPED = "stopped"
    FAULT = "fault"
    OUT_OF_BUDGET = "out_of_budget"
    # The end.
    ARRIVED = "arrived"
    FOUND = "found"
    COUNTED = "counted"
    SEEN = "seen"
    FOLLOWED = "followed"
    EXPLORED = "explored"
    PARTLY_EXPLORED = "partly_explored"
    RECALLED = "recalled"
    NOT_REMEMBERED = "not_remembered"
    MEMORY_UNAVAILABLE = "memory_unavailable"
    TOOL_ANSWERED = "tool_answered"
    TOOL_FAILED = "tool_failed"
    DONE = "done"
    ANSWERED = "answered"
    CANCELLED = "cancelled"


class Spot(Frozen):
    """Name where: a place or room of the site and, where known, the point in `map` [m, rad]."""

    place: str | None = None
    room: str | None = None
    x_m: float | None = None
    y_m: float | None = None
    yaw_rad: float | None = None


class Outcome(Frozen):
    """Tell how a goal ended, with the request, the result and the limits."""

    code: Code
    message: Bilingual
    asked: Spot | None = None
    reached: Spot | None = None
    metres: float | None = Field(default=None, ge=0.0)  # driven, by odometry
    seconds: float | None = Field(default=None, ge=0.0)  # from accepted to ended
    limited_by: tuple[str, ...] = ()  # the bridge's names for what held the speed down
