#include "tests/unit/host_tools/bake/scene/box_files.h"

#include <algorithm>
#include <bit>
#include <sstream>
#include <string_view>

namespace tactus::testing {
namespace {

template <class Value>
void append(std::string& bytes, Value value, std::endian order = std::endian::little) {
  auto raw = std::bit_cast<std::array<char, sizeof(Value)>>(value);
  if (order != std::endian::native) {
    std::ranges::reverse(raw);
  }
  bytes.append(raw.data(), raw.size());
}

void write_vertices(std::ostream& out, std::string_view prefix) {
  for (const auto& corner : kBoxCorners) {
    out << prefix << corner[0] << ' ' << corner[1] << ' ' << corner[2] << '\n';
  }
}

void write_faces(std::ostream& out, std::string_view prefix, std::uint32_t first) {
  for (const auto& triangle : kBoxTriangles) {
    out << prefix << triangle[0] + first << ' ' << triangle[1] + first << ' ' << triangle[2] + first
        << '\n';
  }
}

std::string off() {
  std::ostringstream out;
  out << "OFF\n# a box\n8 12 0\n";
  write_vertices(out, "");
  write_faces(out, "3 ", 0);
  return out.str();
}

std::string obj() {
  std::ostringstream out;
  out << "# a box\no box\n";
  write_vertices(out, "v ");
  write_faces(out, "f ", 1);
  return out.str();
}

std::string ply_header(std::string_view format) {
  std::ostringstream out;
  out << "ply\nformat " << format << " 1.0\ncomment a box\nelement vertex 8\nproperty float x\n"
      << "property float y\nproperty float z\nelement face 12\n"
      << "property list uchar int vertex_indices\nend_header\n";
  return out.str();
}

std::string ascii_ply() {
  std::ostringstream out;
  out << ply_header("ascii");
  write_vertices(out, "");
  write_faces(out, "3 ", 0);
  return out.str();
}

std::string binary_ply(std::endian order) {
  std::string bytes =
      ply_header(order == std::endian::little ? "binary_little_endian" : "binary_big_endian");
  for (const auto& corner : kBoxCorners) {
    for (const float x : corner) {
      append(bytes, x, order);
    }
  }
  for (const auto& triangle : kBoxTriangles) {
    append(bytes, std::uint8_t{3}, order);
    for (const std::uint32_t index : triangle) {
      append(bytes, index, order);
    }
  }
  return bytes;
}

std::string ascii_stl() {
  std::ostringstream out;
  out << "solid box\n";
  for (const auto& triangle : kBoxTriangles) {
    out << "  facet normal 0 0 0\n    outer loop\n";
    for (const std::uint32_t index : triangle) {
      const auto& corner = kBoxCorners[index];
      out << "      vertex " << corner[0] << ' ' << corner[1] << ' ' << corner[2] << '\n';
    }
    out << "    endloop\n  endfacet\n";
  }
  out << "endsolid box\n";
  return out.str();
}

std::string binary_stl() {
  std::string bytes(80, ' ');
  append(bytes, static_cast<std::uint32_t>(kBoxTriangles.size()));
  for (const auto& triangle : kBoxTriangles) {
    bytes.append(12, '\0');
    for (const std::uint32_t index : triangle) {
      for (const float x : kBoxCorners[index]) {
        append(bytes, x);
      }
    }
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      three = three << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : kDigits[three >> (18 - 6 * k) & 63U];
    }
  }
  return text;
}

}  // namespace

std::string box_gltf(double offset_x) {
  std::string buffer;
  for (const auto& corner : kBoxCorners) {
    for (const float x : corner) {
      append(buffer, x);
    }
  }
  const std::size_t indices_at = buffer.size();
  for (const auto& triangle : kBoxTriangles) {
    for (const std::uint32_t index : triangle) {
      append(buffer, static_cast<std::uint16_t>(index));
    }
  }
  std::ostringstream out;
  out << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
      << R"("nodes":[{"mesh":0,"translation":[)" << offset_x << R"(,0,0]}],)"
      << R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
      << R"("accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3",)"
      << R"("min":[0,0,0],"max":[1,2,3]},)"
      << R"({"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}],)"
      << R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":)" << indices_at
      << R"(},{"buffer":0,"byteOffset":)" << indices_at << R"(,"byteLength":72}],)"
      << R"("buffers":[{"byteLength":)" << buffer.size()
      << R"(,"uri":"data:application/octet-stream;base64,)" << base64(buffer) << R"("}]})";
  return out.str();
}

std::vector<BoxFile> box_files() {
  return {{"box.off", off()},
          {"box.obj", obj()},
          {"ascii.ply", ascii_ply()},
          {"little.ply", binary_ply(std::endian::little)},
          {"big.ply", binary_ply(std::endian::big)},
          {"ascii.stl", ascii_stl()},
          {"binary.stl", binary_stl()},
          {"box.gltf", box_gltf(0.0)}};
}

}  // namespace tactus::testing
