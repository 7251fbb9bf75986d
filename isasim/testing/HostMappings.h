/// What this process may do with its memory, as the host's kernel says.
#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace vorion::isasim::testing {

struct HostMapping {
  std::string Rights; ///< as "r-xp"; s instead of p: another mapping may be it
  std::string File;   ///< what it shows, or empty
  bool isExecutable() const { return Rights.find('x') != std::string::npos; }
  bool isWritable() const { return Rights.find('w') != std::string::npos; }
  bool isShared() const { return Rights.find('s') != std::string::npos; }
};

inline std::vector<HostMapping> hostMappings() {
  std::vector<HostMapping> All;
  std::ifstream Maps("/proc/self/maps");
  for (std::string Line; std::getline(Maps, Line);) {
    std::istringstream Words(Line);
    std::string Range, Offset, Device, Number;
    HostMapping M;
    Words >> Range >> M.Rights >> Offset >> Device >> Number >> M.File;
    All.push_back(M);
  }
  return All;
}

/// Mappings with code that no file has.
inline unsigned madeCode(const std::vector<HostMapping> &All) {
  unsigned Count = 0;
  for (const HostMapping &M : All)
    Count += M.isExecutable() && M.File.empty();
  return Count;
}

/// Whether code could be overwritten: where it lies, or by another mapping.
inline bool isCodeWritable(const std::vector<HostMapping> &All) {
  for (const HostMapping &M : All)
    if (M.isExecutable() && (M.isWritable() || M.isShared()))
      return true;
  return false;
}

} // namespace vorion::isasim::testing
