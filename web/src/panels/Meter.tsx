/** Show what the model has cost today, of how much; nothing where no model is set. */
import { language, say, t } from "../i18n";
import { usage } from "../state/store";
import type { Usage } from "../wire/types";

export function Meter() {
  const meter = usage.value;
  if (meter === null || meter.model === null) return null;
  return (
    <section class="card meter" aria-labelledby="meter-title" id="meter">
      <h2 id="meter-title">
        {t("meter.title")}
        {meter.under_way > 0 && <span class="chip state-running">{t("meter.asking")}</span>}
      </h2>
      <p>{meterWords(meter)}</p>
      <progress max={1} value={share(meter)} aria-label={t("meter.share")} />
      {meter.refused && <p class="fell">{say(meter.refused.message)}</p>}
    </section>
  );
}

const number = (value: number): string =>
  value.toLocaleString(language.value === "zh" ? "zh-CN" : "en", { maximumFractionDigits: 2 });

const of = (spent: number, most: number | null): string =>
  most === null ? number(spent) : t("meter.of", { spent: number(spent), most: number(most) });

/** Say the meter in a sentence; money only where a price is set. */
export function meterWords({ today, day_limits: most, currency }: Usage): string {
  const tokens = today.prompt_tokens + today.reply_tokens;
  const parts = [
    t("meter.calls", { n: of(today.calls, most.calls) }),
    t("meter.tokens", { n: number(tokens) }),
    t("meter.seconds", { n: of(Math.round(today.seconds), most.seconds) }),
  ];
  if (currency !== null) parts.push(`${of(today.money, most.money)} ${currency}`);
  return parts.join(" · ");
}

/** Return how much of the tightest limit is spent, 0 to 1. */
export function share({ today, day_limits: most }: Usage): number {
  const shares = (Object.keys(today) as (keyof typeof today)[]).map((what) => {
    const limit = most[what];
    return limit === null || limit <= 0 ? 0 : today[what] / limit;
  });
  return Math.min(1, Math.max(0, ...shares));
}
