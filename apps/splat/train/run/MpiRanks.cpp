// Processes under OpenMPI (VORION_MPI), or the only one.
#include "train/run/Ranks.h"

#include "vorion/support/Environment.h"

#ifdef VORION_MPI
#include <mpi.h>
#endif

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>

namespace vorion::splat {
namespace {

/// Set by OpenMPI's mpirun. What was started without it does not come near
/// MPI, whose start costs time.
const char *startedTogether() {
  return environmentVariable("OMPI_COMM_WORLD_SIZE");
}

#ifdef VORION_MPI
/// Errors of MPI itself end all processes, which is its default.
class MpiRanks : public Ranks {
public:
  MpiRanks() {
    int Rank = 0, Size = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &Rank);
    MPI_Comm_size(MPI_COMM_WORLD, &Size);
    Own = static_cast<unsigned>(Rank);
    All = static_cast<unsigned>(Size);
  }
  ~MpiRanks() override { MPI_Finalize(); }
  MpiRanks(const MpiRanks &) = delete;
  MpiRanks &operator=(const MpiRanks &) = delete;

  unsigned rank() const override { return Own; }
  unsigned size() const override { return All; }

  void share(unsigned From, void *Data, std::size_t Bytes) override {
    constexpr std::size_t Most = std::size_t{1} << 30; // counts are ints
    for (std::size_t Done = 0; Done < Bytes; Done += Most)
      MPI_Bcast(static_cast<std::byte *>(Data) + Done,
                static_cast<int>(std::min(Most, Bytes - Done)), MPI_BYTE,
                static_cast<int>(From), MPI_COMM_WORLD);
  }

private:
  unsigned Own = 0, All = 1;
};
#endif

} // namespace

Expected<std::unique_ptr<Ranks>> openRanks() {
  if (!startedTogether())
    return std::unique_ptr<Ranks>(std::make_unique<OneRank>());
#ifdef VORION_MPI
  // hwloc, which looks at the machine for OpenMPI, would open OpenCL devices to
  // list them.
  setenv("HWLOC_COMPONENTS", "-opencl", 0);
  int Level = 0;
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &Level) !=
          MPI_SUCCESS ||
      Level < MPI_THREAD_FUNNELED)
    return Error{"", "MPI did not start, expected OpenMPI's mpirun",
                 ExitCode::Internal};
  auto Together = std::make_unique<MpiRanks>();
  if (!Together->first() && !std::freopen("/dev/null", "w", stdout))
    return Error{"/dev/null",
                 fmt::format("cannot write: {}", std::strerror(errno))};
  return std::unique_ptr<Ranks>(std::move(Together));
#else
  if (std::strcmp(startedTogether(), "1") != 0)
    return Error{"",
                 fmt::format("mpirun started {} processes and this build is "
                             "without MPI, expected one configured with "
                             "-DVORION_MPI=ON",
                             startedTogether()),
                 ExitCode::Usage};
  return std::unique_ptr<Ranks>(std::make_unique<OneRank>());
#endif
}

} // namespace vorion::splat
