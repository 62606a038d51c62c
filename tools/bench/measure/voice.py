"""Measure spoken orders: how long a recording takes to become a goal, and what is heard right.

A wrong motion is one that nobody was asked about: what is heard, but not quite surely, waits for a
yes. Real processes for the time: from before the request is sent until the goal is answered. The
orders are spoken by espeak-ng, so they say how the chain works, not how well it hears people.
"""

from __future__ import annotations

import io
import itertools
import shutil
import subprocess
import time
import wave
from functools import partial
from typing import TYPE_CHECKING, Any

from planner.language.grammar import plan
from planner.language.stop import is_stop
from planner.plan import Step, StepPlan, Vocabulary
from planner.site import Site
from planner.site.site_view import vocabulary_of
from planner.voice import Recognition, read_wav
from pons.http import PlannerProblem, call
from pons.settings import CHECKOUT
from tools.bench.context import until
from tools.bench.report import ReportRow, row_of
from tools.bench.robot import BenchRobot
from wire import Mode

if TYPE_CHECKING:
    from planner.voice.sphinx import Sphinx
    from tools.bench.context import BenchLab

NAME = "voice"
TITLE = "WAV -> goal, the recogniser's own time, spoken orders heard right, wrong motions"
LONG_ONLY = False
GOAL_BEYOND = "p50 <= 200"
GOAL_RIGHT = ">= 90 %"
GOAL_WRONG = "0"
SPEECH_S = 3.0
GOALS = 20
ORDERS = (
    "go to the {a}",
    "drive to the {a}",
    "please go to the {a}",
    "can you go to the {a}",
    "go to the {a} then the {b}",
    "go to the {a} and then come back",
    "move to the {a} please",
    "return home",
    "return home please",
    "stop",
)
STOPPED = "stopped"
VOICES = ("en-us", "en-us+f3", "en-gb", "en-gb+f2", "en-gb-x-rp")
SPEEDS_WPM = (140, 165)
CHATTER = (
    "what a nice day it is",
    "do not go to the {a}",
    "don't drive to the {a}",
    "I like the {a} very much",
    "open the {a}",
    "bring me a cup of tea",
    "go to the basement",
    "did you see the game last night",
    "the {a} shows that people like coffee",
    "call my mother please",
)


def measure(lab: BenchLab) -> list[ReportRow]:
    """Speak to the default home: 100 orders and as much that is none."""
    if shutil.which("espeak-ng") is None:
        return [
            ReportRow(
                "spoken orders", "", GOAL_RIGHT, value="none", note="no espeak-ng", valid=False
            )
        ]
    times_ms, own_ms = list[float](), list[float]()
    for data in lab.slices("time", 1, lambda _: _time(lab)):
        times_ms += data["ms"]
        own_ms += data["own_ms"]
    beyond_ms = [whole - own for whole, own in zip(times_ms, own_ms, strict=True)]
    spoken = f"WAV of {SPEECH_S:g} s -> goal"
    rows = [
        row_of(spoken, "ms", "", times_ms, "HTTP, home; the recogniser in it"),
        row_of("the recogniser alone", "ms", "", own_ms, "the same recordings, in turns"),
        row_of(f"{spoken}, beyond it", "ms", GOAL_BEYOND, beyond_ms, "pair by pair"),
    ]
    for heard in lab.slices("heard", 1, lambda _: _listen(lab)):
        rows += _heard_rows(heard)
    return rows


def _heard_rows(heard: dict[str, Any]) -> list[ReportRow]:
    right = f"{100.0 * heard['right'] / heard['orders']:.0f}"
    told = (
        f"{heard['orders']} orders, {len(VOICES)} espeak-ng voices; {heard['asked']} ask for a yes"
    )
    tried = heard["orders"] + heard["chatter"]
    bound = f"; 3/n {100.0 * 3 / tried:.1f} %" if not heard["wrong"] else ""
    none = f"of {heard['orders']} orders and {heard['chatter']} other sentences{bound}"
    return [
        ReportRow("orders heard right", "%", GOAL_RIGHT, value=right, note=told),
        ReportRow("wrong motions", "", GOAL_WRONG, value=str(heard["wrong"]), note=none),
    ]


def _ears(site: Site) -> Sphinx:
    from planner.voice.sphinx import Sphinx

    return Sphinx([name for place in site.places for name in place.said_in_english])


