/** Know whether anybody can see the page: what nobody sees is not drawn. */
import { signal } from "@preact/signals";

export const visible = signal(true);

export function startVisible(): void {
  const look = (): void => {
    visible.value = document.visibilityState === "visible";
  };
  document.addEventListener("visibilitychange", look);
  look();
}
