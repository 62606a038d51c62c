"""Hold nonces to their laws: none can be foretold, and none outlives a stop."""

from __future__ import annotations

from functools import cache
from random import Random

from hypothesis import example, given
from hypothesis import strategies as st

from tests.bridge.core.scripted import World
from tests.laws import at_least
from wire import OpKind

STARTS = ("ready", "armed", "driving")
HALTS = ("stop", "estop", "disarm")
MINUTE_S = 61.0
TAG = "0123456789abcdef"
starts, halts = st.sampled_from(STARTS), st.sampled_from(HALTS)
kinds = st.sampled_from(["arm", "reset", "resume"])
acts = st.lists(st.sampled_from([*HALTS, "resume", "minute", "wait"]), min_size=1, max_size=6)
seeds = st.integers(0, 2**32)


@cache
def begun(start: str) -> World:
    world = World()
    return {"ready": world.ready, "armed": world.armed, "driving": world.driving}[start]()


class Seen:
    """Play a world in which chance is real, and keep every nonce that a status has shown."""

    def __init__(self, start: str, seed: int) -> None:
        self.world = begun(start).fork()
        self._random = Random(seed)
        self.nonces: list[str] = []
        self.run(2)

    def run(self, ticks: int) -> None:
        for _ in range(ticks):
            self.world.chance = f"{self._random.getrandbits(64):016x}"
            self.world.tick()
            assert self.world.status is not None
            self.nonces.append(self.world.shown.nonce)

    def act(self, what: str) -> None:
        world = self.world
        if what == "stop":
            world.stop()
        elif what == "minute":
            world.now_s += MINUTE_S
        elif what != "wait":
            world.op(what)  # type: ignore[arg-type]  # the rest are kinds
        self.run(5)

    def asked(self, kind: OpKind, nonce: str) -> str:
        """Ask under a nonce, as with the operator's own key; return the verdict."""
        request_id = self.world.op(kind, nonce=nonce)
        self.run(1)
        return self.world.verdict(request_id)


@at_least(40)
@given(starts, acts, kinds, seeds, st.integers(1, 8), st.sampled_from(["", TAG, "none", "last"]))
@example("driving", ["stop", "stop"], "resume", 1, 2, "none")
@example("ready", ["wait"], "arm", 1, 0, "last")
def test_a_proof_under_a_nonce_that_was_not_shown_yet_never_counts(
    start: str, events: list[str], kind: OpKind, seed: int, ahead: int, tag: str
) -> None:
    """A planner once showed the number six further on and kept the proof until six stops later."""
    seen = Seen(start, seed)
    boot, number, *shown = seen.nonces[-1].split(".")
    end = {"last": "".join(f".{one}" for one in shown), "none": ""}.get(tag, f".{tag}")
    guesses = [f"{boot}.{int(number) + more}{end}" for more in range(1, ahead + 1)]
    for event in events:
        seen.act(event)
        for guess in guesses:
            assert seen.asked(kind, guess) in {"old_nonce", "stopped"}, guess


@at_least(40)
@given(starts, acts, halts, kinds, seeds)
@example("armed", ["estop"], "estop", "reset", 1)
@example("ready", ["wait"], "disarm", "arm", 1)
def test_after_a_stop_no_proof_from_before_it_counts(
    start: str, events: list[str], halt: str, kind: OpKind, seed: int
) -> None:
    seen = Seen(start, seed)
    for event in events:
        seen.act(event)
    before = set(seen.nonces)
    seen.act(halt)
    for nonce in before:
        assert seen.asked(kind, nonce) == "old_nonce"
    assert seen.nonces[-1] not in before
