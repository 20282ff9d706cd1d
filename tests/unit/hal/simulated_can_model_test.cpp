// Random work on a network of five nodes, beside a model that keeps one deque a node.

#include <gtest/gtest.h>
#include <linux/can.h>

#include <algorithm>
#include <array>
#include <deque>
#include <memory>
#include <vector>

#include "hal/simulated/can_bus.h"
#include "tests/unit/hal/random.h"

namespace tactus::hal {
namespace {

constexpr std::size_t kNodes = 5;
constexpr std::size_t kCapacity = 7;

struct ModelNode {
  std::deque<CanFrame> queue;
  std::vector<can_filter> filters{{0, 0}};
  std::uint64_t dropped = 0;
  bool up = true;
  bool off = false;

  bool wants(const CanFrame& frame) const {
    canid_t word = frame.id;
    word |= frame.extended ? CAN_EFF_FLAG : 0U;
    word |= frame.remote ? CAN_RTR_FLAG : 0U;
    return std::ranges::any_of(filters, [word](const can_filter& filter) {
      const canid_t wanted = filter.can_id & filter.can_mask & ~CAN_INV_FILTER;
      return ((word & filter.can_mask) == wanted) == ((filter.can_id & CAN_INV_FILTER) == 0);
    });
  }
};

class CanModel : public ::testing::Test {
 protected:
  CanModel() {
    for (std::size_t i = 0; i < kNodes; ++i) {
      nodes_.push_back(std::make_unique<SimulatedCanBus>(
          network_, SimulatedCanBusConfig{.receive_capacity = kCapacity}));
    }
  }

  CanFrame random_frame() {
    CanFrame frame;
    frame.extended = random_.one_in(4);
    frame.id = random_.bits() &
               (frame.extended ? 0x0104'0007U : 0x107U);  // few, so that filters meet them
    frame.fd = random_.one_in(3);
    frame.remote = !frame.fd && random_.one_in(5);
    frame.length = padded_fd_length(random_.below(frame.fd ? 65 : 9));
    for (std::size_t i = 0; i < frame.length; ++i) {
      frame.data[i] = static_cast<std::byte>(random_.bits());
    }
    return frame;
  }

  void send(std::size_t who) {
    std::vector<CanFrame> batch(1 + random_.below(4));
    std::ranges::generate(batch, [this] { return random_frame(); });
    const auto sent = nodes_[who]->send(batch);
    if (!model_[who].up || model_[who].off) {
      ASSERT_FALSE(sent);
      ASSERT_EQ(sent.error().code, model_[who].up ? ErrorCode::bus_off : ErrorCode::link_down);
      return;
    }
    ASSERT_EQ(sent, batch.size());
    for (std::size_t i = 0; i < kNodes; ++i) {
      for (const CanFrame& frame : batch) {
        if (i != who && model_[i].up && !model_[i].off && model_[i].wants(frame)) {
          if (model_[i].queue.size() < kCapacity) {
            model_[i].queue.push_back(frame);
          } else {
            ++model_[i].dropped;
          }
        }
      }
    }
  }

  void receive(std::size_t who) {
    std::vector<CanReceived> received(1 + random_.below(5));
    const auto count = nodes_[who]->receive(received, kNoWait);
    auto& queue = model_[who].queue;
    if (queue.empty()) {
      ASSERT_FALSE(count);
      ASSERT_EQ(count.error().code, model_[who].up ? ErrorCode::timeout : ErrorCode::link_down);
      return;
    }
    ASSERT_EQ(count, std::min(received.size(), queue.size()));
    for (std::size_t i = 0; i < *count; ++i) {
      const CanFrame& got = received[i].frame;
      ASSERT_EQ(filter_word(got), filter_word(queue.front()));
      ASSERT_EQ(got.fd, queue.front().fd);
      ASSERT_EQ(got.length, queue.front().length);
      ASSERT_EQ(got.data, queue.front().data);
      queue.pop_front();
    }
  }

  void change_filters(std::size_t who) {
    std::vector<CanFilter> filters(random_.below(4));
    model_[who].filters.clear();
    for (CanFilter& filter : filters) {
      filter.mask = random_.bits() & 0xC104'0107U & random_.bits();
      filter.word = filter_word(random_frame());
      filter.inverted = random_.one_in(4);
      model_[who].filters.push_back(
          {filter.word | (filter.inverted ? CAN_INV_FILTER : 0U), filter.mask & ~CAN_INV_FILTER});
    }
    ASSERT_TRUE(nodes_[who]->set_filters(filters));
  }

  void disturb(std::size_t who) {
    ModelNode& model = model_[who];
    if (random_.one_in(2)) {
      model.up = !model.up;
      model.off = false;
      nodes_[who]->set_link_up(model.up);
    } else if (model.up && !model.off) {
      model.off = true;
      nodes_[who]->force_bus_off();
    } else if (model.up) {
      model.off = false;
      ASSERT_TRUE(nodes_[who]->restart());
    }
  }

  Random random_{20'261'121};
  SimulatedClock clock_;
  SimulatedCanNetwork network_{clock_, {.fd = true}};
  std::vector<std::unique_ptr<SimulatedCanBus>> nodes_;
  std::array<ModelNode, kNodes> model_;
};

TEST_F(CanModel, NetworkAgreesWithTheModelThroughRandomWork) {
  for (int step = 0; step < 100'000 && !HasFatalFailure(); ++step) {
    SCOPED_TRACE(step);
    const std::size_t who = random_.below(kNodes);
    const std::size_t what = random_.below(100);
    if (what < 45) {
      send(who);
    } else if (what < 90) {
      receive(who);
    } else if (what < 97) {
      change_filters(who);
    } else {
      disturb(who);
    }
    ASSERT_EQ(nodes_[who]->counters().receive_dropped, model_[who].dropped);
    ASSERT_EQ(nodes_[who]->waiting_to_be_read(), model_[who].queue.size());
  }
  std::uint64_t received = 0;
  std::uint64_t dropped = 0;
  for (const auto& node : nodes_) {
    received += node->counters().received;
    dropped += node->counters().receive_dropped;
  }
  EXPECT_GT(received, 10'000U);
  EXPECT_GT(dropped, 1000U);
}

}  // namespace
}  // namespace tactus::hal
