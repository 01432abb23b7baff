// A wrapper for `i7000 vectors -- node docs/examples/vectors.js`: a few functions, to show how little it takes.
// The protocol is in docs/port_the_codec.md, what the functions do in spec/runner.md.
"use strict";
const TYPES = new Map(require("../../spec/tables/type_codes.json").rows.map((row) => [row.code, row]));
const [OVER, UNDER] = ["over_range", "under_range"];
const OUT_OF_RANGE = { "+9999.9": OVER, "-9999.9": UNDER, "+999.99": OVER, "-999.99": UNDER };
class Fault extends Error {} // what the codec refuses; the message is the name of the fault

const sum = (bytes) => (bytes.reduce((a, b) => a + b, 0) & 0xff).toString(16).toUpperCase().padStart(2, "0");

function crc(bytes) {
  let c = 0xffff;
  for (const byte of bytes) {
    c ^= byte;
    for (let bit = 0; bit < 8; bit++) c = c & 1 ? (c >> 1) ^ 0xa001 : c >> 1;
  }
  return Buffer.from([c & 0xff, c >> 8]).toString("hex");
}

function split(bytes, checksum) {
  const events = [];
  let start = 0, fault = ""; // what began and has not ended: noise if it has a fault, else a frame
  const cut = (end, event) => {
    if (end > start) events.push(event(bytes.toString("hex", start, end)));
    [start, fault] = [end, ""];
  };
  const drop = (end, reason) => cut(end, (noise) => ({ noise, fault: reason }));
  bytes.forEach((byte, at) => {
    if ("%#$~@!>?".includes(String.fromCharCode(byte))) drop(at, fault || "terminator");
    else if (fault || start === at) fault ||= "leading";
    else if (byte === 0x0d) {
      const body = bytes.subarray(start, at - 2);
      if (checksum && (at - start < 3 || sum(body) !== bytes.toString("latin1", at - 2, at))) drop(at + 1, "checksum");
      else cut(at + 1, (frame) => ({ frame }));
    } else if (byte < 0x20 || byte > 0x7e) fault = "character";
    else if (at - start === 255) fault = "length";
  });
  if (fault) drop(bytes.length, fault);
  return { events, rest: bytes.toString("hex", start) };
}

function read({ text, type_code, format }) {
  if (format !== "engineering") return undefined;
  if (text in OUT_OF_RANGE) return { value: null, status: OUT_OF_RANGE[text] };
  if (text === " ".repeat(7)) return { value: null, status: "disabled" };
  const { engineering_decimals: decimals, minimum, maximum, max } = TYPES.get(type_code);
  const value = Number(text), inRange = value >= minimum - max / 10 - 1e-9 && value <= maximum + max / 10 + 1e-9;
  if (!/^[+-]\d+\.\d+$/.test(text) || text.length !== 7 || text.at(-1 - decimals) !== "." || !inRange) throw new Fault("number");
  return { value, status: "ok" };
}

const OPERATIONS = {
  "frames.checksum": ({ body }) => ({ checksum: sum(Buffer.from(body, "hex")) }),
  "frames.crc": ({ body }) => ({ crc: crc(Buffer.from(body, "hex")) }),
  "frames.split": ({ pieces, checksum }) => split(Buffer.from(pieces.join(""), "hex"), checksum),
  "readings.read": read,
};

function answer({ cmd, case: asked }) {
  const implementation = { name: "vectors.js", version: "1", language: "JavaScript" };
  if (cmd === "start") return { protocol: 1, implementation, operations: Object.keys(OPERATIONS) };
  try {
    const result = OPERATIONS[asked.operation](asked.input, asked.profile);
    return result ? { result } : { skipped: "not written yet" };
  } catch (error) {
    return error instanceof Fault ? { error: { fault: error.message } } : { crashed: String(error) };
  }
}

require("node:readline").createInterface({ input: process.stdin }).on("line", (line) => {
  const message = JSON.parse(line);
  if (message.cmd === "stop") process.exit(0);
  console.log(JSON.stringify({ seq: message.seq, ...answer(message) }));
});
