"""What the robot asks stands first on every view, in every state, size, language and theme.

The page is a real one on the planner's own routes; the state of the robot is the test's.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from itertools import product
from typing import TYPE_CHECKING, Any

import pytest

from planner.memory import MemoryStore, Recollection
from planner.state_database import StateDatabase
from tests.planner.api.fakes import FakeServices
from tests.planner.api.serving import served
from tests.web.conftest import expected
from tests.web.states import STATES, Frame, asked
from tests.web.test_looks import TABS, assert_fits, violations

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page, WebSocketRoute

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(600), pytest.mark.nightly(keep=2)]

SIZES = ((390, 844), (1024, 768), (1440, 900))
LOCALES = ("en-US", "zh-CN")
THEMES = ("light", "dark")
READY = ("Ready", "Standing still", "就绪", "静止")

PATIENCE_MS = 60_000

IN_VIEW = """() => {
  const words = document.querySelector("#asked .question-words");
  if (words === null) return "no question";
  const answer = document.querySelector("#asked .clarify button");
  const stop = document.querySelector(".stopbar").getBoundingClientRect().top;
  for (const one of [words, answer]) {
    const { top, bottom, left } = one.getBoundingClientRect();
    if (top < 0 || bottom > stop) return `${one.className} ${top} to ${bottom} of ${stop}`;
    for (const y of [top + 3, bottom - 3]) {
      const there = document.elementFromPoint(left + 6, y);
      if (!one.contains(there)) return `${one.className} is under ${there?.className}`;
    }
  }
  return scrollY === 0 ? "" : `scrolled by ${scrollY}`;
}"""
"""What keeps a person from reading the question and its first answer without scrolling."""


class Told:
    """Stand between planner and page: the robot is in the state that a test says."""

    def __init__(self) -> None:
        self.real: Frame | None = None
        self._socket: WebSocketRoute | None = None
        self._told: Frame | None = None
        self._seq = 0

    def stand(self, page: Page) -> None:
        """Take the planner's place where events are concerned."""
        page.route_web_socket("**/v1/events", self._join)

    def _join(self, socket: WebSocketRoute) -> None:
        self._socket, server = socket, socket.connect_to_server()
        server.on_message(self._hear)

    def _hear(self, text: str | bytes) -> None:
        frame = json.loads(text)
        if frame["kind"] == "snapshot":  # the first one, and after each new connection
            self.real = self.real or frame
            self.tell(self._told or frame)

    def tell(self, frame: Frame) -> None:
        """Send the page a snapshot."""
        self._told = frame
        self._seq += 1
        assert self._socket is not None
        self._socket.send(json.dumps({**frame, "kind": "snapshot", "seq": self._seq}))

    def put(self, name: str) -> Frame:
        """Return the robot in a state of that name, asking something."""
        assert self.real is not None
        frame = asked(self.real)
        STATES[name](frame)
        return frame


Open = Callable[..., tuple["Page", Told]]


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Serve one planner's routes to all pages."""
    services, home = FakeServices(), tmp_path_factory.mktemp("home")
    services.recollection = Recollection(MemoryStore(StateDatabase(home)))
    with served(services) as server:
        yield f"http://127.0.0.1:{server.port}"


@pytest.fixture
def opened(browser: Browser, address: str) -> Iterator[Open]:
    """Return what opens a page in a size, a language and a theme; its console must stay empty."""
    complaints: list[str] = []

    def open_page(
        size: tuple[int, int], locale: str = "en-US", theme: str = "light"
    ) -> tuple[Page, Told]:
        viewport: Any = {"width": size[0], "height": size[1]}
        scheme: Any = theme
        context = browser.new_context(viewport=viewport, locale=locale, color_scheme=scheme)
        page, told = context.new_page(), Told()
        page.set_default_timeout(PATIENCE_MS)
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.on("console", lambda line: complaints.append(line.text))
        told.stand(page)
        page.goto(address)
        page.wait_for_selector("#link[data-state=good]")
        return page, told

    yield open_page
    for context in browser.contexts:
        context.close()
    assert [line for line in complaints if not expected(line)] == []


def hidden(page: Page, told: Told, name: str) -> list[str]:
    """Put the page in a state; return what is wrong with what a person then sees."""
    told.tell(told.put(name))
    page.locator("#asked .question-words").wait_for()
    page.evaluate("scrollTo(0, 0)")
    wrong: list[str] = [page.evaluate(IN_VIEW)]
    told.tell(told.put(name))  # fresh again, however long that took
    words = [page.inner_text("#mode"), page.inner_text(".motion")]
    wrong += [f"says {each!r}" for each in words if each.startswith(READY)]
    assert_fits(page)
    return [f"{name}: {each}" for each in wrong if each]


@pytest.mark.parametrize(
    ("size", "locale", "theme"),
    list(product(SIZES, LOCALES, THEMES)),
    ids=lambda each: str(each[0]) if isinstance(each, tuple) else each,
)
def test_a_question_is_seen_without_scrolling(
    opened: Open, size: tuple[int, int], locale: str, theme: str
) -> None:
    page, told = opened(size, locale, theme)
    found: list[str] = []
    for name in STATES:
        found += hidden(page, told, name)
    for tab in TABS:
        page.click(f"#tab-{tab}")
        found += [f"{tab}, {each}" for each in hidden(page, told, "calm")]
    assert found == []
    for name in ("stopped", "wants a yes", "lost"):
        told.tell(told.put(name))
        found += [f"{name}: {each}" for each in violations(page)]
    assert found == []


def test_a_question_stays_in_view_while_nobody_is_heard(opened: Open) -> None:
    for size in SIZES:
        page, told = opened(size)
        told.tell(told.put("calm"))
        page.locator("#asked").wait_for()
        page.locator("#lost[data-why=planner]").wait_for()
        assert page.evaluate(IN_VIEW) == ""
        assert page.inner_text("#mode") == "No contact"
        assert page.locator("#asked.stale").count() == 1


def test_after_a_stop_one_button_resumes(opened: Open) -> None:
    page, told = opened((390, 844))
    frame: dict[str, Any] = told.put("stopped")
    frame["goals"] = frame["goals"][1:]  # nothing is asked
    told.tell(frame)
    page.locator("#notice-resume").wait_for()
    told.tell(frame)
    assert page.inner_text("#mode") == "Stopped"
    assert page.inner_text(".motion").startswith("Stopped")
    assert "warn" in (page.get_attribute("#mode", "class") or "").split()
    assert page.get_by_role("button", name="Resume").count() == 1
    assert "stopped by the page" in page.inner_text("#said")
