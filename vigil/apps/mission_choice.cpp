#include "vigil/apps/mission_choice.hpp"

#include <fmt/format.h>

#include "vigil/apps/failure.hpp"
#include "vigil/runtime/mission_file.hpp"

namespace vigil::apps {

runtime::Mission choose_mission(const std::filesystem::path& path, const std::vector<std::string>& settings) {
  std::vector<runtime::Override> overrides;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0)
      throw Failure(
          kBadInput,
          fmt::format("--set {}: has no key and value; write it as key=value, e.g. control.fade=0.1", setting));
    overrides.push_back({setting.substr(0, equals), setting.substr(equals + 1)});
  }
  return runtime::load_mission(path, overrides);
}

}  // namespace vigil::apps
