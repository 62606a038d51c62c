/** Say how a standing order stands that is not active. */
import { t } from "../i18n";
import type { Firing, StandingOrder } from "../wire/types";

/** Show an instant as the robot's own clock has it: the reader may be elsewhere. */
export const localTime = (iso: string): string => iso.slice(0, 16).replace("T", " ");

/** Say whether it is over or paused, and until when, where that ends by itself. */
export const standsWords = (
  state: Exclude<StandingOrder["state"], "active">,
  resumes: string | null,
): string =>
  state === "paused" && resumes !== null
    ? t("orders.paused_until", { time: localTime(resumes) })
    : t(`orders.${state}`);

/** Say what became of a run. */
export function runWords(firing: Firing): string {
  switch (firing.state) {
    case "begun":
      return t("orders.begun");
    case "given":
      return t("orders.given");
    case "ended":
      return t("orders.done");
    case "missed":
      return t("orders.missed");
    case "quiet":
      return t("orders.left_out");
  }
}
