#include "Messages.h"

#include <cstdio>
#include <mutex>

namespace vorion {

void tellFailure(cl_context Context, cl_int Status, const std::string &Text) {
  if (Context->notify)
    Context->notify(Text.c_str(), &Status, sizeof(Status),
                    Context->notify_data);
  else
    fprintf(stderr, "vorion: error: %s\n", Text.c_str());
}

void noteModelledTimes() {
  static std::once_flag Once;
  std::call_once(Once, [] {
    fprintf(stderr, "vorion: note: profiling times of kernels are modelled: "
                    "those of the machine, not of this computer "
                    "(VORION_TIME)\n");
  });
}

} // namespace vorion
