/**
 * Keep one WebSocket to /v1/events open: back-off after a loss, and a loss is also two seconds of
 * silence, because the planner sends ten frames a second and half-open sockets say nothing.
 */
import { waitMs } from "./backoff";
import { subprotocols } from "./token";

const SILENT_MS = 2000;
const OPENING_MS = 5000;

export type Ears = {
  readonly opened: () => void;
  readonly closed: () => void;
  readonly heard: (data: unknown) => void;
};

/** Open a WebSocket at a path beside the page's own. */
export function dial(path: string): WebSocket {
  const address = new URL(path, location.href);
  address.protocol = location.protocol === "https:" ? "wss:" : "ws:";
  return new WebSocket(address.href, subprotocols());
}

export class EventSocket {
  private socket: WebSocket | null = null;
  private tries = 0;
  private heardMs = 0;
  private wakes: ReturnType<typeof setTimeout> | undefined;

  constructor(private readonly ears: Ears) {
    setInterval(() => this.watch(), 500);
    addEventListener("online", () => this.again());
  }

  /** Dial now, unless a socket is there. */
  connect(): void {
    if (this.socket !== null) return;
    const socket = dial("v1/events");
    this.socket = socket;
    this.heardMs = performance.now();
    socket.onopen = () => {
      this.heardMs = performance.now();
      this.ears.opened();
    };
    socket.onmessage = (message) => {
      this.heardMs = performance.now();
      this.tries = 0;
      this.ears.heard(message.data);
    };
    socket.onclose = () => this.lost(socket);
  }

  /** Send if the socket is open; say whether it was. Never throws: a stop goes this way. */
  send(message: object): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    try {
      this.socket.send(JSON.stringify(message));
      return true;
    } catch {
      return false;
    }
  }

  /** Dial at once instead of waiting for the next try. */
  again(): void {
    if (this.socket !== null) return;
    clearTimeout(this.wakes);
    this.connect();
  }

  private watch(): void {
    const socket = this.socket;
    if (socket === null) return;
    const patience = socket.readyState === WebSocket.OPEN ? SILENT_MS : OPENING_MS;
    if (performance.now() - this.heardMs > patience) {
      socket.close();
      this.lost(socket); // a half-open socket may take minutes to say that it closed
    }
  }

  private lost(socket: WebSocket): void {
    if (this.socket !== socket) return;
    this.socket = null;
    this.ears.closed();
    this.wakes = setTimeout(() => this.connect(), waitMs(this.tries, Math.random()));
    this.tries += 1;
  }
}
