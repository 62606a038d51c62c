"""Check where a model may be, and where never, in every spelling."""

from __future__ import annotations

import asyncio

import pytest

from planner.outbound import Address, TargetResolver, refused_among
from wire import ConfigError


@pytest.mark.parametrize(
    ("base", "url", "local"),
    [
        ("http://127.0.0.1:11434/v1", "http://127.0.0.1:11434/v1/chat/completions", True),
        ("http://localhost:8080", "http://localhost:8080/v1/chat/completions", True),
        ("http://[::1]:8080/v1/", "http://[::1]:8080/v1/chat/completions", True),
        ("https://api.openai.com/v1", "https://api.openai.com:443/v1/chat/completions", False),
        ("http://10.0.0.7/a/chat/completions", "http://10.0.0.7:80/a/chat/completions", False),
        ("https://h.example/openai/deploy", "https://h.example:443/openai/deploy/chat/completions",
         False),
    ],
)  # fmt: skip
def test_a_base_url_becomes_the_one_url(base: str, url: str, local: bool) -> None:
    address = Address.parse(base)
    assert (address.url, address.local) == (url, local)


@pytest.mark.parametrize(
    "base",
    [
        "file:///etc/passwd",
        "ftp://127.0.0.1/v1",
        "gopher://127.0.0.1",
        "127.0.0.1:11434",
        "",
        "http://",
        "http:///v1",
        "http://user:secret@127.0.0.1/v1",
        "http://127.0.0.1/v1?api_key=secret",
        "http://127.0.0.1/v1#x",
        "http://127.0.0.1:99999/v1",
        "http://127.0.0.1:port/v1",
        "http://127.0.0.1/ v1",
        "http://127.0.0.1\\@169.254.169.254/v1",
        "http://169.254.169.254/latest/meta-data",
        "http://169.254.0.1:8080/v1",
        "http://2852039166/v1",
        "http://0xA9FEA9FE/v1",
        "http://0251.0376.0251.0376/v1",
        "http://169.254.43518/v1",
        "http://[fe80::1]/v1",
        "http://[fe80::1%25eth0]/v1",
        "http://[::ffff:169.254.169.254]/v1",
        "http://[fd00:ec2::254]/v1",
        "http://metadata.google.internal/v1",
        "http://METADATA.google.internal./v1",
        "http://100.100.100.200/v1",
        "http://192.0.0.192/v1",
        "http://instance-data.ec2.internal/v1",
        "http://[64:ff9b::a9fe:a9fe]/v1",
        "http://[::169.254.169.254]/v1",
        "http://[2002:a9fe:a9fe::1]/v1",
        "http://255.255.255.255/v1",
        "http://[::]/v1",
        "HTTP:/\\169.254.169.254/v1",
        "data:text/plain,hi",
        "unix:///run/docker.sock",
        "http://0.0.0.0:8080/v1",
        "http://224.0.0.1/v1",
        "http://例子.example/v1",
        "http://127.0.0.1/v1\nHost: evil",
        "http://" + "a" * 3000,
    ],
)
def test_where_no_model_may_be_refuses_to_start(base: str) -> None:
    with pytest.raises(ConfigError) as refused:
        Address.parse(base)
    assert refused.value.code == "model_url"
    assert "secret" not in str(refused.value)


def test_what_a_name_resolves_to_is_judged_too() -> None:
    assert refused_among(["10.0.0.1", "2001:db8::1"]) is None
    assert refused_among(["10.0.0.1", "169.254.169.254"]) == "169.254.169.254"
    assert refused_among(["fe80::1%eth0"]) == "fe80::1%eth0"
    assert refused_among(["no address"]) == "no address"


def resolving(monkeypatch: pytest.MonkeyPatch, *answers: list[str]) -> list[str]:
    """Let a name lead to these addresses, one list for each look; return what was looked up."""
    asked: list[str] = []

    async def look(_: object, host: str, port: int, **__: object) -> list[tuple[object, ...]]:
        asked.append(host)
        found = answers[min(len(asked), len(answers)) - 1]
        return [(2, 1, 6, "", (each, port)) for each in found]

    monkeypatch.setattr(asyncio.BaseEventLoop, "getaddrinfo", look)
    return asked


async def test_the_address_that_answered_comes_first_and_a_number_is_not_looked_up(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    seven, eight = "203.0.113.7", "203.0.113.8"
    asked = resolving(monkeypatch, [seven, eight], [seven, eight], [eight])
    names = TargetResolver(Address.parse("http://models.example/v1"))
    _, second = await names.targets()
    names.prefer(second)
    assert (await names.targets())[0] is second
    monkeypatch.setattr("planner.outbound.address.RESOLVED_FOR_S", -1.0)
    assert [each.ip for each in await names.targets()] == [eight, seven]
    assert [each.ip for each in await names.targets()] == [eight]
    local = TargetResolver(Address.parse("http://127.0.0.1:1/v1"))
    assert [each.url for each in await local.targets()] == [
        "http://127.0.0.1:1/v1/chat/completions"
    ]
    assert asked == ["models.example"] * 3
