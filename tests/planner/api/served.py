"""Serve a test's own services by routes that are built once: a build takes longer than most tests.

Routes keep nothing between requests but what they were built on, and that is `Stage` here: it looks
the services up in each request's own context. The event stream alone remembers what it told, so
whoever opens a socket gets an application of their own. Everything else is ``build``'s own.
"""

from __future__ import annotations

from contextvars import ContextVar
from functools import cache
from itertools import count
from typing import Any, cast

from fastapi import FastAPI
from starlette.testclient import TestClient
from starlette.types import ASGIApp, Receive, Scope, Send

from planner.api import Access, build
from planner.api.interfaces import Services
from planner.people import Person
from tests.planner.api.fakes import FakeServices, two_room

BASE = "http://127.0.0.1:8420"
LOCAL = Access("127.0.0.1")
_ADDRESSES = count()
_AT_HAND: ContextVar[FakeServices] = ContextVar("services of the request's test")


class Part:
    """Be this part of whichever services are at hand."""

    def __init__(self, name: str) -> None:
        self._name = name

    def __getattr__(self, name: str) -> Any:
        return getattr(getattr(_AT_HAND.get(), self._name), name)


class Stage:
    """Be whichever services are at hand; what routes look at while they are built stays."""

    def __init__(self) -> None:
        self.site = two_room()
        self.goals, self.robot = Part("goals"), Part("robot")
        self.orders, self.people = Part("orders"), Part("people")

    def __getattr__(self, name: str) -> Any:
        return getattr(_AT_HAND.get(), name)


def find_person(token: str) -> Person | None:
    """Find who has a token among the people of the services at hand."""
    return _AT_HAND.get().people.find(token)


PEOPLED = Access(
    "127.0.0.1", operator_token="o" * 20, viewer_token="v" * 20, find_person=find_person
)


@cache
def _routes(access: Access) -> FastAPI:
    return build(cast("Services", Stage()), access)


def client_of(services: FakeServices, access: Access = LOCAL) -> TestClient:
    """Return a client of these services, with an address of its own; two at once do not meet."""
    app = app_of(services, access)
    return TestClient(app, base_url=BASE, client=(f"10.0.0.{next(_ADDRESSES)}", 50_000))


def code(answer: Any) -> str:
    """Return the code of a problem that is told as one."""
    assert answer.headers["content-type"] == "application/problem+json"
    body = answer.json()
    assert body["status"] == answer.status_code
    assert body["detail"]
    return str(body["code"])


def app_of(services: FakeServices, access: Access = LOCAL) -> ASGIApp:
    """Return an application that serves these services, in the caller's own event loop."""
    own: list[FastAPI] = []

    async def app(scope: Scope, receive: Receive, send: Send) -> None:
        _AT_HAND.set(services)
        if scope["type"] == "websocket" and not own:
            own.append(build(services, access))
        await (own[0] if scope["type"] == "websocket" else _routes(access))(scope, receive, send)

    if services.site is not two_room():
        raise ValueError("routes that are built once show the site of two rooms alone")
    return app
