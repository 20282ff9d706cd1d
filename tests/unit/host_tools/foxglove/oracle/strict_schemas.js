// JSON Schemas that admit no field beyond those that they name.
import { createRequire } from "node:module";

import Ajv from "ajv";

const require = createRequire(import.meta.url);
const published = require("@foxglove/schemas/jsonschema");

// Returns the schema with every object that names its fields closed, and all of them required if
// asked.
export function closed(schema, allRequired) {
  if (Array.isArray(schema)) {
    return schema.map((one) => closed(one, allRequired));
  }
  if (schema === null || typeof schema !== "object") {
    return schema;
  }
  const result = Object.fromEntries(
    Object.entries(schema).map(([key, value]) => [key, closed(value, allRequired)]));
  if (result.type === "object" && Object.keys(result.properties ?? {}).length > 0) {
    result.additionalProperties = false;
    if (allRequired) {
      result.required = Object.keys(result.properties);
    }
  }
  return result;
}

const ajv = new Ajv({ strict: false, allErrors: true });

// Returns a function that throws an error unless a message is one of the schema.
export function checkerOf(schema) {
  const validate = ajv.compile(schema);
  return (message) => {
    if (!validate(message)) {
      throw new Error(`${ajv.errorsText(validate.errors)}: ${JSON.stringify(message).slice(0, 300)}`);
    }
  };
}

// Returns the schema that Foxglove publishes under a name such as foxglove.PoseInFrame.
export function publishedSchema(name) {
  return published[name.replace("foxglove.", "")];
}
