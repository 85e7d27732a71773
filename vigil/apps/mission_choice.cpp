#include "vigil/apps/mission_choice.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "vigil/apps/failure.hpp"
#include "vigil/runtime/mission_file.hpp"

namespace vigil::apps {
namespace {

void add_shorthand(std::vector<runtime::Override>& overrides, std::string_view option, const std::string& key,
                   const std::optional<std::string>& value) {
  if (!value) return;
  if (std::ranges::find(overrides, key, &runtime::Override::key) != overrides.end())
    throw Failure(kBadInput, fmt::format("{} {}: is given twice, here and by --set {}; leave one of them out", option,
                                         runtime::on_one_line(*value, 60), key));
  overrides.push_back({.key = key, .value = *value, .option = option});
}

}  // namespace

runtime::Mission choose_mission(const std::filesystem::path& path, const std::vector<std::string>& settings,
                                const Shorthands& shorthands) {
  std::vector<runtime::Override> overrides;
  for (const std::string& setting : settings) overrides.push_back(runtime::parse_override(setting));
  add_shorthand(overrides, "--seconds", "simulation.duration_s", shorthands.seconds);
  add_shorthand(overrides, "--seed", "simulation.seed", shorthands.seed);
  return runtime::load_mission(path, overrides);
}

}  // namespace vigil::apps
