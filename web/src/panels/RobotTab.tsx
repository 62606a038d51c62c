/** Gather what the bridge says of itself, and the orders that are none of a goal's. */
import { rowWords, say, t, word } from "../i18n";
import { forgetKey, hasKey, needsKey } from "../net/proof";
import { Plots } from "../plots/Plots";
import { fresh } from "../state/moment";
import {
  about,
  age,
  bridgeFresh,
  gaps,
  ignored,
  mind,
  pageFresh,
  poseTrouble,
  shown,
  setup,
  shownStatus,
} from "../state/store";
import { headlineNow } from "../state/facts";
import { busy, enter, inSetup } from "../state/trial";
import type { Status } from "../wire/types";
import { Deliberate, KeyBox } from "./Deliberate";
import { fixed, seconds } from "./format";
import { Here } from "./Here";
import { Match } from "./Match";
import { mindWords } from "./MindLine";
import { PeoplePanel } from "./PeoplePanel";
import { limitWords, nameOf } from "./steps";
import { ThemePanel } from "./ThemePanel";

type Pair = readonly [label: string, value: string];

function Pairs({ pairs }: { pairs: readonly Pair[] }) {
  return (
    <dl class="pairs">
      {pairs.map(([label, value]) => (
        <div key={label}>
          <dt>{label}</dt>
          <dd>{value}</dd>
        </div>
      ))}
    </dl>
  );
}

export function RobotTab() {
  const said = shownStatus.value;
  const stale = bridgeFresh.value ? "" : "stale";
  return (
    <>
      {setup.value?.is_there && !inSetup.value && <EnterSetup />}
      <section class="card" aria-labelledby="orders-title" hidden={inSetup.value}>
        <h2 id="orders-title">{t("robot.orders")}</h2>
        <div class="orders">
          <Deliberate kind="arm" where="robot" />
          <Deliberate kind="disarm" where="robot" />
          <Deliberate kind="reset" where="robot" />
          <Deliberate kind="resume" where="robot" />
          <Deliberate kind="estop" where="robot" />
        </div>
        {needsKey(said) && !hasKey.value && <KeyBox />}
        {hasKey.value && (
          <button type="button" onClick={forgetKey}>
            {t("op.key.forget")}
          </button>
        )}
      </section>
      {shown.value?.localizer && (
        <section class="card" aria-labelledby="here-title" id="here">
          <h2 id="here-title">{t("here.title")}</h2>
          <p class="fine">
            {poseTrouble.value
              ? say(poseTrouble.value.message)
              : t(`here.now_${shown.value.localizer}`)}
          </p>
          <Match />
          <Here />
        </section>
      )}
      {said && (
        <div class={stale}>
          <State said={said} />
          <Limits said={said} />
          <Rows said={said} />
        </div>
      )}
      <WhoPlans />
      <PeoplePanel />
      <ThemePanel />
      <Links />
      <Plots />
      {about.value && (
        <p class="fine" id="version">
          Pons {about.value.version}
        </p>
      )}
    </>
  );
}

/** Offer set-up in the bridge's place; asked twice, as all that changes who is in charge. */
function EnterSetup() {
  const disarmed = shownStatus.value?.mode === "DISARMED";
  return (
    <section class="card" aria-labelledby="enter-title" id="enter-setup">
      <h2 id="enter-title">{t("setup.title")}</h2>
      <p class="fine">{t("setup.why")}</p>
      <details>
        <summary>{t("setup.enter")} …</summary>
        <p>{t(disarmed ? "setup.enter.ask" : "setup.enter.disarm")}</p>
        <div class="buttons">
          <button
            type="button"
            class="main"
            disabled={!disarmed || busy.value}
            onClick={() => void enter()}
          >
            {t("setup.enter.yes")}
          </button>
        </div>
      </details>
    </section>
  );
}

