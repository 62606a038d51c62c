"""A goal is one trace, made when it has ended; without a collector there is none."""

from __future__ import annotations

import gzip
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from threading import Event, Thread
from typing import Any

import pytest
from opentelemetry.proto.collector.trace.v1.trace_service_pb2 import ExportTraceServiceRequest
from opentelemetry.sdk.trace import ReadableSpan, TracerProvider
from opentelemetry.sdk.trace.export import SimpleSpanProcessor
from opentelemetry.sdk.trace.export.in_memory_span_exporter import InMemorySpanExporter

from planner.traces import MOST_GOALS, MOST_SPANS, VARIABLE, GoalTraces, export_to, traces_of

pytestmark = pytest.mark.nightly(keep=2)


SECOND = 1_000_000_000


class Story:
    """Tell events to traces whose spans are kept in memory."""

    def __init__(self) -> None:
        self.now_s = 100.0
        self.kept = InMemorySpanExporter()
        provider = TracerProvider()
        provider.add_span_processor(SimpleSpanProcessor(self.kept))
        tracer = provider.get_tracer("test")
        self.traces = GoalTraces(lambda: round(self.now_s * SECOND), export_to(tracer))

    def tell(self, state: str, *steps: tuple[str, str], after_s: float = 0.0, **more: Any) -> None:
        self.now_s += after_s
        plan = {"steps": [{"kind": kind, "state": told} for kind, told in steps]}
        goal = {"id": "g1", "state": state, "by": "page", "text": "a secret", "plan": plan, **more}
        self.traces.offer((1, {"type": "goal", "goal": goal}))

    def spans(self) -> dict[str, ReadableSpan]:
        return {span.name: span for span in self.kept.get_finished_spans()}


def seconds(span: ReadableSpan) -> float:
    assert span.start_time is not None
    assert span.end_time is not None
    return (span.end_time - span.start_time) / SECOND


def test_a_goal_is_one_trace_of_reading_call_route_and_legs() -> None:
    story = Story()
    story.tell("queued")
    story.tell("planning", after_s=0.5)
    story.traces.model_call("g1", 1.5, 1_300, 80)
    story.tell("running", ("go_to", "running"), after_s=2.0)
    story.now_s += 0.1
    story.traces.offer((1, {"type": "first_waypoint", "goal": "g1", "seconds": 2.6}))
    story.tell("running", ("go_to", "succeeded"), ("say", "running"), after_s=9.9)
    assert not story.spans()  # nothing is told of a goal under way
    outcome = {"code": "arrived"}
    story.tell(
        "succeeded", ("go_to", "succeeded"), ("say", "succeeded"), after_s=1.0, outcome=outcome
    )
    spans = story.spans()
    assert {name: round(seconds(span), 3) for name, span in spans.items()} == {
        "goal": 13.5, "queue": 0.5, "reading": 2.0, "model call": 1.5, "route": 0.1,
        "step go_to": 10.0, "step say": 1.0, "drive": 11.0,
    }  # fmt: skip
    root = spans["goal"]
    assert root.context is not None
    for span in spans.values():
        assert span.context is not None
        assert span.context.trace_id == root.context.trace_id
        if span is not root:
            assert span.parent is not None
            assert span.parent.span_id == root.context.span_id
    assert spans["model call"].attributes == {"pons.prompt_tokens": 1_300, "pons.reply_tokens": 80}
    assert "secret" not in "".join(span.to_json() for span in spans.values())


def test_an_end_told_twice_is_one_trace() -> None:
    story = Story()
    story.tell("planning")
    for _ in range(2):
        story.tell("refused", plan=None)
    assert [span.name for span in story.kept.get_finished_spans()].count("goal") == 1


def test_what_is_kept_is_bounded() -> None:
    story = Story()
    for number in range(2 * MOST_GOALS):
        story.tell("running", id=f"g{number}")
    assert len(story.traces._goals) == MOST_GOALS
    for _ in range(2 * MOST_SPANS):
        story.traces.model_call(f"g{2 * MOST_GOALS - 1}", 0.0, 1, 1)
    newest = story.traces._goals[f"g{2 * MOST_GOALS - 1}"]
    assert len(newest.spans) == MOST_SPANS
    story.traces.close()
    story.traces.model_call("gone", 1.0, 1, 1)


def test_without_a_collector_nothing_listens(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(VARIABLE, raising=False)
    assert traces_of("r1", lambda: 0) is None


def test_a_collector_of_otlp_receives_a_goal_as_one_trace(monkeypatch: pytest.MonkeyPatch) -> None:
    """The SDK's own exporter sends protobuf over HTTP; what arrives is read by the protocol."""
    received: list[ExportTraceServiceRequest] = []
    arrived = Event()

    class Collector(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            body = self.rfile.read(int(self.headers["content-length"]))
            if self.headers.get("content-encoding") == "gzip":
                body = gzip.decompress(body)
            assert self.path == "/v1/traces"
            received.append(ExportTraceServiceRequest.FromString(body))
            self.send_response(200)
            self.send_header("content-type", "application/x-protobuf")
            self.end_headers()
            arrived.set()

        def log_request(self, code: object = "-", size: object = "-") -> None:
            """Say nothing."""

    with ThreadingHTTPServer(("127.0.0.1", 0), Collector) as server:
        serving = Thread(target=server.serve_forever)
        serving.start()
        try:
            monkeypatch.setenv(VARIABLE, f"http://127.0.0.1:{server.server_port}")
            told = Story()
            traces = traces_of("r1", lambda: round(told.now_s * SECOND))
            assert traces is not None
            told.traces = traces
            told.tell("planning")
            traces.model_call("g1", 1.0, 10, 5)
            told.tell("running", ("go_to", "running"), after_s=2.0)
            told.tell("succeeded", ("go_to", "succeeded"), after_s=9.0, outcome={"code": "arrived"})
            traces.close()
            assert arrived.wait(60.0)
        finally:
            server.shutdown()
            serving.join()
    resources = [each for request in received for each in request.resource_spans]
    spans = [span for each in resources for scope in each.scope_spans for span in scope.spans]
    assert {span.name for span in spans} >= {"goal", "reading", "model call", "step go_to"}
    assert len({span.trace_id for span in spans}) == 1
    [root] = [span for span in spans if not span.parent_span_id]
    assert root.name == "goal"
    assert {span.parent_span_id for span in spans if span is not root} == {root.span_id}
