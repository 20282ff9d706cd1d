// A viewer: Foxglove's own client of the protocol, subscribed to every channel, with the messages
// that came.
import { once } from "node:events";

import wsProtocol from "@foxglove/ws-protocol";
import WebSocket from "ws";

import { until } from "./served_controller.js";

const { FoxgloveClient } = wsProtocol;

export class Viewer {
  // topic -> channel, and topic -> messages: { time (ns), data }.
  channels = new Map();
  messages = new Map();
  statuses = new Map();
  info = undefined;
  closeCode = undefined;
  error = undefined;

  constructor(port, { wants = () => true } = {}) {
    this.socket = new WebSocket(`ws://127.0.0.1:${port}`, [FoxgloveClient.SUPPORTED_SUBPROTOCOL]);
    this.client = new FoxgloveClient({ ws: this.socket });
    const topics = new Map();
    this.client.on("error", (error) => { this.error = error; });
    this.client.on("serverInfo", (info) => { this.info = info; });
    this.client.on("status", (status) => this.statuses.set(status.id, status));
    this.client.on("removeStatus", ({ statusIds }) => statusIds.forEach((id) => this.statuses.delete(id)));
    this.client.on("close", ({ code }) => { this.closeCode = code; });
    this.client.on("advertise", (channels) => {
      for (const channel of channels) {
        this.channels.set(channel.topic, channel);
        this.messages.set(channel.topic, []);
        if (wants(channel.topic)) {
          topics.set(this.client.subscribe(channel.id), channel.topic);
        }
      }
    });
    this.client.on("message", ({ subscriptionId, timestamp, data }) => {
      const message = { time: timestamp, data: JSON.parse(new TextDecoder().decode(data)) };
      this.messages.get(topics.get(subscriptionId)).push(message);
    });
  }

  // Connects as soon as the server has a place.
  static async connected(port, options) {
    for (;;) {
      const viewer = new Viewer(port, options);
      await until(() => viewer.info !== undefined || viewer.closeCode !== undefined);
      if (viewer.closeCode === undefined) {
        return viewer;
      }
    }
  }

  of(topic) {
    return this.messages.get(topic) ?? [];
  }

  newest(topic) {
    return this.of(topic).at(-1)?.data;
  }

  async close() {
    const closed = once(this.socket, "close");
    this.client.close();
    await closed;
  }
}
