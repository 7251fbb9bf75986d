# Writes OUTPUT, the C++ source of lookSheet(): the file LOOK.
# usage: cmake -DOUTPUT=... -DLOOK=... -P EmbedLook.cmake
cmake_minimum_required(VERSION 3.25)
file(READ "${LOOK}" Look)
file(WRITE "${OUTPUT}" "// Generated from ${LOOK} by EmbedLook.cmake; do not edit.\n#include \"page/Chart.h\"\n\nnamespace vorion::splat {\n\n"
  "std::string_view lookSheet() {\n  return R\"look(${Look})look\";\n}\n\n} // namespace vorion::splat\n")
