// A command server before a controller, for the tests of the server.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "firmware/linux/commands/command_server.h"
#include "host_tools/remote/remote.h"
#include "tests/unit/rendering/scene/small_scene.h"

namespace tactus::firmware {

// Makes an empty folder of its own for a test.
inline std::filesystem::path new_folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "tactus-XXXXXX").string();
  EXPECT_NE(::mkdtemp(pattern.data()), nullptr);
  return pattern;
}

// A server before a controller whose loop runs in a thread, as fast as it comes.
class CommandServerTest : public ::testing::Test {
 public:
  CommandServerTest(const CommandServerTest&) = delete;
  CommandServerTest& operator=(const CommandServerTest&) = delete;
  ~CommandServerTest() override {
    server_->stop();
    stop_loop();
    std::filesystem::remove_all(folder_);
  }

 protected:
  CommandServerTest() {
    EXPECT_TRUE(controller_->configure(cartesian_config()));
    write_scene("left.tactus", testing::small_scene());
    const auto scene = scenes_->open_next((folder_ / "left.tactus").string());
    EXPECT_TRUE(scene);
    EXPECT_TRUE(controller_->load_scene((*scene)->objects(), {.tool_radius_m = 0.002}));
    scenes_->use_next();
  }

  void write_scene(const std::string& name, const host::BakedScene& scene) {
    const std::vector<std::byte> image = host::write_image(scene);
    std::ofstream file(folder_ / name, std::ios::binary);
    for (const std::byte byte : image) {
      file.put(static_cast<char>(byte));
    }
  }

  void serve(CommandServerConfig config = {}) {
    socket_path_ = (folder_ / host::kCommandSocket).string();
    config.socket_path = socket_path_.c_str();
    const auto started = server_->start(config);
    ASSERT_TRUE(started) << started.error().what;
  }

  void start_loop() {
    looping_ = true;
    loop_ = std::thread([this] {
      drivers::JointSample sample;
      sample.position = {0.0, 0.2, 0.0};
      while (looping_) {
        controller_->tick(sample, queue_->before_tick(*controller_));
        queue_->after_tick(*controller_);
        std::this_thread::sleep_for(std::chrono::microseconds(100));
      }
    });
  }

  void stop_loop() {
    looping_ = false;
    if (loop_.joinable()) {
      loop_.join();
    }
  }

  void start() {
    serve();
    start_loop();
  }

  // Programs that ask and do not wait for the answer.
  void ask_and_go(std::size_t programs) {
    for (std::size_t i = 0; i < programs; ++i) {
      host::Remote remote(folder_);
      EXPECT_THROW(remote.send("status", std::chrono::milliseconds(0)), host::UnreachableError);
    }
  }

  std::string say(const std::string& line) { return host::Remote(folder_).send(line).text; }

  std::filesystem::path folder_ = new_folder();
  std::string socket_path_;
  std::unique_ptr<Controller> controller_ = std::make_unique<Controller>();
  std::unique_ptr<CommandQueue> queue_ = std::make_unique<CommandQueue>();
  std::unique_ptr<SceneStore> scenes_ = std::make_unique<SceneStore>();
  std::unique_ptr<CommandServer> server_ = std::make_unique<CommandServer>(*queue_, scenes_.get());
  std::atomic<bool> looping_{false};
  std::thread loop_;
};

// Returns true if the text begins with `start`.
inline bool begins(const std::string& text, std::string_view start) {
  return text.starts_with(start);
}

}  // namespace tactus::firmware
