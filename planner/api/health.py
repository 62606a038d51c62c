"""Say whether the planner lives, is ready, and how it does: /healthz, /readyz, /metrics."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fastapi import APIRouter
from prometheus_client import CONTENT_TYPE_LATEST, CollectorRegistry, generate_latest
from prometheus_client.core import GaugeMetricFamily
from starlette.responses import PlainTextResponse, Response

from planner.api.interfaces import Services
from planner.api.problems import HttpProblem

if TYPE_CHECKING:
    from collections.abc import Iterable

FRESH_S = {"status": 1.0, "localization": 1.0, "scan": 1.0}


def routes(services: Services) -> APIRouter:
    """Return the routes that a supervisor and a monitor ask."""
    router = APIRouter(tags=["health"])
    registry = CollectorRegistry()
    registry.register(_Collector(services))

    @router.get("/healthz", operation_id="healthz")
    async def alive() -> dict[str, str]:
        """Answer while the event loop turns."""
        return {"status": "ok"}

    @router.get("/readyz", operation_id="readyz")
    async def ready() -> dict[str, str]:
        """Answer 200 when a goal could be carried out once the robot is armed."""
        lacking = missing(services)
        if lacking:
            raise HttpProblem(
                503, "not_ready", f"waiting for: {', '.join(lacking)}", waiting=lacking
            )
        return {"status": "ready"}

    @router.get("/metrics", operation_id="metrics", response_class=PlainTextResponse)
    async def metrics() -> Response:
        """Give the figures in Prometheus' text format."""
        told = generate_latest(registry) + generate_latest(services.figures.registry)
        return Response(told, media_type=CONTENT_TYPE_LATEST)

    return router


def missing(services: Services) -> list[str]:
    """Name the missing parts: a silent process, an owner, the bridge's own wants."""
    ages = services.robot.ages_s()
    lacking = [
        name
        for name, limit_s in FRESH_S.items()
        if not ((age_s := ages.get(name)) is not None and age_s <= limit_s)
    ]
    status = services.robot.status
    if status is not None:
        lacking += [f"bridge:{code}" for code in status.waiting_for]
        if status.owner is None:
            refusals = (a.code for a in status.answers if a.kind == "hello" and not a.accepted)
            lacking.append(":".join(["owner", *refusals]))
    return lacking


class _Collector:
    """Read the figures at the moment they are asked for; nothing is counted twice."""

    def __init__(self, services: Services) -> None:
        self._services = services

    def collect(self) -> Iterable[GaugeMetricFamily]:
        """Yield every family."""
        for source, age_s in self._services.robot.ages_s().items():
            if age_s is not None:
                yield _gauge(f"pons_{source}_age_seconds", "Age of the newest message", age_s)
        counts: dict[str, int] = {}
        for goal in self._services.goals.goals(200):
            counts[goal.state.value] = counts.get(goal.state.value, 0) + 1
        family = GaugeMetricFamily("pons_goals", "Newest goals by state", labels=["state"])
        for state, count in counts.items():
            family.add_metric([state], count)
        yield family
        yield from self._bridge()
        yield from self._budget()
        yield from self._eyes()

    def _eyes(self) -> Iterable[GaugeMetricFamily]:
        eyes = self._services.eyes
        sight = eyes.sight
        looks = GaugeMetricFamily("pons_eyes_looks", "Since start, by what came", labels=["what"])
        for what, count in sorted(eyes.counts.items()):
            looks.add_metric([what], count)
        skipped = GaugeMetricFamily(
            "pons_eyes_skipped", "Pictures not thought upon since start", labels=["reason"]
        )
        for reason, count in sorted(eyes.skip_counts.items()):
            skipped.add_metric([reason], count)
        blind = GaugeMetricFamily("pons_eyes_blind", "1 for why nothing is seen", labels=["reason"])
        if sight.blind is not None:
            blind.add_metric([sight.blind], 1)
        yield from (looks, skipped, blind)
        yield _gauge("pons_eyes_things", "Things remembered", len(sight.things))
        yield _gauge("pons_eyes_took_seconds", "Newest look, in the detector", eyes.took_s)
        yield _gauge("pons_eyes_lag_seconds", "Newest look, picture to map", eyes.lag_s)

    def _budget(self) -> Iterable[GaugeMetricFamily]:
        usage = self._services.budget.usage()
        spent = GaugeMetricFamily("pons_model_spent_today", "Spent today", labels=["what"])
        limit = GaugeMetricFamily("pons_model_limit_per_day", "May be spent", labels=["what"])
        for what, amount in usage.today.model_dump().items():
            spent.add_metric([what], amount)
            most = getattr(usage.day_limits, what)
            if most is not None:
                limit.add_metric([what], most)
        yield spent
        yield limit
        yield _gauge("pons_model_calls", "Calls since start", usage.calls_since_start)
        yield _gauge("pons_model_calls_under_way", "Not ended", usage.under_way)
        yield _gauge("pons_model_idle_calls", "Refused: no goal asked", usage.idle_calls)

    def _bridge(self) -> Iterable[GaugeMetricFamily]:
        status = self._services.robot.status
        if status is None:
            return
        mode = GaugeMetricFamily("pons_bridge_mode", "1 for the present mode", labels=["mode"])
        mode.add_metric([status.mode.value], 1)
        yield mode
        ticks = status.ticks
        yield _gauge("pons_bridge_ticks", "Ticks since start", ticks.ticks)
        yield _gauge("pons_bridge_missed_ticks", "Whole missed periods since start", ticks.missed)
        yield _gauge(
            "pons_bridge_late_p50_seconds", "Lateness, last second", ticks.late_p50_us / 1e6
        )
        yield _gauge(
            "pons_bridge_late_max_seconds", "Lateness, last second", ticks.late_max_us / 1e6
        )
        yield _gauge("pons_bridge_dropped_messages", "Dropped since start", ticks.dropped)
        yield _gauge("pons_speed_sent_mps", "Speed sent", status.sent.v_mps)
        yield _gauge("pons_speed_measured_mps", "Speed measured", status.measured.v_mps)
        yield _gauge("pons_speed_limit_mps", "Limit in force", status.limits.v_mps)


def _gauge(name: str, text: str, value: float) -> GaugeMetricFamily:
    return GaugeMetricFamily(name, text, value=value)
