#include "vigil/apps/check_command.hpp"

#include <cstdio>

#include <nlohmann/json.hpp>

#include "vigil/apps/exit_code.hpp"
#include "vigil/apps/mission_choice.hpp"
#include "vigil/runtime/mission_explanation.hpp"
#include "vigil/runtime/mission_schema.hpp"

namespace vigil::apps {

int check(const CheckOptions& options) {
  const runtime::Mission mission = choose_mission(options.mission, options.settings);
  const std::string text = options.json ? runtime::explanation_json(mission).dump(2) + "\n" : runtime::explain(mission);
  std::fputs(text.c_str(), stdout);
  return kDone;
}

int print_schema() {
  std::fputs((runtime::mission_schema_json().dump(2) + "\n").c_str(), stdout);
  return kDone;
}

}  // namespace vigil::apps
