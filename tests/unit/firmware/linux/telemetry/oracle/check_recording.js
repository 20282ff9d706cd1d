// Reads a recording with the libraries that viewers of MCAP files use, and holds it against the CSV
// file of the same ticks.
//   node check_recording.js RUN.mcap RUN.csv
import assert from "node:assert/strict";
import { open, readFile } from "node:fs/promises";

import { crc32 } from "@foxglove/crc";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { ByteBuffer } from "flatbuffers";
import { Parser, Schema, Table } from "flatbuffers_reflection";

const [recordingFile, csvFile] = process.argv.slice(2);
const recording = await readFile(recordingFile);
const kAxes = ["x", "y", "z"];
const kSources = ["contact", "friction", "texture", "effect", "coupling", "safety", "delay"];
// What write_recording.cpp adds to the ticks' clock.
const kClockOffset = 1_700_000_000_000_000_000n;

// What McapIndexedReader reads from.
async function readableFile(name) {
  const file = await open(name);
  return {
    size: async () => BigInt((await file.stat()).size),
    read: async (offset, length) => {
      const bytes = new Uint8Array(Number(length));
      const { bytesRead } = await file.read(bytes, 0, bytes.length, Number(offset));
      assert.equal(bytesRead, bytes.length, "the file is shorter than its index says");
      return bytes;
    },
    close: () => file.close(),
  };
}

// CSV column -> text, for each row.
async function csvRows(name) {
  const [header, ...lines] = (await readFile(name, "utf8")).trimEnd().split("\n");
  const columns = header.split(",");
  return lines.map((line) => new Map(line.split(",").map((cell, i) => [columns[i], cell])));
}

// A message's fields under the names of the CSV columns that have them.
function columnsOf(message) {
  const columns = new Map();
  const put = (name, value) => columns.set(name, value);
  for (const name of [
    "tick", "time_s", "faults", "limits", "device_status", "sample_age_us", "loop_status",
    "missed_ticks", "touch_flags", "object", "sub_goals", "planes", "contact", "friction",
    "depth_m", "state_hash", "dropped", "limited_source", "effort_known", "effort_is_new",
    "fault_joint", "fault_device", "short_of_goal_m",
  ]) {
    put(name, message[name]);
  }
  put("passivity_J", message.passivity_j);
  const vectors = {
    tool_p_w: ["tool", "m"], tool_v_w: ["tool_v", "m_per_s"], proxy_w: ["proxy", "m"],
    normal_w: ["normal", ""], force_rendered_w: ["rendered", "N"],
    force_commanded_w: ["force", "N"],
  };
  for (const [field, [column, unit]] of Object.entries(vectors)) {
    for (const axis of kAxes) {
      put([column, axis, unit].filter(Boolean).join("_"), message[field][axis]);
    }
  }
  const joint = {
    position: ["joint", ""], velocity: ["velocity", ""], effort: ["effort", ""],
    compensation: ["compensation", ""], gravity: ["gravity", ""], shaft_rad: ["shaft", "_rad"],
    torque_nm: ["torque", "_Nm"],
  };
  message.joints.forEach((one, i) => {
    for (const [field, [column, unit]] of Object.entries(joint)) {
      put(`${column}${i + 1}${unit}`, one[field]);
    }
  });
  message.measured.forEach((effort, i) => put(`measured${i + 1}`, effort));
  for (const source of kSources) {
    put(`energy_${source}_J`, message.energy_j[source]);
  }
  for (const [field, value] of Object.entries(message.counters)) {
    put(field, value);
  }
  for (const [field, value] of Object.entries(message.stage_ns)) {
    put(`${field}_ns`, value);
  }
  for (const [field, value] of Object.entries(message.loop)) {
    put(field, value);
  }
  for (const [field, value] of Object.entries(message.change)) {
    put(`changed_${field}`, value);
  }
  return columns;
}

const kModes = ["init", "homing", "ready", "active", "fault"];
const kRequests = ["none", "home", "enable", "disable", "reset", "estop"];

// What a CSV cell says, as the number that a message has.
function cellValue(name, cell, like) {
  if (name === "state_hash") {
    return BigInt(`0x${cell}`);
  }
  if (typeof like === "bigint") {
    return BigInt(cell);
  }
  return { inf: Infinity, "-inf": -Infinity }[cell] ?? Number(cell);
}

function compareTick(message, row) {
  const columns = columnsOf(message);
  for (const [name, value] of columns) {
    const cell = row.get(name);
    assert.ok(cell !== undefined, `the CSV file has no column ${name}`);
    assert.ok(Object.is(cellValue(name, cell, value), value),
      `tick ${message.tick}: ${name} is ${value} in the message and ${cell} in the CSV file`);
  }
  assert.equal(kModes[message.mode], row.get("mode"));
  assert.equal(kRequests[message.request], row.get("request"));
  const words = 2;  // mode and request
  const joints = 1;  // the number of joints: the message has as many
  assert.equal(columns.size + words + joints, row.size, "a CSV column that no message has");
}

