/// That a file's ending is what is in it. Whether the file can be written is
/// asked by claimOutputs() (vorion/support/Outputs.h).
#pragma once

#include "vorion/support/Expected.h"

#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// That \p File, the value of \p Option, has one of \p Endings, as ".ply". An
/// Error of usage names them. No name at all is fine, and so are standard
/// output and whatever is there and no regular file.
Expected<Success> checkEnding(std::string_view Option, const std::string &File,
                              const std::vector<std::string_view> &Endings);

/// Gives \p File, the value of \p Option, a name if the user gave none: that of
/// \p Input, a file or a folder, in the current folder and with \p Ending.
/// Reports say it as if the user had.
void nameOutput(const char *Option, std::string &File, const std::string &Input,
                std::string_view Ending);

/// That the ending of \p File, the value of --json, does not promise another
/// kind of file.
Expected<Success> checkJsonName(const std::string &File);

/// That \p Prefix, with which the names of several files begin, is none itself.
Expected<Success> checkPrefix(std::string_view Option,
                              const std::string &Prefix);

} // namespace vorion::splat
