#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace vigil::bench {

/// A WebSocket of the console's protocol to a server on 127.0.0.1, for one thread that reads many by turns. It confirms
/// what it reads, as the page does.
class LiveClient {
 public:
  /// A message that came whole: JSON where `is_text`, a binary frame otherwise. Valid during the call.
  using Take = std::function<void(std::string_view message, bool is_text)>;

  /// Connects and says hello; waits for the server's answer to the upgrade. Throws std::runtime_error.
  LiveClient(std::uint16_t port, const std::string& name);
  ~LiveClient();
  LiveClient(LiveClient&& other) noexcept;
  LiveClient& operator=(LiveClient&&) = delete;

  /// For poll(2).
  [[nodiscard]] int descriptor() const { return descriptor_; }
  void say(std::string_view json) { send_frame(kText, json); }
  /// Hands over what has arrived, without waiting for more. Throws std::runtime_error where the server hung up.
  void read(const Take& take);

 private:
  static constexpr unsigned kText = 1;
  static constexpr unsigned kClose = 8;
  static constexpr unsigned kPing = 9;
  static constexpr unsigned kPong = 10;

  void send_all(std::string_view bytes) const;
  void send_frame(unsigned opcode, std::string_view payload) const;
  void upgrade(std::uint16_t port);
  bool receive(int flags);
  std::size_t take_one(std::string_view bytes, const Take& take);
  void take_message(std::string_view message, bool is_text, const Take& take);
  void take_part(std::string_view part, const Take& take);

  int descriptor_;
  std::string received_;
  std::uint64_t messages_ = 0;
  std::array<std::string, 256> begun_;  ///< of each stream, what came of a message in parts
};

}  // namespace vigil::bench
