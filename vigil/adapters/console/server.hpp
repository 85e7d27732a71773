#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vigil/adapters/console/access.hpp"
#include "vigil/adapters/console/client_message.hpp"
#include "vigil/adapters/console/desk.hpp"
#include "vigil/runtime/replay_loop.hpp"

namespace vigil::console {

struct ServerOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8080;          ///< 0: any that is free
  std::vector<std::string> names;     ///< more names by which browsers come here
  std::optional<Tokens> tokens;       ///< precondition: there where the address is not loopback
  std::filesystem::path certificate;  ///< PEM; empty: no TLS
  std::filesystem::path key;
  std::filesystem::path page;  ///< the folder of the built page
  std::string program;         ///< "vigil 0.1.0"
  std::string recording_folder;
  std::function<void(const DeskNews&)> overhear;  ///< told of what the desk does, on its thread; may be empty
  std::function<void()> ready;  ///< called once, by run(), when the first tick can be asked for; may be empty
};

/// The console's server: HTTP and WebSockets for whoever looks at a flight, and the desk behind it. Beside the control
/// thread of the flight it has two: the sockets' (the one that calls run() or show()) and the desk's, or a recording's.
/// One of run() and show() is called, once.
class Server {
 public:
  /// Listens at once. store: null where nothing is kept. Throws SetupError.
  Server(const ServerOptions& options, Desk::MakeFlight make_flight, std::shared_ptr<runtime::FlightStore> store);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  [[nodiscard]] std::uint16_t port() const;
  /// "http://127.0.0.1:8080/"
  [[nodiscard]] std::string url() const;

  /// Flies the mission and serves until `is_over` says so, which is asked a few times a second. saved: what an earlier
  /// run left, or null. Throws what making the flight throws, and at the end what its recorder throws.
  void run(const runtime::Mission& mission, const runtime::SavedFlight* saved, const std::function<bool()>& is_over);

  /// Shows a recording instead, from its first tick on.
  void show(const std::shared_ptr<runtime::ReplayLoop>& recording, const std::function<bool()>& is_over);

  // Any thread, while run() does its work; afterwards nothing comes of it.
  /// A command that did not come through the sockets. `answer` is called once, on the sockets' thread, with why it was
  /// refused; empty: it was followed.
  void command(ClientMessage message, Role role, std::string by,
               std::function<void(const std::string& refusal)> answer);
  /// Something that operators should know of.
  void warn(std::string text);

 private:
  class Sockets;
  std::unique_ptr<Sockets> sockets_;
};

}  // namespace vigil::console
