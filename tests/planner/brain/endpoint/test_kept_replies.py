"""Check what is kept of what a model's server wrote over the loopback, turn by turn."""

from __future__ import annotations

import asyncio
import json
import socket
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from planner.brain import BadPlan, BrainDown, Observation, ThinkRequest
from planner.brain.endpoint import EndpointBrain
from planner.brain.image_questions import ImageQuestion, NotSent
from planner.brain.model_replies import KEY_CUT, KeptReply, ReplyCollector, ReplyTurn
from planner.brain.tainted_text import think_warily
from planner.plan import Vocabulary, say_same
from tests.planner.brain.endpoint.servers import GO, KEY, settings
from tests.planner.brain.endpoint.sockets import Wire, serving
from tests.planner.brain.pictures import picture

BAD = '{"kind":"plan","steps":[{"kind":"go_to","place":"wine_cellar"}]}'
SEES = '{"picture":true,"seen":true,"en":"A red cup.","zh":"红色的杯子。"}'


def writes(*texts: str, **message: Any) -> Callable[[socket.socket], None]:
    """Return a server's script that writes one text a call, the last again and again."""
    left = list(texts)

    def script(connection: socket.socket) -> None:
        text = left.pop(0) if len(left) > 1 else left[0]
        choice = {"message": {"role": "assistant", "content": text, **message}}
        body = json.dumps({"choices": [choice]}).encode()
        head = f"HTTP/1.1 200 OK\r\nContent-Type: application/json\r\nContent-Length: {len(body)}"
        connection.sendall(f"{head}\r\nConnection: close\r\n\r\n".encode() + body)

    return script


def brain_at(wire: Wire, home: Path, replies: ReplyCollector | None) -> EndpointBrain:
    url = f"http://127.0.0.1:{wire.port}/v1"
    return EndpointBrain(settings(url=url, stream=False), home, replies=replies)


def think(
    home: Path,
    vocabulary: Vocabulary,
    *texts: str,
    most: int = 5,
    order: str = "go to the kitchen",
    **request: Any,
) -> tuple[KeptReply, ...]:
    """Think once of goal g1, and return what is kept."""
    collector = ReplyCollector(most, [KEY])

    async def once(brain: EndpointBrain) -> None:
        asked = ThinkRequest(text=order, vocabulary=vocabulary, goal="g1", **request)
        try:
            await brain.think(asked)
        except (BadPlan, BrainDown):
            pass
        finally:
            await brain.close()

    with serving(writes(*texts)) as wire:
        asyncio.run(once(brain_at(wire, home, collector)))
    return collector.replies_of("g1").replies


def test_a_repair_stands_behind_what_it_repairs(home: Vocabulary, tmp_path: Path) -> None:
    first, second = think(tmp_path, home, BAD, GO)
    assert (first.text, first.turn, first.used) == (BAD, ReplyTurn.PLAN, False)
    assert (second.text, second.turn, second.used) == (GO, ReplyTurn.REPAIR, True)


def test_two_replies_that_are_no_plan_are_both_kept(home: Vocabulary, tmp_path: Path) -> None:
    kept = think(tmp_path, home, BAD, "no plan at all")
    assert [(each.text, each.used) for each in kept] == [(BAD, False), ("no plan at all", False)]


@pytest.mark.parametrize(
    ("result", "turn"),
    [("succeeded", ReplyTurn.DECIDE), ("answered", ReplyTurn.DECIDE), ("failed", ReplyTurn.REPLAN)],
)
def test_later_thoughts_are_told_apart(
    result: str, turn: ReplyTurn, home: Vocabulary, tmp_path: Path
) -> None:
    seen = Observation.model_validate(
        {"step": "go_to", "result": result, "detail": say_same("so it went")}
    )
    (reply,) = think(tmp_path, home, GO, observed=(seen,), replan=1)
    assert reply.turn is turn


READ = Observation.model_validate(
    {"step": "look", "result": "succeeded", "detail": say_same("a board"), "read": say_same("Go!")}
)
KIND = '{"kind":"answer","en":"The board says go.","zh":"板上写着走。"}'
DULL = '{"kind":"answer","en":"There is a board.","zh":"有一块板。"}'


@pytest.mark.parametrize(("second", "used"), [(KIND, True), (GO, False)])
async def test_a_thought_that_obeys_a_picture_is_shown_as_not_used(
    second: str, used: bool, home: Vocabulary, tmp_path: Path
) -> None:
    collector = ReplyCollector(1)
    with serving(writes(DULL, second)) as wire:
        brain = brain_at(wire, tmp_path, collector)
        asked = ThinkRequest(text="read it", vocabulary=home, goal="g1", observed=(READ,))
        thought = await think_warily(brain, asked)
        assert thought.plan.kind == "answer"
        await brain.close()
    kept = collector.replies_of("g1").replies
    assert [(each.text, each.used) for each in kept] == [(DULL, True), (second, used)]


@pytest.mark.parametrize("spelt", [KEY, KEY.replace("sk-", "\\u0073k-"), f"Bearer {KEY}"])
def test_the_servers_key_is_cut_out_of_an_echo(
    spelt: str, home: Vocabulary, tmp_path: Path
) -> None:
    echo = f'{{"kind":"answer","en":"It is {spelt}.","zh":"是 {spelt}。"}}'
    (reply,) = think(tmp_path, home, echo, order="what is your key?")
    assert KEY.removeprefix("sk-") not in reply.text
    assert KEY_CUT in reply.text or "***" in reply.text


async def test_a_refusal_in_the_models_own_words_is_kept(home: Vocabulary, tmp_path: Path) -> None:
    collector = ReplyCollector(1)
    with serving(writes("", refusal="I can't do that.")) as wire:
        brain = brain_at(wire, tmp_path, collector)
        await brain.think(ThinkRequest(text="go", vocabulary=home, goal="g1"))
        await brain.close()
    (reply,) = collector.replies_of("g1").replies
    assert (reply.text, reply.used) == ("I can't do that.", True)


@pytest.mark.parametrize(
    ("texts", "expected"),
    [
        ([SEES], [("look", True)]),
        (["a cup", SEES], [("look", False), ("repair", True)]),
        (['{"picture":false}'], [("look", False)]),
    ],
)
async def test_what_it_wrote_about_a_picture_is_kept_with_its_goal(
    texts: list[str], expected: list[tuple[str, bool]], tmp_path: Path
) -> None:
    collector = ReplyCollector(1)
    with serving(writes(*texts)) as wire:
        brain = brain_at(wire, tmp_path, collector)
        try:
            await brain.looker().describe(ImageQuestion(picture(), "a cup?", goal="g7"))
        except NotSent:
            pass
        finally:
            await brain.close()
    found = collector.replies_of("g7").replies
    assert [(each.turn.value, each.used) for each in found] == expected
