#include "vigil/adapters/console/query.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace vigil::console {
namespace {

std::optional<std::string> decoded(std::string_view text) {
  std::string plain;
  for (; !text.empty(); text.remove_prefix(1)) {
    if (text.front() != '%') {
      plain += text.front();
      continue;
    }
    unsigned char byte = 0;
    const std::string_view digits = text.substr(1, 2);
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16);
    if (digits.size() < 2 || read.ptr != digits.data() + digits.size()) return std::nullopt;
    plain += static_cast<char>(byte);
    text.remove_prefix(2);
  }
  return plain;
}

/// Takes the first "name=value" away from the rest.
std::string_view take_part(std::string_view& query) {
  const std::string_view part = query.substr(0, query.find('&'));
  query.remove_prefix(std::min(query.size(), part.size() + 1));
  return part;
}

}  // namespace

std::optional<std::string> query_value(std::string_view query, std::string_view name) {
  while (!query.empty()) {
    const std::string_view part = take_part(query);
    const std::size_t equals = part.find('=');
    if (equals != std::string_view::npos && part.substr(0, equals) == name) return decoded(part.substr(equals + 1));
  }
  return std::nullopt;
}

std::string query_problem(std::string_view query, std::string_view known) {
  constexpr std::size_t kMostShown = 40;
  for (bool is_seen = false; !query.empty();) {
    const std::string_view part = take_part(query);
    const std::string_view name = part.substr(0, part.find('='));
    if (name.empty()) continue;
    if (name != known)
      return fmt::format("{}: is not known here; {}", name.substr(0, kMostShown),
                         known.empty() ? "this path takes no query" : fmt::format("known is {}", known));
    if (is_seen) return fmt::format("{}: is there twice; give it once", name);
    is_seen = true;
  }
  return {};
}

}  // namespace vigil::console