// Every checksum there is: of the data, of the summary, of each chunk and attachment.
function checkChecksums() {
  const view = new DataView(recording.buffer, recording.byteOffset, recording.byteLength);
  const magicBytes = 8;
  const footerBytes = 1 + 8 + 8 + 8 + 4;
  const footer = recording.length - magicBytes - footerBytes;
  assert.equal(view.getUint8(footer), 2, "the file does not end in a footer");
  const summaryStart = Number(view.getBigUint64(footer + 9, true));
  const dataEndBytes = 1 + 8 + 4;
  const dataEnd = summaryStart - dataEndBytes;
  assert.equal(view.getUint8(dataEnd), 15, "no end of data in front of the summary");
  assert.equal(view.getUint32(dataEnd + 9, true), crc32(recording.subarray(0, dataEnd)),
    "checksum of the data");
  assert.equal(view.getUint32(footer + footerBytes - 4, true),
    crc32(recording.subarray(summaryStart, footer + footerBytes - 4)), "checksum of the summary");
}

// All records in the order of the file; the reader holds chunks and attachments against their
// checksums.
function readAsStream() {
  const reader = new McapStreamReader({ includeChunks: true, validateCrcs: true });
  reader.append(recording);
  const counts = {};
  for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
    counts[record.type] = (counts[record.type] ?? 0) + 1;
  }
  assert.ok(reader.done(), "the file does not end where its format ends");
  return counts;
}

async function main() {
  checkChecksums();
  const counts = readAsStream();
  const rows = await csvRows(csvFile);
  const readable = await readableFile(recordingFile);
  const reader = await McapIndexedReader.Initialize({ readable });

  const channels = new Map([...reader.channelsById.values()].map((one) => [one.topic, one]));
  assert.deepEqual([...channels.keys()].sort(), ["/tactus/event", "/tactus/tick"]);
  const parsers = new Map();
  for (const channel of channels.values()) {
    assert.equal(channel.messageEncoding, "flatbuffer");
    const schema = reader.schemasById.get(channel.schemaId);
    assert.equal(schema.encoding, "flatbuffer");
    parsers.set(channel.id, new Parser(Schema.getRootAsSchema(new ByteBuffer(schema.data))));
  }
  assert.equal(reader.schemasById.get(channels.get("/tactus/tick").schemaId).name,
    "tactus.telemetry.Record");

  let ticks = 0;
  let events = 0;
  let lastTime = 0n;
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    const parser = parsers.get(message.channelId);
    const table = Table.getRootTable(new ByteBuffer(message.data));
    const object = parser.toObject(table);
    assert.ok(message.logTime >= lastTime, "messages out of order");
    lastTime = message.logTime;
    if (message.channelId === channels.get("/tactus/event").id) {
      assert.equal(object.name, "note");
      ++events;
      continue;
    }
    const withDefaults = parser.toObject(table, true);
    assert.equal(message.sequence, ticks);
    compareTick(withDefaults, rows[ticks]);
    ++ticks;
  }
  assert.equal(ticks, rows.length);
  const statistics = reader.statistics;
  assert.equal(statistics.messageCount, BigInt(ticks + events));
  assert.equal(statistics.channelMessageCounts.get(channels.get("/tactus/tick").id), BigInt(ticks));
  assert.equal(statistics.chunkCount, reader.chunkIndexes.length);
  assert.equal(counts.Chunk, reader.chunkIndexes.length);
  assert.equal(statistics.messageEndTime, lastTime);

  // The index leads to the middle of the run.
  const start = (statistics.messageStartTime + statistics.messageEndTime) / 2n;
  let found = 0;
  for await (const message of reader.readMessages({ startTime: start, topics: ["/tactus/tick"] })) {
    assert.ok(message.logTime >= start);
    ++found;
  }
  const expected = rows.filter((row) => BigInt(row.get("scheduled_ns")) + kClockOffset >= start);
  assert.equal(found, expected.length);

  let attachments = 0;
  for await (const attachment of reader.readAttachments()) {
    assert.equal(attachment.name, "device.tactus");
    assert.equal(new TextDecoder().decode(attachment.data), "image");
    ++attachments;
  }
  assert.equal(attachments, 1);
  for await (const metadata of reader.readMetadata({ name: "tactus" })) {
    assert.equal(metadata.metadata.get("rate_hz"), "1000");
  }
  await readable.close();
  console.log(`${ticks} ticks and ${events} events in ${counts.Chunk} chunks are as they should be`);
}

await main();
