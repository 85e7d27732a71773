#include "live_client.hpp"

#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <cstring>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <stdexcept>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

namespace vigil::bench {
namespace {

int connect_to(std::uint16_t port) {
  const int descriptor = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (descriptor < 0 || ::connect(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    throw std::runtime_error(fmt::format("no connection to port {}", port));
  const int yes = 1;
  ::setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  return descriptor;
}

unsigned byte_at(std::string_view bytes, std::size_t n) { return static_cast<unsigned char>(bytes[n]); }

std::size_t big_endian(std::string_view bytes, std::size_t from, std::size_t count) {
  std::size_t value = 0;
  for (std::size_t n = 0; n < count; ++n) value = value << 8U | byte_at(bytes, from + n);
  return value;
}

/// A frame's header and payload, as RFC 6455 has them; nothing where more must come.
struct WireFrame {
  unsigned opcode = 0;
  std::size_t header = 0;
  std::size_t size = 0;
};
WireFrame frame_in(std::string_view bytes) {
  if (bytes.size() < 2) return {};
  const unsigned length = byte_at(bytes, 1) & 127U;
  const std::size_t more = length == 126 ? 2 : length == 127 ? 8 : 0;
  if (bytes.size() < 2 + more) return {};
  return {byte_at(bytes, 0) & 15U, 2 + more, more == 0 ? length : big_endian(bytes, 2, more)};
}

}  // namespace

LiveClient::LiveClient(std::uint16_t port, const std::string& name) : descriptor_(connect_to(port)) {
  upgrade(port);
  say(fmt::format(R"({{"type":"hello","name":"{}","confirms":true}})", name));
}

LiveClient::LiveClient(LiveClient&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      received_(std::move(other.received_)),
      messages_(other.messages_),
      begun_(std::move(other.begun_)) {}

LiveClient::~LiveClient() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void LiveClient::upgrade(std::uint16_t port) {
  send_all(
      fmt::format("GET /live HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                  "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\nSec-WebSocket-Version: 13\r\n"
                  "Sec-WebSocket-Protocol: vigil.v1\r\n\r\n",
                  port));
  constexpr std::string_view kEnd = "\r\n\r\n";
  while (received_.find(kEnd) == std::string::npos) receive(0);
  if (!received_.starts_with("HTTP/1.1 101")) throw std::runtime_error("no WebSocket: " + received_);
  received_.erase(0, received_.find(kEnd) + kEnd.size());
}

void LiveClient::send_all(std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0) throw std::runtime_error("the server hung up");
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
}

/// With a mask of zeros, which is a mask. Short messages only.
void LiveClient::send_frame(unsigned opcode, std::string_view payload) const {
  constexpr std::size_t kLongest = 0xFFFF;
  const std::size_t size = payload.size();
  if (size > kLongest) throw std::logic_error("too long for a benchmark's message");
  std::string frame;
  frame += static_cast<char>(0x80U | opcode);
  frame += static_cast<char>(0x80U | (size < 126 ? size : 126));
  if (size >= 126) {
    frame += static_cast<char>(size >> 8U);
    frame += static_cast<char>(size & 0xFFU);
  }
  send_all(frame.append(4, '\0').append(payload));
}

/// Whether something came.
bool LiveClient::receive(int flags) {
  std::array<char, 64 * 1024> chunk{};
  const ssize_t size = ::recv(descriptor_, chunk.data(), chunk.size(), flags);
  if (size < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return false;
  if (size <= 0) throw std::runtime_error("the server hung up");
  received_.append(chunk.data(), static_cast<std::size_t>(size));
  return true;
}

void LiveClient::read(const Take& take) {
  while (receive(MSG_DONTWAIT)) {
  }
  std::size_t done = 0;
  while (const std::size_t used = take_one(std::string_view(received_).substr(done), take)) done += used;
  received_.erase(0, done);
}

/// How many bytes the first frame takes; 0 where it is not all there.
std::size_t LiveClient::take_one(std::string_view bytes, const Take& take) {
  const WireFrame frame = frame_in(bytes);
  if (frame.header == 0 || bytes.size() - frame.header < frame.size) return 0;
  const std::string_view payload = bytes.substr(frame.header, frame.size);
  if (frame.opcode == kClose) throw std::runtime_error("the server said goodbye");
  if (frame.opcode == kPing) send_frame(kPong, payload);
  if (frame.opcode == 1 || frame.opcode == 2) take_message(payload, frame.opcode == kText, take);
  return frame.header + frame.size;
}

void LiveClient::take_message(std::string_view message, bool is_text, const Take& take) {
  constexpr char kPart = 7;  // a kind of frame of protocol/README.md
  if (!is_text && message.size() > 4 && message[4] == kPart)
    take_part(message, take);
  else
    take(message, is_text);
  say(fmt::format(R"({{"type":"confirm","received":{}}})", ++messages_));
}

/// Parts of a stream come one after the other, the first at offset 0.
void LiveClient::take_part(std::string_view part, const Take& take) {
  constexpr std::size_t kHeader = 24;
  const auto u32 = [part](std::size_t offset) {
    std::uint32_t value = 0;
    std::memcpy(&value, part.data() + offset, sizeof value);
    return value;
  };
  if (part.size() < kHeader) throw std::runtime_error("a part is too short");
  std::string& begun = begun_[byte_at(part, 5)];
  if (u32(16) == 0) begun.clear();
  begun += part.substr(kHeader);
  if (begun.size() < u32(20)) return;
  const std::string whole = std::exchange(begun, {});
  take(whole, !whole.starts_with("VGL1"));
}

}  // namespace vigil::bench
