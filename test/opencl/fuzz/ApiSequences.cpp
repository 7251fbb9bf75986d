/// Random sequences of OpenCL calls, each in a process of its own: no crash, no
/// hang, and nothing of what Sequence.h says is wrong.

#include "Sequence.h"
#include "Watched.h"

using namespace vorion::test;

int main(int Argc, char **Argv) {
  return runWatched(Argc, Argv, "opencl_api_sequences",
                    [](uint64_t Seed) { return Sequence(Seed).run(120); });
}
