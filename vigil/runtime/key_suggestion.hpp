#pragma once

#include <span>
#include <string>
#include <string_view>

namespace vigil::runtime {

/// What to do about a key or a choice that is not known: names the nearest of `known`, where one is near.
[[nodiscard]] std::string suggestion_for(std::string_view unknown, std::span<const std::string_view> known);

}  // namespace vigil::runtime
