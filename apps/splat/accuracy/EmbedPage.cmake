# Writes OUTPUT, the C++ source of the pages' templates: page.html of FOLDER as
# pageTemplate() and train.html as trainPageTemplate(), each with style.css,
# common.js and the script of its name where it says so.
# usage: cmake -DOUTPUT=... -DFOLDER=... -P EmbedPage.cmake
cmake_minimum_required(VERSION 3.25)
set(Text "// Generated from apps/splat/accuracy/ by EmbedPage.cmake; do not edit.\n")
string(APPEND Text "#include \"accuracy/Page.h\"\n\nnamespace vorion::splat {\n\n")
function(add Name Function)
  file(READ "${FOLDER}/${Name}.html" Page)
  file(READ "${FOLDER}/style.css" Style)
  file(READ "${FOLDER}/common.js" Common)
  file(READ "${FOLDER}/${Name}.js" Script)
  string(REPLACE "@STYLE@" "${Style}" Page "${Page}")
  string(REPLACE "@SCRIPT@" "${Common}${Script}" Page "${Page}")
  string(APPEND Text "std::string_view ${Function}() {\n  return R\"page(${Page})page\";\n}\n\n")
  set(Text "${Text}" PARENT_SCOPE)
endfunction()
add(page pageTemplate)
add(train trainPageTemplate)
file(WRITE "${OUTPUT}" "${Text}} // namespace vorion::splat\n")