def _listen(lab: BenchLab) -> dict[str, Any]:
    site = Site.load(CHECKOUT / "sites" / "home")
    vocabulary = vocabulary_of(site)
    ears = _ears(site)
    names = itertools.cycle(name for place in site.places for name in place.said_in_english)
    right = wrong = asked = 0
    speakers = list(itertools.product(VOICES, SPEEDS_WPM))
    for number, (form, (voice, wpm)) in enumerate(itertools.product(ORDERS, speakers)):
        lab.say(f"order {number + 1}/{len(ORDERS) * len(speakers)}")
        text = form.format(a=next(names), b=next(names))
        heard = _hear(ears, text, voice, wpm)
        meant, done = steps_of(text, vocabulary), steps_of(_text(heard), vocabulary)
        right += done == meant
        moves = bool(done) and done != STOPPED
        wrong += moves and done != meant and heard.sure
        asked += moves and not heard.sure
    for number, (form, (voice, wpm)) in enumerate(itertools.product(CHATTER, speakers)):
        lab.say(f"other sentence {number + 1}/{len(CHATTER) * len(speakers)}")
        heard = _hear(ears, form.format(a=next(names)), voice, wpm)
        done = steps_of(_text(heard), vocabulary)
        wrong += bool(done) and done != STOPPED and heard.sure
    count = len(speakers)
    return {
        "right": right,
        "wrong": wrong,
        "asked": asked,
        "orders": count * len(ORDERS),
        "chatter": count * len(CHATTER),
    }


def steps_of(text: str, vocabulary: Vocabulary) -> tuple[Step, ...] | str:
    """Return the steps that a text drives; none for what moves nothing."""
    if is_stop(text):
        return STOPPED
    made = plan(text, vocabulary)
    return made.steps if isinstance(made, StepPlan) else ()


def _hear(ears: Sphinx, text: str, voice: str, wpm: int) -> Recognition:
    sound = read_wav(speak(text, voice, wpm))
    return ears.hear(sound.pcm, sound.rate_hz, sound.channels)


def _text(heard: Recognition) -> str:
    return heard.transcript if heard.understood else ""


def _time(lab: BenchLab) -> dict[str, Any]:
    recordings = [
        _pad_to_length(speak(f"go to the {place} then the {then}", "en-us+f3", 150))
        for place, then in (("kitchen", "bedroom"), ("bedroom", "kitchen"))
    ]
    times_ms, own_ms = list[float](), list[float]()
    ears = _ears(Site.load(CHECKOUT / "sites" / "home"))
    with lab.folder() as home, BenchRobot(home, "home") as robot:
        robot.make_ready()
        for number in range(GOALS + 1):
            lab.say(f"recording {number + 1}/{GOALS + 1}")
            began_s = time.monotonic()
            try:
                spoken = _send(robot, recordings[number % 2])
            except PlannerProblem as refused:
                lab.say(str(refused))
                continue
            took_ms = (time.monotonic() - began_s) * 1e3
            if spoken["goal"] is None:
                continue
            own = _own_ms(ears, recordings[number % 2])
            if number:  # the first may have waited for the model to load
                times_ms.append(took_ms)
                own_ms.append(own)
            robot.cancel(spoken["goal"]["id"])
            until(partial(_rests, robot), 10.0, "standing after cancel")
    return {"ms": times_ms, "own_ms": own_ms}


def _own_ms(ears: Sphinx, recording: bytes) -> float:
    """Return how long the recogniser takes for a recording in a process of its own."""
    sound = read_wav(recording)
    began_s = time.monotonic()
    ears.hear(sound.pcm, sound.rate_hz, sound.channels)
    return (time.monotonic() - began_s) * 1e3


def _send(robot: BenchRobot, recording: bytes) -> dict[str, Any]:
    headers = {"Content-Type": "audio/wav"}
    spoken: dict[str, Any] = call(
        robot.settings, "POST", "/v1/voice", None, 30.0, headers, recording
    )
    return spoken


def _rests(robot: BenchRobot) -> bool:
    status = robot.status
    return status is not None and status.mode is Mode.HOLD and abs(status.measured.v_mps) < 0.02


def speak(text: str, voice: str, wpm: int) -> bytes:
    """Return a WAV of a sentence by a synthetic voice."""
    command = ["espeak-ng", "-v", voice, "-s", str(wpm), "--stdout", "--", text]
    data = subprocess.run(command, check=True, capture_output=True).stdout
    return _wav(data[44 : len(data) // 2 * 2], int.from_bytes(data[24:28], "little"))


def _pad_to_length(recording: bytes) -> bytes:
    """Return the recording with silence up to SPEECH_S."""
    sound = read_wav(recording)
    missing = int(SPEECH_S * sound.rate_hz) * 2 - len(sound.pcm)
    return _wav(sound.pcm + bytes(max(0, missing)), sound.rate_hz)


def _wav(pcm: bytes, rate_hz: int) -> bytes:
    out = io.BytesIO()
    with wave.open(out, "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(rate_hz)
        file.writeframes(pcm)
    return out.getvalue()
