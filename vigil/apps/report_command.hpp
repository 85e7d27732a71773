#pragma once

#include <filesystem>

namespace vigil::apps {

struct ReportOptions {
  std::filesystem::path directory;  ///< as simulate left it
};

/// `vigil report`: draws the figures of a recording and writes report.html beside it. Returns the exit code.
[[nodiscard]] int report(const ReportOptions& options);

}  // namespace vigil::apps
