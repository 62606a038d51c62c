/** Name what the planner tells of missions that were. Types only. */
import type { Bilingual, Goal } from "./types";

export type MissionRow = {
  readonly id: string;
  readonly order: number;
  readonly created_unix_s: number;
  readonly seconds: number | null;
  readonly state: string;
  readonly text: string;
  readonly source: string;
  readonly metres: number;
  readonly told: Partial<Bilingual>;
};

export type MissionPage = { readonly goals: readonly MissionRow[]; readonly next: number | null };

export type Mission = {
  readonly goal: Goal;
  readonly story: {
    readonly source: string;
    readonly questions: readonly string[];
    readonly replies: readonly string[];
    readonly metres: number;
    readonly changes: readonly { readonly state: string; readonly at_unix_s: number }[];
  };
  readonly usage: {
    readonly model: string | null;
    readonly currency: string | null;
    readonly goal: { readonly calls: number; readonly money: number } | null;
  };
};

export type TrackSample = {
  readonly s: number;
  readonly x_m: number | null;
  readonly y_m: number | null;
  readonly yaw_rad: number | null;
  readonly asked_mps: number;
  readonly measured_mps: number;
  readonly mode: string;
  readonly rows: readonly string[];
};

export type Track = {
  readonly samples: readonly TrackSample[];
  readonly events: readonly {
    readonly s: number;
    readonly code: string;
    readonly detail: string;
  }[];
  readonly gaps: readonly (readonly [number, number])[];
  readonly way_m: number;
};
