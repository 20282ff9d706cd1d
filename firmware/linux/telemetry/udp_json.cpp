#include "firmware/linux/telemetry/udp_json.h"

#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>
#include <cmath>
#include <string_view>

#include "firmware/linux/telemetry/text_buffer.h"

namespace tactus::firmware {
namespace {

// Writes the members of a JSON object.
class JsonObject {
 public:
  explicit JsonObject(TextBuffer& text) : text_(&text) { text_->text("{"); }

  TextBuffer& key(std::string_view name) {
    text_->text(first_ ? "\"" : ",\"").text(name).text("\":");
    first_ = false;
    return *text_;
  }
  void real(std::string_view name, double value) { put(key(name), value); }
  void whole(std::string_view name, auto value) { key(name).number(value); }
  void triple(std::string_view name, const Triple& value) {
    JsonObject inner(key(name));
    inner.real("x", value[0]);
    inner.real("y", value[1]);
    inner.real("z", value[2]);
    inner.close();
  }
  void reals(std::string_view name, std::span<const double> values) {
    key(name).text("[");
    for (std::size_t i = 0; i < values.size(); ++i) {
      put(text_->text(i == 0 ? "" : ","), values[i]);
    }
    text_->text("]");
  }
  void close() { text_->text("}"); }

 private:
  static void put(TextBuffer& text, double value) {
    constexpr int kDigits = 9;
    if (std::isfinite(value)) {
      text.rounded(value, kDigits);
    } else {
      text.text("null");
    }
  }

  TextBuffer* text_;
  bool first_ = true;
};

}  // namespace

std::span<const char> write_json(const RecordedTick& tick,
                                 std::array<char, kMaxDatagramBytes>& room) {
  const TelemetryRecord& record = tick.record;
  const std::size_t joints = std::min<std::size_t>(tick.joint_count, drivers::kMaxJoints);
  TextBuffer text(room);
  JsonObject json(text);
  json.real("timestamp", record.time_s);
  json.whole("tick", record.tick);
  json.whole("mode", static_cast<unsigned>(record.mode));
  json.whole("faults", record.faults);
  json.whole("limits", record.limits);
  json.whole("contact", static_cast<unsigned>(record.contact));
  json.whole("friction", static_cast<unsigned>(record.friction));
  json.triple("tool_m", record.tool_p_W);
  json.triple("tool_m_per_s", record.tool_v_W);
  json.triple("proxy_m", record.proxy_W);
  json.triple("force_N", record.force_commanded_W);
  json.triple("force_rendered_N", record.force_rendered_W);
  json.real("depth_m", record.depth_m);
  json.real("passivity_J", record.passivity_J);
  json.reals("joint_position", std::span(record.joint_position).first(joints));
  json.reals("joint_velocity", std::span(record.joint_velocity).first(joints));
  json.reals("joint_effort", std::span(record.joint_effort).first(joints));
  json.whole("sample_age_us", record.sample_age_us);
  json.whole("wake_latency_ns", tick.loop.wake_latency_ns());
  json.whole("busy_ns", tick.loop.busy_ns());
  json.whole("dropped", tick.dropped);
  json.close();
  return text.written();
}

int UdpJson::open(std::uint16_t port) {
  hal::FileDescriptor opened(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!opened.is_open()) {
    return errno;
  }
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  // The socket calls take every address as this general type.
  if (connect(opened.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
    return errno;
  }
  socket_ = std::move(opened);
  return 0;
}

void UdpJson::send(const RecordedTick& tick) {
  const auto datagram = write_json(tick, room_);
  // ECONNREFUSED only means that nobody listened to the previous datagram; it is not a failure.
  if (::send(socket_.get(), datagram.data(), datagram.size(), MSG_DONTWAIT) < 0 &&
      errno != ECONNREFUSED) {
    ++failed_;
  }
}

}  // namespace tactus::firmware
