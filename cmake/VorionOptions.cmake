# Language level, warnings and sanitizers, the same for every component.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib")
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib")

# Where scripts/fetch-source.sh unpacked the two source packages.
set(VORION_SOURCES "${CMAKE_SOURCE_DIR}/build/sources" CACHE PATH
    "Folder with the unpacked LLVM and PoCL sources")
set(VORION_SANITIZE "" CACHE STRING
    "Sanitizers for our own libraries and tools, as in -fsanitize=")

find_program(CCACHE ccache)
if(CCACHE)
  # Depend mode: a file that is not known yet is not preprocessed twice. The rest is what ccache asks
  # for where headers are compiled once.
  set(CMAKE_C_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env CCACHE_DEPEND=true
      CCACHE_SLOPPINESS=pch_defines,time_macros "${CCACHE}")
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_C_COMPILER_LAUNCHER}")
endif()

# Warnings for the code we wrote; fetched sources do not link this.
add_library(vorion_options INTERFACE)
target_compile_options(vorion_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wno-gnu-zero-variadic-macro-arguments -Werror
  # Removing a rounding changes results (docs/abi.md); fused operations are written fma().
  -ffp-contract=off
  # Some libraries ask for it, and headers compiled once are for all of our files.
  -pthread)
if(VORION_SANITIZE)
  target_compile_options(vorion_options INTERFACE
    -fsanitize=${VORION_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(vorion_options INTERFACE -fsanitize=${VORION_SANITIZE})
endif()
