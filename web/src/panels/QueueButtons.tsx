/** Move a queued goal nearer to its turn or farther from it, or do it now. */
import { computed } from "@preact/signals";
import { t } from "../i18n";
import { doInstead, moveBy } from "../state/acts";
import { currentGoals, queuedGoals } from "../state/store";
import type { Goal } from "../wire/types";

const running = computed(() => currentGoals.value.find((goal) => goal.state === "running")?.id);

/** Do a queued goal now, in place of whatever runs by then. */
function instead(goal: Goal): void {
  const runs = currentGoals.value.find(({ id }) => id === running.value);
  if (runs) void doInstead(goal, runs);
}

export function QueueButtons({ goal }: { goal: Goal }) {
  const index = queuedGoals.value.findIndex(({ id }) => id === goal.id);
  const turns = [
    { by: -1, mark: "↑", name: t("goal.sooner"), can: index > 0 },
    { by: 1, mark: "↓", name: t("goal.later"), can: index < queuedGoals.value.length - 1 },
  ] as const;
  return (
    <>
      {turns
        .filter(({ can }) => can)
        .map(({ by, mark, name }) => (
          <button key={mark} type="button" aria-label={name} onClick={() => void moveBy(goal, by)}>
            {mark}
          </button>
        ))}
      {running.value !== undefined && (
        <button type="button" onClick={() => instead(goal)}>
          {t("goal.instead")}
        </button>
      )}
    </>
  );
}
