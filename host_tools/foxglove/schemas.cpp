#include "host_tools/foxglove/schemas.h"

#include <nlohmann/json.hpp>

#include <initializer_list>
#include <string_view>
#include <utility>

namespace tactus::host {
namespace {

using Json = nlohmann::ordered_json;

// A member of an object and its schema.
struct SchemaMember {
  std::string_view name;
  Json schema;
};

Json simple(std::string_view type) {
  return {{"type", type}};
}

Json number() {
  return simple("number");
}

Json object(std::initializer_list<SchemaMember> members) {
  Json properties = Json::object();
  for (const SchemaMember& member : members) {
    properties[std::string(member.name)] = member.schema;
  }
  return {{"type", "object"}, {"properties", std::move(properties)}};
}

Json array(Json items) {
  return {{"type", "array"}, {"items", std::move(items)}};
}

// A schema with the name by which Foxglove knows it.
Json titled(std::string_view title, Json schema) {
  schema["title"] = title;
  return schema;
}

// A time or a duration.
Json seconds(std::string_view title) {
  constexpr int kMostNs = 999'999'999;
  return titled(title,
                object({{"sec", {{"type", "integer"}, {"minimum", 0}}},
                        {"nsec", {{"type", "integer"}, {"minimum", 0}, {"maximum", kMostNs}}}}));
}

Json vector3() {
  return titled("foxglove.Vector3", object({{"x", number()}, {"y", number()}, {"z", number()}}));
}

Json point3() {
  return titled("foxglove.Point3", object({{"x", number()}, {"y", number()}, {"z", number()}}));
}

Json quaternion() {
  return titled("foxglove.Quaternion",
                object({{"x", number()}, {"y", number()}, {"z", number()}, {"w", number()}}));
}

Json pose() {
  return titled("foxglove.Pose", object({{"position", vector3()}, {"orientation", quaternion()}}));
}

Json color() {
  return titled("foxglove.Color",
                object({{"r", number()}, {"g", number()}, {"b", number()}, {"a", number()}}));
}

Json arrow() {
  return titled("foxglove.ArrowPrimitive", object({{"pose", pose()},
                                                   {"shaft_length", number()},
                                                   {"shaft_diameter", number()},
                                                   {"head_length", number()},
                                                   {"head_diameter", number()},
                                                   {"color", color()}}));
}

Json sphere() {
  return titled("foxglove.SpherePrimitive",
                object({{"pose", pose()}, {"size", vector3()}, {"color", color()}}));
}

Json triangles() {
  return titled("foxglove.TriangleListPrimitive",
                object({{"pose", pose()},
                        {"points", array(point3())},
                        {"color", color()},
                        {"colors", array(color())},
                        {"indices", array({{"type", "integer"}, {"minimum", 0}})}}));
}

Json entity() {
  const Json metadata = titled("foxglove.KeyValuePair",
                               object({{"key", simple("string")}, {"value", simple("string")}}));
  return titled("foxglove.SceneEntity", object({{"timestamp", seconds("time")},
                                                {"frame_id", simple("string")},
                                                {"id", simple("string")},
                                                {"lifetime", seconds("duration")},
                                                {"frame_locked", simple("boolean")},
                                                {"metadata", array(metadata)},
                                                {"arrows", array(arrow())},
                                                {"cubes", array(object({}))},
                                                {"spheres", array(sphere())},
                                                {"cylinders", array(object({}))},
                                                {"lines", array(object({}))},
                                                {"triangles", array(triangles())},
                                                {"texts", array(object({}))},
                                                {"models", array(object({}))}}));
}

}  // namespace

std::string scene_update_schema() {
  const Json deletion =
      titled("foxglove.SceneEntityDeletion",
             object({{"timestamp", seconds("time")},
                     {"type", {{"type", "integer"}, {"minimum", 0}, {"maximum", 1}}},
                     {"id", simple("string")}}));
  return titled(kSceneUpdateSchema,
                object({{"deletions", array(deletion)}, {"entities", array(entity())}}))
      .dump();
}

std::string pose_in_frame_schema() {
  return titled(kPoseInFrameSchema, object({{"timestamp", seconds("time")},
                                            {"frame_id", simple("string")},
                                            {"pose", pose()}}))
      .dump();
}

std::string frame_transforms_schema() {
  const Json transform =
      titled("foxglove.FrameTransform", object({{"timestamp", seconds("time")},
                                                {"parent_frame_id", simple("string")},
                                                {"child_frame_id", simple("string")},
                                                {"translation", vector3()},
                                                {"rotation", quaternion()}}));
  return titled(kFrameTransformsSchema, object({{"transforms", array(transform)}})).dump();
}

std::string fields_schema(const std::string& title, std::span<const NamedField> fields) {
  Json properties = Json::object();
  for (const NamedField& field : fields) {
    properties[field.name] = simple(field.is_number ? "number" : "string");
  }
  return titled(title, {{"type", "object"}, {"properties", std::move(properties)}}).dump();
}

}  // namespace tactus::host
