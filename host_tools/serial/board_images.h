// The device image and the scene image of a board: from a file of the user, from the images that
// were fetched before, or over the line. The gateway's thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/line/message.h"
#include "host_tools/serial/board_link.h"

namespace tactus::host {

// Shows how much of an image has come.
using ShowProgress =
    std::function<void(std::string_view image, std::size_t bytes, std::size_t total)>;

// Returns the file of an image in such a folder, named by its checksum.
std::filesystem::path image_file(const std::filesystem::path& folder, firmware::BoardImage image,
                                 std::uint64_t checksum);

// Returns true if the file is an image of that checksum and size without a changed bit.
bool is_image_file(const std::filesystem::path& file, const firmware::ImageOnBoard& wanted);

// Throws InputError if the user's file is not the image that the board works with.
void check_user_image(const std::string& file, const firmware::ImageOnBoard& wanted);

// Fetches an image over the line. `other` gets the messages that are no part of it. Throws
// UnreachableError if the board stops sending it, or sends another one than it has said.
std::vector<std::byte> fetch_image(BoardLink& link, firmware::BoardImage image,
                                   const firmware::ImageOnBoard& wanted,
                                   const BoardLink::Hear& other, const ShowProgress& progress);

}  // namespace tactus::host
