"""Measure what a server that hears changes: the time of a stop, and motions out of foreign sound.

A stop is heard with a server that hangs and without one, in turns, by the real recogniser process.
Foreign recordings are speech in six other languages and orders under noise; whatever becomes a
drive of them without a question is a wrong motion. The server is the mock, so nothing is said here
of how well a real one hears.
"""

from __future__ import annotations

import array
import asyncio
import itertools
import random
import shutil
import socket
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any

import uvicorn

from planner.settings import VoiceSettings
from planner.site import Site
from planner.site.site_view import vocabulary_of
from planner.voice import Ears, Sound, VoiceWorker, is_spoken_stop, read_wav
from planner.voice.transcription import open_caller
from pons.mock_llm import Switches, build
from pons.settings import CHECKOUT
from tools.bench.measure.voice import STOPPED, speak, steps_of
from tools.bench.report import ReportRow, row_of

if TYPE_CHECKING:
    from tools.bench.context import BenchLab

NAME = "foreign_voice"
TITLE = "spoken stop beside a server that hangs; motions out of foreign and noisy sound"
LONG_ONLY = False
PAIRS = 60
GOAL_STOP = "p99 as without"
GOAL_BEYOND = "p50 <= 200"
GOAL_WRONG = "0 of >= 300"
FOREIGN = {
    "cmn": ("去客厅看看有没有人", "停下来", "今天天气怎么样", "把灯打开"),
    "de": ("geh in die Küche", "wie spät ist es", "bring mir ein Glas Wasser", "halt an"),
    "fr": ("va dans la cuisine", "quelle heure est il", "apporte moi un verre d'eau", "arrête"),
    "es": ("ve a la cocina", "qué hora es", "tráeme un vaso de agua", "para"),
    "it": ("vai in cucina", "che ore sono", "portami un bicchiere d'acqua", "fermati"),
    "ru": ("иди на кухню", "который час", "принеси мне стакан воды", "стой"),
}
SPEEDS_WPM = (120, 145, 175)
ORDERS = ("go to the kitchen", "drive to the bedroom", "return home", "go to the sofa")
NOISE_DB = (20.0, 10.0, 5.0, 0.0)
"""Of the speech above the noise."""
NOISE_SEEDS = 15
SLICES = 8
"""Each is kept: a long run that was interrupted goes on behind the last one."""


def measure(lab: BenchLab) -> list[ReportRow]:
    """Time stops and orders beside a server, then hear what is no order in English."""
    if shutil.which("espeak-ng") is None:
        return [ReportRow("foreign voice", "", "", value="none", note="no espeak-ng", valid=False)]
    rows: list[ReportRow] = []
    for took in lab.slices("times", 1, lambda _: asyncio.run(_time(lab))):
        note = "process of its own, in turns"
        rows += [
            row_of("stop heard, no server", "ms", "", took["alone"], note),
            row_of("stop heard, server hangs", "ms", GOAL_STOP, took["hanging"], note),
            row_of("order beyond a server's own 0 s", "ms", GOAL_BEYOND, took["order"], note),
        ]
    parts = list(lab.slices("foreign", SLICES, lambda index: _hear_part(lab, index)))
    heard = {name: sum(part[name] for part in parts) for name in ("n", "wrong", "stops")}
    if not heard["n"]:
        return rows
    bound = f"; 3/n {300.0 / heard['n']:.1f} %" if not heard["wrong"] else ""
    told = f"{heard['stops']} of them heard as a stop{bound}"
    what = f"wrong motions of {heard['n']} foreign or noisy recordings"
    rows.append(ReportRow(what, "", GOAL_WRONG, value=str(heard["wrong"]), note=told))
    return rows


