#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "vigil/adapters/console/server.hpp"

namespace vigil::apps {

/// Where a console is served, and to whom.
struct ConsoleOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8080;          ///< 0: any that is free
  std::vector<std::string> names;     ///< by which browsers come here, beside the address
  std::filesystem::path tokens;       ///< empty: no login
  std::filesystem::path certificate;  ///< empty: no TLS
  std::filesystem::path key;
  std::filesystem::path page;  ///< empty: where the build or the installation has it
};

/// Throws Failure (kBadInput) where they contradict each other, or would let in whoever comes.
void check_console(const ConsoleOptions& options);

/// Prints a warning where others on the way can read tokens and orders.
void warn_of_readers(const ConsoleOptions& options);

/// For the server; the tokens are read. Throws console::SetupError.
[[nodiscard]] console::ServerOptions server_options(const ConsoleOptions& options, const std::string& version);

}  // namespace vigil::apps
