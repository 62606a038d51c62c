/** Fetch what the model wrote about a goal, and ask no more where nothing is kept or may be read. */
import { ApiError, listReplies } from "../net/api";
import { authorization } from "../net/token";
import type { Goal, ModelReply } from "../wire/types";

/** The asker who was told that there is nothing to read; a planner tells the same until it restarts. */
let turnedAway: string | null = null;

/** Say whether a model was asked about a goal, be it in vain. */
export const wasModelAsked = ({ brain }: Goal): boolean =>
  brain !== null && (brain.name !== "offline" || brain.fallback_from !== null);

export async function fetchReplies(goal: string): Promise<readonly ModelReply[]> {
  const asker = authorization().authorization ?? "";
  if (asker === turnedAway) return [];
  try {
    const found = await listReplies(goal);
    if (found.kept === 0) turnedAway = asker;
    return found.replies;
  } catch (error) {
    if (error instanceof ApiError && error.code === "operator_needed") turnedAway = asker;
    return []; // it is read beside the goal, whose own requests tell what is wrong
  }
}
