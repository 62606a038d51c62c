"""Who asks for calm waits for it, is told, and goes on either way."""

from __future__ import annotations

import pytest

from scripts import calm
from scripts.scheduler_probe import HostTiming, Pulse


@pytest.mark.parametrize(
    ("calm_from_s", "said"),
    [
        (0.0, "the machine keeps time after 2 s: 0 of 200 naps"),
        (30.0, "the machine keeps time after 32 s"),
        (9e9, "the machine still does not keep time after 120 s: 9 of 200 naps"),
    ],
    ids=["calm", "calm later", "never"],
)
def test_it_waits_and_tells(calm_from_s: float, said: str) -> None:
    now_s = [0.0]

    def look() -> HostTiming:
        began_s = now_s[0]
        now_s[0] += 2.0
        return HostTiming(200, 0, 0.003) if began_s >= calm_from_s else HostTiming(200, 9, 0.3)

    assert said in calm.wait_for_calm(look, lambda: now_s[0])


def test_it_always_ends_well(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(Pulse, "look", lambda _: HostTiming(0, 0, 0.0))
    monkeypatch.setattr(calm, "LIMIT_S", 0.0)
    assert calm.main() == 0
    assert capsys.readouterr().out.startswith("calm: the machine still does not keep time")
