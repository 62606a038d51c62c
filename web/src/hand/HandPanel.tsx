/** Show the stick: who drives, why the robot stands, and what becomes of the goal under way. */
import { computed, signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { t, word } from "../i18n";
import { act } from "../state/acts";
import { bridgeFresh, currentGoals, log, pageFresh, shown, shownStatus } from "../state/store";
import { steady } from "../state/steady";
import { inSetup } from "../state/trial";
import { reasons } from "../panels/reasons";
import { isGate, limitWords } from "../panels/steps";
import { deflection, keysDeflection, steers } from "./inputs";
import { callMyself, drop, hand, openStick, ownId, ownName, padName, share, take } from "./stick";

const opened = signal(false);
const SHARES = { slow: 0.4, middle: 0.7, full: 1 } as const;

export function HandPanel() {
  const driver = inSetup.value ? null : driverNow.value;
  return (
    <section class="card hand" id="hand" aria-label={t("hand.title")}>
      <details open={opened.value} onToggle={(event) => (opened.value = event.currentTarget.open)}>
        <summary>
          {t("hand.title")}
          {driver !== null && (
            <span class="chip hand-driver" dir="auto">
              {othersWords(driver)}
            </span>
          )}
        </summary>
        {opened.value && (inSetup.value ? <p>{t("hand.setup")}</p> : <Stick />)}
      </details>
    </section>
  );
}

/** The stick as it is shown: its clock ticks twenty times a second, and nobody sees that. */
const stickNow = steady(() => {
  const { open, held, driving, why, forward, left } = hand.value;
  return { open, held, driving, why, forward, left };
});

/** The name of another hand that drives, as far as that is known now. */
const driverNow = steady(() => {
  const driver = pageFresh.value && bridgeFresh.value ? (shown.value?.driver ?? null) : null;
  return driver === null || driver.id === ownId.value ? null : driver.name;
});

/** What of its surroundings holds the robot back now. */
const gateNow = steady(() => {
  const by = shownStatus.value?.limits.by ?? "";
  return isGate(by) ? by : null;
});

const othersWords = (name: string): string =>
  name === "" ? t("hand.someone") : t("hand.other", { name });

function Stick() {
  useEffect(openStick, []);
  return (
    <>
      <p class={`hand-state ${stickNow.value.driving ? "good" : ""}`} id="hand-state" role="status">
        {words()}
      </p>
      <Knob />
      <Stands />
      <Goal />
      <p class="fine" id="hand-how">
        {t("hand.how")} {padName.value !== null && t("hand.pad")}
      </p>
      <Speed />
      <label class="field">
        <span>{t("hand.name")}</span>
        <input
          type="text"
          autocomplete="nickname"
          maxLength={40}
          value={ownName.value}
          onInput={(event) => callMyself(event.currentTarget.value)}
        />
      </label>
    </>
  );
}

/** Say who drives, and to whom asked for the stick meanwhile when it is free; else why nobody does. */
function words(): string {
  const { open, held, driving, why } = stickNow.value;
  const gate = gateNow.value;
  if (driving) return gate === null ? t("hand.you") : t("hand.gated", { what: limitWords(gate) });
  const other = driverNow.value;
  const refused = why === "hand_taken"; // so only while that hand drives
  if (other !== null && held === null)
    return refused ? `${othersWords(other)} ${word("hand.why", why)}` : othersWords(other);
  if (why !== null && !refused) return word("hand.why", why);
  if (!open) return t("hand.connecting");
  return t(held === null ? "hand.ready" : "hand.asking");
}

/** What keeps the robot standing under a hand; its own hold after a hand does not. */
const standing = steady(() => {
  const said = shownStatus.value;
  if (said === null) return null;
  const byHand = said.held?.reason === "teleop" ? { ...said, held: null } : said;
  return reasons(byHand, log.value)[0] ?? null;
});

function Stands() {
  if (stickNow.value.driving || standing.value === null) return null;
  return (
    <p class="reason" id="hand-stands">
      {t("hand.stands", { why: standing.value })}
    </p>
  );
}

const underWay = computed(() =>
  currentGoals.value.find(
    ({ state, reason }) => state === "running" || (state === "paused" && reason === "teleop"),
  ),
);

/** Say what a hand does to the goal under way, and offer to go on with it. */
function Goal() {
  const goal = underWay.value;
  if (!goal) return null;
  const paused = goal.state === "paused";
  return (
    <div class="hand-goal" data-goal={goal.id}>
      <p dir="auto">{t(paused ? "hand.paused" : "hand.pauses", { text: goal.text })}</p>
      {paused && (
        <button type="button" onClick={() => void act(goal, "resume")}>
          {t("goal.resume")}
        </button>
      )}
    </div>
  );
}

function Speed() {
  return (
    <fieldset class="hand-speed">
      <legend>{t("hand.speed")}</legend>
      {(["slow", "middle", "full"] as const).map((name) => (
        <label key={name}>
          <input
            type="radio"
            name="hand-speed"
            checked={share.value === SHARES[name]}
            onChange={() => (share.value = SHARES[name])}
          />
          {t(`hand.${name}`)}
        </label>
      ))}
    </fieldset>
  );
}

/** Where a finger took the stick [px]: what the page shows above it meanwhile moves nothing. */
type Finger = {
  readonly id: number;
  readonly x: number;
  readonly y: number;
  readonly way: number;
};

/** Hold and push it: by finger or mouse, by keys while it has the focus, or by a gamepad. */
function Knob() {
  const finger = useRef<Finger | null>(null);
  const down = useRef(new Set<string>());
  const asked = (event: PointerEvent) => {
    const { x, y, way } = finger.current ?? { x: 0, y: 0, way: 0 };
    return deflection(event.clientX - x, event.clientY - y, way);
  };
  const lift = (event: PointerEvent, end: () => void): void => {
    if (finger.current?.id !== event.pointerId) return;
    finger.current = null;
    end();
  };
  const release = (): void => take({ type: "release", source: "pointer" });
  const { forward, left, held, driving } = stickNow.value;
  return (
    <div
      id="stick"
      class={`stick ${driving ? "drives" : held ? "held" : ""}`}
      role="application"
      tabIndex={0}
      aria-label={t("hand.stick")}
      aria-describedby="hand-how"
      onContextMenu={(event) => event.preventDefault()} // a long press is no menu
      onPointerDown={(event) => {
        if (event.button !== 0 || finger.current !== null) return;
        const { left, top, width, height } = event.currentTarget.getBoundingClientRect();
        const [x, y] = [left + width / 2, top + height / 2];
        finger.current = { id: event.pointerId, x, y, way: width * 0.36 };
        event.currentTarget.setPointerCapture(event.pointerId);
        take({ type: "press", source: "pointer", ...asked(event) });
      }}
      onPointerMove={(event) => {
        if (finger.current?.id === event.pointerId)
          take({ type: "steer", source: "pointer", ...asked(event) });
      }}
      onPointerUp={(event) => lift(event, release)}
      onPointerCancel={(event) => lift(event, () => drop("cancelled"))}
      onLostPointerCapture={(event) => lift(event, () => drop("cancelled"))}
      onKeyDown={(event) => {
        if (!steers(event.code) || event.ctrlKey || event.metaKey || event.altKey) return;
        event.preventDefault(); // it must not scroll too
        if (event.repeat) return;
        down.current.add(event.code);
        const type = down.current.size === 1 ? "press" : "steer";
        take({ type, source: "keys", ...keysDeflection(down.current) });
      }}
      onKeyUp={(event) => {
        if (!down.current.delete(event.code)) return;
        if (down.current.size === 0) take({ type: "release", source: "keys" });
        else take({ type: "steer", source: "keys", ...keysDeflection(down.current) });
      }}
      onBlur={() => {
        down.current.clear();
        if (hand.peek().held === "keys") drop("blur");
      }}
    >
      <span
        class="knob"
        style={{ transform: `translate(${-left * 100}%, ${-forward * 100}%)` }}
        aria-hidden="true"
      />
    </div>
  );
}
