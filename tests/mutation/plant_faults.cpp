// plant_faults LIST SOURCE_ROOT TARGET_ROOT <FILES: copies the files that standard input names, one
// a line, from one tree into another with the list's faults in them, and prints a line for each
// fault: number, program, filter, file, name.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

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

// A file that is as it should be keeps its time, so that nothing is compiled again. A new one has
// the permissions of the file that it is made from.
void write_if_changed(const std::filesystem::path& from, const std::filesystem::path& path,
                      const std::string& text) {
  if (std::filesystem::exists(path) && text_of(path) == text) {
    return;
  }
  std::filesystem::create_directories(path.parent_path());
  std::filesystem::copy_file(from, path, std::filesystem::copy_options::overwrite_existing);
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
  for (std::string file; std::getline(std::cin, file);) {
    const std::string text = text_of(from / file);
    const auto own = by_file.extract(file);
    write_if_changed(from / file, to / file,
                     own.empty() ? text : with_faults(list, text, own.mapped()));
  }
  if (!by_file.empty()) {
    const PlantedFault& fault = by_file.begin()->second.front();
    throw std::runtime_error(fmt::format("{}:{}: {} is none of the files that are copied", list,
                                         fault.line, fault.file));
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
    std::fputs("usage: plant_faults LIST SOURCE_ROOT TARGET_ROOT <FILES\n", stderr);
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
