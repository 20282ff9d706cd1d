// Watches a running `tactus sim --serve` with Foxglove's own client of its protocol, and holds what
// it gets against the mesh file, `tactus watch`, closed forms and the advertised schemas.
//   node check_foxglove.js TACTUS EXAMPLES
import assert from "node:assert/strict";
import { copyFile, mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";

import { checkHostileClients } from "./hostile_clients.js";
import { killAll, run, start, until } from "./served_controller.js";
import { checkerOf, closed, publishedSchema } from "./strict_schemas.js";
import { Viewer } from "./viewer.js";

const [tactus, examples] = process.argv.slice(2);
const here = import.meta.dirname;
const folder = await mkdtemp(join(tmpdir(), "tactus-foxglove-"));
const options = { cwd: folder, env: { ...process.env, TACTUS_RUN_DIR: join(folder, "run") } };

const kTopics = {
  "/scene": "foxglove.SceneUpdate", "/tf": "foxglove.FrameTransforms",
  "/tool": "foxglove.PoseInFrame", "/proxy": "foxglove.PoseInFrame",
  "/markers": "foxglove.SceneUpdate", "/force": "tactus.Force", "/joints": "tactus.Joints",
  "/state": "tactus.State", "/timing": "tactus.Timing",
};

// The corners and faces of an OFF file of triangles.
async function readOff(file) {
  const lines = (await readFile(file, "utf8")).split("\n")
    .map((line) => line.replace(/#.*/, "").trim()).filter(Boolean);
  assert.equal(lines[0], "OFF");
  const [corners, faces] = lines[1].split(/\s+/).map(Number);
  const rows = lines.slice(2).map((line) => line.split(/\s+/).map(Number));
  return { corners: rows.slice(0, corners), faces: rows.slice(corners, corners + faces) };
}

const kObjects = { gem: 0, turning: 1, table: 2, cube: 3 };

function checkChannels(viewer) {
  const topics = Object.fromEntries(
    [...viewer.channels.values()].map(({ topic, schemaName }) => [topic, schemaName]));
  assert.deepEqual(topics, kTopics);
  for (const channel of viewer.channels.values()) {
    assert.equal(channel.encoding, "json");
    assert.equal(channel.schemaEncoding, "jsonschema");
    assert.equal(JSON.parse(channel.schema).title, channel.schemaName);
  }
  assert.deepEqual(viewer.info.capabilities, []);
}

// Every message has the fields of its advertised schema, and all of those of the schema that
// Foxglove publishes under the same name; neither admits others.
function checkSchemas(viewer) {
  for (const { topic, schema, schemaName } of viewer.channels.values()) {
    const checks = [checkerOf(closed(JSON.parse(schema), false))];
    if (schemaName.startsWith("foxglove.")) {
      checks.push(checkerOf(closed(publishedSchema(schemaName), true)));
    }
    assert.ok(viewer.of(topic).length > 0, `${topic}: no message`);
    viewer.of(topic).forEach(({ data }) => checks.forEach((check) => check(data)));
  }
}

async function checkMesh(viewer) {
  const off = await readOff(join(folder, "gem.off"));
  const { entities } = viewer.of("/scene")[0].data;
  assert.deepEqual(entities.map(({ metadata }) => metadata.find(({ key }) => key === "name").value),
    Object.keys(kObjects));
  const [{ points, indices }] = entities[kObjects.gem].triangles;
  assert.equal(indices.length, 3 * off.faces.length);
  // Baking may sort corners and triangles: each of the file's triangles is there once, with its
  // corners in the same sense.
  const key = (corners) => {
    const texts = corners.map((p) => p.map((x) => (x + 0).toFixed(6)).join(" "));
    const first = texts.indexOf([...texts].sort()[0]);
    return [0, 1, 2].map((i) => texts[(first + i) % 3]).join(", ");
  };
  const shown = [];
  for (let i = 0; i < indices.length; i += 3) {
    shown.push(key(indices.slice(i, i + 3).map((k) => [points[k].x, points[k].y, points[k].z])));
  }
  const filed = off.faces.map(([, ...corners]) => key(corners.map((k) => off.corners[k])));
  assert.deepEqual(shown.sort(), filed.sort());
  assert.equal(entities[kObjects.gem].frame_id, "W");
  assert.equal(entities[kObjects.turning].frame_id, "object/1");
  assert.equal(entities[kObjects.cube].frame_id, "object/3");
  entities.forEach(({ triangles }) => assert.ok(triangles[0].indices.length > 0));
}

// The messages of one instant have one time; `tactus watch` has the same tick in the same digits.
function checkAgainstWatch(viewer, lines) {
  const ticks = new Map(lines.map((line) => {
    const fields = Object.fromEntries(line.split(" ").map((word) => word.split("=")));
    return [Number(fields.tick), fields];
  }));
  const at = (topic, time) => viewer.of(topic).find((message) => message.time === time)?.data;
  let compared = 0;
  let forced = 0;
  for (const { time, data: state } of viewer.of("/state")) {
    const watched = ticks.get(state.tick);
    const [tool, proxy, force] = ["/tool", "/proxy", "/force"].map((topic) => at(topic, time));
    if (!watched || !tool || !proxy || !force) {
      continue;
    }
    ++compared;
    for (const axis of ["x", "y", "z"]) {
      assert.equal(tool.pose.position[axis], Number(watched[`tool_${axis}_m`]));
      assert.equal(proxy.pose.position[axis], Number(watched[`proxy_${axis}_m`]));
      assert.equal(force[`force_${axis}_N`], Number(watched[`force_${axis}_N`]));
    }
    for (const word of ["mode", "faults", "limits", "contact"]) {
      assert.equal(state[word], watched[word]);
    }
    forced += force.force_y_N > 0.1 ? 1 : 0;
  }
  assert.ok(compared > 20, `only ${compared} ticks were seen by both`);
  assert.ok(forced > 0, "the gem pushed in no tick");
}

const nanoseconds = ({ sec, nsec }) => BigInt(sec) * 1_000_000_000n + BigInt(nsec);
const frame = (message, name) =>
  message.transforms.find(({ child_frame_id: child }) => child === name);

// Returns the tick of each time since 1970, from the lines of `tactus watch` and a tick that the
// viewer has, too.
function ticksByTime(viewer, lines) {
  const clock = lines.map((line) => line.match(/^tick=(\d+) .* scheduled_ns=(\d+)/))
    .map(([, tick, time]) => [Number(tick), BigInt(time)]);
  const due = new Map(clock);
  const { time, data: { tick } } = viewer.of("/state").find(({ data }) => due.has(data.tick));
  const offset = time - due.get(tick);
  return new Map(clock.map(([number, clockTime]) => [clockTime + offset, number]));
}

// The box turns by half a milliradian a tick, the cube comes to rest on the table, and the world's y
// is the z of the frame that Foxglove shows upright.
function checkFrames(viewer, lines) {
  const ticks = ticksByTime(viewer, lines);
  const messages = viewer.of("/tf").map(({ data }) => data);
  const turns = messages.map((message) => frame(message, "object/1"))
    .map(({ timestamp, rotation: { z, w } }) =>
      ({ tick: ticks.get(nanoseconds(timestamp)), angle: 2 * Math.atan2(z, w) }))
    // Nothing moves before the device is homed.
    .filter(({ tick, angle }) => tick !== undefined && angle !== 0);
  assert.ok(turns.length > 20, `only ${turns.length} places were seen by both`);
  for (const { tick, angle } of turns) {
    const spun = 0.0005 * (tick - turns[0].tick);
    assert.ok(Math.abs(angle - turns[0].angle - spun) < 1e-7, `${angle} rad at tick ${tick}`);
  }

  const cube = frame(messages.at(-1), "object/3").translation;
  // Its frame is that of the scene, in which its middle is at y = 0.05 m; on the table it is half an
  // edge high.
  assert.ok(Math.abs(cube.y - (0.015 - 0.05)) < 1e-3, `the cube has moved by ${cube.y} m`);
  const { parent_frame_id: parent, rotation } = frame(messages[0], "W");
  assert.equal(parent, "map");
  const { x, y, z, w } = rotation;
  // The second column of the rotation's matrix: the world's y.
  const up = [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)];
  up.forEach((part, i) => assert.ok(Math.abs(part - [0, 0, 1][i]) < 1e-8));
}

async function bake(name) {
  await run(tactus, ["bake", `${name}.toml`, "-o", `${name}.tactus`], options);
}

// Another scene takes the place of the first one in the same session.
async function checkOtherScene(viewer) {
  const before = viewer.of("/scene").length;
  await run(tactus, ["disable"], options);
  await run(tactus, ["scene", join(folder, "other_scene.tactus")], options);
  await until(() => viewer.of("/scene").length > before);
  const { deletions, entities } = viewer.newest("/scene");
  assert.equal(deletions[0].type, 1);
  assert.equal(entities.length, 1);
  assert.equal(entities[0].metadata[0].value, "ball");
  assert.ok(nanoseconds(entities[0].timestamp) > nanoseconds(deletions[0].timestamp));
}

function serve() {
  return start(tactus, ["sim", "scene.tactus", "--path", "wish.csv", "--serve"], options);
}

// A controller that ends and comes back is shown again, and users are told meanwhile.
async function checkNewController(viewer, simulation) {
  await simulation.end();
  await until(() => viewer.statuses.has("controller"));
  const another = serve();
  await until(() => !viewer.statuses.has("controller"));
  const seen = viewer.of("/state").length;
  await until(() => viewer.of("/state").length > seen + 5);
  assert.equal(viewer.newest("/scene").entities.length, 4);
  assert.equal(viewer.closeCode, undefined);
  return another;
}

// Starts the server, and returns it with its port.
async function serveFoxglove() {
  const foxglove = start(tactus, ["foxglove", "--port", "0"], options);
  const port = Number((await foxglove.line(/ws:\/\/127\.0\.0\.1:(\d+)/))[1]);
  return { foxglove, port };
}

// What cannot be served ends with 2 and a line that says what, and what to do.
async function checkRefusals(port) {
  for (const [words, says] of [
    [["--port", `${port}`], /another program has the port.*--port 0 finds a free one/],
    [["--address", "nonsense"], /--address.*nonsense/],
    [["--rate-hz", "0"], /--rate-hz: Value 0 not in range/],
    [["--run-dir", folder], /nobody answers there: is tactusd running/],
    [["--device", "no_such_device"], /no device is named "no_such_device"/]]) {
    const refused = start(tactus, ["foxglove", ...words], options);
    await refused.line(says);
    assert.equal((await refused.ended)[0], 2);
  }
}

// The devices of one controller have topics of their own, and one scene.
async function checkSeveralDevices() {
  const simulation = start(tactus, ["sim", "other_scene.tactus", "--device", "cartesian", "--device",
    "falcon", "--path", "wish.csv", "--path", "wish.csv", "--serve"], options);
  await simulation.line(/serving in/);
  const { foxglove, port } = await serveFoxglove();
  const viewer = new Viewer(port);
  await until(() => viewer.of("/falcon/joints").length > 0 && viewer.of("/scene").length > 0);
  const own = Object.keys(kTopics).filter((topic) => !["/scene", "/tf"].includes(topic));
  const expected = ["cartesian", "falcon"].flatMap((name) => own.map((topic) => `/${name}${topic}`));
  assert.deepEqual([...viewer.channels.keys()], ["/scene", "/tf", ...expected]);
  assert.equal(await foxglove.end(), 0);
  await simulation.end();
}

async function main() {
  await Promise.all(["scene.toml", "other_scene.toml", "wish.csv"].map(
    (name) => copyFile(join(here, name), join(folder, name))));
  await copyFile(join(examples, "gem/gem.off"), join(folder, "gem.off"));
  await bake("scene");
  await bake("other_scene");
  let simulation = serve();
  await simulation.line(/serving in/);
  const { foxglove, port } = await serveFoxglove();
  await run(tactus, ["home", "--wait"], options);
  await run(tactus, ["enable"], options);

  const watched = [];
  const watch = start(tactus, ["watch", "--fields",
    "tick,mode,faults,limits,contact,tool,proxy,force,scheduled_ns"], options);
  watch.lines((line) => watched.push(line));
  const viewer = new Viewer(port);
  const isPushed = ({ data }) => data.force_y_N > 0.5;
  await until(() => viewer.of("/force").some(isPushed) && viewer.of("/state").length > 100);
  await until(() => watched.some((line) => line.startsWith(`tick=${viewer.newest("/state").tick} `)));
  await watch.end();

  checkChannels(viewer);
  checkSchemas(viewer);
  await checkMesh(viewer);
  const ticks = watched.filter((line) => line.startsWith("tick="));
  checkAgainstWatch(viewer, ticks);
  checkFrames(viewer, ticks);
  await checkHostileClients(port, viewer);
  await checkRefusals(port);
  await checkOtherScene(viewer);
  simulation = await checkNewController(viewer, simulation);
  checkSchemas(viewer);

  assert.equal(viewer.error, undefined);
  assert.equal(await foxglove.end(), 0);
  await until(() => viewer.closeCode !== undefined);
  await simulation.end();
  await checkSeveralDevices();
  console.log(`${viewer.of("/state").length} messages of each topic are as they should be`);
}

try {
  await main();
} catch (error) {
  console.error(error);
  process.exitCode = 1;
} finally {
  killAll();
  await rm(folder, { recursive: true });
}
process.exit();