async def _time(lab: BenchLab) -> dict[str, Any]:
    grammar = VoiceWorker(names())
    stop, order = _sound("stop", "en-us", 150), _sound("go to the kitchen", "en-us", 150)
    took: dict[str, list[float]] = {"alone": [], "hanging": [], "order": []}
    with _mock(Switches(fault="hang")) as hangs, _mock(Switches()) as answers:
        servers = [open_caller(VoiceSettings(url=url)) for url in (hangs, answers)]
        beside, with_answer = (Ears(grammar, each, "server", 8.0) for each in servers if each)
        try:
            await grammar.hear(stop)
            for number in range(PAIRS):
                lab.say(f"pair {number + 1}/{PAIRS}")
                for name, ears in (("alone", grammar), ("hanging", beside)):
                    began_s = time.monotonic()
                    heard = await ears.hear(stop)
                    if is_spoken_stop(heard):
                        took[name].append((time.monotonic() - began_s) * 1e3)
                began_s = time.monotonic()
                await with_answer.hear(order)
                took["order"].append((time.monotonic() - began_s) * 1e3)
        finally:
            await grammar.close()
            for server in servers:
                if server is not None:
                    await server.close()
    return took


@contextmanager
def _mock(switches: Switches) -> Iterator[str]:
    """Serve one mock on a free port, and yield its base."""
    app = build(switches)
    server = uvicorn.Server(uvicorn.Config(app, log_level="error", timeout_graceful_shutdown=0))
    app.state.mock.ending = lambda: server.should_exit
    with socket.socket() as door:
        door.bind(("127.0.0.1", 0))
        door.listen(16)
        thread = threading.Thread(target=server.run, kwargs={"sockets": [door]})
        thread.start()
        try:
            yield f"http://127.0.0.1:{door.getsockname()[1]}/v1"
        finally:
            server.should_exit = True
            thread.join()


def _hear_part(lab: BenchLab, index: int) -> dict[str, Any]:
    """Hear one recording of each SLICES; a busy core takes a minute for that."""
    from planner.voice.sphinx import Sphinx

    ears = Sphinx(names())
    vocabulary = vocabulary_of(Site.load(CHECKOUT / "sites" / "home"))
    wrong = stops = count = 0
    for meant, make in itertools.islice(_recordings(), index, None, SLICES):
        count += 1
        lab.say(f"slice {index + 1}, recording {count}")
        sound = make()
        heard = ears.hear(sound.pcm, sound.rate_hz, sound.channels)
        stops += is_spoken_stop(heard)
        done = steps_of(heard.transcript if heard.understood else "", vocabulary)
        moves = bool(done) and done != STOPPED and heard.sure
        wrong += moves and done != steps_of(meant, vocabulary)
    return {"n": count, "wrong": wrong, "stops": stops}


def _recordings() -> Iterator[tuple[str, Callable[[], Sound]]]:
    """Yield each order with what makes its recording; a foreign sentence means none here."""
    for (voice, texts), wpm in itertools.product(FOREIGN.items(), SPEEDS_WPM):
        for text in texts:
            yield "", partial(_sound, text, voice, wpm)
    for order, decibel, seed in itertools.product(ORDERS, NOISE_DB, range(NOISE_SEEDS)):
        yield order, partial(_noisy, order, decibel, seed)


def _noisy(order: str, decibel: float, seed: int) -> Sound:
    chance = random.Random(f"{order} {decibel} {seed}")
    clean = _sound(order, chance.choice(("en-us", "en-gb", "en-us+f3")), 150)
    return _with_noise(clean, decibel, chance)


def _sound(text: str, voice: str, wpm: int) -> Sound:
    return read_wav(speak(text, voice, wpm))


def _with_noise(sound: Sound, decibel: float, chance: random.Random) -> Sound:
    """Return speech that stands so far above white noise."""
    samples = array.array("h")
    samples.frombytes(sound.pcm)
    power = sum(each * each for each in samples) / max(1, len(samples))
    sigma = (power / 10.0 ** (decibel / 10.0)) ** 0.5
    noisy = (each + chance.gauss(0.0, sigma) for each in samples)
    mixed = array.array("h", [int(max(-32768, min(32767, each))) for each in noisy])
    return Sound(sound.rate_hz, sound.channels, mixed.tobytes())


def names() -> list[str]:
    """Return the English names of the default home."""
    site = Site.load(CHECKOUT / "sites" / "home")
    return [name for place in site.places for name in place.said_in_english]
