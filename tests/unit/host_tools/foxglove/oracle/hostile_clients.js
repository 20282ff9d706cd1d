// Clients that break the protocol, or do not read: each is dropped or ignored, and a well-behaved
// viewer goes on.
import assert from "node:assert/strict";
import { once } from "node:events";

import WebSocket from "ws";

import { until } from "./served_controller.js";
import { Viewer } from "./viewer.js";

const kProtocol = "foxglove.websocket.v1";
const kPolicyViolation = 1008;
const kTooLarge = 1009;

function connect(port, protocols) {
  const socket = new WebSocket(`ws://127.0.0.1:${port}`, protocols);
  socket.on("error", () => {});
  return socket;
}

// Returns the code with which a connection ends, be it by an error.
function closeOf(socket) {
  return new Promise((resolve) => socket.on("close", resolve));
}

// Sends the bytes and returns the code with which the server closes.
async function codeAfter(port, bytes) {
  const socket = connect(port, [kProtocol]);
  await once(socket, "open");
  const closed = closeOf(socket);
  socket.send(bytes);
  return await closed;
}

async function goesOn(viewer) {
  const seen = viewer.of("/state").length;
  await until(() => viewer.of("/state").length > seen + 20);
  assert.equal(viewer.closeCode ?? viewer.error, undefined);
}

// Returns the answer to a text that is no error of the protocol.
async function statusAfter(port, text) {
  const socket = connect(port, [kProtocol]);
  await once(socket, "open");
  const status = new Promise((resolve) => socket.on("message", (data, isBinary) => {
    const message = isBinary ? {} : JSON.parse(data);
    if (message.op === "status") {
      resolve(message);
    }
  }));
  socket.send(text);
  const answer = await status;
  socket.terminate();
  return answer;
}

async function checkRubbish(port) {
  const deep = "[".repeat(60_000);
  for (const text of ["{", "[]", "7", "\u0000", deep, '{"op":3}', '{"op":"subscribe"}',
    '{"op":"subscribe","subscriptions":[7]}',
    '{"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]}',
    '{"op":"subscribe","subscriptions":[{"id":1,"channelId":99999999999}]}',
    '{"op":"unsubscribe","subscriptionIds":["1"]}']) {
    assert.equal(await codeAfter(port, text), kPolicyViolation, text.slice(0, 60));
  }
  assert.equal(await codeAfter(port, "x".repeat(200_000)), kTooLarge);
}

async function checkRefusals(port) {
  const kWarning = 1;
  const kError = 2;
  assert.equal((await statusAfter(port, '{"op":"setParameters","parameters":[]}')).level, kWarning);
  assert.equal((await statusAfter(port, Buffer.from([1, 0, 0, 0, 0, 7]))).level, kWarning);
  const unknown = '{"op":"subscribe","subscriptions":[{"id":1,"channelId":99}]}';
  assert.match((await statusAfter(port, unknown)).message, /channel 99: there is no such channel/);
  const twice = JSON.stringify({ op: "subscribe",
    subscriptions: [{ id: 5, channelId: 8 }, { id: 5, channelId: 9 }] });
  assert.equal((await statusAfter(port, twice)).level, kError);
}

// A client of another protocol, or of none, is not let in; one that knows several gets ours.
async function checkOtherProtocols(port) {
  for (const protocols of [["chat"], []]) {
    const socket = connect(port, protocols);
    await closeOf(socket);
    assert.equal(socket.protocol, "");
  }
  const several = connect(port, ["foxglove.sdk.v1", kProtocol]);
  await once(several, "open");
  assert.equal(several.protocol, kProtocol);
  several.terminate();
  assert.equal((await fetch(`http://127.0.0.1:${port}/`)).status, 404);
}

// Reads the tick of a message of /state, and the number of its subscription.
function stateIn(bytes) {
  const kHeaderBytes = 13;
  return { subscription: bytes.readUInt32LE(1), ...JSON.parse(bytes.subarray(kHeaderBytes)) };
}

// A client that asks for more than it reads misses messages, and has the newest once it reads again;
// the viewer goes on meanwhile.
async function checkSlowClient(port, viewer) {
  const slow = connect(port, [kProtocol]);
  await once(slow, "open");
  const ticks = [];
  slow.on("message", (data, isBinary) => {
    const state = isBinary ? stateIn(data) : {};
    if (state.subscription === 0) {
      ticks.push(state.tick);
    }
  });
  const channelId = viewer.channels.get("/state").id;
  slow.send(JSON.stringify({ op: "subscribe",
    subscriptions: Array.from({ length: 250 }, (_, id) => ({ id, channelId })) }));
  await until(() => ticks.length > 0);
  slow.pause();
  const from = viewer.of("/state").length;
  await until(() => viewer.of("/state").length > from + 200);
  slow.resume();
  const { tick: newest } = viewer.newest("/state");
  await until(() => ticks.at(-1) >= newest);
  const seen = viewer.of("/state").length - from;
  assert.ok(ticks.length < seen, `${ticks.length} messages waited for a client that did not read`);
  slow.terminate();
}

// A client that has subscribed to everything and reads nothing more.
async function stuckClient(port) {
  const stuck = await Viewer.connected(port);
  await until(() => stuck.of("/scene").length > 0);
  stuck.socket.pause();
  return stuck;
}

// The places are taken by clients that do not read; the one more is refused.
async function checkPlaces(port, viewer) {
  const kPlaces = 8;
  const others = [];
  for (let i = 1; i < kPlaces; ++i) {
    others.push(await stuckClient(port));
  }
  await goesOn(viewer);
  const more = connect(port, [kProtocol]);
  await closeOf(more);
  const gone = others.map((other) => closeOf(other.socket));
  others.forEach((other) => other.socket.terminate());
  others.forEach((other) => other.socket.resume());
  await Promise.all(gone);
}

// After an unsubscription the other subscriptions go on alone.
async function checkUnsubscribe(port, viewer) {
  // The server may not have seen yet that the others have gone.
  const another = await Viewer.connected(port, { wants: (topic) => topic === "/tool" });
  await until(() => another.of("/tool").length > 5);
  assert.equal(another.of("/state").length, 0);
  another.client.unsubscribe(0);
  await goesOn(viewer);
  const seen = another.of("/tool").length;
  await goesOn(viewer);
  assert.equal(another.of("/tool").length, seen);
  await another.close();
}

export async function checkHostileClients(port, viewer) {
  await checkRubbish(port);
  await goesOn(viewer);
  await checkRefusals(port);
  await checkOtherProtocols(port);
  await checkSlowClient(port, viewer);
  await checkPlaces(port, viewer);
  await checkUnsubscribe(port, viewer);
}
