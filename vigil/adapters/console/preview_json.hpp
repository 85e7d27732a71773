#pragma once

#include <cstdint>

#include "vigil/adapters/console/server_messages.hpp"
#include "vigil/core/field/field.hpp"
#include "vigil/runtime/what_if.hpp"

namespace vigil::console {

/// What a look ahead is answered for.
struct PreviewContext {
  std::uint32_t epoch = 0;
  std::uint64_t revision = 0;
  field::WorldFrame frame;
};

/// `preview` of protocol/README.md, without its id.
[[nodiscard]] Json preview_json(const runtime::Outlooks& outlooks, const PreviewContext& context);

}  // namespace vigil::console
