"""Ask with pydantic-ai's agent, its output held to the schema by the server ("native").

Run as ``python -m tools.bench.peers.pydantic_ai_agent FACTS`` in the peers' environment.
"""

from __future__ import annotations

import sys
from importlib.metadata import version

from pydantic_ai import Agent, NativeOutput
from pydantic_ai.models.openai import OpenAIChatModel
from pydantic_ai.providers.openai import OpenAIProvider

from tools.bench.peers.loop import take_turns
from tools.bench.peers.shape import PeerFacts, check, plan_model


def main(path: str) -> None:
    """Take turns with the bench."""
    facts = PeerFacts.load(path)
    provider = OpenAIProvider(base_url=facts.url, api_key="none")
    model = OpenAIChatModel("pydantic-ai", provider=provider)
    output = NativeOutput(plan_model(facts))
    agent = Agent(model, output_type=output, system_prompt=facts.system)

    async def plan_once() -> None:
        done = await agent.run(facts.order, model_settings={"temperature": 0.0})
        check(done.output, facts)

    take_turns("pydantic-ai", {"pydantic-ai": version("pydantic-ai-slim")}, plan_once)


if __name__ == "__main__":
    main(sys.argv[1])
