/**
 * Ask the planner over HTTP. Every failure is an ApiError with a code; nothing is thrown raw. Paths are
 * relative to the page, which a proxy may serve below a path of its own.
 */
import type {
  Bilingual,
  Firing,
  Goal,
  GoalReplies,
  Grid,
  KeptPicture,
  Known,
  Language,
  Memories,
  NewPerson,
  Objects,
  OrderRun,
  Person,
  PersonRole,
  Place,
  Pose,
  StandingOrders,
  Taught,
} from "../wire/types";
import type { OperatorProof } from "./proof";
import { askForToken, authorization, type Authorization } from "./token";

export class ApiError extends Error {
  constructor(
    readonly code: string,
    readonly detail: string,
    readonly words: Bilingual | null = null,
  ) {
    super(`${code}: ${detail}`);
  }
}

const TIMEOUT_MS = 8000;
/** So long may a recording take to be read. */
export const RECORDED_MS = 25_000;
const HEARD_MS = 40_000; // the owner's recogniser may take 30 s, the built-in one answers then

type Json = { readonly [key: string]: unknown };

export async function call(
  method: "GET" | "POST" | "PUT" | "PATCH" | "DELETE",
  path: string,
  body?: object | ArrayBuffer,
  headers: Record<string, string> = {},
  timeoutMs = TIMEOUT_MS,
): Promise<unknown> {
  const proof = authorization();
  const request: RequestInit = {
    method,
    headers: { "content-type": "application/json", ...proof, ...headers },
    signal: AbortSignal.timeout(timeoutMs),
    cache: "no-store",
  };
  if (body instanceof ArrayBuffer) request.body = body;
  else if (body !== undefined) request.body = JSON.stringify(body);
  const answer = await asked(path, request);
  const content = (await answer.json().catch(() => null)) as Json | null;
  if (!answer.ok) throw refusal(answer, content ?? {}, proof);
  if (content === null) throw new ApiError("planner_silent", ""); // it broke off half-way
  return content;
}

async function asked(path: string, request: RequestInit): Promise<Response> {
  try {
    return await fetch(path, request);
  } catch {
    throw new ApiError("planner_silent", "");
  }
}

function refusal(answer: Response, content: Json, proof: Authorization): ApiError {
  if (answer.status === 401) askForToken(proof);
  return new ApiError(
    typeof content.code === "string" ? content.code : `http_${answer.status}`,
    typeof content.detail === "string" ? content.detail : "",
    (content.message as Bilingual | undefined) ?? null,
  );
}

/** Return an unguessable id; crypto.randomUUID is missing on plain HTTP from another machine. */
export function newId(prefix: string): string {
  const bytes = crypto.getRandomValues(new Uint8Array(12));
  return `${prefix}-${[...bytes].map((byte) => byte.toString(16).padStart(2, "0")).join("")}`;
}

const withProof = (operator: OperatorProof | null): object => (operator ? { operator } : {});

export async function giveGoal(
  text: string,
  replace: boolean,
  operator: OperatorProof | null,
): Promise<Goal> {
  const body = { text, source: "page", ...(replace ? { replace } : {}), ...withProof(operator) };
  const key = { "idempotency-key": newId("page") };
  return (await call("POST", "v1/goals", body, key)) as Goal;
}

export type Spoken = {
  readonly goal: Goal | null;
  readonly message: Bilingual | null;
  readonly trouble: string | null; // why another recogniser than the owner's heard it
};

/** Give a goal by a recording; none where no order was heard surely enough. */
export async function giveSpoken(wav: ArrayBuffer, confirm = false): Promise<Spoken> {
  const headers = { "content-type": "audio/wav", "idempotency-key": newId("page") };
  const path = confirm ? "v1/voice?confirm=true" : "v1/voice";
  const heard = (await call("POST", path, wav, headers, HEARD_MS)) as {
    goal: Goal | null;
    outcome: { message: Bilingual | null };
    trouble: string | null;
  };
  return { goal: heard.goal, message: heard.outcome.message, trouble: heard.trouble };
}

export type Voice = {
  readonly languages: readonly Language[];
  readonly host: string | null;
};

