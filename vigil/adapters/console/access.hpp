#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "vigil/adapters/console/role.hpp"

/// Who may come in.
namespace vigil::console {

/// Says what is wrong with what the server was set up with, and what to do.
class SetupError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// With small letters for A to Z.
[[nodiscard]] std::string lower(std::string_view text);

/// Compares all of both texts, however early they differ: the time tells nothing but their lengths.
[[nodiscard]] bool equal_in_constant_time(std::string_view a, std::string_view b) noexcept;

/// The tokens that open the console, each with its role.
class Tokens {
 public:
  static constexpr std::size_t kLeastBytes = 16;

  /// Lines of `role token`; empty lines and those that begin with # do not count. Throws SetupError, also for a token
  /// of two roles.
  [[nodiscard]] static Tokens parse(std::string_view text, const std::string& name);
  [[nodiscard]] static Tokens read(const std::filesystem::path& path);

  /// The role that the token opens; nothing where it opens none. Looks at every token, always.
  [[nodiscard]] std::optional<Role> role_for(std::string_view token) const noexcept;

 private:
  struct Entry {
    Role role;
    std::string token;
  };
  std::vector<Entry> entries_;
};

/// Which names a browser may have used to come here: a page from elsewhere that resolves its own name to this machine
/// must not reach the server.
class Gate {
 public:
  /// Where the server listens, and more names by which people reach it, all without ports.
  Gate(const std::string& address, std::vector<std::string> names);

  /// The Host header, with or without a port.
  [[nodiscard]] bool admits_host(std::string_view host) const;
  /// The Origin header of a WebSocket or of a request that changes something: of the page that `host` served, or empty,
  /// which no browser leaves it.
  [[nodiscard]] bool admits_origin(std::string_view origin, std::string_view host) const;

 private:
  std::vector<std::string> names_;
};

/// "127.0.0.1", "::1" and all else that only this machine reaches.
[[nodiscard]] bool is_loopback(std::string_view address);

}  // namespace vigil::console
