#include "vigil/adapters/console/access.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace vigil::console {
namespace {

constexpr std::size_t kMostTokenBytes = 512;
constexpr std::size_t kMostTokens = 100;

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view take_word(std::string_view& line) {
  while (!line.empty() && is_space(line.front())) line.remove_prefix(1);
  const auto* const end = std::find_if(line.begin(), line.end(), is_space);
  const std::string_view word = line.substr(0, static_cast<std::size_t>(end - line.begin()));
  line.remove_prefix(word.size());
  return word;
}

/// Of "name:port" or "[::1]:port".
std::string_view without_port(std::string_view authority) {
  const std::size_t bracket = authority.rfind(']');
  const std::size_t colon = authority.rfind(':');
  const bool has_port = colon != std::string_view::npos && (bracket == std::string_view::npos || colon > bracket);
  return has_port ? authority.substr(0, colon) : authority;
}

}  // namespace

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return result;
}

bool equal_in_constant_time(std::string_view a, std::string_view b) noexcept {
  unsigned difference = a.size() == b.size() ? 0U : 1U;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto mine = static_cast<unsigned char>(a[i]);
    const auto theirs = static_cast<unsigned char>(b.empty() ? '\0' : b[i % b.size()]);
    difference |= static_cast<unsigned>(mine ^ theirs);
  }
  return difference == 0;
}

Tokens Tokens::parse(std::string_view text, const std::string& name) {
  Tokens tokens;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::string_view word = take_word(line);
    if (word.empty() || word.starts_with('#')) continue;
    const std::string_view token = take_word(line);
    const auto role = role_of(word);
    if (!role || token.size() < kLeastBytes || token.size() > kMostTokenBytes || !take_word(line).empty())
      throw SetupError(
          fmt::format("{}:{}: must be a role ({}) and a token of {} to {} characters without spaces; "
                      "make one with: openssl rand -hex 24",
                      name, number, fmt::join(kRoleWords, ", "), kLeastBytes, kMostTokenBytes));
    if (tokens.role_for(token).value_or(*role) != *role)
      throw SetupError(
          fmt::format("{}:{}: this token stands for another role above; give each role its own tokens, "
                      "or remove one of the two lines",
                      name, number));
    tokens.entries_.push_back({*role, std::string(token)});
  }
  if (tokens.entries_.empty() || tokens.entries_.size() > kMostTokens)
    throw SetupError(fmt::format("{}: must have 1 to {} lines of a role and a token", name, kMostTokens));
  return tokens;
}

Tokens Tokens::read(const std::filesystem::path& path) {
  constexpr std::size_t kMostBytes = 1 << 16;
  std::error_code error;
  const bool is_small_file =
      std::filesystem::is_regular_file(path, error) && std::filesystem::file_size(path, error) <= kMostBytes;
  std::ifstream file(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!is_small_file || error || !file)
    throw SetupError(
        fmt::format("--tokens {}: cannot be read; name a small file with lines of a role and a token", path.string()));
  return parse(text, path.string());
}

std::optional<Role> Tokens::role_for(std::string_view token) const noexcept {
  std::optional<Role> best;
  for (const Entry& entry : entries_) {
    const bool is_it = equal_in_constant_time(entry.token, token);
    if (is_it && (!best || entry.role > *best)) best = entry.role;
  }
  return best;
}

bool is_loopback(std::string_view address) {
  return address.starts_with("127.") || address == "::1" || address == "localhost";
}

Gate::Gate(const std::string& address, std::vector<std::string> names) : names_(std::move(names)) {
  for (std::string& name : names_) name = lower(name);
  names_.push_back(address.find(':') == std::string::npos ? lower(address) : "[" + lower(address) + "]");
  if (is_loopback(address))
    for (const char* name : {"localhost", "127.0.0.1", "[::1]"}) names_.emplace_back(name);
}

bool Gate::admits_host(std::string_view host) const {
  return std::find(names_.begin(), names_.end(), lower(without_port(host))) != names_.end();
}

bool Gate::admits_origin(std::string_view origin, std::string_view host) const {
  if (origin.empty()) return true;
  const std::size_t scheme_end = origin.find("://");
  if (scheme_end == std::string_view::npos) return false;  // "null", too: a sandboxed page, or a file
  return admits_host(host) && lower(origin.substr(scheme_end + 3)) == lower(host);
}

}  // namespace vigil::console
