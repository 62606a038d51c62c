"""Hold the fleet's use of a robot's API to a real planner's missions."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from fleet.records import GOAL_ENDED
from fleet.watch import CLOSING, CONFLICT
from tests.planner.api.test_real_missions import served
from tests.planner.mission.live import run


def test_a_closed_key_makes_no_mission_and_a_known_one_is_told(tmp_path: Path) -> None:
    body = {"text": "go to the kitchen", "language": "en", "source": "fleet", "confirm": True}

    async def story() -> None:
        async with served(tmp_path, by_grammar=True) as (world, operator, _):
            client: Any = operator._client
            headers = operator._headers

            async def offer(what: dict[str, Any], key: str) -> Any:
                return await client.post(
                    "/v1/goals", json=what, headers={**headers, "idempotency-key": key}
                )

            known = await offer(body, "m-known")
            assert known.status_code == 202
            assert (await offer(CLOSING, "m-known")).json()["code"] == CONFLICT
            assert (await offer(body, "m-known")).json()["id"] == known.json()["id"]

            closing = await offer(CLOSING, "m-closed")
            assert closing.status_code == 202
            goal_id = closing.json()["id"]
            await world.until(lambda: world.missions.goal(goal_id).state in GOAL_ENDED)
            assert world.missions.goal(goal_id).state == "refused"
            assert (await offer(body, "m-closed")).json()["code"] == CONFLICT

    run(story())
