/** Say how a step goes and what came of it: what was asked, what was reached, what is left. Pure. */
import { t } from "../i18n";
import type { Step } from "../wire/types";
import { fixed, wayLeft } from "./format";
import { spotWords } from "./steps";

export const degrees = (radians: number): string => `${fixed((radians * 180) / Math.PI, 0)}°`;

const known = (value: number | null | undefined): value is number => typeof value === "number";

/** Return the figures of a step, in the order in which a person asks for them. */
export function verdict(step: Step): string[] {
  return step.state === "running" ? ahead(step) : done(step);
}

function ahead(step: Step): string[] {
  const figures: string[] = [];
  if (known(step.left_m)) figures.push(t("step.to_go", { left: wayLeft(step.left_m) }));
  if (known(step.left_rad)) figures.push(t("step.to_go", { left: degrees(step.left_rad) }));
  if (known(step.left_s)) figures.push(t("step.to_go", { left: fixed(step.left_s, 0, "s") }));
  return [...figures, ...visited(step), ...bill(step)];
}

function done(step: Step): string[] {
  const figures: string[] = visited(step);
  const where = spotWords(step.reached ?? null);
  if (where) figures.push(t("step.reached", { what: where }));
  if (known(step.moved_m))
    figures.push(t("step.by_odometry", { came: fixed(step.moved_m, 2, "m") }));
  if (known(step.turned_rad)) {
    figures.push(t("step.by_odometry", { came: degrees(step.turned_rad) }));
  }
  if (known(step.residual_m)) {
    figures.push(t("step.left", { metres: fixed(step.residual_m, 2, "m") }));
  }
  if (step.answer) figures.push(t("step.answered", { text: step.answer }));
  return [...figures, ...bill(step)];
}

function visited(step: Step): string[] {
  if (!known(step.visited)) return [];
  return [t("step.visited", { n: String(step.visited), of: String(step.places.length) })];
}

/** Return what a search by the vision model has cost, and while it runs what it may cost. */
function bill(step: Step): string[] {
  const own = step.bill;
  if (!own) return [];
  const money = (amount: number | null): string =>
    known(amount) ? ` · ${amount.toPrecision(3)} ${own.currency ?? ""}` : "";
  const spent = {
    pictures: String(own.pictures),
    money: money(own.money),
  };
  if (step.state !== "running") return [t("step.bill", spent)];
  const most = {
    most: String(own.pictures_most),
    money_most: money(own.money_most),
  };
  return [t("step.bill_so_far", spent), t("step.bill_most", most)];
}
