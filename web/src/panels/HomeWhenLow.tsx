/** One switch for the order that most want: home when the battery is low. It is a standing order like any other. */
import { t } from "../i18n";
import { keepOrder, turnOrder } from "../state/acts";
import type { StandingOrder } from "../wire/types";

/** Find the order that sends it home on a low battery, where one is kept that is not over. */
export const homeWhenLow = (orders: readonly StandingOrder[]): StandingOrder | undefined =>
  orders.find(
    ({ rule, may, state }) =>
      state !== "ended" &&
      rule.event === "battery_low" &&
      may.length === 1 &&
      may[0]?.kind === "return_home",
  );

/** Give the order, or let the kept one rest or count again: what it did stays in its history. */
export function turnHomeWhenLow(kept: StandingOrder | undefined): Promise<boolean> {
  if (kept === undefined) return keepOrder(t("orders.low_home_said"));
  return turnOrder(kept.id, kept.state === "active" ? "pause" : "resume");
}

export function HomeWhenLow({ orders }: { orders: readonly StandingOrder[] }) {
  const kept = homeWhenLow(orders);
  return (
    <label class="switch">
      <input
        type="checkbox"
        id="home-when-low"
        checked={kept?.state === "active"}
        onChange={(event) => {
          const box = event.currentTarget;
          void turnHomeWhenLow(kept).then((done) => {
            if (!done) box.checked = kept?.state === "active";
          });
        }}
      />
      <span>{t("orders.low_home")}</span>
    </label>
  );
}
