/** Show the button that stops: by touch at once, by Enter, and by screen readers. */
export function StopButton({ word, keys, stop }: { word: string; keys: string; stop: () => void }) {
  return (
    <button
      type="button"
      class="stop"
      id="stop"
      aria-keyshortcuts="Space Escape"
      onPointerDown={(event) => {
        if (event.button === 0) stop(); // on touch, not on release: a slipping finger still stops
      }}
      onClick={(event) => {
        if (event.detail === 0) stop(); // by Enter or by a screen reader: no pointer came before
      }}
    >
      <span class="stop-word">{word}</span>
      <span class="stop-keys">{keys}</span>
    </button>
  );
}