export async function fetchVoice(): Promise<Voice> {
  return (await call("GET", "v1/voice")) as Voice;
}

/** Break off what the robot itself is saying. */
export async function hushRobot(): Promise<void> {
  await call("POST", "v1/voice/hush");
}

export type GoalVerb = "cancel" | "pause" | "resume" | "confirm";

export async function actOnGoal(
  id: string,
  verb: GoalVerb,
  operator: OperatorProof | null = null,
): Promise<Goal> {
  return (await call("POST", `v1/goals/${encodeURIComponent(id)}/${verb}`, {
    source: "page",
    ...withProof(operator),
  })) as Goal;
}

export async function answerGoal(
  id: string,
  text: string,
  operator: OperatorProof | null,
): Promise<Goal> {
  const body = { text, source: "page", ...withProof(operator) };
  return (await call("POST", `v1/goals/${encodeURIComponent(id)}/answer`, body)) as Goal;
}

export async function moveGoal(id: string, before: string | null): Promise<Goal> {
  return (await call("POST", `v1/goals/${encodeURIComponent(id)}/move`, { before })) as Goal;
}

export type Act = "arm" | "disarm" | "reset" | "resume" | "estop";

export async function operate(kind: Act, operator: OperatorProof | null): Promise<void> {
  await call("POST", `v1/${kind}`, { source: "page", ...withProof(operator) });
}

export type TrialAct = "watch" | "begin" | "find" | "leave";

/** Ask set-up for something; a watch bears the id of its begin. */
export async function askTrial(
  act: TrialAct,
  id: string,
  answered: number,
  proof: OperatorProof["proof"] | null = null,
): Promise<void> {
  await call("POST", "v1/trial", { act, id, source: "page", answered, proof });
}

/** Put set-up in the bridge's place. */
export async function enterSetup(): Promise<void> {
  await call("POST", "v1/setup", { source: "page" });
}

export async function fetchPlaces(): Promise<Known> {
  return (await call("GET", "v1/places")) as Known;
}

export type Names = { readonly en?: string; readonly zh?: string };
export type Point = Pick<Pose, "x_m" | "y_m">;

/** Teach a place: at a point of the map, as a proposed room, or where the robot stands. */
export async function teachPlace(
  name: Names,
  point: Point | null,
  room: string | null = null,
): Promise<Taught> {
  const body = { name, source: "page", ...(point ? { point } : {}), ...(room ? { room } : {}) };
  return (await call("POST", "v1/places", body)) as Taught;
}

/** Teach a place somewhere else, under the id and names that it has. */
export async function movePlace(
  { id, name }: Pick<Place, "id" | "name">,
  point: Pose,
): Promise<void> {
  const names = { en: name.en, zh: name.zh };
  await call("PUT", `v1/places/${encodeURIComponent(id)}`, { name: names, point, source: "page" });
}

/** Tell localization where the robot is: at a point of the map, or in a place. */
export async function hintPose(where: { point: Point } | { place: string }): Promise<void> {
  await call("POST", "v1/localization/hint", { source: "page", ...where });
}

export async function forgetPlace(id: string): Promise<void> {
  await call("DELETE", `v1/places/${encodeURIComponent(id)}`);
}

export async function fetchOrders(): Promise<StandingOrders> {
  return (await call("GET", "v1/orders")) as StandingOrders;
}

export async function fetchHistory(id: string): Promise<readonly Firing[]> {
  const shown = (await call("GET", `v1/orders/${encodeURIComponent(id)}`)) as {
    readonly history: readonly Firing[];
  };
  return shown.history;
}

/** Return the newest runs of all standing orders, newest first. */
export async function fetchRuns(): Promise<readonly OrderRun[]> {
  return ((await call("GET", "v1/orders/firings")) as { firings: readonly OrderRun[] }).firings;
}

/** Give a standing order as a sentence; return what the robot will do, in both languages. */
export async function giveOrder(text: string): Promise<Bilingual> {
  const kept = await call("POST", "v1/orders", { text, source: "page" });
  return (kept as { readonly told: Bilingual }).told;
}

