#include "rendering/scene/scene_error.h"

#include <array>
#include <cstddef>

namespace tactus::rendering {
namespace {

// The text of one fault: what is wrong and what to do, and what SceneError::place counts.
struct Text {
  std::string_view description;
  std::string_view noun;
};

// The texts, in the order of SceneFault.
constexpr std::array kTexts{
    Text{"image is not aligned in memory; load it at a multiple of 16 bytes", ""},
    Text{"image is cut short; copy it again or bake the scene again", "byte"},
    Text{"not a Tactus scene image; bake the scene into one first", "byte"},
    Text{"image format is older than this program reads; bake the scene again", "version"},
    Text{"image format is newer than this program reads; update the program", "version"},
    Text{"image states a size over 2 GiB; bake a smaller scene", "size"},
    Text{"bytes follow after the image's end; copy it again or bake the scene again", "byte"},
    Text{"checksum does not match, bits have changed; copy it again or bake the scene again", ""},
    Text{"payload is malformed; bake the scene again", ""},
    Text{"there are no objects; bake the scene again", ""},
    Text{"tool radius is negative or not finite; bake the scene again", ""},
    Text{"unknown value of sides; bake the scene again", "value"},
    Text{"unknown friction model; update the program", "model"},
    Text{
        "material has a coefficient that is negative, not finite or dynamic above static; bake the "
        "scene again",
        ""},
    Text{"mesh is empty; bake the scene again", ""},
    Text{"mesh arrays differ in size; bake the scene again", ""},
    Text{"vertex is not finite; bake the scene again", "vertex"},
    Text{"vertex normal is not finite; bake the scene again", "vertex"},
    Text{"vertex index is out of range; bake the scene again", "triangle"},
    Text{"neighbour is out of range or not mutual; bake the scene again", "triangle"},
    Text{"hierarchy has a child out of place; bake the scene again", "node"},
    Text{"hierarchy is deeper than 64 levels; bake the scene again", "node"},
    Text{"hierarchy does not cover the triangles once each, in order; bake the scene again",
         "node"},
    Text{"hierarchy has a box that does not hold what is below it; bake the scene again", "node"},
    Text{"shape has a number that is not finite or out of range; bake the scene again", ""},
    Text{"formula cannot be carried out; bake the scene again", "instruction"},
    Text{"unknown contact method, or one that does not go with the surface; bake the scene again",
         "method"},
    Text{"there are no tools; bake the scene again", ""},
    Text{"corner normals are not as many as triangles; bake the scene again", "count"},
    Text{"texture coordinates are not as many as triangles, or out of range; bake the scene again",
         "triangle"},
    Text{"texture has a size or a number that is out of range; bake the scene again", "texture"},
    Text{"effect has an unknown law or a number out of range; bake the scene again", "effect"},
    Text{"motion has a number out of range, or its object does not move; bake the scene again", ""},
    Text{"the scene is larger than this program has room for; leave something out", ""},
    Text{"effect has a law that this program does not know; update the program", "effect"},
    Text{"body has a mass, a hull or a number that is out of range, or its object cannot be one; "
         "bake the scene again",
         ""},
    Text{"needle has a number that is out of range; bake the scene again", ""},
    Text{
        "tissue has a number that is out of range, or its object cannot be pierced; bake the scene "
        "again",
        ""},
    Text{"part of a body is neither a convex primitive nor a hull that can be used; bake the scene "
         "again",
         "part"},
};
static_assert(kTexts.size() == static_cast<std::size_t>(SceneFault::body_part) + 1);

const Text& text_of(SceneFault fault) {
  return kTexts[static_cast<std::size_t>(fault)];
}

}  // namespace

FaultName::FaultName(std::string_view text) {
  constexpr auto is_printable = [](char letter) { return letter >= ' ' && letter <= '~'; };
  for (const char letter : text.substr(0, text_.size())) {
    text_[size_++] = is_printable(letter) ? letter : '?';
  }
}

std::string_view describe(SceneFault fault) {
  return text_of(fault).description;
}

std::string_view describe(const SceneError& error, std::span<char> room) {
  return error.fault == SceneFault::capacity ? exceeded_words(error.exceeded, room)
                                             : describe(error.fault);
}

std::string_view place_noun(SceneFault fault) {
  return text_of(fault).noun;
}

}  // namespace tactus::rendering
