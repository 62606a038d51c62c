"""The owner is told at the one address, a few times at most, and nothing waits for it."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable

import httpx
import pytest

from planner.orders.notifier import MOST_WAITING, Message, Notifier
from planner.plan import Bilingual, Language, QuietHours
from planner.settings import NotifySettings, OrderSettings
from wire import ConfigError

TOLD = Message(
    "missed", "o1", "held", Language.ZH, Bilingual(en="Missed.", zh="错过了。"), 1_800_000_000.0
)


def telling(
    answer: Callable[[httpx.Request], httpx.Response], count: int = 1, **settings: object
) -> tuple[Notifier, list[httpx.Request]]:
    asked: list[httpx.Request] = []

    def take(request: httpx.Request) -> httpx.Response:
        asked.append(request)
        return answer(request)

    given = NotifySettings.model_validate({"url": "http://127.0.0.1:9/secret", **settings})

    async def story() -> Notifier:
        notifier = Notifier(given, "token-word", httpx.MockTransport(take), (0.0, 0.0, 0.0))
        for _ in range(count):
            notifier.tell(TOLD)
        for _ in range(300):
            if notifier.sent + notifier.dropped >= count:
                break
            await asyncio.sleep(0.001)
        await notifier.close()
        return notifier

    return asyncio.run(story()), asked


def test_a_webhook_gets_code_and_words_and_the_token() -> None:
    notifier, [asked] = telling(lambda _: httpx.Response(204, stream=httpx.ByteStream(b"")))
    assert notifier.sent == 1
    assert asked.headers["authorization"] == "Bearer token-word"
    assert json.loads(asked.content) == {
        "kind": "missed", "order": "o1", "code": "held", "at_unix_s": 1_800_000_000.0,
        "text": {"en": "Missed.", "zh": "错过了。"},
    }  # fmt: skip


def test_ntfy_gets_the_words_in_the_orders_language() -> None:
    _, [asked] = telling(lambda _: httpx.Response(200, stream=httpx.ByteStream(b"")), form="ntfy")
    assert asked.content.decode() == "错过了。"
    assert (asked.headers["title"], asked.headers["priority"]) == ("Pons", "4")


@pytest.mark.parametrize("form", ["webhook", "ntfy"])
def test_without_words_only_codes_leave(form: str) -> None:
    _, [asked] = telling(
        lambda _: httpx.Response(200, stream=httpx.ByteStream(b"")), form=form, words=False
    )
    assert b"Missed" not in asked.content
    assert "错过" not in asked.content.decode()
    assert b"held" in asked.content


@pytest.mark.parametrize(
    ("status", "tries"), [(500, 3), (429, 3), (404, 1), (301, 1), (302, 1), (401, 1)]
)
def test_tries_are_bounded_and_no_redirect_is_followed(status: int, tries: int) -> None:
    elsewhere = {"location": "http://127.0.0.2/"}
    notifier, asked = telling(
        lambda _: httpx.Response(status, headers=elsewhere, stream=httpx.ByteStream(b""))
    )
    assert (len(asked), notifier.dropped) == (tries, 1)
    assert {request.url.host for request in asked} == {"127.0.0.1"}


def test_a_dead_address_is_given_up(caplog: pytest.LogCaptureFixture) -> None:
    def fail(_: httpx.Request) -> httpx.Response:
        raise httpx.ConnectError("refused")

    notifier, asked = telling(fail)
    assert (len(asked), notifier.dropped) == (3, 1)
    assert "notify_failed: 127.0.0.1" in caplog.text
    assert "secret" not in caplog.text


def test_a_metadata_service_is_never_told() -> None:
    with pytest.raises(ConfigError):
        Notifier(NotifySettings(url="http://169.254.169.254/latest"))


def test_what_is_not_asked_for_is_not_told() -> None:
    notifier, asked = telling(
        lambda _: httpx.Response(200, stream=httpx.ByteStream(b"")), tells=["done"]
    )
    assert (notifier.sent, asked) == (0, [])


def test_no_more_than_so_many_wait() -> None:
    notifier, asked = telling(
        lambda _: httpx.Response(200, stream=httpx.ByteStream(b"")), count=MOST_WAITING + 20
    )
    assert len(asked) <= MOST_WAITING
    assert notifier.dropped == 20


@pytest.mark.parametrize(
    "url", ["ftp://host/x", "http://", "file:///x", "http://user:word@host/", "hook", "http://a b/"]
)
def test_what_is_no_address_is_refused(url: str) -> None:
    with pytest.raises(ValueError, match="url"):
        NotifySettings(url=url)


@pytest.mark.parametrize("quiet", ["22:00-22:00", "25:00-07:00", "10pm-6am"])
def test_quiet_hours_around_the_clock_are_refused(quiet: str) -> None:
    with pytest.raises(ValueError, match="quiet"):
        OrderSettings.model_validate({"quiet": quiet})
    read = OrderSettings.model_validate({"quiet": "22:00-07:00"})
    assert read.quiet == QuietHours(1320, 420)
