#include "vigil/apps/interrupt.hpp"

#include <csignal>

namespace vigil::apps {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void note_interrupt(int signal_number) {
  interrupted = 1;
  std::signal(signal_number, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, note_interrupt);
  std::signal(SIGTERM, note_interrupt);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow further is an error of that file, not the end of a flight
}

bool is_interrupted() noexcept { return interrupted != 0; }

}  // namespace vigil::apps
