#include "host_tools/bake/mesh_file/ply_numbers.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

template <class Number>
double as_double(const std::array<char, 8>& bytes) {
  Number number{};
  std::memcpy(&number, bytes.data(), sizeof(Number));
  return static_cast<double>(number);
}

// Returns the number that the bytes are, in the machine's own order.
double ply_number(const std::array<char, 8>& bytes, PlyType type) {
  switch (type) {
    case PlyType::int8:
      return as_double<std::int8_t>(bytes);
    case PlyType::uint8:
      return as_double<std::uint8_t>(bytes);
    case PlyType::int16:
      return as_double<std::int16_t>(bytes);
    case PlyType::uint16:
      return as_double<std::uint16_t>(bytes);
    case PlyType::int32:
      return as_double<std::int32_t>(bytes);
    case PlyType::uint32:
      return as_double<std::uint32_t>(bytes);
    case PlyType::float32:
      return as_double<float>(bytes);
    case PlyType::float64:
      return as_double<double>(bytes);
  }
  return 0.0;
}

}  // namespace

void PlyNumbers::start(const FilePart& part, std::size_t total) {
  part_ = part;
  total_ = total;
  if (format_ == PlyFormat::ascii) {
    count_unused_words();
    line_ = text_.require_line(part, total);
  }
}

void PlyNumbers::count_unused_words() {
  if (line_.find_first_not_of(kBlanks) != std::string_view::npos && lines_with_more_++ == 0) {
    first_with_more_ = text_.number();
  }
  line_ = {};
}

double PlyNumbers::next(PlyType type) {
  if (format_ == PlyFormat::ascii) {
    const std::string_view word = next_word(line_);
    const std::optional<double> value = any_number(word);
    if (!value) {
      fail(word.empty() ? " has too few numbers" : fmt::format(": '{}' is not a number", word));
    }
    return *value;
  }
  const std::size_t size = size_of(type);
  if (body_.size() < size) {
    throw InputError(
        fmt::format("{}: the file ends before {} of {}; repair or export the mesh again",
                    text_.file(), part_.name(), total_));
  }
  std::array<char, 8> bytes{};
  const bool is_native =
      (format_ == PlyFormat::little_endian) == (std::endian::native == std::endian::little);
  for (std::size_t k = 0; k < size; ++k) {
    bytes[is_native ? k : size - 1 - k] = body_[k];
  }
  body_.remove_prefix(size);
  return ply_number(bytes, type);
}

double PlyNumbers::next_finite(PlyType type) {
  const double value = next(type);
  if (!std::isfinite(value)) {
    fail(fmt::format(" is not finite ({})", value));
  }
  return value;
}

std::int64_t PlyNumbers::next_whole(PlyType type) {
  const double value = next(type);
  constexpr double kMost = 9e15;
  if (!(std::abs(value) < kMost) || value != std::floor(value)) {
    fail(fmt::format(": '{}' is not a whole number", value));
  }
  return static_cast<std::int64_t>(value);
}

void PlyNumbers::fail(const std::string& what) const {
  if (format_ == PlyFormat::ascii) {
    text_.fail(part_.name() + what);
  }
  throw InputError(
      fmt::format("{}: {}{}; repair or export the mesh again", text_.file(), part_.name(), what));
}

std::optional<std::string> PlyNumbers::note_on_lines() {
  count_unused_words();
  if (lines_with_more_ == 0) {
    return std::nullopt;
  }
  return fmt::format(
      "{}:{}: {} lines have more numbers than the header's properties, which are left "
      "out, the first of them here; correct the header or the lines",
      text_.file(), first_with_more_, lines_with_more_);
}

std::optional<std::string> PlyNumbers::note_on_rest() {
  if (format_ == PlyFormat::ascii) {
    return text_.note_on_rest("the elements that the header declares");
  }
  if (body_.find_first_not_of(std::string_view("\0\r\n \t", 5)) == std::string_view::npos) {
    return std::nullopt;
  }
  return fmt::format(
      "{}: {} bytes after the elements that the header declares are left out; correct "
      "the counts if they belong to the mesh",
      text_.file(), body_.size());
}

}  // namespace tactus::host
