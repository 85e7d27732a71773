#include "vigil/adapters/mpi/mpi_team.hpp"

#include <chrono>
#include <cstdio>
#include <limits>
#include <thread>

#define OMPI_SKIP_MPICXX 1  // the C++ interface that MPI took back in 2012
#include <mpi.h>

namespace vigil::mpi {
namespace {

constexpr int kLeader = 0;
constexpr int kTag = 1;
/// MPI's own waiting keeps a core busy; the last to arrive may be minutes late.
constexpr std::chrono::milliseconds kPatience{20};

int count_of(const std::string& text) {
  if (text.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw MpiError("--mpi: a message is too long");
  return static_cast<int>(text.size());
}

void wait_idle(MPI_Request& request) {
  for (int is_done = 0;;) {
    MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
    if (is_done != 0) return;
    std::this_thread::sleep_for(kPatience);
  }
}

/// Errors need no handling here: MPI's default ends every process and says which call failed.
class MpiTeam final : public runtime::CampaignTeam {
 public:
  MpiTeam() {
    int granted = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &granted);
    if (granted < MPI_THREAD_FUNNELED) throw MpiError("--mpi: this MPI does not let a program have threads of its own");
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    MPI_Comm here = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &here);
    MPI_Comm_size(here, &size_here_);
    MPI_Comm_free(&here);
  }
  MpiTeam(const MpiTeam&) = delete;
  MpiTeam& operator=(const MpiTeam&) = delete;
  ~MpiTeam() override {
    if (has_parted_) MPI_Finalize();
  }

  [[nodiscard]] std::size_t rank() const noexcept override { return static_cast<std::size_t>(rank_); }
  [[nodiscard]] std::size_t size() const noexcept override { return static_cast<std::size_t>(size_); }
  [[nodiscard]] std::size_t size_here() const noexcept override { return static_cast<std::size_t>(size_here_); }

  [[nodiscard]] std::string share(std::string text) override {
    int count = count_of(text);
    broadcast(&count, 1, MPI_INT);
    text.resize(static_cast<std::size_t>(count));
    broadcast(text.data(), count, MPI_CHAR);
    return text;
  }

  void hand_in(const std::string& text) override {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Isend(text.data(), count_of(text), MPI_CHAR, kLeader, kTag, MPI_COMM_WORLD, &request);
    wait_idle(request);
  }

  [[nodiscard]] std::optional<std::string> take() override {
    int is_there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, kTag, MPI_COMM_WORLD, &is_there, &status);
    if (is_there == 0) return std::nullopt;
    int count = 0;
    MPI_Get_count(&status, MPI_CHAR, &count);
    std::string text(static_cast<std::size_t>(count), '\0');
    MPI_Recv(text.data(), count, MPI_CHAR, status.MPI_SOURCE, kTag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return text;
  }

  void part() override {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(MPI_COMM_WORLD, &request);
    wait_idle(request);
    has_parted_ = true;
  }

  void abandon(int exit_code) override {
    std::fflush(nullptr);
    MPI_Abort(MPI_COMM_WORLD, exit_code);
  }

 private:
  static void broadcast(void* data, int count, MPI_Datatype type) {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibcast(data, count, type, kLeader, MPI_COMM_WORLD, &request);
    wait_idle(request);
  }

  int rank_ = 0;
  int size_ = 1;
  int size_here_ = 1;
  bool has_parted_ = false;
};

}  // namespace

std::unique_ptr<runtime::CampaignTeam> join_team() { return std::make_unique<MpiTeam>(); }

}  // namespace vigil::mpi
