/** Have the shown plan driven in the simulator, and hold how it goes: asked twice a second until it is over. */
import { effect, signal } from "@preact/signals";
import { call } from "../net/api";
import { explain, tell } from "../state/note";
import type { Bilingual } from "../wire/types";
import { shown, type Rehearsal, type Shown } from "./rehearsal";

export type DrivenStep = {
  readonly index: number;
  readonly kind: string;
  readonly name: Bilingual | null;
  readonly branch: boolean;
  readonly outcome: "pending" | "running" | "succeeded" | "failed" | "stuck" | "left_out";
  readonly length_m: number;
  readonly seconds: number;
  readonly nearest_m: number | null;
  readonly contacts: number;
  readonly rows: readonly string[];
  readonly code: string | null;
  readonly message: Bilingual | null;
};

export type DrivenRehearsal = {
  readonly id: string;
  readonly state: "running" | "done" | "cancelled" | "failed";
  readonly shown: Rehearsal;
  readonly driven: {
    readonly steps: readonly DrivenStep[];
    readonly trail: readonly (readonly [number, number])[];
    readonly length_m: number;
    readonly seconds: number;
    readonly contacts: number;
  };
  readonly left_out: readonly string[];
  readonly times_faster: number | null;
  readonly message: Bilingual | null;
};

const PATH = "v1/rehearsals/drive";
const EVERY_MS = 500;
const BEGIN_MS = 30_000; // the ways are searched first

export const driven = signal<DrivenRehearsal | null>(null);
let turn = 0;

/** Begin to drive what is shown. Another's drive that runs is told as a refusal. */
export async function driveShown(of: Shown["of"]): Promise<void> {
  const mine = ++turn;
  try {
    let next = (await call("POST", PATH, of, {}, BEGIN_MS)) as DrivenRehearsal;
    while (mine === turn) {
      driven.value = next;
      if (next.state !== "running") return;
      await new Promise((done) => setTimeout(done, EVERY_MS));
      next = (await call("GET", PATH)) as DrivenRehearsal;
    }
  } catch (error) {
    if (mine !== turn) return;
    driven.value = null;
    tell(explain(error), true);
  }
}

/** End the drive in the simulator; the robot was never moved by it. */
export async function cancelDrive(): Promise<void> {
  turn += 1;
  try {
    driven.value = (await call("DELETE", PATH)) as DrivenRehearsal;
  } catch (error) {
    driven.value = null;
    tell(explain(error), true);
  }
}

/** Put a drive away with the plan that it was of. */
export function startDrives(): void {
  let of: Shown["of"] | null = null;
  effect(() => {
    const next = shown.value?.of ?? null;
    if (next === of) return;
    of = next;
    const running = driven.peek()?.state === "running";
    if (running) void cancelDrive().then(() => (driven.value = null));
    else {
      turn += 1;
      driven.value = null;
    }
  });
}
