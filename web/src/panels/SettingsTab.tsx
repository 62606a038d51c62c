/** Show the owner's settings in groups, each with a sentence; save a group as a whole. */
import { useEffect } from "preact/hooks";
import { byWhom, t, word } from "../i18n";
import type { Key } from "../i18n/en";
import type { Setting } from "../net/settings";
import {
  changesOf,
  draft,
  type Group,
  GROUPS,
  isBusy,
  isPending,
  isRestarting,
  look,
  reached,
  readTyped,
  restart,
  save,
  settings,
  shownValue,
  trouble,
  tryModel,
  type,
} from "../state/settings";
import { isOwner } from "../state/asker";
import { inSetup } from "../state/trial";
import { toTeaching } from "./Tabs";
import { ToolsPanel } from "./ToolsPanel";
import { Wizard } from "./Wizard";

export function SettingsTab() {
  useEffect(() => {
    void look();
    return () => {
      draft.value = {}; // a key that was typed isn't left in a page
      reached.value = null;
    };
  }, []);
  const now = settings.value;
  return (
    <>
      {trouble.value !== null && (
        <section class="card" role="alert" id="settings-trouble">
          <p>{trouble.value}</p>
          <button type="button" onClick={() => void look()}>
            {t("set.again")}
          </button>
        </section>
      )}
      {(isPending.value || isRestarting.value) && <NextStart />}
      {now !== null && GROUPS.map((group) => <GroupCard key={group} group={group} />)}
      {now !== null && <ToolsPanel />}
      {now !== null && <Places />}
      {!inSetup.value && isOwner.value !== false && <Wizard />}
    </>
  );
}

function NextStart() {
  const can = settings.value?.can_restart;
  return (
    <section class="card notice tells" id="settings-pending" role="status">
      <p>{t(can ? "set.restart.why" : "set.restart.alone")}</p>
      {can && (
        <button
          type="button"
          class="main"
          disabled={isRestarting.value}
          onClick={() => void restart()}
        >
          {t(isRestarting.value ? "set.restarting" : "set.restart")}
        </button>
      )}
    </section>
  );
}

function GroupCard({ group }: { readonly group: Group }) {
  const fields = settings.value?.fields.filter((field) => field.group === group) ?? [];
  const changed = Object.keys(changesOf(group)).length > 0;
  return (
    <section class="card settings" aria-labelledby={`set-${group}`} data-group={group}>
      <h2 id={`set-${group}`}>{t(`set.group.${group}`)}</h2>
      <p class="fine">{t(`set.group.${group}.why`)}</p>
      <form
        onSubmit={(event) => {
          event.preventDefault();
          void save(group);
        }}
      >
        {fields.map((field) => (
          <Field key={field.name} field={field} />
        ))}
        <div class="buttons">
          <button type="submit" class="main" disabled={!changed || isBusy.value}>
            {t("set.save")}
          </button>
          {group === "model" && <TryModel />}
        </div>
      </form>
    </section>
  );
}

function Field({ field }: { readonly field: Setting }) {
  const [id, why] = [`set-${field.name}`, `why-${field.name}`];
  const fixed = field.source === "environment";
  const notes = [
    fixed && t("set.elsewhere"),
    field.is_pending && t("set.pending"),
    field.in_force === "at_once" && t("set.at_once"),
  ].filter((note): note is string => typeof note === "string");
  return (
    <div class="field" data-setting={field.name}>
      <label for={id}>{t(`set.${field.name}` as Key)}</label>
      <Box field={field} id={id} why={why} fixed={fixed} />
      <small id={why}>
        {t(`set.${field.name}.why` as Key)}
        {notes.length > 0 && ` (${notes.join("; ")})`}
      </small>
    </div>
  );
}

type BoxProps = {
  readonly field: Setting;
  readonly id: string;
  readonly why: string;
  readonly fixed: boolean;
};

function Box({ field, id, why, fixed }: BoxProps) {
  const value = shownValue(field);
  const take = (text: string): void => type(field, readTyped(field, text));
  const common = { id, "aria-describedby": why, disabled: fixed };
  if (field.kind === "choice" || field.kind === "yes") {
    const choices = field.kind === "yes" ? ["true", "false"] : field.choices;
    return (
      <select
        {...common}
        value={value === null ? "" : String(value)}
        onChange={(event) => take(event.currentTarget.value)}
      >
        <option value="">{t("set.default")}</option>
        {choices.map((choice) => (
          <option key={choice} value={choice}>
            {choiceWords(choice)}
          </option>
        ))}
      </select>
    );
  }
  if (field.kind === "secret") return <SecretBox field={field} common={common} take={take} />;
  return (
    <input
      {...common}
      type="text"
      inputMode={field.kind === "number" ? "decimal" : "text"}
      maxLength={2000}
      dir="auto"
      placeholder={t("set.default")}
      value={value === null ? "" : String(value)}
      onInput={(event) => take(event.currentTarget.value)}
    />
  );
}

type SecretProps = {
  readonly field: Setting;
  readonly common: object;
  readonly take: (text: string) => void;
};

/** Take a secret, which is never shown: only whether it is set. */
function SecretBox({ field, common, take }: SecretProps) {
  const typed = Object.hasOwn(draft.value, field.name) ? draft.value[field.name] : "";
  return (
    <span class="secret">
      <input
        {...common}
        type="text"
        autocomplete="off"
        autocapitalize="off"
        spellcheck={false}
        maxLength={2000}
        placeholder={t(field.is_set && typed !== null ? "set.secret_set" : "set.secret_unset")}
        value={typeof typed === "string" ? typed : ""}
        onInput={(event) => take(event.currentTarget.value)}
      />
      {field.is_set && (
        <button
          type="button"
          class="quiet"
          aria-label={`${t("set.take_away")}: ${t(`set.${field.name}` as Key)}`}
          aria-pressed={typed === null}
          onClick={() => (draft.value = { ...draft.value, [field.name]: null })}
        >
          {t("set.take_away")}
        </button>
      )}
    </span>
  );
}

function choiceWords(choice: string): string {
  if (choice === "true" || choice === "false") return t(choice === "true" ? "set.yes" : "set.no");
  const words = word("set.choice", choice);
  return words;
}

function TryModel() {
  const now = reached.value;
  return (
    <>
      <button type="button" disabled={now === "asking"} onClick={() => void tryModel()}>
        {t(now === "asking" ? "set.testing" : "set.test")}
      </button>
      <p id="model-reached" role="status" class={now !== null && now !== "asking" ? "fine" : ""}>
        {now !== null &&
          now !== "asking" &&
          (now.is_reached
            ? t("set.reached", { where: now.where })
            : t("set.unreached", { where: now.where, trouble: now.trouble ?? "" }))}
      </p>
    </>
  );
}

function Places() {
  const last = settings.value?.changes[0];
  return (
    <section class="card">
      <p class="fine">{t("set.names")}</p>
      <button type="button" onClick={toTeaching}>
        {t("set.names.open")}
      </button>
      {last && (
        <p class="fine" id="settings-last">
          {t("set.last", {
            at: new Date(last.at).toLocaleString(document.documentElement.lang),
            by: byWhom(last.by),
            names: last.names.map((name) => t(`set.${name}` as Key)).join(", "),
          })}
        </p>
      )}
    </section>
  );
}
