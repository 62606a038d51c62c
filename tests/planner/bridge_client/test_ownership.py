"""Hold the owner to the wire's law, against scripted statuses."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from planner.bridge_client.ownership import (
    STANDING,
    Course,
    Identity,
    OwnerState,
    on_course,
    on_status,
)
from tests.planner.mission.fakes import HASH, status
from wire import (
    PROTOCOL,
    Grant,
    GrantLeft,
    Heartbeat,
    HeldReason,
    Hello,
    LegReport,
    Mode,
    Owner,
    Record,
    StandingHold,
    Status,
    Waypoint,
    Waypoints,
)

ME = Identity("p1", HASH, HASH, HASH)
OURS = Owner(planner_id="p1", kind="planner")
POINTS = (Waypoint(x_m=0.0, y_m=0.0, speed_mps=0.5), Waypoint(x_m=0.1, y_m=0.0, speed_mps=0.5))
DRIVE = Course("g1", 1, POINTS, final=True)


def left(mission: str = "g1") -> GrantLeft:
    return GrantLeft(mission=mission, metres=1.0, seconds=1.0)


def say(
    state: OwnerState, said: Status, course: Course = STANDING, now_s: float = 0.0
) -> tuple[OwnerState, tuple[Record, ...]]:
    return on_status(ME, state, said, course, said.seq, now_s)


def kinds(messages: tuple[Record, ...]) -> list[type[Record]]:
    return [type(message) for message in messages]


def test_hello_on_each_status_until_owner() -> None:
    state = OwnerState()
    for seq in (1, 2, 3):
        state, messages = say(state, status(seq=seq), DRIVE)
        (hello,) = messages
        assert isinstance(hello, Hello)
        assert (hello.seen, hello.protocol, hello.kind) == (seq, PROTOCOL, "planner")
    state, messages = say(state, status(seq=4, owner=OURS))
    assert kinds(messages) == [Heartbeat]


def test_another_owner_gets_no_word_but_hello() -> None:
    other = status(owner=Owner(planner_id="p9", kind="planner"), grant=left())
    _, messages = say(OwnerState(), other, DRIVE)
    assert kinds(messages) == [Hello]


def test_heartbeat_shows_what_was_seen_and_what_was_used() -> None:
    _, messages = on_status(ME, OwnerState(), status(seq=9, owner=OURS), STANDING, 4, 0.0)
    (beat,) = messages
    assert isinstance(beat, Heartbeat)
    assert (beat.seen, beat.used) == (9, 4)


def test_grant_on_each_status_until_it_shows_and_never_while_held() -> None:
    state = OwnerState()
    held = StandingHold(reason=HeldReason.STOP, id="h1")
    state, messages = say(state, status(seq=1, owner=OURS, held=held), DRIVE)
    assert kinds(messages) == [Heartbeat]
    for seq in (2, 3):
        state, messages = say(state, status(seq=seq, owner=OURS), DRIVE)
        assert kinds(messages) == [Heartbeat, Grant, Waypoints]
    state, messages = say(state, status(seq=4, owner=OURS, grant=left("g0")), DRIVE)
    assert kinds(messages) == [Heartbeat, Grant, Waypoints], "the grant shown is another mission's"
    state, messages = say(state, status(seq=5, owner=OURS, grant=left()), DRIVE)
    assert kinds(messages) == [Heartbeat, Waypoints]


def test_one_status_is_asked_for_one_grant() -> None:
    state, shown = OwnerState(), status(owner=OURS)
    state, first = on_course(ME, state, shown, DRIVE, 0.0)
    state, second = on_course(ME, state, shown, DRIVE, 0.0)
    assert (kinds(first), second) == ([Grant, Waypoints], ())


def test_no_waypoint_before_its_grant_is_asked_for() -> None:
    held = StandingHold(reason=HeldReason.STOP, id="h1")
    _, messages = say(OwnerState(), status(owner=OURS, held=held), DRIVE)
    assert Waypoints not in kinds(messages)


def test_a_path_follows_its_grant_at_once_and_again_when_that_is_confirmed() -> None:
    state, shown = OwnerState(), status(owner=OURS)
    state, thinking = on_course(ME, state, shown, Course("g1"), 0.0)
    assert kinds(thinking) == [Grant], "asked for while the route is still searched"
    state, behind = on_course(ME, state, shown, DRIVE, 0.01)
    assert kinds(behind) == [Waypoints]
    state, confirmed = say(state, status(seq=2, owner=OURS, grant=left()), DRIVE, 0.03)
    assert kinds(confirmed) == [Heartbeat, Waypoints], "the first may have come before its grant"


def test_a_path_sent_behind_its_grant_is_halted_like_any_other() -> None:
    state, shown = OwnerState(), status(owner=OURS)
    state, _ = on_course(ME, state, shown, DRIVE, 0.0)
    state, messages = on_course(ME, state, shown, STANDING, 0.0)
    (halt,) = messages
    assert isinstance(halt, Waypoints)
    assert (halt.mission, halt.points) == ("g1", ())


def test_waypoints_at_ten_hertz_but_a_new_leg_at_once() -> None:
    state, sent = OwnerState(), []
    for seq in range(1, 41):  # two seconds of statuses at 20 Hz
        now_s = 0.05 * seq
        state, messages = say(state, status(seq=seq, owner=OURS, grant=left()), DRIVE, now_s)
        sent += [m for m in messages if isinstance(m, Waypoints)]
    assert len(sent) == 20
    assert [m.seq for m in sent] == list(range(1, 21))
    shown = status(seq=40, owner=OURS, grant=left())
    state, messages = on_course(ME, state, shown, Course("g1", 2, POINTS), 2.0)
    assert kinds(messages) == [Waypoints]


def test_a_halt_leaves_at_once_and_is_repeated_until_the_bridge_holds() -> None:
    state = OwnerState()
    state, _ = say(state, status(seq=1, owner=OURS, grant=left()), DRIVE, 0.0)
    active = status(seq=1, owner=OURS, grant=left(), mode=Mode.ACTIVE)
    state, messages = on_course(ME, state, active, STANDING, 0.01)
    (halt,) = messages
    assert isinstance(halt, Waypoints)
    assert (halt.points, halt.mission, halt.leg) == ((), "g1", 1)
    sent = 0
    for seq in range(2, 40):
        mode = Mode.ACTIVE if seq < 20 else Mode.HOLD
        shown = status(seq=seq, owner=OURS, grant=left(), mode=mode)
        state, messages = say(state, shown, STANDING, 0.05 * seq)
        halts = [m for m in messages if isinstance(m, Waypoints)]
        assert all(m.points == () for m in halts)
        sent += len(halts)
        if seq > 30:
            assert not halts
    assert sent >= 9


def test_a_robot_found_driving_our_old_leg_is_halted() -> None:
    leg = LegReport(mission="g1", leg=5, following=True, reached=False, residual_m=0.0,
                    residual_rad=0.0, refusal=None)  # fmt: skip
    shown = status(owner=OURS, grant=left(), mode=Mode.ACTIVE, leg=leg)
    _, messages = say(OwnerState(), shown, STANDING)
    halt = messages[-1]
    assert isinstance(halt, Waypoints)
    assert (halt.leg, halt.points) == (5, ())


courses = st.sampled_from([STANDING, DRIVE, Course("g1"), Course("g2", 3, POINTS)])


@given(
    st.lists(
        st.tuples(
            st.integers(1, 3),  # epoch
            st.sampled_from([None, "p1", "p9"]),
            st.sampled_from([None, "g1", "g2"]),
            st.booleans(),  # held
            courses,
            st.sampled_from([0.0, 0.02, 0.05, 1.0]),
        ),
        max_size=40,
    )
)
def test_no_history_makes_it_say_what_the_wire_forbids(
    history: list[tuple[int, str | None, str | None, bool, Course, float]],
) -> None:
    state, now_s, epoch, newest = OwnerState(), 0.0, "", 0
    for seq, (number, owner, granted, held, course, pause_s) in enumerate(history, start=1):
        now_s += pause_s
        shown = status(
            seq=seq,
            epoch=f"b1-{number}",
            owner=Owner(planner_id=owner, kind="planner") if owner else None,
            grant=left(granted) if granted else None,
            held=StandingHold(reason=HeldReason.STOP, id="h") if held else None,
        )
        if shown.epoch != epoch:
            epoch, newest = shown.epoch, 0
        state, messages = say(state, shown, course, now_s)
        asked = None
        for message in messages:
            if isinstance(message, Hello):
                assert owner != "p1"
                continue
            assert isinstance(message, Heartbeat | Grant | Waypoints)
            assert owner == "p1"
            assert (message.epoch, message.seen) == (shown.epoch, seq)
            if isinstance(message, Grant):
                assert not held
                assert message.mission != granted
                asked = message.mission
            if isinstance(message, Waypoints):
                assert message.mission in (granted, asked)
                assert message.seq == newest + 1
                newest = message.seq
                if message.points:
                    assert (message.mission, message.leg) == (course.mission, course.leg)
