"""Share fixtures and laws of the test run.

Owns the tests' environment; knows no package of ours.
"""

from __future__ import annotations

import asyncio
import gc
import inspect
import os
import socket
import tempfile
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest
from hypothesis import HealthCheck, settings

from tests.contact import Contacts
from tests.nightly import Sampled, pytest_addoption

__all__ = ["pytest_addoption"]

ROOT = Path(__file__).resolve().parents[1]
CHILD_GRACE_S = 5.0
os.environ["LC_ALL"] = "C.UTF-8"  # what a command says, here and in each child, is told in English
SELDOM = (100_000, 50, 100)
"""Allocations between two looks for garbage, and how many looks between deeper ones."""

# CI repeats the same examples so that a red run can be run again; a developer's run looks further,
# and `make laws` furthest: the laws that state no number of their own try 2 000 examples each.
# No deadline: a busy machine must not fail a law.
settings.register_profile(
    "ci",
    deadline=None,
    derandomize=True,
    max_examples=50,
    print_blob=True,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.register_profile("dev", deadline=None, max_examples=50)
settings.register_profile("laws", deadline=None, max_examples=2_000)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "ci" if os.environ.get("CI") else "dev"))


def pytest_configure(config: pytest.Config) -> None:
    """Let a contact decide how the run ends, and the gate leave out what a night has time for."""
    config.pluginmanager.register(Contacts())
    config.pluginmanager.register(Sampled(config))


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Iterator[None]:
    """Collect thousands of tests without looking again and again for garbage among them.

    They live until the end, so no later look need walk them either; and looking seldom afterwards
    saves a tenth of the processor's time.
    """
    gc.disable()
    try:
        return (yield)
    finally:
        gc.enable()
        gc.freeze()
        gc.set_threshold(*SELDOM)


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Put drives through the home first, then long stories, each kind in its random order.

    Begun last, one keeps all others' processors waiting.
    """
    items.sort(
        key=lambda item: tuple(item.get_closest_marker(each) is None for each in ("home", "long"))
    )


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> bool | None:
    """Run a test that is a coroutine to its end, in an event loop of its own."""
    if not inspect.iscoroutinefunction(pyfuncitem.obj):
        return None
    wanted = inspect.signature(pyfuncitem.obj).parameters
    asyncio.run(pyfuncitem.obj(**{name: pyfuncitem.funcargs[name] for name in wanted}))
    return True


@pytest.fixture(scope="session", autouse=True)
def owner_settings_left_outside() -> Iterator[None]:
    """Keep the person's own Pons and model settings out of every test, and state in a fresh place.

    The place has a short name because socket paths end at 107 bytes.
    """
    with pytest.MonkeyPatch.context() as patch, tempfile.TemporaryDirectory(prefix="pons-") as home:
        for name in [n for n in os.environ if n.startswith(("PONS_", "OPENAI_", "ANTHROPIC_"))]:
            patch.delenv(name)
        patch.setenv("PONS_HOME", home)
        patch.setenv("PONS_RUNNING", home)  # no test's robot is found by a person, nor theirs here
        yield


@pytest.fixture(scope="session", autouse=True)
def nothing_left_running() -> Iterator[None]:
    """Fail the run if a process that a test started outlives it."""
    yield
    children = [child for child in psutil.Process().children(recursive=True) if not helper(child)]
    _, alive = psutil.wait_procs(children, timeout=CHILD_GRACE_S)
    left = [f"{child.pid} {' '.join(child.cmdline())}" for child in alive if child.is_running()]
    for child in alive:
        child.kill()
    if left:
        pytest.fail(f"processes left running by tests: {left}")


def helper(process: psutil.Process) -> bool:
    """Tell whether a process is the standard library's own, which ends with its parent."""
    try:
        words = " ".join(process.cmdline())
    except psutil.NoSuchProcess:
        return True
    return "resource_tracker" in words or "forkserver" in words


@pytest.fixture(scope="session")
def repository() -> Path:
    """Return the checkout's root folder."""
    return ROOT


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """Return the folder of data from outside that may lie beside the checkout, or skip aloud."""
    folder = ROOT.parent / "shared" / "data"
    if not folder.is_dir():
        pytest.skip(f"no data from outside at {folder}")
    return folder


@pytest.fixture
def free_port() -> int:
    """Return a TCP port of the loopback that nothing listens on now."""
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])
