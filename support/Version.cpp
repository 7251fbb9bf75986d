// LLVM's tools link this too: it uses nothing but the standard library.
#include "vorion/support/Version.h"

#include <filesystem>
#include <fstream>
#include <system_error>

namespace vorion {

std::string_view projectVersion() { return VORION_VERSION; }
std::string_view llvmVersion() { return VORION_LLVM_VERSION; }
std::string_view poclVersion() { return VORION_POCL_VERSION; }

std::string commitOfTree() {
  std::error_code Failed;
  const std::filesystem::path Program =
      std::filesystem::read_symlink("/proc/self/exe", Failed);
  std::ifstream File(Program.parent_path().parent_path() / "share" / "vorion" /
                     "commit");
  std::string Commit;
  File >> Commit;
  return Commit.empty() ? "unknown" : Commit;
}

std::string versionLine(std::string_view Tool) {
  return std::string(Tool) + " " VORION_VERSION ", commit " + commitOfTree() +
         ", LLVM " VORION_LLVM_VERSION ", PoCL " VORION_POCL_VERSION;
}

} // namespace vorion
