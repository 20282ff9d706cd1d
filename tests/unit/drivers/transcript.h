// Transcripts of what a driver and a device say to each other, kept as text.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/paths.h"

namespace tactus::drivers {

struct TranscriptLine {
  int number = 0;
  std::string word;
  std::string rest;
};

// The lines of tests/unit/drivers/transcripts/<name> but for empty ones and comments.
inline std::vector<TranscriptLine> transcript(const std::string& name) {
  std::ifstream file(tactus::testing::in_repository("tests/unit/drivers/transcripts/" + name));
  if (!file) {
    throw std::runtime_error("no transcript " + name);
  }
  std::vector<TranscriptLine> lines;
  int number = 0;
  for (std::string text; std::getline(file, text);) {
    ++number;
    if (text.empty() || text.front() == '#') {
      continue;
    }
    std::istringstream words(text);
    TranscriptLine line{.number = number, .word = {}, .rest = {}};
    words >> line.word;
    std::getline(words >> std::ws, line.rest);
    lines.push_back(line);
  }
  return lines;
}

inline std::vector<std::byte> hex_bytes(const std::string& text) {
  std::vector<std::byte> bytes;
  std::istringstream words(text);
  for (unsigned value = 0; words >> std::hex >> value;) {
    bytes.push_back(static_cast<std::byte>(value));
  }
  return bytes;
}

inline std::vector<std::byte> letter_bytes(const std::string& text) {
  std::vector<std::byte> bytes;
  for (const char letter : text) {
    bytes.push_back(static_cast<std::byte>(letter));
  }
  return bytes;
}

}  // namespace tactus::drivers
