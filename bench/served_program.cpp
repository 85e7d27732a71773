#include "served_program.hpp"

#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <linux/capability.h>
#include <sched.h>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace vigil::bench {
namespace {

pid_t fork_or_throw() {
  const pid_t pid = ::fork();
  if (pid < 0) throw std::runtime_error("no process is to be had");
  if (pid == 0) ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  return pid;
}

/// What a user without privileges has: neither the right nor a limit that allows it.
void forgo_priority() {
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_RTPRIO, &none);
  ::prctl(PR_CAPBSET_DROP, CAP_SYS_NICE, 0, 0, 0);
}

/// Starts the program; `output` becomes where its output can be read.
Child start(const std::string& program, const std::string& mission, bool may_have_priority,
            const std::string& state_folder, int& output) {
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0) throw std::runtime_error("no pipe is to be had");
  const pid_t pid = fork_or_throw();
  if (pid == 0) {
    if (!may_have_priority) forgo_priority();
    ::dup2(pipe[1], STDOUT_FILENO);
    std::vector<std::string> words{program, "serve", mission, "--port", "0"};
    if (!state_folder.empty()) words.insert(words.end(), {"--state", state_folder});
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    ::execv(program.c_str(), arguments.data());
    std::_Exit(127);
  }
  ::close(pipe[1]);
  output = pipe[0];
  return Child(pid);
}

/// "vigil: crowd at http://127.0.0.1:40123/"
std::uint16_t port_in(const std::string& line) {
  const std::size_t colon = line.rfind(':');
  const unsigned long port = colon == std::string::npos ? 0 : std::strtoul(line.c_str() + colon + 1, nullptr, 10);
  if (port == 0 || port > 0xFFFF) throw std::runtime_error("vigil serve did not say where it listens: " + line);
  return static_cast<std::uint16_t>(port);
}

std::string first_line_of(int descriptor) {
  std::string line;
  for (char c = '\0'; c != '\n' && ::read(descriptor, &c, 1) == 1;) line += c;
  return line;
}

}  // namespace

Child::Child(Child&& other) noexcept : pid_(std::exchange(other.pid_, -1)) {}

Child::~Child() {
  if (pid_ < 0) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

Child spin() {
  const pid_t pid = fork_or_throw();
  volatile unsigned turns = 0;
  while (pid == 0) turns = turns + 1;
  return Child(pid);
}

ServedProgram::ServedProgram(const std::string& program, const std::string& mission, bool may_have_priority,
                             const std::string& state_folder)
    : child_(start(program, mission, may_have_priority, state_folder, output_)),
      port_(port_in(first_line_of(output_))) {}

bool ServedProgram::has_priority() const {
  for (const auto& task : std::filesystem::directory_iterator(fmt::format("/proc/{}/task", child_.pid())))
    if (::sched_getscheduler(std::stoi(task.path().filename())) == SCHED_FIFO) return true;
  return false;
}

std::size_t ServedProgram::memory_kib() const {
  std::ifstream status(fmt::format("/proc/{}/status", child_.pid()));
  for (std::string word; status >> word;)
    if (word == "VmRSS:") return status >> word ? std::stoul(word) : 0;
  return 0;
}

}  // namespace vigil::bench
