"""Be one process of the key table, for the delivery test.

Says every key that the party may say, hears every key that it may hear, and prints each pair
(key, sender) the first time it is heard. Ends when its input closes.
"""

from __future__ import annotations

import select
import sys
from pathlib import Path

from tests.wire.examples import EXAMPLES
from wire import DecodeFailure, Record
from wire.keys import KEYS, Key, Party
from wire.session import Subscriber, open_session

PERIOD_S = 0.02


def said_by(party: Party, key: Key[Record]) -> Record:
    """Return the key's example, naming its sender where more than one may say it."""
    message = EXAMPLES[key.message]
    for name in ("source", "source_id", *(("boot_id",) if len(key.senders) > 1 else ())):
        if name in key.message.model_fields:
            return message.model_copy(update={name: party.value})
    return message


def sender_of(key: Key[Record], message: Record) -> str:
    if len(key.senders) == 1:
        return next(iter(key.senders)).value
    named = (getattr(message, name, None) for name in ("source", "source_id", "boot_id"))
    return str(next(name for name in named if name))


def hear(key: Key[Record], subscriber: Subscriber[Record], heard: set[tuple[str, str]]) -> None:
    for item in subscriber.drain().items:
        if isinstance(item, DecodeFailure):
            print("rejected", key.path, item.code, flush=True)
            continue
        pair = (key.path, sender_of(key, item))
        if pair not in heard:
            heard.add(pair)
            print("heard", *pair, flush=True)


def main(party: Party, home: Path) -> None:
    with open_session(party, "r1", home) as session:
        out = [
            (session.publisher(key), said_by(party, key)) for key in KEYS if party in key.senders
        ]
        into = [(key, session.subscriber(key)) for key in KEYS if party in key.receivers]
        heard: set[tuple[str, str]] = set()
        while not select.select([sys.stdin], [], [], PERIOD_S)[0]:
            for publisher, message in out:
                publisher.put(message)
            for key, subscriber in into:
                hear(key, subscriber, heard)


if __name__ == "__main__":
    main(Party(sys.argv[1]), Path(sys.argv[2]))
