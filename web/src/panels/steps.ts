/** Say one step, and why a goal or step is as it is, in the person's language. */
import { causeWords, hasWord, rowWords, say, t, word } from "../i18n";
import { places } from "../state/store";
import type { Spot, Step } from "../wire/types";
import { fixed } from "./format";

export function nameOf(id: string | null): string {
  const place = places.value.find((known) => known.id === id);
  return place ? say(place.name) : (id ?? "");
}

export function stepWords(step: Step): string {
  const kind = step.kind === "go_to_pose" && step.look ? "look_at_point" : step.kind;
  const template = word(`step`, kind);
  return template === kind ? step.kind : template.replace("{what}", what(step)).trim();
}

/** Say what a step is to the one that holds it, and what a condition came to. */
export function roleWords(step: Step): string {
  if (!step.role) return "";
  const answer = typeof step.holds === "boolean" ? t(step.holds ? "role.yes" : "role.no") : "";
  return [word("role", step.role), answer].filter((words) => words).join(" ");
}

function what(step: Step): string {
  if (step.kind === "repeat") {
    return step.round > 0
      ? t("step.round", { n: `${step.round}`, of: `${step.times ?? 1}` })
      : t("step.times", { of: `${step.times ?? 1}` });
  }
  if (step.kind === "use_tool") {
    return [step.tool ?? "", ...(step.arguments ?? []).filter((given) => given)].join(" · ");
  }
  if (step.kind === "wait_for") return step.object ?? step.word ?? step.time ?? "";
  if (step.kind === "stand_at") return standing(step);
  if (typeof step.x_m === "number") return `(${fixed(step.x_m, 2)}, ${fixed(step.y_m ?? 0, 2)})`;
  if (step.kind === "clock") return `${step.after ?? ""} – ${step.before ?? ""}`;
  if (step.kind === "follow" && step.object) return step.object;
  if (typeof step.seconds === "number") return fixed(step.seconds, 0, "s");
  if (typeof step.angle_rad === "number") return `${fixed((step.angle_rad * 180) / Math.PI, 0)}°`;
  if (typeof step.distance_m === "number") return fixed(step.distance_m, 2, "m");
  const object = step.object ?? step.text ?? "";
  const place = nameOf(step.place) || (step.places ?? []).map(nameOf).join(", ");
  return object && place ? `${object} (${place})` : object || place;
}

function standing(step: Step): string {
  const side = word("side", step.side ?? "before").replace(
    "{what}",
    step.object ?? nameOf(step.place),
  );
  return typeof step.distance_m === "number" ? `${side} (${fixed(step.distance_m, 1, "m")})` : side;
}

const FAULT = /^fault\((\w+)\)$/;

export function reasonWords(reason: string | null): string {
  if (!reason) return "";
  const row = FAULT.exec(reason)?.[1];
  if (!row) return word("reason", reason);
  return causeWords(row) ?? word("reason", row.toLowerCase()); // HELD and FAULT are no rows
}

export function spotWords(spot: Spot | null): string {
  return spot ? nameOf(spot.place ?? spot.room) : "";
}

/** Say what sets a limit: a gate by its name, a row by its sentence. */
export function limitWords(by: string): string {
  return hasWord("by", by) ? word("by", by) : rowWords(by.toUpperCase());
}

const GATES: ReadonlySet<string> = new Set([
  "obstacle",
  "unseen",
  "fence",
  "contact",
  "no_scan",
  "pose_lost",
]);

/** Say whether what bounds the robot is where it is: the number of its speed limit is then not what holds it back. */
export const isGate = (by: string): boolean => GATES.has(by);

/** Name a brain: the built-in one in words, a model by its own name. */
export const brainName = (name: string): string => (name === "offline" ? t("mind.offline") : name);

export const needed = (key: "goal.limited", names: readonly string[]): string =>
  names.length > 0 ? t(key, { what: names.map(limitWords).join(", ") }) : "";
