/** Lead a person from an empty folder to a robot that knows its rooms: one next act at a time. */
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { say, t } from "../i18n";
import {
  choosePreset,
  fetchWizard,
  lookAround,
  mapHome,
  saveMap,
  takeRobot,
  type StepName,
  type WizardState,
  writeRobot,
} from "../net/wizard";
import { explain, tell } from "../state/note";
import { open } from "../state/store";
import { inSetup } from "../state/trial";
import { toGoalBox, toTeaching } from "./Tabs";

const wizard = signal<WizardState | null>(null); // null: not known, or not ours to see
const busy = signal(false);
const isTaking = signal(false);
const chosen = signal("");
const typed = signal<Readonly<Record<string, string>>>({});

const NUMBERS = ["wheel_radius_m", "wheel_separation_m", "radius_m"] as const;
const MARKS = { done: "✓", now: "→", later: "·" } as const;

async function look(): Promise<void> {
  wizard.value = await fetchWizard().catch(() => null);
}

async function attempt(work: () => Promise<WizardState>): Promise<void> {
  if (busy.value) return;
  busy.value = true;
  try {
    wizard.value = await work();
  } catch (error) {
    tell(explain(error), true);
  } finally {
    busy.value = false;
  }
}

/** Ask for what takes this planner's place; the page comes back by itself. */
async function changeOver(ask: () => Promise<void>): Promise<void> {
  if (isTaking.value) return;
  isTaking.value = true;
  try {
    await ask();
  } catch (error) {
    isTaking.value = false;
    tell(explain(error), true);
  }
}

export function Wizard() {
  const isSetUp = inSetup.value;
  const isOpen = open.value;
  useEffect(() => {
    if (!isOpen) return; // what was seen stays in view until another start answers
    isTaking.value = false;
    void look();
  }, [isSetUp, isOpen]);
  const now = wizard.value;
  if (now === null || now.step === null) return null;
  return (
    <section class="card" aria-labelledby="wizard-title" id="wizard" data-step={now.step}>
      <h2 id="wizard-title">{t("wizard.title")}</h2>
      <ol class="wizard" aria-label={t("wizard.steps")}>
        {now.steps.map((step) => {
          const state = step === now.step ? "now" : now.done.includes(step) ? "done" : "later";
          return (
            <li key={step} data-state={state} aria-current={state === "now" ? "step" : undefined}>
              <p>
                <span aria-hidden="true">{MARKS[state]} </span>
                {t(`wizard.${step}`)}
              </p>
              {state === "now" && <NextAct step={step} now={now} />}
            </li>
          );
        })}
      </ol>
      {now.mapping !== null && now.step !== "map" && <MapIt now={now} />}
    </section>
  );
}

type StepProps = { readonly now: WizardState };

function NextAct({ step, now }: StepProps & { readonly step: StepName }) {
  switch (step) {
    case "look":
      return (
        <>
          <p class="fine">{t("wizard.look.what")}</p>
          <LookButton again={false} />
        </>
      );
    case "choose":
      return <Choose now={now} />;
    case "measure":
      return <Measure now={now} />;
    case "try":
      return <TryIt now={now} />;
    case "map":
      return <MapIt now={now} />;
    case "rooms":
      return (
        <button type="button" class="main" onClick={toTeaching}>
          {t("wizard.rooms.do")}
        </button>
      );
  }
}

function LookButton({ again }: { readonly again: boolean }) {
  const words = busy.value ? "wizard.look.doing" : again ? "wizard.look.again" : "wizard.look.do";
  return (
    <button
      type="button"
      class={again ? "" : "main"}
      disabled={busy.value}
      onClick={() => void attempt(lookAround)}
    >
      {t(words)}
    </button>
  );
}

