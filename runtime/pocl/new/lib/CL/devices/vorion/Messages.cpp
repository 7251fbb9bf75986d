#include "Messages.h"

#include <cstdio>

namespace vorion {

void tellFailure(cl_context Context, cl_int Status, const std::string &Text) {
  if (Context->notify)
    Context->notify(Text.c_str(), &Status, sizeof(Status),
                    Context->notify_data);
  else
    fprintf(stderr, "vorion: error: %s\n", Text.c_str());
}

} // namespace vorion
