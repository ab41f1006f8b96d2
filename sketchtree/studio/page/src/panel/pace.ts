// How often may a slider speak? At most once in `interval` milliseconds, and the last word is always said.

export interface Pace<T> {
  say(value: T): void; // at once, or as soon as it may; the newest wins
  flush(): void; // what waits is said now
  drop(): void; // what waits is forgotten
}

export function pace<T>(interval: number, speak: (value: T) => void, now: () => number = () => performance.now()): Pace<T> {
  let waiting: { value: T } | null = null;
  let timer: ReturnType<typeof setTimeout> | null = null;
  let spoke = -Infinity;

  const stop = (): void => {
    if (timer !== null) clearTimeout(timer);
    timer = null;
  };
  const flush = (): void => {
    stop();
    if (!waiting) return;
    const { value } = waiting;
    waiting = null;
    spoke = now();
    speak(value);
  };
  return {
    say(value) {
      waiting = { value };
      const left = spoke + interval - now();
      if (left <= 0) flush();
      else timer ??= setTimeout(flush, left);
    },
    flush,
    drop() {
      stop();
      waiting = null;
    },
  };
}
