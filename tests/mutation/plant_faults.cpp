// plant_faults LIST SOURCE_ROOT TARGET_ROOT: copies the sources that LIST names from one tree into
// another with the list's faults in them, and prints a line for each: number, program, filter,
// name.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "tests/mutation/planted_faults.h"

namespace tactus::mutation {
namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw std::runtime_error(fmt::format("{}: cannot be read", path.string()));
  }
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// A file that is as it should be keeps its time, so that nothing is compiled again.
void write_if_changed(const std::filesystem::path& path, const std::string& text) {
  if (std::filesystem::exists(path) && text_of(path) == text) {
    return;
  }
  std::ofstream file(path, std::ios::binary);
  if (!(file << text << std::flush)) {
    throw std::runtime_error(fmt::format("{}: cannot be written", path.string()));
  }
}

void plant(const std::string& list, const std::filesystem::path& from,
           const std::filesystem::path& to) {
  const std::vector<PlantedFault> faults = read_faults(list, text_of(list));
  std::map<std::string, std::vector<PlantedFault>> by_file;
  for (const PlantedFault& fault : faults) {
    by_file[fault.file].push_back(fault);
  }
  for (const auto& [file, own] : by_file) {
    write_if_changed(to / file, with_faults(list, text_of(from / file), own));
  }
  for (const PlantedFault& fault : faults) {
    fmt::print("{}\t{}\t{}\t{}\t{}\n", fault.number, fault.program, fault.filter, fault.file,
               fault.name);
  }
}

}  // namespace
}  // namespace tactus::mutation

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: plant_faults LIST SOURCE_ROOT TARGET_ROOT\n", stderr);
    return 2;
  }
  try {
    tactus::mutation::plant(argv[1], argv[2], argv[3]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "plant_faults: %s\n", error.what());
    return 2;
  }
  return 0;
}
