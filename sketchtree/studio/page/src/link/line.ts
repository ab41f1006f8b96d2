// Is there a line to the program? One WebSocket; when it breaks it is opened again, after a pause that grows.

export interface LineEvents {
  onOpen: () => void;
  onText: (text: string) => void;
  onBinary: (data: ArrayBuffer) => void;
  onBreak: (tries: number) => void; // tries that failed in a row
}

const FIRST_PAUSE = 250; // ms
const LONGEST_PAUSE = 5000;

/** How long to wait before the next try: twice as long each time, a little uneven, so that pages do not come all at once. */
export function pause(tries: number, chance: number = Math.random()): number {
  return Math.min(LONGEST_PAUSE, FIRST_PAUSE * 2 ** tries) * (0.75 + 0.5 * chance);
}

export class Line {
  private socket: WebSocket | null = null;
  private tries = 0;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private ended = false;

  constructor(private readonly address: string, private readonly events: LineEvents) {
    addEventListener("online", () => this.hurry());
    document.addEventListener("visibilitychange", () => { if (!document.hidden) this.hurry(); });
    this.open();
  }

  send(text: string): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(text);
  }

  end(): void {
    this.ended = true;
    clearTimeout(this.timer);
    this.socket?.close();
  }

  /** There may be a line again: try now. */
  private hurry(): void {
    if (this.ended || this.socket?.readyState === WebSocket.OPEN || this.socket?.readyState === WebSocket.CONNECTING) return;
    clearTimeout(this.timer);
    this.open();
  }

  private open(): void {
    const socket = new WebSocket(this.address);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    socket.onopen = () => {
      this.tries = 0;
      this.events.onOpen();
    };
    socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => {
      if (typeof event.data === "string") this.events.onText(event.data);
      else this.events.onBinary(event.data);
    };
    socket.onclose = () => {
      if (this.ended || this.socket !== socket) return;
      this.events.onBreak(this.tries);
      this.timer = setTimeout(() => this.open(), pause(this.tries));
      this.tries += 1;
    };
  }
}
