# Writes OUTPUT, the C++ source of pages' templates. PAGES: "NAME=FUNCTION;...": FOLDER/NAME.html as FUNCTION() of HEADER,
# with look.css of SHARED and FOLDER/style.css, if there is one, where it says @STYLE@, and common.js of SHARED and
# FOLDER/NAME.js where it says @SCRIPT@.
# usage: cmake -DOUTPUT=... -DHEADER=... -DFOLDER=... -DSHARED=... "-DPAGES=..." -P EmbedPages.cmake
cmake_minimum_required(VERSION 3.25)
set(Text "// Generated from ${FOLDER} by EmbedPages.cmake; do not edit.\n")
string(APPEND Text "#include \"${HEADER}\"\n\nnamespace vorion::splat {\n\n")
file(READ "${SHARED}/look.css" Style)
if(EXISTS "${FOLDER}/style.css")
  file(READ "${FOLDER}/style.css" Own)
  string(APPEND Style "${Own}")
endif()
file(READ "${SHARED}/common.js" Common)
foreach(Each IN LISTS PAGES)
  string(REGEX MATCH "^(.*)=(.*)$" Matched "${Each}")
  set(Name "${CMAKE_MATCH_1}")
  set(Function "${CMAKE_MATCH_2}")
  file(READ "${FOLDER}/${Name}.html" Page)
  file(READ "${FOLDER}/${Name}.js" Script)
  string(REPLACE "@STYLE@" "${Style}" Page "${Page}")
  string(REPLACE "@SCRIPT@" "${Common}${Script}" Page "${Page}")
  string(APPEND Text "std::string_view ${Function}() {\n  return R\"page(${Page})page\";\n}\n\n")
endforeach()
file(WRITE "${OUTPUT}" "${Text}} // namespace vorion::splat\n")
