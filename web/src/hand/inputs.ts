/** Turn fingers, keys and gamepads into fractions of the stick's way. Pure. */

export type Deflection = { readonly forward: number; readonly left: number };

const CENTRE = 0.12;

/** Return how far a knob is pushed, from its offset to the middle [px] and the way that it has. */
export function deflection(rightPx: number, downPx: number, wayPx: number): Deflection {
  const away = Math.hypot(rightPx, downPx) / wayPx;
  if (!(away > CENTRE)) return { forward: 0, left: 0 };
  const scale = Math.min(1, (away - CENTRE) / (1 - CENTRE)) / (away * wayPx);
  return { forward: -downPx * scale, left: -rightPx * scale };
}

const WAYS: Readonly<Record<string, readonly [forward: number, left: number]>> = {
  KeyW: [1, 0],
  ArrowUp: [1, 0],
  KeyS: [-1, 0],
  ArrowDown: [-1, 0],
  KeyA: [0, 1],
  ArrowLeft: [0, 1],
  KeyD: [0, -1],
  ArrowRight: [0, -1],
};

export const steers = (code: string): boolean => Object.hasOwn(WAYS, code);

/** Return what the keys that are down ask for together. */
export function keysDeflection(down: ReadonlySet<string>): Deflection {
  let [forward, left] = [0, 0];
  for (const code of down) {
    const [ahead, aside] = WAYS[code] ?? [0, 0];
    forward += ahead;
    left += aside;
  }
  return { forward: Math.sign(forward), left: Math.sign(left) };
}

const STICKS = 4; // axes; of a pad that is not "standard" triggers follow, which rest at -1
const SHOULDERS = [4, 5];

export type PadLike = {
  readonly axes: readonly number[];
  readonly buttons: readonly { readonly pressed: boolean }[];
  readonly connected: boolean;
};

/** Read a gamepad: the left stick steers, a shoulder button is the dead-man. */
export function readPad({ axes, buttons }: PadLike): Deflection & { readonly button: boolean } {
  const button = SHOULDERS.some((index) => buttons[index]?.pressed === true);
  const [aside = 0, back = 0, ...others] = axes.slice(0, STICKS);
  const rests = !button && others.some((axis) => Math.abs(axis) > CENTRE); // all must be neutral
  const own = deflection(aside, back, 1);
  return rests ? { forward: 1, left: 0, button } : { ...own, button };
}
