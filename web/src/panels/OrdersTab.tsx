/** Give standing orders as sentences; list, pause and remove them; show what became of their runs. */
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { say, t } from "../i18n";
import { fetchHistory, fetchOrders } from "../net/api";
import { keepOrder, turnOrder } from "../state/acts";
import { ordersVersion, pageFresh } from "../state/store";
import { HomeWhenLow } from "./HomeWhenLow";
import { SkillsPanel } from "./SkillsPanel";
import { localTime, runWords, standsWords } from "./standing";
import type { Firing, StandingOrder, StandingOrders } from "../wire/types";

const known = signal<StandingOrders | null>(null);
const sentence = signal("");
const sending = signal(false);
const doubted = signal<string | null>(null); // whose removal is being asked about
const unfolded = signal<string | null>(null); // whose history is shown
const history = signal<readonly Firing[]>([]);

export function OrdersTab() {
  const version = ordersVersion.value;
  useEffect(() => void load(), [version]);
  return (
    <>
      <Give />
      <List />
      <SkillsPanel />
    </>
  );
}

/** Load what is kept; what fails is tried at the next change or connection. */
async function load(): Promise<void> {
  await fetchOrders().then(
    (orders) => (known.value = orders),
    () => undefined,
  );
  if (unfolded.value !== null) await unfold(unfolded.value);
}

async function unfold(id: string): Promise<void> {
  history.value = await fetchHistory(id).catch(() => []);
  unfolded.value = id;
}

async function send(): Promise<void> {
  const text = sentence.value.trim();
  if (text === "" || sending.value) return;
  sending.value = true;
  if (await keepOrder(text)) sentence.value = "";
  sending.value = false;
}

function Give() {
  return (
    <section class="card" aria-labelledby="order-title" id="give-order">
      <h2 id="order-title">{t("orders.give")}</h2>
      <form
        onSubmit={(event) => {
          event.preventDefault();
          void send();
        }}
      >
        <label class="field" for="order-text">
          <span>{t("orders.sentence")}</span>
          {/* No maxLength here: it cuts a paste unseen, and the rest may say "but not …". */}
          <input
            id="order-text"
            type="text"
            dir="auto"
            autocomplete="off"
            value={sentence.value}
            onInput={(event) => (sentence.value = event.currentTarget.value)}
          />
        </label>
        <button type="submit" class="main" disabled={sentence.value.trim() === "" || sending.value}>
          {t("orders.keep")}
        </button>
      </form>
      <p class="fine">{t("orders.how")}</p>
    </section>
  );
}

function List() {
  const orders = known.value;
  return (
    <section
      class={`card ${pageFresh.value ? "" : "stale"}`}
      aria-labelledby="orders-title"
      id="orders"
    >
      <h2 id="orders-title">{t("orders.kept")}</h2>
      {orders && <HomeWhenLow orders={orders.orders} />}
      {orders?.orders.length === 0 && <p class="fine">{t("orders.none")}</p>}
      <ul class="taught">
        {orders?.orders.map((order) => (
          <Line key={order.id} order={order} />
        ))}
      </ul>
      {orders && (
        <p class="fine">
          {t("orders.zone", { zone: orders.timezone })}{" "}
          {orders.quiet !== null && t("orders.quiet", { quiet: orders.quiet })}
        </p>
      )}
    </section>
  );
}

function Line({ order }: { order: StandingOrder }) {
  return (
    <li data-order={order.id} class={order.state === "active" ? "" : "quiet"}>
      <span class="said">
        <strong dir="auto">
          {say(order.when)}: {say(order.does)}
        </strong>
        <span class="fine" dir="auto">
          {order.text}
        </span>
        <span class="fine">
          {order.state !== "active" && `${standsWords(order.state, order.resumes)} · `}
          {order.next !== null && `${t("orders.next", { time: localTime(order.next) })} · `}
          {t("orders.counts", { fired: `${order.fired}`, missed: `${order.missed}` })}
        </span>
        {unfolded.value === order.id && <History />}
      </span>
      <Buttons order={order} />
    </li>
  );
}

function Buttons({ order }: { order: StandingOrder }) {
  const verb = order.state === "paused" ? "resume" : "pause";
  if (doubted.value === order.id)
    return (
      <span class="buttons">
        <button
          type="button"
          class="main"
          onClick={() => {
            doubted.value = null;
            void turnOrder(order.id, "remove");
          }}
        >
          {t("orders.remove_yes")}
        </button>
        <button type="button" class="quiet" onClick={() => (doubted.value = null)}>
          {t("op.no")}
        </button>
      </span>
    );
  return (
    <span class="buttons">
      {order.state !== "ended" && (
        <button type="button" onClick={() => void turnOrder(order.id, verb)}>
          {t(`orders.${verb}`)}
        </button>
      )}
      <button
        type="button"
        aria-expanded={unfolded.value === order.id}
        onClick={() =>
          unfolded.value === order.id ? (unfolded.value = null) : void unfold(order.id)
        }
      >
        {t("orders.history")}
      </button>
      <button type="button" onClick={() => (doubted.value = order.id)}>
        {t("orders.remove")}
      </button>
    </span>
  );
}

function History() {
  if (history.value.length === 0) return <span class="fine">{t("orders.none")}</span>;
  return (
    <ol class="log">
      {history.value.map((firing) => (
        <li key={firing.serial} data-state={firing.state}>
          <time>{localTime(firing.due)}</time>
          <span dir="auto">
            {runWords(firing)}
            {firing.count > 1 && ` × ${firing.count}`}
            {firing.told && <small class="fine">{say(firing.told)}</small>}
            {firing.reason !== null && <small class="fine">{firing.reason}</small>}
          </span>
        </li>
      ))}
    </ol>
  );
}