function Choose({ now }: StepProps) {
  const ports = now.ports ?? [];
  return (
    <form
      onSubmit={(event) => {
        event.preventDefault();
        void attempt(() => choosePreset(chosen.value));
      }}
    >
      {ports.every((port) => port.device === "") && <p>{t("wizard.found.none")}</p>}
      <ul class="rows">
        {ports.map((port) => (
          <li key={port.path} data-code={port.code}>
            <strong>{port.path}</strong>
            {port.device && <span>{port.device}</span>}
            {port.cure && <span class="reason">{say(port.cure)}</span>}
          </li>
        ))}
      </ul>
      <fieldset class="presets">
        <legend class="fine">{t("wizard.choose")}</legend>
        {now.presets?.map((preset) => (
          <label key={preset.name} class="check">
            <input
              type="radio"
              name="preset"
              value={preset.name}
              checked={chosen.value === preset.name}
              onChange={() => (chosen.value = preset.name)}
            />
            <span>
              <strong>{preset.name}</strong>
              {preset.fits > 0 && ` (${t("wizard.choose.fits")})`}
              <small class="fine"> {preset.what}</small>
            </span>
          </label>
        ))}
      </fieldset>
      <div class="buttons">
        <button type="submit" class="main" disabled={chosen.value === "" || busy.value}>
          {t("wizard.choose.do")}
        </button>
        <LookButton again />
      </div>
    </form>
  );
}

const numberOf = (name: string): number => Number((typed.value[name] ?? "").replace(",", "."));

function Measure({ now }: StepProps) {
  const base = now.presets?.find((preset) => preset.name === now.preset)?.base ?? {};
  const name = (typed.value.name ?? "").trim();
  const whole = /^[a-z0-9][a-z0-9_-]{0,31}$/.test(name) && NUMBERS.every((n) => numberOf(n) > 0);
  return (
    <form
      onSubmit={(event) => {
        event.preventDefault();
        const [wheel_radius_m, wheel_separation_m, radius_m] = [
          numberOf("wheel_radius_m"),
          numberOf("wheel_separation_m"),
          numberOf("radius_m"),
        ];
        void attempt(() => writeRobot({ name, wheel_radius_m, wheel_separation_m, radius_m }));
      }}
    >
      {(["name", ...NUMBERS] as const).map((key) => (
        <div class="field" key={key}>
          <label for={`measure-${key}`}>{t(`wizard.measure.${key}`)}</label>
          <input
            id={`measure-${key}`}
            aria-describedby={`measure-${key}-why`}
            inputMode={key === "name" ? "text" : "decimal"}
            maxLength={32}
            placeholder={key === "name" ? "rover" : String(base[key] ?? "")}
            value={typed.value[key] ?? ""}
            onInput={(event) =>
              (typed.value = { ...typed.value, [key]: event.currentTarget.value })
            }
          />
          <small id={`measure-${key}-why`}>{t(`wizard.measure.${key}.why`)}</small>
        </div>
      ))}
      <button type="submit" class="main" disabled={!whole || busy.value}>
        {t("wizard.measure.do")}
      </button>
    </form>
  );
}

function TryIt({ now }: StepProps) {
  if (inSetup.value) return <p class="fine">{t("wizard.try.here")}</p>;
  if (!now.can_take) return <Command about={t("wizard.try.command")} lines={["pons up"]} />;
  return (
    <>
      <p class="fine">{t("wizard.try.take")}</p>
      <button
        type="button"
        class="main"
        disabled={isTaking.value}
        onClick={() => void changeOver(takeRobot)}
      >
        {t(isTaking.value ? "wizard.taking" : "wizard.try.do")}
      </button>
    </>
  );
}

function MapIt({ now }: StepProps) {
  if (!now.can_map) {
    const name = now.mapping ?? "home";
    const lines = [`pons up --map ${name}`, "pons arm", 'pons say "explore the house"'];
    return (
      <Command about={t("wizard.map.what")} lines={[...lines, `pons map ${name}`, "pons up"]} />
    );
  }
  const maps = now.mapping !== null;
  const doing = maps ? "wizard.map.saving" : "wizard.taking";
  return (
    <>
      <p class="fine">{t(maps ? "wizard.map.drive" : "wizard.map.begin")}</p>
      <div class="buttons">
        {maps && (
          <button type="button" onClick={toGoalBox}>
            {t("wizard.map.go")}
          </button>
        )}
        <button
          type="button"
          class="main"
          id={maps ? "map-save" : "map-begin"}
          disabled={isTaking.value}
          onClick={() => void changeOver(maps ? saveMap : mapHome)}
        >
          {t(isTaking.value ? doing : maps ? "wizard.map.save" : "wizard.map.do")}
        </button>
      </div>
    </>
  );
}

function Command({ about, lines }: { readonly about: string; readonly lines: readonly string[] }) {
  return (
    <>
      <p class="fine">{about}</p>
      <pre>{lines.join("\n")}</pre>
    </>
  );
}
