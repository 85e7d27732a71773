#include "vigil/adapters/console/query.hpp"

#include <algorithm>
#include <charconv>

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

/// The encoded values of the name, in order, until `take` returns false.
template <typename Take>
void each_value(std::string_view query, std::string_view name, Take take) {
  while (!query.empty()) {
    const std::string_view part = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), part.size() + 1));
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos || part.substr(0, equals) != name) continue;
    if (!take(part.substr(equals + 1))) return;
  }
}

}  // namespace

std::optional<std::string> query_value(std::string_view query, std::string_view name) {
  std::optional<std::string> value;
  each_value(query, name, [&value](std::string_view encoded) {
    value = decoded(encoded);
    return false;
  });
  return value;
}

bool names_twice(std::string_view query, std::string_view name) {
  std::size_t values = 0;
  each_value(query, name, [&values](std::string_view) { return ++values < 2; });
  return values == 2;
}

}  // namespace vigil::console
