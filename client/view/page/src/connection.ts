// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The WebSocket to the server: comes back by itself, says how it is.
import { decodeFrame, type Frame } from "./frame";

export type State = "connecting" | "live" | "read only" | "lost";

export interface Hello {
  type: "hello";
  mode: "live" | "log";
  log: string;
  may_write: boolean;
}

export interface Message {
  type: string;
  [key: string]: unknown;
}

export interface Listener {
  state(state: State): void;
  hello(hello: Hello): void;
  frame(frame: Frame): void;
  message(message: Message): void;
}

const FIRST_PAUSE_MS = 300;
const LONGEST_PAUSE_MS = 3000;

export class Connection {
  private socket: WebSocket | null = null;
  private pauseMs = FIRST_PAUSE_MS;
  private withToken = true;

  constructor(private readonly listener: Listener) {
    void this.connect();
  }

  send(message: object): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  /** Whether there is a server at all: a socket that is refused does not tell. */
  private async isThere(): Promise<boolean> {
    return fetch("/", { method: "HEAD", cache: "no-store" }).then((answer) => answer.ok, () => false);
  }

  private again(): void {
    this.listener.state("lost");
    setTimeout(() => void this.connect(), this.pauseMs);
    this.pauseMs = Math.min(this.pauseMs * 1.5, LONGEST_PAUSE_MS);
  }

  private async connect(): Promise<void> {
    if (!(await this.isThere())) return this.again();
    const token = new URLSearchParams(location.hash.slice(1)).get("token");
    const query = token && this.withToken ? "?token=" + encodeURIComponent(token) : "";
    const scheme = location.protocol === "https:" ? "wss://" : "ws://";
    const socket = new WebSocket(scheme + location.host + "/socket" + query);
    let opened = false;
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      opened = true;
      this.pauseMs = FIRST_PAUSE_MS;
    };
    socket.onmessage = (event) => this.received(event.data);
    socket.onclose = () => {
      // A server that was started anew has another token: without it there is still something to see.
      if (!opened) this.withToken = !this.withToken;
      else this.withToken = true;
      this.again();
    };
    this.socket = socket;
  }

  private received(data: unknown): void {
    if (data instanceof ArrayBuffer) {
      this.listener.frame(decodeFrame(data));
      return;
    }
    const message = JSON.parse(String(data)) as Message;
    if (message.type === "hello") {
      const hello = message as unknown as Hello;
      this.listener.state(hello.may_write ? "live" : "read only");
      this.listener.hello(hello);
    } else {
      this.listener.message(message);
    }
  }

  /** The frame was drawn: the next but one may come. */
  acknowledge(serial: number): void {
    this.send({ type: "ack", serial });
  }
}
