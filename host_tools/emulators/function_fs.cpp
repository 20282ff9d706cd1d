#include "host_tools/emulators/function_fs.h"

#include <fcntl.h>
#include <linux/usb/functionfs.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>

#include "hal/linux/system.h"
#include "host_tools/input_error.h"

namespace tactus::host {

namespace {

// How soon the threads notice that the program ends, how long they wait after an error, and the
// size of a high-speed bulk packet.
constexpr int kPollInterval_ms = 5;
constexpr std::chrono::milliseconds kRetry{1};
constexpr std::size_t kLargestPacket = 512;

// Little-endian bytes, as USB descriptors are.
class Blob {
 public:
  void add(std::uint32_t value) { add_bytes(value, 4); }
  void add_short(std::uint32_t value) { add_bytes(value, 2); }
  void add_byte(std::uint32_t value) { add_bytes(value, 1); }
  // Returns the bytes with their length in the second word, where both headers of FunctionFS have
  // it.
  std::vector<std::uint8_t> with_length() const {
    auto bytes = bytes_;
    bytes.at(4) = static_cast<std::uint8_t>(bytes.size());
    bytes.at(5) = static_cast<std::uint8_t>(bytes.size() >> 8U);
    return bytes;
  }

 private:
  void add_bytes(std::uint32_t value, unsigned count) {
    for (unsigned i = 0; i < count; ++i) {
      bytes_.push_back(static_cast<std::uint8_t>(value >> (8U * i)));
    }
  }
  std::vector<std::uint8_t> bytes_;
};

// Adds the descriptor of a bulk endpoint.
void add_endpoint(Blob& blob, std::uint32_t address, std::uint32_t max_packet) {
  blob.add_byte(USB_DT_ENDPOINT_SIZE);
  blob.add_byte(USB_DT_ENDPOINT);
  blob.add_byte(address);
  blob.add_byte(USB_ENDPOINT_XFER_BULK);
  blob.add_short(max_packet);
  blob.add_byte(0);
}

// Adds an interface with a bulk endpoint in each direction, 1 in and 2 out, as an FTDI chip has.
void add_interface(Blob& blob, std::uint32_t max_packet) {
  blob.add_byte(USB_DT_INTERFACE_SIZE);
  blob.add_byte(USB_DT_INTERFACE);
  blob.add_byte(0);  // number
  blob.add_byte(0);  // alternate
  blob.add_byte(2);  // endpoints
  blob.add_byte(USB_CLASS_VENDOR_SPEC);
  blob.add_byte(0xFF);
  blob.add_byte(0xFF);
  blob.add_byte(0);  // no name
  add_endpoint(blob, USB_DIR_IN | 1U, max_packet);
  add_endpoint(blob, USB_DIR_OUT | 2U, max_packet);
}

// Returns the descriptors for full speed (packets of 64 bytes) and high speed, three of each.
std::vector<std::uint8_t> descriptors() {
  Blob blob;
  blob.add(FUNCTIONFS_DESCRIPTORS_MAGIC_V2);
  blob.add(0);
  // An FTDI chip's requests are addressed to the device and not to its interface, so all recipients
  // are wanted.
  blob.add(FUNCTIONFS_HAS_FS_DESC | FUNCTIONFS_HAS_HS_DESC | FUNCTIONFS_ALL_CTRL_RECIP);
  blob.add(3);
  blob.add(3);
  add_interface(blob, 64);
  add_interface(blob, kLargestPacket);
  return blob.with_length();
}

// Returns the table of strings, which FunctionFS demands: an empty one.
std::vector<std::uint8_t> no_strings() {
  Blob blob;
  blob.add(FUNCTIONFS_STRINGS_MAGIC);
  blob.add(0);
  blob.add(0);
  blob.add(0);
  return blob.with_length();
}

// Returns a file descriptor. Throws InputError with the reason.
int open_file(const std::filesystem::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC);
  if (descriptor < 0) {
    throw InputError("cannot open " + path.string() + ": " + std::strerror(errno));
  }
  return descriptor;
}

// Throws InputError if FunctionFS does not take all bytes.
void write_all(int descriptor, const std::vector<std::uint8_t>& bytes) {
  if (::write(descriptor, bytes.data(), bytes.size()) != std::ssize(bytes)) {
    throw InputError(std::string("FunctionFS does not take the descriptors: ") +
                     std::strerror(errno));
  }
}

hal::UsbSetup setup_of(const usb_ctrlrequest& request) {
  return {.request_type = request.bRequestType,
          .request = request.bRequest,
          .value = request.wValue,
          .index = request.wIndex};
}

}  // namespace

