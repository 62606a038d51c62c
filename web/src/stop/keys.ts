/** Stop by keyboard: Esc always, Space unless somebody types. Pure but for `listen`. */

export type Pressed = {
  readonly key: string;
  readonly code: string;
  readonly typing: boolean;
};

export function stops(pressed: Pressed): boolean {
  if (pressed.key === "Escape" || pressed.code === "Escape") return true;
  return (pressed.key === " " || pressed.code === "Space") && !pressed.typing;
}

const NO_TEXT = new Set([
  "button",
  "checkbox",
  "radio",
  "range",
  "submit",
  "reset",
  "color",
  "file",
]);

/** Say whether a key press would write text where it goes. */
export function typesInto(target: EventTarget | null): boolean {
  if (!(target instanceof HTMLElement)) return false;
  if (target instanceof HTMLInputElement) return !NO_TEXT.has(target.type);
  return target instanceof HTMLTextAreaElement || target.isContentEditable;
}

/** Call `stop` on such a key, before any component hears of it. */
export function listen(stop: () => void): void {
  let spaceTaken = false;
  addEventListener(
    "keydown",
    (event) => {
      const { key, code } = event;
      if (!stops({ key, code, typing: typesInto(event.target) })) return;
      if (code === "Space" || key === " ") {
        event.preventDefault(); // it must not also press the button that has the focus, or scroll
        spaceTaken = true;
      }
      if (!event.repeat) stop();
    },
    { capture: true },
  );
  addEventListener(
    "keyup",
    (event) => {
      if (spaceTaken && (event.code === "Space" || event.key === " ")) {
        event.preventDefault(); // browsers press a button when Space is let go
        spaceTaken = false;
      }
    },
    { capture: true },
  );
}
