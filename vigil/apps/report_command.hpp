#pragma once

#include <filesystem>

namespace vigil::apps {

struct ReportArguments {
  std::filesystem::path directory;  ///< as simulate left it
};

/// `vigil report`: draws the figures of a recording and writes report.html beside it. Returns the exit code; throws
/// what main() turns into one line and an exit code.
[[nodiscard]] int report(const ReportArguments& arguments);

}  // namespace vigil::apps
