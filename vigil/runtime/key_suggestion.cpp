#include "vigil/runtime/key_suggestion.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace vigil::runtime {
namespace {

/// Longer words are not worth comparing letter by letter: no key is that long.
constexpr std::size_t kLongestWord = 64;

/// The least number of letters to insert, remove or replace to make `a` of `b` (Levenshtein).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// `speed_limit` for `speed_limit_m_s`: right but for the unit.
bool lacks_only_the_unit(std::string_view unknown, std::string_view known) {
  return unknown.size() >= 2 && known.size() > unknown.size() && known.starts_with(unknown) &&
         known[unknown.size()] == '_';
}

/// `separation_cm` for `separation_m`: the same words before the last underscores.
bool has_another_unit(std::string_view unknown, std::string_view known) {
  const std::size_t words = known.rfind('_');
  return words != std::string_view::npos && words >= 2 && unknown.size() > words &&
         unknown.starts_with(known.substr(0, words + 1));
}

}  // namespace

std::string suggestion_for(std::string_view unknown, std::span<const std::string_view> known) {
  if (unknown.size() > kLongestWord || known.empty()) return "remove it";
  for (const std::string_view key : known) {
    if (lacks_only_the_unit(unknown, key)) return fmt::format("did you mean {}? units are part of the key", key);
  }
  const auto distance = [&](std::string_view key) { return edit_distance(unknown, key); };
  const std::string_view nearest = std::ranges::min(known, {}, distance);
  for (const std::string_view key : known) {
    if (has_another_unit(unknown, key)) return fmt::format("did you mean {}? units are SI and part of the key", key);
  }
  const bool is_near = distance(nearest) <= std::max<std::size_t>(2, nearest.size() / 3);
  return is_near ? fmt::format("did you mean {}?", nearest) : "remove it";
}

}  // namespace vigil::runtime
