# The headers that most of our files include are compiled once: reading them takes three quarters of
# a file's time. A file still includes what it uses: scripts/lint.sh reads each one without them.
option(VORION_PRECOMPILE "Compile common headers once" ON)
# Programs are compiled as libraries are, or they would need headers of their own.
set(CMAKE_CXX_COMPILE_OPTIONS_PIE "${CMAKE_CXX_COMPILE_OPTIONS_PIC}")

# None whose variables are made when a program starts: every file would make them.
set(CommonHeaders
  <algorithm> <array> <bit> <charconv> <chrono> <cmath> <cstdint> <cstdio> <cstdlib> <cstring> <filesystem> <fstream>
  <functional> <limits> <map> <memory> <mutex> <numeric> <optional> <random> <set> <span> <sstream> <string> <string_view>
  <thread> <tuple> <unordered_map> <utility> <variant> <vector>
  <fmt/format.h> <fmt/ranges.h> <nlohmann/json.hpp>)

# vorion_precompiled(NAME HEADER...): a target whose headers others use.
function(vorion_precompiled Name)
  set(Source "${CMAKE_BINARY_DIR}/${Name}.cpp")
  file(CONFIGURE OUTPUT "${Source}" CONTENT "")
  add_library(${Name} OBJECT "${Source}")
  target_link_libraries(${Name} PRIVATE vorion_options)
  # ccache takes what was compiled with them for the same only if they hold no time.
  target_compile_options(${Name} PRIVATE "SHELL:-Xclang -fno-pch-timestamp")
  target_precompile_headers(${Name} PRIVATE ${ARGN})
endfunction()

# vorion_precompiled_with_code(NAME HEADER...): the same, and a library NAME_library with what the
# headers' functions become. A file that uses the headers has no code of its own for them.
function(vorion_precompiled_with_code Name)
  vorion_precompiled(${Name} ${ARGN})
  target_compile_options(${Name} PRIVATE -fpch-codegen -fpch-debuginfo)
  set(Headers "${CMAKE_BINARY_DIR}/CMakeFiles/${Name}.dir/cmake_pch.hxx.pch")
  set(Object "${CMAKE_BINARY_DIR}/${Name}.o")
  string(TOUPPER "${CMAKE_BUILD_TYPE}" Type)
  separate_arguments(Flags UNIX_COMMAND "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${Type}}")
  add_custom_command(OUTPUT "${Object}"
    COMMAND "${CMAKE_CXX_COMPILER}" ${Flags} ${CMAKE_CXX_COMPILE_OPTIONS_PIC} -ffunction-sections
            "$<TARGET_PROPERTY:vorion_options,INTERFACE_COMPILE_OPTIONS>" -c "${Headers}" -o "${Object}"
    DEPENDS "${Headers}" COMMENT "Building the code of ${Name}" COMMAND_EXPAND_LISTS VERBATIM)
  add_library(${Name}_library STATIC "${Object}")
  set_target_properties(${Name}_library PROPERTIES LINKER_LANGUAGE CXX)
  # The code has every inline function of the headers, also some that call what libstdc++ keeps for itself.
  target_link_options(${Name}_library INTERFACE -Wl,--gc-sections)
endfunction()

# vorion_precompile(FOLDER): every target of C++ in FOLDER and in the folders below it that does not
# set DISABLE_PRECOMPILE_HEADERS. Those set it whose flags change the language or the vectors, and
# files with their own level of optimisation set SKIP_PRECOMPILE_HEADERS: a build may have another.
function(vorion_precompile Folder)
  if(NOT VORION_PRECOMPILE)
    return()
  endif()
  get_property(Targets DIRECTORY "${Folder}" PROPERTY BUILDSYSTEM_TARGETS)
  foreach(Target IN LISTS Targets)
    get_target_property(Kind ${Target} TYPE)
    get_target_property(Off ${Target} DISABLE_PRECOMPILE_HEADERS)
    get_target_property(Files ${Target} SOURCES)
    if(Off OR Files MATCHES "[.]c(;|$)" OR NOT Kind MATCHES "^(EXECUTABLE|STATIC_LIBRARY|SHARED_LIBRARY|MODULE_LIBRARY|OBJECT_LIBRARY)$")
      continue()
    endif()
    get_target_property(Libraries ${Target} LINK_LIBRARIES)
    if(Libraries MATCHES "GTest::")
      target_precompile_headers(${Target} REUSE_FROM vorion_precompiled_test)
    elseif("CLI11::CLI11" IN_LIST Libraries)
      target_precompile_headers(${Target} REUSE_FROM vorion_precompiled_commands)
      target_link_libraries(${Target} PRIVATE vorion_precompiled_commands_library)
    else()
      target_precompile_headers(${Target} REUSE_FROM vorion_precompiled_code)
    endif()
  endforeach()
  get_property(Folders DIRECTORY "${Folder}" PROPERTY SUBDIRECTORIES)
  foreach(Sub IN LISTS Folders)
    vorion_precompile("${Sub}")
  endforeach()
endfunction()

if(VORION_PRECOMPILE)
  find_package(GTest REQUIRED)
  vorion_precompiled(vorion_precompiled_code ${CommonHeaders})
  # CLI11 is headers alone: six seconds for each file that names an option.
  vorion_precompiled_with_code(vorion_precompiled_commands ${CommonHeaders} <CLI/CLI.hpp>)
  vorion_precompiled(vorion_precompiled_test ${CommonHeaders} <gtest/gtest.h>)
  target_link_libraries(vorion_precompiled_test PRIVATE GTest::gtest)
endif()
