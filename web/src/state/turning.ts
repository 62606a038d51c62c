/** Tell the changes of a robot that a person must see at once from those that may wait a moment. */
import type { Robot } from "../wire/types";

/** Return what must not wait, as one text: it differs where a turning point lies between. */
export function turning(robot: Robot | null): string {
  if (robot === null) return "never";
  const said = robot.status;
  if (said === null) return "silent";
  const rows = said.rows.map((row) => row.row + row.action);
  return [said.boot, said.mode, said.epoch, said.held?.id, said.owner?.planner_id, said.blocked]
    .concat(rows, said.waiting_for)
    .join(" ");
}
