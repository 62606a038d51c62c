"""Write and read the keys of rmw_zenoh: topics, liveliness tokens, attachments. Pure.

After its design page and its sources (Jazzy 0.2.4 and later, Kilted). A token says all of one
endpoint in its key: ``@ros2_lv/domain/session/node/entity/kind/enclave/namespace/name`` and, of an
endpoint, ``/topic/type/hash/qos``, with ``%`` where a name has a slash.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ros2.endpoints import GraphEndpoint
from ros2.layouts import dds_name, ros_name

if TYPE_CHECKING:
    from collections.abc import Sequence

ADMIN = "@ros2_lv"
NODE, PUBLISHER, SUBSCRIPTION = "NN", "MP", "MS"
ANY_HASH = "*"
NO_HASH = "TypeHashNotSupported"
"""What Humble says in a hash's place."""
GID_BYTES = 16
_PARTS_OF_NODE, _PARTS = 9, 13
_QOS = "{reliability}:{durability}:1,1:,:,:,,"
_RELIABLE, _BEST_EFFORT, _KEEPS, _VOLATILE = "1", "2", "1", "2"


@dataclass(frozen=True, slots=True)
class OwnNode:
    """Hold what our tokens have in common."""

    domain: int
    session: str
    name: str

    def node_token(self) -> str:
        """Return the token of the node itself."""
        return self._token(0, NODE)

    def endpoint_token(self, number: int, endpoint: GraphEndpoint, *, keeps: bool = False) -> str:
        """Return the token of the node's publisher or subscription ``number``."""
        kind = PUBLISHER if endpoint.publishes else SUBSCRIPTION
        parts = (
            endpoint.topic.replace("/", "%"),
            dds_name(endpoint.kind),
            endpoint.type_hash or NO_HASH,
            qos_text(reliable=endpoint.publishes or keeps, keeps=keeps),
        )
        return "/".join((self._token(number, kind), *parts))

    def _token(self, number: int, kind: str) -> str:
        head: Sequence[object] = (ADMIN, self.domain, self.session, 0, number, kind)
        return "/".join([*map(str, head), "%", "%", self.name])


def qos_text(*, reliable: bool, keeps: bool) -> str:
    """Return a quality of service as tokens carry it: what is left empty is the default."""
    return _QOS.format(
        reliability=_RELIABLE if reliable else _BEST_EFFORT,
        durability=_KEEPS if keeps else _VOLATILE,
    )


def all_tokens(domain: int) -> str:
    """Return the key expression of every token of a domain."""
    return f"{ADMIN}/{domain}/**"


def read_token(key: str) -> tuple[str, GraphEndpoint | None] | None:
    """Return whose session a token is of, and its endpoint, None for a node's.

    None for what is no token, or one of a service.
    """
    parts = key.split("/")
    if len(parts) < _PARTS_OF_NODE or parts[0] != ADMIN:
        return None
    session, kind = parts[2], parts[5]
    if kind == NODE:
        return session, None
    if len(parts) != _PARTS or kind not in (PUBLISHER, SUBSCRIPTION):
        return None
    topic, type_name, type_hash = parts[9].replace("%", "/"), ros_name(parts[10]), parts[11]
    return session, GraphEndpoint(topic, type_name, kind == PUBLISHER, type_hash)


def topic_key(domain: int, topic: str, kind: str, type_hash: str = ANY_HASH) -> str:
    """Return the key that a topic's messages have."""
    return f"{domain}/{topic.strip('/')}/{dds_name(kind)}/{type_hash}"


def attachment(seq: int, wall_ns: int, gid: bytes) -> bytes:
    """Return what rides beside a message: its number, its time, and its publisher's 16 bytes."""
    return struct.pack("<qqB", seq, wall_ns, GID_BYTES) + gid
