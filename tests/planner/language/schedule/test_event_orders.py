"""Orders upon an event that stands behind them: whom they wait for, what is told or refused."""

from __future__ import annotations

import pytest

from planner.language.schedule import ScheduleCommand, read_order_command
from planner.plan.timing import EventRule, WorldEvent

TELLS = ("tell me", "let me know", "please tell me", "call me", "give me a shout", "warn me")
EVENTS = (("somebody comes in", WorldEvent.PERSON_SEEN),
          ("someone's at the front door", WorldEvent.PERSON_SEEN),
          ("anybody comes into the house", WorldEvent.PERSON_SEEN),
          ("your battery is low", WorldEvent.BATTERY_LOW),
          ("something moves", WorldEvent.MOVEMENT),
          ("you are back home", WorldEvent.ARRIVED_HOME))  # fmt: skip


def read(text: str) -> ScheduleCommand:
    command = read_order_command(text)
    assert isinstance(command, ScheduleCommand), (text, command)
    return command


@pytest.mark.parametrize("tells", TELLS)
@pytest.mark.parametrize(("clause", "event"), EVENTS)
def test_the_news_of_an_event_is_told_wherever_the_event_stands(
    tells: str, clause: str, event: WorldEvent
) -> None:
    for text in (f"{tells} when {clause}", f"when {clause}, {tells}",
                 f"{tells} when {clause}, I'm expecting a parcel"):  # fmt: skip
        command = read(text)
        assert command.when == EventRule(event=event), text
        assert command.reminder, text


@pytest.mark.parametrize(
    ("text", "order"),
    [
        ("say welcome to everyone who comes in", "say welcome"),
        ("greet everybody who comes in", "say hello"),
        ("greet people coming in with good evening", "say good evening"),
        ("welcome each guest who arrives", "say welcome"),
        ("tell everyone who comes in to take off their shoes", 'say "Please take off your shoes"'),
        ("whenever anyone comes in, tell them to wipe their feet",
         'say "Please wipe your feet"'),
        ("when somebody comes, wish them a happy birthday", 'say "Happy birthday"'),
    ],
)  # fmt: skip
def test_what_is_said_to_everybody_waits_for_somebody(text: str, order: str) -> None:
    command = read(text)
    assert command.when == EventRule(event=WorldEvent.PERSON_SEEN)
    assert command.order == order


@pytest.mark.parametrize("who", ["Mia", "Grandpa", "my daughter", "the postman"])
def test_who_is_named_before_the_event_is_who_is_waited_for(who: str) -> None:
    for text in (f"say hello to {who} when she comes home", f"greet {who} when he comes in",
                 f"tell {who} dinner is ready when they get home",
                 f"wish {who} a good evening when she comes back"):  # fmt: skip
        command = read(text)
        assert command.when == EventRule(event=WorldEvent.PERSON_SEEN), text
        assert command.who == who, text
        assert command.order.startswith("say "), text


@pytest.mark.parametrize("clause", ["Grandpa comes into the living room", "Mia is in the kitchen",
                                    "somebody enters the study", "someone is at the desk",
                                    "anybody goes into my room"])  # fmt: skip
def test_a_place_is_asked_about_and_the_nearest_event_offered(clause: str) -> None:
    for text in (f"when {clause}, say hello", f"say hello when {clause}", f"tell me when {clause}"):
        command = read(text)
        assert command.problem == "order_event_place", text
        assert isinstance(read(command.offer).when, EventRule), command.offer


@pytest.mark.parametrize(
    "text",
    ["say something nice to Grandpa when he wakes up", "when I get up, say good morning",
     "tell me when dinner is ready", "when the doorbell rings, tell me",
     "when the dog barks, say quiet", "whenever the cat goes in the study, tell me",
     "tell me every time the phone rings, I'm in the garden"],
)  # fmt: skip
def test_what_no_event_tells_is_refused(text: str) -> None:
    command = read(text)
    assert command.when is None
    assert command.problem == "order_no_event"


@pytest.mark.parametrize(
    "text",
    ["go to the kitchen and tell me when somebody comes",
     "stay here and tell me when someone comes",
     "tell me what you see when you get to the kitchen", "when you're done, come back",
     "greet everybody in the kitchen", "say hello to everyone", "tell me when you are done",
     "when the dog barks, come to me", "say hello when somebody comes in, go to the kitchen"],
)  # fmt: skip
def test_what_drives_or_runs_now_is_left_to_others(text: str) -> None:
    assert not isinstance(read_order_command(text), ScheduleCommand)
