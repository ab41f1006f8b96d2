// How is a number written for people? In as few characters as say enough, with its unit; a thin no-break space parts the thousands.

const THIN = "\u202f";

/** 1234567 → "1 234 567". */
export function count(value: number): string {
  return String(Math.round(value)).replace(/\B(?=(\d{3})+$)/g, THIN);
}

/** One or many: "1 leaf", "2 340 leaves". */
export function counted(value: number, one: string, many: string): string {
  return `${count(value)} ${Math.round(value) === 1 ? one : many}`;
}

/** At most `digits` after the point, and none that says nothing: 3.50 → "3.5". */
export function plain(value: number, digits = 2): string {
  return String(Number(value.toFixed(digits)));
}

/** Metres: "8.2 m"; below one metre centimetres. */
export function metres(value: number): string {
  return value < 0.995 ? `${Math.round(value * 100)} cm` : `${value < 99.95 ? plain(value, 1) : count(value)} m`;
}

/** Milliseconds: "84 ms"; from a second on "1.3 s". */
export function duration(milliseconds: number): string {
  return milliseconds < 1000 ? `${Math.round(milliseconds)} ms` : `${plain(milliseconds / 1000, 1)} s`;
}

/** Bytes as a file manager has them: "412 kB", "3.4 MB". */
export function bytes(value: number): string {
  if (value < 1000) return `${value} bytes`;
  return value < 999_500 ? `${Math.round(value / 1000)} kB` : `${plain(value / 1e6, value < 1e7 ? 1 : 0)} MB`;
}

/** A probability: "62 %"; what is small but there is "under 1 %". */
export function percent(share: number): string {
  if (share > 0 && share < 0.005) return "under 1 %";
  return `${Math.round(share * 100)} %`;
}
