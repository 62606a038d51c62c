/** Show the stick: who drives, why the robot stands, and what becomes of the goal under way. */
import { computed, signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { t, word } from "../i18n";
import { act } from "../state/acts";
import { currentGoals, log, shown, shownStatus } from "../state/store";
import { steady } from "../state/steady";
import { inSetup } from "../state/trial";
import { reasons } from "../panels/reasons";
import { deflection, keysDeflection, steers } from "./inputs";
import { callMyself, drop, hand, openStick, ownName, padName, share, take } from "./stick";

const opened = signal(false);
const SHARES = { slow: 0.4, middle: 0.7, full: 1 } as const;

export function HandPanel() {
  const driver = inSetup.value ? null : driverNow.value;
  return (
    <section class="card hand" id="hand" aria-label={t("hand.title")}>
      <details open={opened.value} onToggle={(event) => (opened.value = event.currentTarget.open)}>
        <summary>
          {t("hand.title")}
          {driver !== null && !hand.value.driving && (
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

const driverNow = steady(() => shown.value?.driver?.name ?? null);

const othersWords = (name: string): string =>
  name === "" ? t("hand.someone") : t("hand.other", { name });

function Stick() {
  useEffect(openStick, []);
  return (
    <>
      <p class={`hand-state ${hand.value.driving ? "good" : ""}`} id="hand-state" role="status">
        {words()}
      </p>
      <Stands />
      <Goal />
      <Knob />
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
          onChange={(event) => callMyself(event.currentTarget.value.trim())}
        />
      </label>
    </>
  );
}

/** Say who drives; else why not. */
function words(): string {
  const { open, held, driving, why } = hand.value;
  if (driving) return t("hand.you");
  const other = driverNow.value;
  if (other !== null && held === null) return othersWords(other);
  if (why !== null) return word("hand.why", why);
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
  if (hand.value.driving || standing.value === null) return null;
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

/** Hold and push it: by finger or mouse, by keys while it has the focus, or by a gamepad. */
function Knob() {
  const place = useRef<HTMLDivElement>(null);
  const finger = useRef<number | null>(null);
  const down = useRef(new Set<string>());
  const asked = (event: PointerEvent) => {
    const box = place.current?.getBoundingClientRect();
    if (!box) return { forward: 0, left: 0 };
    const right = event.clientX - box.left - box.width / 2;
    return deflection(right, event.clientY - box.top - box.height / 2, box.width * 0.36);
  };
  const lift = (event: PointerEvent, end: () => void): void => {
    if (finger.current !== event.pointerId) return;
    finger.current = null;
    end();
  };
  const release = (): void => take({ type: "release", source: "pointer" });
  const { forward, left, held, driving } = hand.value;
  return (
    <div
      ref={place}
      id="stick"
      class={`stick ${driving ? "drives" : held ? "held" : ""}`}
      role="application"
      tabIndex={0}
      aria-label={t("hand.stick")}
      aria-describedby="hand-how"
      onContextMenu={(event) => event.preventDefault()} // a long press is no menu
      onPointerDown={(event) => {
        if (event.button !== 0 || finger.current !== null) return;
        finger.current = event.pointerId;
        event.currentTarget.setPointerCapture(event.pointerId);
        take({ type: "press", source: "pointer", ...asked(event) });
      }}
      onPointerMove={(event) => {
        if (finger.current === event.pointerId)
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
