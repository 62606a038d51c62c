/** Say what keeps the robot from driving, a sentence each. Pure: told the status and the log. */
import { causeWords, rowWords, t, wantWords, word } from "../i18n";
import type { LogEntry } from "../state/model";
import type { Status } from "../wire/types";

/** Why the black box takes nothing: said while driving too, for it keeps nobody from driving on. */
const UNRECORDED = new Set(["recorder_down", "disk_full"]);
const GATES = new Set(["obstacle", "fence", "contact"]);

export function reasons(said: Status, log: readonly LogEntry[]): string[] {
  const rows = said.rows.filter((row) => row.binding).map((row) => rowWords(row.row));
  const untold = said.waiting_for.filter((code) => UNRECORDED.has(code));
  const disarmed = said.mode === "DISARMED" ? [t("notice.disarmed")] : [];
  return [
    ...new Set([
      ...rows,
      ...(said.blocked ? [shut(log)] : []),
      ...heldBy(said),
      ...latched(said),
      ...untold.map((code) => word("notice", code)),
      ...refused(said),
      ...disarmed,
      ...waiting(said),
    ]),
  ];
}

/** Name the gate that shut the way, as the newest stop's event tells it. */
function shut(log: readonly LogEntry[]): string {
  const stops = log.filter((entry) => entry.kind === "bridge" && entry.code === "mode");
  const newest = stops.map((entry) => entry.text.split(" ")).find(([, to]) => to === "STOPPING");
  const gate = newest?.[2] ?? "";
  return (GATES.has(gate) ? causeWords(gate) : null) ?? t("notice.blocked");
}

function heldBy(said: Status): string[] {
  if (said.held === null) return [];
  if (said.mode === "TELEOP" && said.held.reason === "teleop") return []; // it is, and drives
  const why = said.held.reason === "fault" ? causeWords(said.held.id) : null;
  return [word("held", said.held.reason), ...(why ? [why] : [])];
}

/** Say that only a reset helps; in FAULT, the one thing that status waits for is the fault. */
function latched(said: Status): string[] {
  if (!["ESTOPPED", "FAULT"].includes(said.mode)) return [];
  const faults = said.mode === "FAULT" ? said.waiting_for : [];
  return [...faults.map((code) => causeWords(code) ?? named(code)), t("notice.latched")];
}

/** Say why no planner owns the robot, where one asked. */
function refused(said: Status): string[] {
  if (said.owner !== null) return [];
  return said.answers
    .filter((answer) => answer.kind === "hello" && !answer.accepted)
    .map((answer) => causeWords(answer.code))
    .filter((words) => words !== null);
}

function waiting(said: Status): string[] {
  if (said.mode === "FAULT") return [];
  const up = new Set(said.rows.map((row) => row.row.toLowerCase()));
  const codes = said.waiting_for.filter((code) => !up.has(code) && !UNRECORDED.has(code));
  const comma = t("notice.comma");
  return codes.length > 0 ? [t("notice.waiting", { what: codes.map(named).join(comma) })] : [];
}

/** Name what is waited for; some wants bear a row's name in lower case. */
export const named = (code: string): string =>
  wantWords(code) ?? causeWords(code) ?? code.replaceAll("_", " ");
