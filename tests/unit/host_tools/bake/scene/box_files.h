// The box from (0, 0, 0) to (1, 2, 3) in every format that people are likely to bring.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tactus::testing {

struct BoxFile {
  std::string name;
  std::string content;
};

// Twelve triangles, wound counter-clockwise seen from outside. STL repeats its vertices, the others
// share eight.
std::vector<BoxFile> box_files();

inline constexpr std::array<std::array<float, 3>, 8> kBoxCorners{
    {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 3}, {1, 0, 3}, {1, 2, 3}, {0, 2, 3}}};
inline constexpr std::array<std::array<std::uint32_t, 3>, 12> kBoxTriangles{{{0, 2, 1},
                                                                             {0, 3, 2},
                                                                             {4, 5, 6},
                                                                             {4, 6, 7},
                                                                             {0, 1, 5},
                                                                             {0, 5, 4},
                                                                             {3, 6, 2},
                                                                             {3, 7, 6},
                                                                             {0, 4, 7},
                                                                             {0, 7, 3},
                                                                             {1, 2, 6},
                                                                             {1, 6, 5}}};

// The box as glTF, its node moved by `offset_x`.
std::string box_gltf(double offset_x);

}  // namespace tactus::testing
