"""A change is tested by all that imports it, however far away, and by no more."""

from __future__ import annotations

import pytest

from scripts.changed import reached_tests

SOURCES = {
    "wire/__init__.py": "from wire.codec import decode",
    "wire/codec.py": "",
    "wire/keys.py": "",
    "bridge/link.py": "import wire.keys",
    "sim/robot.py": "def late() -> None:\n    from bridge import link",
    "tests/wire/test_keys.py": "from wire.keys import KEYS",
    "tests/sim/test_robot.py": "from tests.sim.fakes import robot",
    "tests/sim/fakes.py": "import sim.robot",
    "tests/sim/conftest.py": "",
    "tests/maps/test_cells.py": "",
}
KEYS, ROBOT = "tests/wire/test_keys.py", "tests/sim/test_robot.py"
CELLS = "tests/maps/test_cells.py"


@pytest.mark.parametrize(
    ("changed", "reached"),
    [
        ({"wire/keys.py"}, {KEYS, ROBOT}),
        ({"wire/codec.py"}, {KEYS, ROBOT}),  # by the package's door
        ({"sim/robot.py"}, {ROBOT}),
        ({"tests/sim/fakes.py"}, {ROBOT}),
        ({"tests/sim/conftest.py"}, {ROBOT}),
        ({CELLS}, {CELLS}),
        ({"bridge/gone.py"}, set()),
        ({"docs/safety.md"}, set()),
        ({"wire/keys.py", "sites/home/places.yaml"}, {"tests"}),
        (set(), set()),
    ],
)
def test_a_change_reaches_what_imports_it(changed: set[str], reached: set[str]) -> None:
    assert reached_tests(changed, SOURCES) == reached
