"""Give the bodies that the routes take: closed, bounded, bilingual where a person writes."""

from __future__ import annotations

from typing import Annotated

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, StrictBool, model_validator

from maps.errors import BilingualError
from planner.language.catalogue import say
from planner.people import name_asker
from planner.plan import GIVEN, MAX_STEPS, GoToPose, Language, Step, list_nodes
from wire import Proof, TrialAct
from wire.bounded_types import Count, Fingerprint, Name
from wire.geometry import Metres, Mps, Radps, Yaw

MAX_GOAL_CHARACTERS = 4_000
"""Of a goal and of an answer; lists, snapshots and the journal keep them many times over."""
MAX_TEXT_CHARACTERS = 200_000
"""Of any text: a longer one than a goal may be is still searched for a stop."""


class Body(BaseModel):
    """Refuse unknown fields: a misspelt option must not be ignored."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class OperatorProof(Body):
    """Carry a proof made in CLI or page; the planner relays what it can't make."""

    id: Name
    proof: Proof


Source = Annotated[Name, AfterValidator(name_asker), Field(validate_default=True)]
"""Names the asker, for the record; a person with a token of their own, whatever is said."""
Text = Annotated[
    str,
    Field(
        max_length=MAX_TEXT_CHARACTERS,
        description=f"At most {MAX_GOAL_CHARACTERS} characters; longer ones may only stop",
    ),
]


class GoalPoint(Body):
    """Point at a spot of the map: to stand at, with a heading or without, or to look at."""

    x_m: Annotated[Metres, Field(strict=True)]
    y_m: Annotated[Metres, Field(strict=True)]
    yaw_rad: Annotated[Yaw, Field(strict=True)] | None = None
    look: StrictBool = False
    """Stand near by, where the point is seen from, and face it; then no yaw_rad."""

    @model_validator(mode="after")
    def _faces_one_way(self) -> GoalPoint:
        if self.look and self.yaw_rad is not None:
            raise law_broken("look_or_yaw")
        return self


class NewGoal(Body):
    """Give a goal in words, by points of the map in a row, or by steps of the vocabulary."""

    text: Text | None = None
    source: Source = "api"
    """The door that it comes through (``page``, ``cli``): shown beside the goal."""
    points: Annotated[tuple[GoalPoint, ...], Field(min_length=1, max_length=20)] | None = None
    map_id: Fingerprint | None = None
    """The map that the points are on."""
    steps: Annotated[tuple[Step, ...], Field(min_length=1, max_length=MAX_STEPS)] | None = None
    """The whole plan: no brain reads it, and it passes the same check as a brain's."""
    language: Language | None = None
    confirm: StrictBool = False
    """Show the plan and wait for a yes before the first step."""
    replace: StrictBool = False
    """Once understood, end the running goal (where none runs, the one that thinks or asks) and go
    first; what is paused or queued keeps its place."""
    operator: OperatorProof | None = None
    """On a robot of metal: a proof of kind resume, which clears what a stop has held."""

    @model_validator(mode="after")
    def _given_once(self) -> NewGoal:
        if sum(each is not None for each in (self.text, self.points, self.steps)) != 1:
            raise law_broken("text_or_points")
        if any(node.step.kind in GIVEN for node in list_nodes(self.steps or ())):
            raise law_broken("points_in_steps")
        if (self.points is None) is not (self.map_id is None):
            raise law_broken("points_need_map")
        return self

    @property
    def given_steps(self) -> tuple[Step, ...]:
        """Return the steps, or the points as steps; none of a goal in words."""
        return self.steps or tuple(
            GoToPose(map_id=self.map_id or "", **point.model_dump()) for point in self.points or ()
        )


class GoalOrder(Body):
    """Act on a goal; resuming may carry a proof."""

    source: Source = "api"
    operator: OperatorProof | None = None


class GoalReply(Body):
    """Answer a goal's question."""

    text: Text
    source: Source = "api"
    operator: OperatorProof | None = None


class GoalMove(Body):
    """Put a queued goal before another one; last without ``before``."""

    before: Name | None = None


class StopOrder(Body):
    """Stop now; ``source`` names the asker, for the record."""

    source: Source = "api"


class OperatorOrder(Body):
    """Arm, disarm, protective stop, reset or resume."""

    source: Source = "api"
    operator: OperatorProof | None = None


class Steer(Body):
    """Steer by hand while ``dead_man`` is held; send at 20 Hz."""

    source: Source
    v_mps: Annotated[Mps, Field(strict=True)]
    w_radps: Annotated[Radps, Field(strict=True)]
    dead_man: StrictBool


class SetupAsk(Body):
    """Ask for set-up in the bridge's place."""

    source: Source = "api"


class TrialAsk(Body):
    """Ask set-up for something, or show that the page which began a trial still watches."""

    act: TrialAct
    id: Name
    """Of this request; of a watch: that of its begin, which the proof of that covers."""
    source: Source = "api"
    answered: Count = 0
    """Of a watch: the number of the newest question whose answer is "done"."""
    proof: Proof | None = None
    """Of a begin, over "trial", the robot's id, the status's nonce and this id."""


def law_broken(law: str) -> BilingualError:
    """Return what a body breaks, for pydantic to carry: both sentences reach the answer."""
    told = say(f"request.{law}")
    return BilingualError(told.en, told.zh)
