# Versions that every tool's --version says (support/Version.cpp). Those of the
# two source packages are defined where they are fetched.
function(vorion_package_version Package Variable)
  file(STRINGS "${CMAKE_SOURCE_DIR}/scripts/fetch-source.sh" Line REGEX "package=${Package} version=")
  string(REGEX REPLACE ".*version=([0-9]+:)?([0-9.]+).*" "\\2" Version "${Line}")
  set(${Variable} "${Version}" PARENT_SCOPE)
endfunction()
vorion_package_version(llvm-toolchain-19 VORION_LLVM_VERSION)
vorion_package_version(pocl VORION_POCL_VERSION)

# The commit is a file that tools read and no part of them: compiled kernels and
# measurements are kept by the contents of the programs, which a commit alone
# must not change. Every build looks, and writes only what is new.
set(VORION_COMMIT "" CACHE STRING "Commit of a source tree that is no checkout")
set(CommitFile "${CMAKE_BINARY_DIR}/share/vorion/commit")
add_custom_target(vorion_commit ALL
  COMMAND "${CMAKE_COMMAND}" "-DOUTPUT=${CommitFile}" "-DSOURCE=${CMAKE_SOURCE_DIR}" "-DCOMMIT=${VORION_COMMIT}"
          -P "${CMAKE_CURRENT_LIST_DIR}/WriteCommit.cmake"
  BYPRODUCTS "${CommitFile}" VERBATIM)
install(FILES "${CommitFile}" DESTINATION share/vorion)
