# find_package(Vorion): Vorion::runtime, the driver API (C); Vorion::isasim, the
# simulator as a library (C++20); and the tools, as Vorion::clang, Vorion::sim
# and so on.
include(CMakeFindDependencyMacro)
find_dependency(fmt)
find_dependency(Threads)
find_dependency(PkgConfig)
pkg_check_modules(LIBDW REQUIRED IMPORTED_TARGET libdw)
include("${CMAKE_CURRENT_LIST_DIR}/VorionTargets.cmake")
