/** Show what the model wrote about a goal, as plain text; nothing where nothing is kept of it. */
import { useSignal, type Signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { t, word } from "../i18n";
import { mayReadReplies } from "../state/asker";
import { fetchReplies, wasModelAsked } from "../state/replies";
import type { Goal, ModelReply } from "../wire/types";
import { clock } from "./format";

export function Replies({ goal }: { goal: Goal }) {
  const found = useSignal<readonly ModelReply[]>([]);
  const asked = wasModelAsked(goal) && mayReadReplies.value;
  useEffect(() => {
    if (asked) void fetchInto(found, goal.id);
  }, [goal.id, goal.state, asked, found]);
  if (found.value.length === 0) return null;
  return (
    <details
      class="replies"
      onToggle={(event) => {
        if (event.currentTarget.open) void fetchInto(found, goal.id);
      }}
    >
      <summary>{t("replies.title")}</summary>
      <ReplyList replies={found.value} />
    </details>
  );
}

async function fetchInto(found: Signal<readonly ModelReply[]>, goal: string): Promise<void> {
  found.value = await fetchReplies(goal);
}

export function ReplyList({ replies }: { replies: readonly ModelReply[] }) {
  return (
    <ol>
      {replies.map((reply, index) => (
        <li key={index} data-turn={reply.turn} data-used={reply.used}>
          <p class="fine">
            {clock(Date.parse(reply.at))} · {reply.model} · {word("replies.turn", reply.turn)} ·{" "}
            {t(reply.used ? "replies.used" : "replies.unused")}
          </p>
          <pre dir="auto">{reply.text === "" ? t("replies.empty") : reply.text}</pre>
        </li>
      ))}
    </ol>
  );
}
