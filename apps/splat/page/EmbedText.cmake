# Writes OUTPUT, the C++ source of FUNCTION() of HEADER: the text of FILE.
# usage: cmake -DOUTPUT=... -DHEADER=... -DFUNCTION=... -DFILE=... -P EmbedText.cmake
cmake_minimum_required(VERSION 3.25)
file(READ "${FILE}" Text)
file(WRITE "${OUTPUT}" "// Generated from ${FILE} by EmbedText.cmake; do not edit.\n#include \"${HEADER}\"\n\nnamespace vorion::splat {\n\n"
  "std::string_view ${FUNCTION}() {\n  return R\"text(${Text})text\";\n}\n\n} // namespace vorion::splat\n")
