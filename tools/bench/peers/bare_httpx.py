"""Ask with httpx alone and validate with pydantic: the floor that no client of Python goes below.

Run as ``python -m tools.bench.peers.bare_httpx FACTS``.
"""

from __future__ import annotations

import sys

import httpx
import pydantic

from tools.bench.peers.loop import take_turns
from tools.bench.peers.shape import PeerFacts, check, plan_model


def main(path: str) -> None:
    """Take turns with the bench."""
    facts = PeerFacts.load(path)
    plan = plan_model(facts)
    schema = {"name": "plan", "schema": plan.model_json_schema()}
    body = {
        "model": "bare httpx",
        "messages": [
            {"role": "system", "content": facts.system},
            {"role": "user", "content": facts.order},
        ],
        "temperature": 0,
        "response_format": {"type": "json_schema", "json_schema": schema},
    }
    client = httpx.AsyncClient(trust_env=False)

    async def plan_once() -> None:
        reply = await client.post(f"{facts.url}/chat/completions", json=body)
        written = reply.json()["choices"][0]["message"]["content"]
        check(plan.model_validate_json(written), facts)

    take_turns("bare httpx", {"httpx": httpx.__version__, "pydantic": pydantic.VERSION}, plan_once)


if __name__ == "__main__":
    main(sys.argv[1])
