// Does the pointer (or the focus) rest on something, or only pass over it? Told after `delay`; leaving is told only where resting was.

export interface Linger<T> {
  over(what: T): void;
  pass(): void; // not on anything now, but near: what was rested on still counts
  away(): void;
}

export function linger<T>(delay: number, rest: (what: T) => void, leave: () => void): Linger<T> {
  let timer: ReturnType<typeof setTimeout> | null = null;
  let resting = false;
  const stop = (): void => {
    if (timer !== null) clearTimeout(timer);
    timer = null;
  };
  return {
    over(what) {
      stop();
      timer = setTimeout(() => {
        timer = null;
        resting = true;
        rest(what);
      }, delay);
    },
    pass: stop,
    away() {
      stop();
      if (resting) leave();
      resting = false;
    },
  };
}
