/** Ask how far the set-up of a robot has come, and do its next step. */
import type { Bilingual } from "../wire/types";
import { call } from "./api";

export type StepName = "look" | "choose" | "measure" | "try" | "map" | "rooms";

export type PluggedIn = {
  readonly path: string;
  readonly code: string;
  readonly device: string;
  readonly cure: Bilingual | null;
};

export type Preset = {
  readonly name: string;
  readonly what: string;
  readonly base: Readonly<Record<string, number>>;
  readonly fits: number;
};

export type WizardState = {
  readonly steps: readonly StepName[];
  readonly done: readonly StepName[];
  readonly step: StepName | null;
  readonly ports: readonly PluggedIn[] | null;
  readonly preset: string | null;
  readonly presets: readonly Preset[] | null;
  readonly is_written: boolean;
  readonly can_take: boolean;
  readonly mapping: string | null;
  readonly can_map: boolean;
};

export type Measures = {
  readonly name: string;
  readonly wheel_radius_m: number;
  readonly wheel_separation_m: number;
  readonly radius_m: number;
};

const PATH = "v1/wizard";
const SAVE_MS = 305_000; // a large home's loops are settled once more
const LOOK_MS = 45_000; // a slow board needs some ten seconds, and a command is given forty

export const fetchWizard = async (): Promise<WizardState> =>
  (await call("GET", PATH, undefined, {}, LOOK_MS)) as WizardState;

export const lookAround = async (): Promise<WizardState> =>
  (await call("POST", `${PATH}/look`, { source: "page" }, {}, LOOK_MS)) as WizardState;

export const choosePreset = async (preset: string): Promise<WizardState> =>
  (await call("POST", `${PATH}/preset`, { preset })) as WizardState;

export const writeRobot = async (measures: Measures): Promise<WizardState> =>
  (await call("POST", `${PATH}/robot`, measures, {}, LOOK_MS)) as WizardState;

/** End the simulated robot; the one that was written takes its place. */
export async function takeRobot(): Promise<void> {
  await call("POST", `${PATH}/take`, { source: "page" });
}

/** Begin a map of this home; what runs ends, and the robot stands until it is driven. */
export async function mapHome(): Promise<void> {
  await call("POST", `${PATH}/map`, { source: "page" });
}

/** Save the map as this home's; what runs ends, and drives on it begin. */
export async function saveMap(): Promise<void> {
  await call("POST", `${PATH}/map/save`, { source: "page" }, {}, SAVE_MS);
}
