"""Check that the meter is shown: by its route, on the event stream when it moves, to monitors."""

from __future__ import annotations

import json

from planner.api.live_state import Feed
from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import BASE, client_of


def test_the_route_shows_the_day_and_one_goal() -> None:
    services = FakeServices()
    services.budget.calls = 7
    with client_of(services) as client:
        whole = client.get("/v1/usage").json()
        assert (whole["today"]["calls"], whole["day_limits"]["calls"]) == (7, 20)
        assert (whole["goal"], whole["day"], whole["refused"]) == (None, "2026-01-01", None)
        assert client.get("/v1/usage?goal=g1").json()["goal"]["calls"] == 7
        assert services.budget.asked == [None, "g1"]
        assert client.get(f"/v1/usage?goal={'g' * 81}").status_code == 422
        metrics = client.get("/metrics").text
        assert 'pons_model_spent_today{what="calls"} 7.0' in metrics
        assert 'pons_model_limit_per_day{what="money"}' not in metrics
        assert "pons_model_idle_calls 0.0" in metrics
        with client.websocket_connect("/v1/events", headers={"host": BASE[7:]}) as socket:
            assert socket.receive_json()["usage"] == whole


async def test_the_stream_tells_the_meter_only_when_it_moves() -> None:
    services = FakeServices()
    feed = Feed(services, clock=lambda: 0.0)
    listener = feed.listen()
    feed.look()
    await listener.take()
    feed.look()
    assert not listener._waiting
    services.budget.changes, services.budget.calls = 1, 5
    feed.look()
    [body] = await listener.take()
    assert json.loads("{" + body)["usage"]["today"]["calls"] == 5
    feed.leave(listener)
