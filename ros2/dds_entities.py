"""Wrap Cyclone DDS: a domain's participant, its discovered endpoints, readers and writers of bytes.

The only file that knows cyclonedds. Its types are made from our layouts, so that peers who compare
types find them equal; the bytes themselves are read and written by ``ros2.cdr``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from cyclonedds.builtin import (
    BuiltinDataReader,
    BuiltinTopicDcpsPublication,
    BuiltinTopicDcpsSubscription,
)
from cyclonedds.core import DDSException, InstanceState, Policy, Qos
from cyclonedds.domain import Domain, DomainParticipant
from cyclonedds.idl import make_idl_struct, types
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

from ros2.layouts import LAYOUTS, dds_name

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ros2.layouts import MessageField

__all__ = ["DDSException", "DdsDomain", "RawReader", "RawWriter"]

_CONFIG = """<CycloneDDS><Domain>{general}<Compatibility>
<IgnoreTypeInformation>1.15</IgnoreTypeInformation></Compatibility></Domain></CycloneDDS>"""
"""Fast DDS (vendor 1.15) says type information that Cyclone DDS can't match: without this word a
reader of ours hears none of its publishers (eclipse-cyclonedds/cyclonedds PR 2333)."""
_INTERFACE = """<General><Interfaces><NetworkInterface name="{name}" multicast="{multicast}"/>
</Interfaces></General>"""
_MOST = 64
_LIVE = InstanceState.Alive
_SHORT_S = 0.01


@dataclass(frozen=True, slots=True)
class EndpointChange:
    """Hold one endpoint that came, changed or went."""

    key: str
    topic: str
    kind: str
    publishes: bool
    is_gone: bool


class DdsDomain:
    """Be one participant."""

    def __init__(self, domain: int, interface: str | None) -> None:
        """Join.

        Raises:
            DDSException: the interface is none of this computer's, or no socket could be had.
        """
        general = ""
        if interface is not None:
            multicast = "true" if interface == "lo" else "default"
            general = _INTERFACE.format(name=interface, multicast=multicast)
        self._domain = _configure(domain, _CONFIG.format(general=general))
        self._participant = DomainParticipant(domain)
        self._publications = BuiltinDataReader(self._participant, BuiltinTopicDcpsPublication)
        self._subscriptions = BuiltinDataReader(self._participant, BuiltinTopicDcpsSubscription)
        self._own = str(self._participant.guid)
        self._topics: dict[str, Topic[Any]] = {}

    def changes(self) -> Iterator[EndpointChange]:
        """Yield what was discovered of others since the last call."""
        for reader, publishes in ((self._publications, True), (self._subscriptions, False)):
            for found in reader.take(_MOST):
                if found.sample_info.instance_state != _LIVE:
                    yield EndpointChange(str(found.key), "", "", publishes, is_gone=True)
                elif str(found.participant_key) != self._own:
                    yield EndpointChange(
                        str(found.key), found.topic_name, found.type_name, publishes, is_gone=False
                    )

    def reader(self, topic: str, kind: str, *, keeps: bool) -> RawReader:
        """Return a reader of a topic; of one that keeps, what it has said before comes too."""
        qos = Qos(
            Policy.Reliability.Reliable(duration(seconds=_SHORT_S))
            if keeps
            else Policy.Reliability.BestEffort,
            Policy.Durability.TransientLocal if keeps else Policy.Durability.Volatile,
            Policy.History.KeepLast(_MOST if keeps else 1),
        )
        return RawReader(DataReader(self._participant, self._topic(topic, kind), qos))

    def writer(self, topic: str, kind: str) -> RawWriter:
        """Return a writer of a topic."""
        qos = Qos(
            Policy.Reliability.Reliable(duration(seconds=_SHORT_S)),
            Policy.Durability.Volatile,
            Policy.History.KeepLast(1),
            Policy.DataRepresentation(use_cdrv0_representation=True),
        )
        return RawWriter(DataWriter(self._participant, self._topic(topic, kind), qos), kind)

    def close(self) -> None:
        """Leave the domain, and say so."""
        del self._publications, self._subscriptions
        self._topics.clear()
        del self._participant, self._domain

    def _topic(self, topic: str, kind: str) -> Topic[Any]:
        made = self._topics.get(topic)
        if made is None or made.data_type is not idl_type(kind):
            made = self._topics[topic] = Topic(self._participant, topic, idl_type(kind))
        return made


def _configure(domain: int, config: str) -> Domain | None:
    """Set up a domain for this process; None where it was already, by whoever joined first."""
    try:
        return Domain(domain, config)
    except DDSException as error:
        if error.code != DDSException.DDS_RETCODE_PRECONDITION_NOT_MET:
            raise
    return None


class RawReader:
    """Take the bytes of one topic."""

    def __init__(self, reader: DataReader[Any]) -> None:
        self._reader = reader

    def take(self) -> list[bytes]:
        """Return what waits, head and all."""
        return [one.payload for one in self._reader.take(_MOST) if hasattr(one, "payload")]


class RawWriter:
    """Write bytes of one topic."""

    def __init__(self, writer: DataWriter[Any], kind: str) -> None:
        self._writer, self.kind = writer, kind
        self._type = idl_type(kind)

    def write(self, payload: bytes) -> bool:
        """Write; False where it would have waited for longer than a tick."""
        try:
            self._writer.write(self._type.of(payload))
        except DDSException:
            return False
        return True

    def close(self) -> None:
        """Be a publisher no longer."""
        del self._writer


_TYPES: dict[str, Any] = {}
_SIMPLE: dict[str, Any] = {
    "int8": types.int8, "uint8": types.uint8, "int32": types.int32, "uint32": types.uint32,
    "float32": types.float32, "float64": types.float64, "string": str,
}  # fmt: skip


def idl_type(kind: str) -> Any:
    """Return the type of a message, whose samples are bytes that were written elsewhere."""
    if kind not in _TYPES:
        fields = {field.name: _idl_field(field) for field in LAYOUTS[kind]}
        made: Any = make_idl_struct(f"{kind.rsplit('/', 1)[1]}_", dds_name(kind), fields)
        made.of = made.deserialize = classmethod(_of)
        made.serialize = _serialize
        _TYPES[kind] = made
    return _TYPES[kind]


def _idl_field(field: MessageField) -> Any:
    one = _SIMPLE[field.kind] if field.kind in _SIMPLE else idl_type(field.kind)
    lists: Any = types
    if field.is_list:
        return lists.sequence[one]
    return lists.array[one, field.count] if field.count else one


def _of(cls: Any, /, payload: bytes, **_: object) -> Any:
    """Return a sample that carries bytes."""
    sample = cls.__new__(cls)
    sample.payload = bytes(payload)
    return sample


def _serialize(self: Any, **_: object) -> bytes:
    payload: bytes = self.payload
    return payload
