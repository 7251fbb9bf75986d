#include "FileState.h"

namespace fs = std::filesystem;

namespace vorion {

std::string stateOf(const fs::path &File) {
  std::error_code Error;
  return std::to_string(fs::file_size(File, Error)) + " " +
         std::to_string(
             fs::last_write_time(File, Error).time_since_epoch().count());
}

} // namespace vorion
