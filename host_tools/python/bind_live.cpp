#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "host_tools/python/bindings.h"
#include "host_tools/recording/live_reader.h"
#include "host_tools/recording/record_columns.h"
#include "host_tools/remote/remote.h"
#include "host_tools/serial/line_session.h"
#include "host_tools/serial/serial_place.h"

namespace tactus::host::python {

namespace py = pybind11;

namespace {

std::chrono::milliseconds milliseconds_of(double seconds) {
  constexpr double kLongest_s = 1e6;
  return std::chrono::milliseconds(std::llround(1e3 * std::clamp(seconds, 0.0, kLongest_s)));
}

py::object object_of(const ColumnValue& value) {
  return std::visit(
      [](const auto& each) -> py::object {
        using Value = std::remove_cvref_t<decltype(each)>;
        if constexpr (std::is_same_v<Value, HashValue>) {
          return py::int_(each.hash);
        } else if constexpr (std::is_same_v<Value, std::string_view>) {
          return py::str(std::string(each));
        } else {
          return py::cast(each);
        }
      },
      value);
}

// The ticks of a running controller as dictionaries.
class LiveTicks {
 public:
  // Throws InputError if nobody answers at the socket.
  LiveTicks(const std::filesystem::path& folder, std::vector<std::string> fields,
            std::uint64_t every)
      : reader_((folder / kLiveSocketFile).string()), fields_(std::move(fields)), every_(every) {}

  // Returns the next tick, or None if none has come in that time or the controller has ended.
  py::object next(double patience_s);
  [[nodiscard]] bool ended() const { return reader_.ended(); }

 private:
  // Returns the next tick that is not passed over, or nothing.
  std::optional<firmware::RecordedTick> wait(std::chrono::steady_clock::time_point deadline);
  py::dict dict_of_tick(const firmware::RecordedTick& tick);

  LiveReader reader_;
  std::vector<std::string> fields_;
  std::uint64_t every_;
  std::uint64_t seen_ = 0;
  std::size_t joints_ = 0;
  std::vector<std::string> names_;
  std::vector<std::size_t> columns_;
  std::vector<ColumnValue> values_;
};

std::optional<firmware::RecordedTick> LiveTicks::wait(
    std::chrono::steady_clock::time_point deadline) {
  // Ctrl-C is heard as often.
  constexpr std::chrono::milliseconds kPiece(50);
  do {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        deadline - std::chrono::steady_clock::now());
    const auto message = reader_.next(std::clamp(left, std::chrono::milliseconds(0), kPiece));
    if (!message) {
      check_signals();
      continue;
    }
    const auto* const tick = std::get_if<firmware::RecordedTick>(&*message);
    if (tick != nullptr && seen_++ % every_ == 0) {
      return *tick;
    }
  } while (!reader_.ended() && std::chrono::steady_clock::now() < deadline);
  return std::nullopt;
}

py::dict LiveTicks::dict_of_tick(const firmware::RecordedTick& tick) {
  if (names_.empty()) {
    joints_ = std::min<std::size_t>(tick.joint_count, drivers::kMaxJoints);
    names_ = column_names(joints_);
    columns_ = chosen_columns(fields_.empty() ? names_ : fields_, joints_);
  }
  read_columns(tick, joints_, values_);
  py::dict entry;
  for (const std::size_t column : columns_) {
    entry[py::str(names_[column])] = object_of(values_[column]);
  }
  return entry;
}

py::object LiveTicks::next(double patience_s) {
  std::optional<firmware::RecordedTick> tick;
  {
    const py::gil_scoped_release released;
    tick = wait(std::chrono::steady_clock::now() + milliseconds_of(patience_s));
  }
  return tick ? py::object(dict_of_tick(*tick)) : py::object(py::none());
}

// The line to a board, if there is one, and the folder of the sockets.
class ControllerPlace {
 public:
  // Throws UnreachableError if no device has the name, or no board answers.
  ControllerPlace(const std::string& run_dir, const std::string& device, const std::string& serial)
      : folder_(serial.empty() ? run_folder_of(run_dir, device) : std::filesystem::path()) {
    if (!serial.empty()) {
      GatewayOptions options;
      options.place = parse_serial_place(serial);
      line_ = std::make_unique<LineSession>(std::move(options));
      folder_ = line_->folder();
    }
  }

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  // Ends the line. Throws UnreachableError if it was lost meanwhile.
  void close() {
    if (line_) {
      std::exchange(line_, nullptr)->finish();
    }
  }

 private:
  std::filesystem::path folder_;
  std::unique_ptr<LineSession> line_;
};

using ReplyParts = std::tuple<bool, std::string, std::vector<std::string>>;

ReplyParts parts_of(Reply reply) {
  return {reply.is_ok, std::move(reply.text), std::move(reply.lines)};
}

ReplyParts send_line(const ControllerPlace& place, const std::string& line, double patience_s) {
  const py::gil_scoped_release released;
  Remote remote(place.folder());
  return parts_of(remote.send(line, milliseconds_of(patience_s)));
}

ReplyParts stop(const ControllerPlace& place) {
  const py::gil_scoped_release released;
  return parts_of(send_stop(place.folder()));
}

}  // namespace

void bind_live(py::module_& module) {
  module.attr("DEFAULT_RUN_DIR") = std::string(kDefaultRunDir);
  py::class_<LiveTicks>(module, "LiveTicks")
      .def("next", &LiveTicks::next, py::arg("patience_s"))
      .def_property_readonly("ended", &LiveTicks::ended);
  py::class_<ControllerPlace>(module, "ControllerPlace")
      .def(py::init<const std::string&, const std::string&, const std::string&>(),
           py::arg("run_dir"), py::arg("device"), py::arg("serial"),
           py::call_guard<py::gil_scoped_release>())
      .def("send", &send_line, py::arg("line"), py::arg("patience_s"))
      .def("stop", &stop)
      .def(
          "ticks",
          [](const ControllerPlace& place, std::vector<std::string> fields, std::uint64_t every) {
            return std::make_unique<LiveTicks>(place.folder(), std::move(fields), every);
          },
          py::arg("fields"), py::arg("every"))
      .def("close", &ControllerPlace::close, py::call_guard<py::gil_scoped_release>());
}

}  // namespace tactus::host::python
