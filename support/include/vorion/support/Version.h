/// What every tool's --version says, and reports that a tool writes.
#pragma once

#include <string>
#include <string_view>

namespace vorion {

/// Of the project, and of the projects whose code it holds.
std::string_view projectVersion();
std::string_view llvmVersion();
std::string_view poclVersion();

/// Of the build or installed tree that this program is in: twelve digits, with
/// "-changed" if files differed from it; "unknown" of what was built from no
/// checkout.
std::string commitOfTree();

/// "vorion-sim 0.1.0, commit 0123456789ab, LLVM 19.1.7, PoCL 6.0".
std::string versionLine(std::string_view Tool);

} // namespace vorion
