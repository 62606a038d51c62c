/** Write numbers for people; a number that is not there is a dash. */
import { language, t } from "../i18n";

export function fixed(value: number | null | undefined, digits: number, unit = ""): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const text = value.toFixed(digits);
  const shown = Number(text) === 0 ? (0).toFixed(digits) : text; // never "-0.00"
  return unit ? `${shown} ${unit}` : shown;
}

/** Write how far it is still: tenths only where it is near, so that a far figure rests. */
export const wayLeft = (metres: number): string => fixed(metres, metres < 3 ? 1 : 0, "m");

/** Write a measured speed in steps of 0.05 m/s: a finer figure trembles while nothing changes. */
export const steadySpeed = (mps: number): string =>
  (Math.max(1, Math.round(20 * Math.abs(mps))) / 20).toFixed(2);

export const percent = (share: number): string => `${Math.round(100 * Math.max(0, share))} %`;

/** Write an age: tenths while it is young, then whole seconds, minutes, hours. */
export function seconds(value: number | null): string {
  if (value === null || !Number.isFinite(value)) return "–";
  if (value < 10) return t("unit.s", { n: value.toFixed(1) });
  if (value < 120) return t("unit.s", { n: String(Math.round(value)) });
  if (value < 7200) return t("unit.min", { n: String(Math.round(value / 60)) });
  return t("unit.h", { n: String(Math.round(value / 3600)) });
}

/** Write when something was: the time of day, with its date where that is not today's. */
export function when(wallMs: number, nowMs: number): string {
  const then = new Date(wallMs);
  const time = clock(wallMs).slice(0, 5);
  if (then.toDateString() === new Date(nowMs).toDateString()) return time;
  const tongue = language.value === "zh" ? "zh-CN" : "en";
  return `${then.toLocaleDateString(tongue, { month: "short", day: "numeric" })} ${time}`;
}

export function clock(wallMs: number): string {
  const time = new Date(wallMs);
  return [time.getHours(), time.getMinutes(), time.getSeconds()]
    .map((part) => String(part).padStart(2, "0"))
    .join(":");
}
