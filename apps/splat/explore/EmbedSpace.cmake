# Writes OUTPUT, the C++ source of defaultSpace() (Space.h): the text of FILE.
# usage: cmake -DOUTPUT=... -DFILE=... -P EmbedSpace.cmake
file(READ "${FILE}" Text)
file(WRITE "${OUTPUT}" "// Generated from explore/space.json by EmbedSpace.cmake; do not edit.
#include \"explore/Space.h\"

namespace vorion::splat {

std::string_view defaultSpace() { return R\"json(${Text})json\"; }

} // namespace vorion::splat
")
