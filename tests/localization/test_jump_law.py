"""No good word displaces the robot before poor ones were said."""

from __future__ import annotations

from math import hypot

from hypothesis import given
from hypothesis import strategies as st

from localization.jump_law import DECLARED_M, DECLARED_RAD, DECLARING, JumpLaw
from localization.quality import POOR_QUALITY
from wire import IDENTITY, Pose2, compose, wrap

FAR = Pose2(1.0, 0.0, 0.0)


def test_a_displacement_is_declared_first() -> None:
    law = JumpLaw()
    assert law.apply(IDENTITY, IDENTITY, 0.9) == (IDENTITY, 0.9)
    for _ in range(DECLARING):
        assert law.apply(FAR, IDENTITY, 0.9) == (IDENTITY, 0.0)
    assert law.apply(FAR, IDENTITY, 0.9) == (FAR, 0.9)
    assert law.apply(FAR, IDENTITY, 0.9) == (FAR, 0.9)


def test_poor_words_that_were_said_anyway_count() -> None:
    law = JumpLaw()
    law.apply(IDENTITY, IDENTITY, 0.9)
    for _ in range(DECLARING):
        assert law.apply(IDENTITY, IDENTITY, 0.1) == (IDENTITY, 0.1)
    assert law.apply(FAR, IDENTITY, 0.9) == (FAR, 0.9)


def test_another_odometry_compares_with_nothing() -> None:
    law = JumpLaw()
    law.apply(IDENTITY, IDENTITY, 0.9)
    law.clear()
    assert law.apply(FAR, IDENTITY, 0.9) == (FAR, 0.9)


WORDS = st.tuples(
    st.floats(-1, 1), st.floats(-1, 1), st.floats(-3, 3), st.floats(0, 1), st.floats(-9, 9)
)


@given(st.lists(WORDS, max_size=40))
def test_two_good_words_in_a_row_are_close_at_the_robots_place(
    words: list[tuple[float, float, float, float, float]],
) -> None:
    law, last = JumpLaw(), None
    for x_m, y_m, yaw, quality, along in words:
        at = Pose2(along, 0.0, 0.0)
        said, good = law.apply(Pose2(x_m, y_m, yaw), at, quality)
        if good < POOR_QUALITY:
            last = None
            continue
        if last is not None:
            before, after = compose(last, at), compose(said, at)
            assert hypot(after.x_m - before.x_m, after.y_m - before.y_m) <= DECLARED_M + 1e-9
            assert abs(wrap(after.yaw_rad - before.yaw_rad)) <= DECLARED_RAD + 1e-9
        last = said
