#include "host_tools/export/zip_writer.h"

#include <fmt/format.h>
#include <minizip/zip.h>

#include <algorithm>
#include <limits>

#include "host_tools/input_error.h"

namespace tactus::host {

ZipWriter::ZipWriter(const std::filesystem::path& output)
    : output_(output),
      file_(output, OutputKind::file),
      zip_(::zipOpen64(file_.partial().c_str(), APPEND_STATUS_CREATE)) {
  if (zip_ == nullptr) {
    fail();
  }
}

ZipWriter::~ZipWriter() {
  if (zip_ != nullptr) {
    ::zipClose(zip_, nullptr);
  }
}

void ZipWriter::begin(const std::string& name, std::uint64_t bytes) {
  // A head of the old kind tells sizes below 4 GiB.
  constexpr std::uint64_t kOldKind_bytes = std::numeric_limits<std::uint32_t>::max() - 65536;
  zip_fileinfo info{};
  info.tmz_date = {
      .tm_sec = 0, .tm_min = 0, .tm_hour = 0, .tm_mday = 1, .tm_mon = 0, .tm_year = 1980};
  constexpr int kStored = 0;
  if (::zipOpenNewFileInZip64(zip_, name.c_str(), &info, nullptr, 0, nullptr, 0, nullptr, kStored,
                              0, bytes > kOldKind_bytes ? 1 : 0) != ZIP_OK) {
    fail();
  }
}

void ZipWriter::write(std::span<const std::byte> bytes) {
  // minizip counts the bytes of a call with 32 bits.
  constexpr std::size_t kAtOnce = std::size_t{1} << 30U;
  while (!bytes.empty()) {
    const auto part = bytes.first(std::min(bytes.size(), kAtOnce));
    if (::zipWriteInFileInZip(zip_, part.data(), static_cast<unsigned>(part.size())) != ZIP_OK) {
      fail();
    }
    bytes = bytes.subspan(part.size());
  }
}

void ZipWriter::end() {
  if (::zipCloseFileInZip(zip_) != ZIP_OK) {
    fail();
  }
}

void ZipWriter::commit() {
  const int closed = ::zipClose(zip_, nullptr);
  zip_ = nullptr;
  if (closed != ZIP_OK) {
    fail();
  }
  file_.commit();
}

void ZipWriter::fail() const {
  throw InputError(fmt::format("{}: cannot be written; is the disk full?", output_.string()));
}

}  // namespace tactus::host