function State({ said }: { said: Status }) {
  const pose = said.base_in_map;
  const drive = [
    said.drive.virtual ? t("robot.virtual") : said.drive.kind,
    said.drive.enabled ? t("robot.powered") : t("robot.unpowered"),
  ].join(", ");
  return (
    <section class="card" aria-labelledby="state-title">
      <h2 id="state-title">
        {t("robot.state")}
        {!bridgeFresh.value && (
          <span class="old"> {t("link.age", { age: seconds(age("status")) })}</span>
        )}
      </h2>
      <Pairs
        pairs={[
          [t("robot.mode"), t(headlineNow.value.word)],
          [t("robot.held"), said.held ? word("reason", said.held.reason) : t("robot.no")],
          [t("robot.room"), nameOf(shown.value?.room ?? null) || "–"],
          [
            t("robot.pose"),
            pose
              ? `${fixed(pose.x_m, 2)}, ${fixed(pose.y_m, 2)} m, ${fixed((pose.yaw_rad * 180) / Math.PI, 0)}°`
              : "–",
          ],
          [t("robot.drive"), drive],
          [
            t("robot.battery"),
            said.drive.battery === null ? "–" : fixed(said.drive.battery * 100, 0, "%"),
          ],
        ]}
      />
      <details>
        <summary class="fine">{t("now.details")}</summary>
        <Pairs
          pairs={[
            [t("robot.mode"), said.mode],
            [t("robot.owner"), said.owner?.planner_id ?? t("robot.nobody")],
            [t("robot.epoch"), said.epoch],
          ]}
        />
      </details>
      <Speeds said={said} />
    </section>
  );
}

const TWISTS = ["asked", "sent", "measured"] as const;

function Speeds({ said }: { said: Status }) {
  return (
    <table class="speeds">
      <thead>
        <tr>
          <td />
          {TWISTS.map((name) => (
            <th key={name} scope="col">
              {t(`plot.${name}`)}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        <tr>
          <th scope="row">{t("robot.speed")}</th>
          {TWISTS.map((name) => (
            <td key={name}>{fixed(said[name].v_mps, 2)}</td>
          ))}
        </tr>
        <tr>
          <th scope="row">{t("robot.turn")}</th>
          {TWISTS.map((name) => (
            <td key={name}>{fixed(said[name].w_radps, 2)}</td>
          ))}
        </tr>
      </tbody>
    </table>
  );
}

function Limits({ said }: { said: Status }) {
  const { limits } = said;
  return (
    <section class="card" aria-labelledby="limits-title">
      <h2 id="limits-title">{t("limits.title")}</h2>
      <Pairs
        pairs={[
          [t("limits.speed"), fixed(limits.v_mps, 2, "m/s")],
          [t("limits.turn"), fixed(limits.w_radps, 2, "rad/s")],
          [t("limits.by"), limitWords(limits.by)],
          [t("limits.free"), fixed(limits.free_m, 2, "m")],
          [t("limits.margin"), fixed(limits.margin_m, 2, "m")],
          [
            t("limits.left"),
            `${fixed(said.operator_metres, 0, "m")}, ${seconds(said.operator_seconds)}`,
          ],
        ]}
      />
    </section>
  );
}

function Rows({ said }: { said: Status }) {
  return (
    <section class="card" aria-labelledby="rows-title">
      <h2 id="rows-title">{t("rows.title")}</h2>
      {said.rows.length === 0 && <p class="fine">{t("rows.none")}</p>}
      <ul class="rows">
        {said.rows.map((row) => (
          <li key={row.row} class={row.binding ? "" : "quiet"}>
            <strong>{rowWords(row.row)}</strong>
            <span class="fine">
              {row.row} · {row.action} · {row.evidence} ·{" "}
              {t("rows.for", { age: seconds(row.for_s) })}
              {!row.binding && ` · ${t("notice.shown_only")}`}
            </span>
          </li>
        ))}
      </ul>
    </section>
  );
}

function WhoPlans() {
  const who = mind.value;
  if (who === null) return null;
  return (
    <section class={`card ${pageFresh.value ? "" : "stale"}`} aria-labelledby="mind-title">
      <h2 id="mind-title">{t("mind.title")}</h2>
      <p>
        {mindWords(who)} {who.last_error && say(who.last_error.message)}
      </p>
    </section>
  );
}

const SOURCES = ["page", "status", "localization", "odometry", "scan"] as const;

function Links() {
  const ticks = shownStatus.value?.ticks;
  return (
    <section class="card" aria-labelledby="links-title" id="links">
      <h2 id="links-title">{t("links.title")}</h2>
      <dl class="pairs">
        {SOURCES.map((source) => (
          <div key={source} class={fresh(age(source)) ? "" : "stale"} data-source={source}>
            <dt>{t(`links.${source}`)}</dt>
            <dd>
              {age(source) === null
                ? t("link.never")
                : t("link.age", { age: seconds(age(source)) })}
            </dd>
          </div>
        ))}
        <div>
          <dt>{t("links.ignored")}</dt>
          <dd id="ignored">{ignored.value}</dd>
        </div>
        <div>
          <dt>{t("links.gaps")}</dt>
          <dd>{gaps.value}</dd>
        </div>
        <div>
          <dt>{t("links.ticks")}</dt>
          <dd>{ticks ? `${ticks.missed} / ${ticks.ticks}` : "–"}</dd>
        </div>
      </dl>
    </section>
  );
}
