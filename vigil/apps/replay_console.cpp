#include "vigil/apps/replay_console.hpp"

#include <cstdio>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "vigil/adapters/recording/bag_recording.hpp"
#include "vigil/apps/exit_code.hpp"
#include "vigil/apps/failure.hpp"
#include "vigil/apps/interrupt.hpp"
#include "vigil/apps/recording_choice.hpp"
#include "vigil/runtime/replay_loop.hpp"

namespace vigil::apps {
namespace {

void announce(const ConsoleOptions& options, const runtime::ReplayLoop& recording, const std::string& url) {
  const runtime::ReplayScene& scene = recording.scene();
  fmt::print("vigil: {}, recorded from {:g} s to {:g} s, at {}\n", recording.mission().name, scene.begin_s(),
             scene.end_s(), url);
  warn_of_readers(options);
  if (!scene.recording().incomplete_reason().empty())
    fmt::print("vigil: not whole: {}\n", scene.recording().incomplete_reason());
  std::fflush(stdout);
}

int show(const std::filesystem::path& directory, const ConsoleOptions& options, const std::string& version) {
  const auto open = [&directory] { return std::make_unique<recording::BagRecording>(directory); };
  const auto recording = std::make_shared<runtime::ReplayLoop>(choose_recording(directory).mission, open, /*epoch=*/1U);
  std::string url;
  console::ServerOptions served = server_options(options, version);
  served.ready = [&] { announce(options, *recording, url); };
  console::Server server(served, {}, nullptr);
  url = server.url();
  catch_interrupts();
  server.show(recording, is_interrupted);
  return kDone;
}

}  // namespace

int replay_in_console(const std::filesystem::path& directory, const ConsoleOptions& options,
                      const std::string& version) {
  check_console(options);
  try {
    return show(directory, options, version);
  } catch (const console::SetupError& error) {
    throw Failure(kBadInput, error.what());
  }
}

}  // namespace vigil::apps