FunctionFs::FunctionFs(GadgetDevice& device, const GadgetPlace& place)
    : device_(device), place_(place) {
  control_ = open_file(place.function_fs / "ep0", O_RDWR);
  write_all(control_, descriptors());
  write_all(control_, no_strings());
  // Non-blocking: an endpoint of an unplugged gadget then returns an error instead of waiting for
  // ever.
  in_ = open_file(place.function_fs / "ep1", O_RDWR | O_NONBLOCK);
  out_ = open_file(place.function_fs / "ep2", O_RDWR | O_NONBLOCK);
  // The signals that end the run belong to the main thread. Another thread would consume them where
  // the shell ignores them, or die of them.
  sigset_t all;
  sigfillset(&all);
  const hal::SignalMask no_signals(SIG_SETMASK, all);
  threads_.emplace_back([this] { serve_control(); });
  threads_.emplace_back([this] { serve_out(); });
  threads_.emplace_back([this] { serve_in(); });
}

FunctionFs::~FunctionFs() {
  ending_ = true;
  wake();
  try {
    unplug();  // ends what the threads wait for
    // NOLINTNEXTLINE(bugprone-empty-catch): it was not plugged in
  } catch (const InputError&) {
  }
  for (std::thread& thread : threads_) {
    thread.join();
  }
  for (const int descriptor : {in_, out_, control_}) {
    ::close(descriptor);
  }
}

void FunctionFs::plug_in() {
  bind(place_.controller);
}

void FunctionFs::unplug() {
  bind("");
}

void FunctionFs::bind(const std::string& controller) const {
  const int file = open_file(place_.gadget / "UDC", O_WRONLY);
  const std::string line = controller + "\n";
  const bool done = ::write(file, line.data(), line.size()) == std::ssize(line);
  const int reason = errno;
  ::close(file);
  if (!done) {
    throw InputError("cannot bind " + place_.gadget.string() + " to '" + controller +
                     "': " + std::strerror(reason));
  }
}

void FunctionFs::serve_control() {
  while (!ending_) {
    pollfd waiting{.fd = control_, .events = POLLIN, .revents = 0};
    usb_functionfs_event event{};
    if (poll(&waiting, 1, kPollInterval_ms) > 0 &&
        ::read(control_, &event, sizeof event) == sizeof event && event.type == FUNCTIONFS_SETUP) {
      answer(setup_of(event.u.setup), event.u.setup.wLength);
    }
  }
}

// FunctionFS stalls a request when the program reads where data are to be written, or the other way
// round.
void FunctionFs::answer(const hal::UsbSetup& setup, std::size_t length) {
  std::array<std::byte, hal::kMaxUsbControlBytes> buffer{};
  const std::lock_guard lock(mutex_);
  ssize_t done = 0;
  if ((setup.request_type & USB_DIR_IN) != 0) {
    const auto data = device_.control_in(setup);
    done = data ? ::write(control_, data->data(), std::min(length, data->size()))
                : ::read(control_, buffer.data(), 0);
  } else {
    done = device_.control_out(setup)
               ? ::read(control_, buffer.data(), std::min(length, buffer.size()))
               : ::write(control_, buffer.data(), 0);
  }
  (void)done;  // a stall reports itself as an error, an unplug as another: nothing follows from
               // either
  wake();
}

void FunctionFs::serve_out() {
  std::array<std::byte, kLargestPacket> packet{};
  while (!ending_) {
    // A transfer ends when its buffer is full, so the buffer is one packet at the speed that the
    // host has negotiated.
    usb_endpoint_descriptor descriptor{};
    const bool known = ioctl(out_, FUNCTIONFS_ENDPOINT_DESC, &descriptor) == 0;
    const ssize_t got = known ? ::read(out_, packet.data(), descriptor.wMaxPacketSize) : -1;
    if (got < 0) {
      std::this_thread::sleep_for(kRetry);
      continue;
    }
    const std::lock_guard lock(mutex_);
    device_.bulk_out(hal::monotonic_now_ns(),
                     std::span(packet).first(static_cast<std::size_t>(got)));
    wake();
  }
}

void FunctionFs::serve_in() {
  while (!ending_) {
    const auto packet = next_packet();
    if (!packet.empty() && ::write(in_, packet.data(), packet.size()) < 0) {
      std::this_thread::sleep_for(kRetry);  // unplugged: the packet is lost
    }
  }
}

std::vector<std::byte> FunctionFs::next_packet() {
  std::unique_lock lock(mutex_);
  while (!ending_) {
    const hal::TimeNs now_ns = hal::monotonic_now_ns();
    const hal::TimeNs due_ns = device_.next_packet_ns();
    if (due_ns <= now_ns) {
      return device_.packet(now_ns);
    }
    const hal::TimeNs longest_ns = hal::TimeNs{kPollInterval_ms} * 1'000'000;
    changed_.wait_for(lock, std::chrono::nanoseconds(std::min(due_ns - now_ns, longest_ns)));
  }
  return {};
}

}  // namespace tactus::host
