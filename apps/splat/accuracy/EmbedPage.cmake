# Writes OUTPUT, the C++ source of pageTemplate(): the HTML file PAGE with the
# script SCRIPT where it says so.
# usage: cmake -DOUTPUT=... -DPAGE=... -DSCRIPT=... -P EmbedPage.cmake
cmake_minimum_required(VERSION 3.25)
file(READ "${PAGE}" Page)
file(READ "${SCRIPT}" Script)
string(REPLACE "@SCRIPT@" "${Script}" Page "${Page}")
set(Text "// Generated from apps/splat/accuracy/ by EmbedPage.cmake; do not edit.\n")
string(APPEND Text "#include \"accuracy/Page.h\"\n\nnamespace vorion::splat {\n\n")
string(APPEND Text "std::string_view pageTemplate() {\n  return R\"page(${Page})page\";\n}\n\n} // namespace vorion::splat\n")
file(WRITE "${OUTPUT}" "${Text}")
