/** Hold the owner's settings as they are and as a person has typed them. */
import { computed, signal } from "@preact/signals";
import { t } from "../i18n";
import { ApiError } from "../net/api";
import {
  changeSettings,
  fetchSettings,
  type Reached,
  restartPlanner,
  type Setting,
  type Settings,
  testModel,
  type Value,
} from "../net/settings";
import { isOwner } from "./asker";
import { explain, tell } from "./note";

export const GROUPS = ["model", "eyes", "voice", "limits", "notices", "budget"] as const;
export type Group = (typeof GROUPS)[number];

export const settings = signal<Settings | null>(null);
/** Why they can't be shown; null where they are. */
export const trouble = signal<string | null>(null);
/** What was typed and is not saved, by name; null: to be taken away. */
export const draft = signal<Readonly<Record<string, Value>>>({});
export const reached = signal<Reached | "asking" | null>(null);
export const isBusy = signal(false);
export const isRestarting = signal(false);

export const isPending = computed(() => settings.value?.fields.some((f) => f.is_pending) ?? false);

export async function look(): Promise<void> {
  if (isOwner.peek() === false) {
    trouble.value = t("set.owners");
    return;
  }
  try {
    settings.value = await fetchSettings();
    trouble.value = null;
    isRestarting.value = false;
  } catch (error) {
    if (isRestarting.peek()) return; // it is on its way
    settings.value = null;
    const isOwners = error instanceof ApiError && error.code === "owner_needed";
    trouble.value = isOwners ? t("set.owners") : explain(error);
  }
}

/** Take what a person typed for a setting; what it is already is no change. */
export function type(field: Setting, typed: Value): void {
  const rest = Object.fromEntries(Object.entries(draft.value).filter(([n]) => n !== field.name));
  const same = typed === field.value || (typed === null && !field.is_set);
  draft.value = same ? rest : { ...rest, [field.name]: typed };
}

/** Return what is shown of a setting: as typed, else as saved. */
export const shownValue = (field: Setting): Value =>
  Object.hasOwn(draft.value, field.name) ? (draft.value[field.name] ?? null) : field.value;

/** Return a setting's value from what stands in its box; a number that is none stays a text. */
export function readTyped(field: Setting, text: string): Value {
  const bare = text.trim();
  if (bare === "") return null;
  if (field.kind === "yes") return bare === "true";
  const number = Number(bare.replace(",", "."));
  return field.kind === "number" && Number.isFinite(number) ? number : bare;
}

export const changesOf = (group: string): Readonly<Record<string, Value>> => {
  const names = new Set(settings.value?.fields.filter((f) => f.group === group).map((f) => f.name));
  return Object.fromEntries(Object.entries(draft.value).filter(([name]) => names.has(name)));
};

/** Save what was typed in one group; what was typed in others stays typed. */
export async function save(group: string): Promise<void> {
  const [now, changes] = [settings.value, changesOf(group)];
  if (now === null || isBusy.value) return;
  isBusy.value = true;
  try {
    settings.value = await changeSettings(now.revision, changes);
    draft.value = Object.fromEntries(
      Object.entries(draft.value).filter(([name]) => !Object.hasOwn(changes, name)),
    );
    const waits = settings.value.fields.some((f) => Object.hasOwn(changes, f.name) && f.is_pending);
    tell(t(waits ? "set.saved_pending" : "set.saved"));
  } catch (error) {
    tell(explain(error), true);
    if (error instanceof ApiError && error.code === "settings_changed") await look();
  } finally {
    isBusy.value = false;
  }
}

export async function tryModel(): Promise<void> {
  const typed = draft.value["model.url"];
  reached.value = "asking";
  try {
    reached.value = await testModel(typeof typed === "string" ? typed : null);
  } catch (error) {
    reached.value = null;
    tell(explain(error), true);
  }
}

const LOOK_AGAIN_MS = 1000;

/** Have the planner start again, and look until it has. */
export async function restart(): Promise<void> {
  try {
    await restartPlanner();
  } catch (error) {
    tell(explain(error), true);
    return;
  }
  isRestarting.value = true;
  const timer = setInterval(() => {
    if (isRestarting.value) void look();
    else clearInterval(timer);
  }, LOOK_AGAIN_MS);
}
