"""A key is struck out of what a server says, in every spelling and at every cut."""

from __future__ import annotations

from planner.outbound import Secret

KEY = "sk-this-is-secret"


def test_a_key_that_a_stream_echoes_is_never_shown() -> None:
    secret = Secret(KEY)
    for spelt in (KEY, KEY.replace("s", "\\u0073")):
        said = f'the key is "{spelt}", again {spelt}.'
        for end in range(len(said) + 1):
            assert KEY[:4] not in secret.struck_growing(said[:end]).replace("***", "")
    assert Secret("").struck_growing(KEY) == KEY
