/** Ask for the owner's settings, change them, try the model. Types of what comes back. */
import { call } from "./api";

export type Value = string | number | boolean | null;

export type Setting = {
  readonly name: string;
  readonly group: string;
  readonly kind: "text" | "secret" | "yes" | "number" | "choice";
  readonly value: Value;
  readonly is_set: boolean;
  readonly source: "file" | "environment" | "default";
  readonly choices: readonly string[];
  readonly least: number | null;
  readonly most: number | null;
  readonly in_force: "at_once" | "next_start";
  readonly is_pending: boolean;
};

export type Settings = {
  readonly revision: string;
  readonly fields: readonly Setting[];
  readonly changes: readonly {
    readonly at: string;
    readonly by: string;
    readonly names: readonly string[];
  }[];
  readonly can_restart: boolean;
};

export type Reached = {
  readonly name: string;
  readonly where: string;
  readonly is_reached: boolean;
  readonly trouble: string | null;
};

const PATH = "v1/settings";

export const fetchSettings = async (): Promise<Settings> => (await call("GET", PATH)) as Settings;

/** Save changes, all or none; null takes one away. */
export async function changeSettings(
  revision: string,
  changes: Readonly<Record<string, Value>>,
): Promise<Settings> {
  return (await call("PATCH", PATH, { revision, changes, source: "page" })) as Settings;
}

/** Try the model's server: one that is typed, or the saved one. */
export const testModel = async (url: string | null): Promise<Reached> =>
  (await call("POST", `${PATH}/model/test`, url === null ? {} : { url })) as Reached;

export async function restartPlanner(): Promise<void> {
  await call("POST", `${PATH}/restart`, { source: "page" });
}
