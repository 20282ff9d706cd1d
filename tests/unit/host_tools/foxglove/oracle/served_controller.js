// Programs of the tests: a simulated controller behind its sockets, `tactus foxglove` in front of
// it, and the commands of a user.
import { execFile, spawn } from "node:child_process";
import { once } from "node:events";
import { createInterface } from "node:readline";
import { promisify } from "node:util";

const children = [];

// Kills what start() has started and is still there.
export function killAll() {
  children.forEach((child) => child.kill("SIGKILL"));
}

// Starts `tactus` with these words. `line` waits for a line of its messages that matches; `lines`
// gets every line of its output; `end` ends it as Ctrl-C does, and returns its exit code.
export function start(tactus, words, options) {
  const child = spawn(tactus, words, { ...options, stdio: ["ignore", "pipe", "pipe"] });
  children.push(child);
  const said = [];
  const waiting = [];
  createInterface({ input: child.stderr }).on("line", (line) => {
    said.push(line);
    for (const look of waiting.splice(0)) {
      look();
    }
  });
  const ended = once(child, "exit");
  const line = async (pattern) => {
    for (;;) {
      const found = said.map((one) => one.match(pattern)).find(Boolean);
      if (found) {
        return found;
      }
      const hasEnded = await Promise.race([
        new Promise((resolve) => waiting.push(() => resolve(false))), ended.then(() => true)]);
      if (hasEnded) {
        throw new Error(`tactus ${words.join(" ")} has ended: ${said.join("\n")}`);
      }
    }
  };
  const end = async () => {
    child.kill("SIGINT");
    return (await ended)[0];
  };
  const lines = (take) => createInterface({ input: child.stdout }).on("line", take);
  return { line, lines, end, ended };
}

// Runs `tactus` with these words to its end, and returns what it prints.
export async function run(tactus, words, options) {
  return (await promisify(execFile)(tactus, words, options)).stdout;
}

// Waits until the condition holds; it is asked again whenever something may have changed.
export async function until(condition) {
  while (!condition()) {
    await new Promise((resolve) => setTimeout(resolve, 5));
  }
}
