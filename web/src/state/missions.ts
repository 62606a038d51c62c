/** Keep the list of missions, the questions asked of it, and the one that is looked at. */
import { signal } from "@preact/signals";
import { call, fetchMissionPage, RECORDED_MS } from "../net/api";
import { language } from "../i18n";
import { attempt } from "./acts";
import type { Mission, MissionPage, MissionRow, Track } from "../wire/missions";

export const STATES = ["succeeded", "failed", "cancelled", "refused", "paused", "running"] as const;
const PAGE = 50;
const SAVED_MS = 60_000; // some browsers ask first where to save

export type Wanted = { readonly day: string; readonly state: string; readonly search: string };

export const wanted = signal<Wanted>({ day: "", state: "", search: "" });
export const missions = signal<readonly MissionRow[] | null>(null);
export const more = signal<number | null>(null);
export const shown = signal<Mission | null>(null);
export const track = signal<Track | null>(null);
export const failed = signal(false);

/** Return the question as the planner takes it; a day is one of this device's clock. */
export function question({ day, state, search }: Wanted, before: number | null): string {
  const asked = new URLSearchParams({ limit: String(PAGE) });
  const begin = day === "" ? Number.NaN : new Date(`${day}T00:00`).getTime() / 1000;
  if (Number.isFinite(begin)) {
    const end = new Date(`${day}T00:00`);
    end.setDate(end.getDate() + 1); // a day that changes the clock is no 24 hours long
    asked.set("since_unix_s", String(begin));
    asked.set("until_unix_s", String(end.getTime() / 1000));
  }
  if (state !== "") asked.set("state", state);
  if (search.trim() !== "") asked.set("search", search.trim());
  if (before !== null) asked.set("before", String(before));
  return `v1/history?${asked}`;
}

let newest = 0;

/** Load the list from its beginning, or on from where it ends; a later question wins. */
export async function load(before: number | null = null): Promise<void> {
  const mine = ++newest;
  try {
    const page = (await call("GET", question(wanted.value, before))) as MissionPage;
    if (mine !== newest) return;
    missions.value = before === null ? page.goals : [...(missions.value ?? []), ...page.goals];
    more.value = page.next;
    failed.value = false;
  } catch {
    if (mine === newest) failed.value = true;
  }
}

/** Look at one mission, and then at its recording; null: at none. */
export async function look(id: string | null): Promise<void> {
  shown.value = track.value = null;
  if (id === null) return;
  const path = `v1/history/${encodeURIComponent(id)}`;
  try {
    const mission = (await call("GET", path)) as Mission;
    shown.value = mission;
    const way = (await call("GET", `${path}/track`, undefined, {}, RECORDED_MS)) as Track;
    if (shown.peek() === mission) track.value = way;
  } catch {
    failed.value = true;
  }
}

/** Save a mission as one HTML file, which needs no network. */
export function share(id: string): Promise<boolean> {
  return attempt(async () => {
    const address = URL.createObjectURL(await fetchMissionPage(id, language.peek()));
    const link = document.createElement("a");
    link.href = address;
    link.download = `pons-${id}.html`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(address), SAVED_MS);
    return undefined;
  });
}
