#include "vigil/apps/progress_bar.hpp"

#include <algorithm>
#include <cmath>
#include <unistd.h>

#include <fmt/format.h>

namespace vigil::apps {
namespace {

constexpr int kWidth = 30;
constexpr std::chrono::milliseconds kRedraw{100};

std::string bar(double share) {
  const int full = static_cast<int>(std::lround(share * kWidth));
  return fmt::format("{:#>{}}{:.>{}}", "", full, "", kWidth - full);
}

}  // namespace

ProgressBar::ProgressBar(std::string what)
    : what_(std::move(what)), is_terminal_(isatty(STDERR_FILENO) == 1), began_(Clock::now()), drawn_(began_) {}

ProgressBar::~ProgressBar() {
  if (is_terminal_) fmt::print(stderr, "\r\033[K");
}

void ProgressBar::show(double share, const std::string& note) {
  if (!is_terminal_ || Clock::now() - drawn_ < kRedraw) return;
  drawn_ = Clock::now();
  const double so_far_s = std::chrono::duration<double>(drawn_ - began_).count();
  const double left_s = share > 0.0 ? so_far_s * (1.0 - share) / share : 0.0;
  fmt::print(stderr, "\r\033[K{} [{}] {:3.0f} %  {:.0f} s left  {}", what_, bar(std::clamp(share, 0.0, 1.0)),
             100.0 * share, left_s, note);
  std::fflush(stderr);
}

}  // namespace vigil::apps