export async function changeOrder(id: string, verb: "pause" | "resume"): Promise<void> {
  await call("POST", `v1/orders/${encodeURIComponent(id)}/${verb}`, {});
}

export async function removeOrder(id: string): Promise<void> {
  await call("DELETE", `v1/orders/${encodeURIComponent(id)}`);
}

export async function fetchGrid(): Promise<Grid> {
  return (await call("GET", "v1/map")) as Grid;
}

export async function fetchObjects(): Promise<Objects> {
  return (await call("GET", "v1/objects")) as Objects;
}

export async function forgetObject(id: string): Promise<void> {
  await call("DELETE", `v1/objects/${encodeURIComponent(id)}`);
}

/** Fetch the camera's newest picture. */
export const fetchPicture = (): Promise<Blob> => fetchBlob("v1/camera.jpg");

/** Fetch a picture that a patrol kept. */
export const fetchKeptPicture = (id: number): Promise<Blob> => fetchBlob(`v1/pictures/${id}`);

/** Fetch a mission as one HTML file to share; the black box is read for it by a process. */
export const fetchMissionPage = (id: string, language: Language): Promise<Blob> =>
  fetchBlob(`v1/history/${encodeURIComponent(id)}/page?language=${language}`, RECORDED_MS);

async function fetchBlob(path: string, timeoutMs = TIMEOUT_MS): Promise<Blob> {
  const signal = AbortSignal.timeout(timeoutMs);
  const proof = authorization();
  const answer = await asked(path, { headers: proof, signal, cache: "no-store" });
  if (answer.ok) return answer.blob();
  throw refusal(answer, ((await answer.json().catch(() => null)) as Json | null) ?? {}, proof);
}

/** Return the pictures that a goal's patrols kept. */
export async function listPictures(goal: string): Promise<readonly KeptPicture[]> {
  const shown = await call("GET", `v1/pictures?${new URLSearchParams({ goal })}`);
  return (shown as { readonly pictures: readonly KeptPicture[] }).pictures;
}

/** Return what the model wrote about a goal, as far as it is kept. */
export async function listReplies(goal: string): Promise<GoalReplies> {
  return (await call("GET", `v1/goals/${encodeURIComponent(goal)}/replies`)) as GoalReplies;
}

export async function forgetPicture(id: number): Promise<void> {
  await call("DELETE", `v1/pictures/${id}`);
}

/** Return what is remembered, the newest first; of a search what fits, or what comes nearest. */
export async function listMemories(words: string, limit: number): Promise<Memories> {
  const asked = new URLSearchParams({ limit: String(limit), ...(words ? { q: words } : {}) });
  return (await call("GET", `v1/memory?${asked}`)) as Memories;
}

export async function teachFact(text: string): Promise<void> {
  await call("POST", "v1/memory/facts", { text, source: "page" });
}

export async function forgetMemory(id: number): Promise<number> {
  return ((await call("DELETE", `v1/memory/${id}`)) as { forgotten: number }).forgotten;
}

export async function forgetMemories(): Promise<number> {
  return ((await call("DELETE", "v1/memory")) as { forgotten: number }).forgotten;
}

type Askers = { readonly you: Person | null; readonly people: readonly Person[] | null };

/** Return who may use the robot; null to anybody but its owner. */
export async function listPeople(): Promise<readonly Person[] | null> {
  return ((await call("GET", "v1/people")) as Askers).people;
}

export type Asker = { readonly role: PersonRole; readonly isOwner: boolean };

/** Return who holds this page's token; the owner and the token that only looks are no persons. */
export async function fetchAsker(): Promise<Asker> {
  const { you, people } = (await call("GET", "v1/people")) as Askers;
  if (people !== null) return { role: "operator", isOwner: true };
  return { role: you?.role ?? "viewer", isOwner: false };
}

/** Add a person; the token in the answer is told this once. */
export async function addPerson(name: string, role: PersonRole): Promise<NewPerson> {
  return (await call("POST", "v1/people", { name, role })) as NewPerson;
}

export async function removePerson(id: string): Promise<void> {
  await call("DELETE", `v1/people/${encodeURIComponent(id)}`);
}
