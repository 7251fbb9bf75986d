# Run by cpack between installing and packing: adds to each package's tree what Debian wants in
# places of its own, and takes out what must not be in a package.
set(Names vorion dev doc)
set(PackageOf_vorion vorion)
set(PackageOf_dev vorion-dev)
set(PackageOf_doc vorion-doc)
set(Here "${CMAKE_CURRENT_LIST_DIR}")
set(Source "${CPACK_VORION_SOURCE}")

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# The same sources give the same packages: every time is that of the last commit.
if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  execute_process(COMMAND git -C "${Source}" log -1 --format=%ct OUTPUT_VARIABLE Time
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT Time)
    string(TIMESTAMP Time %s)
  endif()
  set(ENV{SOURCE_DATE_EPOCH} "${Time}")
endif()
set(Time "$ENV{SOURCE_DATE_EPOCH}")

# --- the tools and the OpenCL device ------------------------------------------
set(Top "${CPACK_TEMPORARY_DIRECTORY}/vorion")
set(Tree "${Top}/usr/lib/vorion")
file(MAKE_DIRECTORY "${Top}/usr/bin" "${Top}/etc/OpenCL/vendors")
file(GLOB Programs RELATIVE "${Tree}/bin" "${Tree}/bin/*")
list(FILTER Programs EXCLUDE REGEX "[.]cfg$")
foreach(Program IN LISTS Programs)
  file(CREATE_LINK "../lib/vorion/bin/${Program}" "${Top}/usr/bin/${Program}" SYMBOLIC)
endforeach()
file(WRITE "${Top}/etc/OpenCL/vendors/vorion.icd" "/usr/lib/vorion/pocl/lib/libvorion-pocl.so.2\n")
# As an absolute link it would be one that an image of a system cannot follow.
file(CREATE_LINK "../../../llvm-19/lib/clang/19" "${Tree}/lib/clang/19" SYMBOLIC)
# The Python package lies where Debian's Python looks.
if(EXISTS "${Tree}/lib/python3")
  file(RENAME "${Tree}/lib/python3" "${Top}/usr/lib/python3")
endif()
file(GLOB_RECURSE Extensions "${Top}/usr/lib/python3/*.so")
file(GLOB Binaries "${Tree}/bin/*" "${Tree}/pocl/bin/*" "${Tree}/lib/*.so"
     "${Tree}/pocl/lib/*.so.*.*")
list(FILTER Binaries EXCLUDE REGEX "[.]cfg$")
run(strip --strip-unneeded --remove-section=.comment --remove-section=.note ${Binaries} ${Extensions})
# Pages of the manual and completions of shells lie where the system looks.
foreach(Folder man bash-completion zsh fish)
  if(EXISTS "${Tree}/share/${Folder}")
    file(MAKE_DIRECTORY "${Top}/usr/share")
    file(RENAME "${Tree}/share/${Folder}" "${Top}/usr/share/${Folder}")
  endif()
endforeach()
# Debian's zsh looks elsewhere for what packages bring.
if(EXISTS "${Top}/usr/share/zsh/site-functions")
  file(RENAME "${Top}/usr/share/zsh/site-functions" "${Top}/usr/share/zsh/vendor-completions")
endif()
file(GLOB_RECURSE Pages "${Top}/usr/share/man/*.[1-9]")
foreach(Page IN LISTS Pages)
  run(gzip -9n "${Page}")
endforeach()

# --- the development files ------------------------------------------------------
set(Top "${CPACK_TEMPORARY_DIRECTORY}/dev")
set(Tree "${Top}/usr/lib/vorion")
execute_process(COMMAND dpkg-architecture -qDEB_HOST_MULTIARCH OUTPUT_VARIABLE Triplet
                OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
file(GLOB Archives "${Tree}/lib/*.a")
run(strip --strip-debug --enable-deterministic-archives ${Archives})
# Where CMake and pkg-config look; both point to the tree.
file(COPY "${Tree}/lib/cmake/Vorion/VorionConfigVersion.cmake" DESTINATION "${Top}/usr/lib/cmake/Vorion")
file(WRITE "${Top}/usr/lib/cmake/Vorion/VorionConfig.cmake"
     "include(\"\${CMAKE_CURRENT_LIST_DIR}/../../vorion/lib/cmake/Vorion/VorionConfig.cmake\")\n")
file(GLOB PcFiles RELATIVE "${Tree}/lib/pkgconfig" "${Tree}/lib/pkgconfig/*.pc")
foreach(PcFile IN LISTS PcFiles)
  file(READ "${Tree}/lib/pkgconfig/${PcFile}" Text)
  string(REPLACE "prefix=\${pcfiledir}/../.." "prefix=\${pcfiledir}/../../vorion" Text "${Text}")
  file(WRITE "${Top}/usr/lib/${Triplet}/pkgconfig/${PcFile}" "${Text}")
endforeach()

# --- the documents ----------------------------------------------------------------
set(Top "${CPACK_TEMPORARY_DIRECTORY}/doc")
file(MAKE_DIRECTORY "${Top}/usr/share")
file(RENAME "${Top}/usr/lib/vorion/share/doc" "${Top}/usr/share/doc")
file(REMOVE_RECURSE "${Top}/usr/lib")
# The same as a site that one can search, where the packages are built with MkDocs. Its pages of options are made by the
# tools that are packed.
find_program(MkDocs mkdocs)
if(MkDocs)
  set(Site "${CPACK_TOPLEVEL_DIRECTORY}/site")
  run("${Source}/docs/site/build.py" "${Site}" "${CPACK_TEMPORARY_DIRECTORY}/vorion/usr/lib/vorion/bin")
  file(RENAME "${Site}" "${Top}/usr/share/doc/vorion/html")
  file(REMOVE_RECURSE "${Site}-pages")
endif()

# --- what every package has ---------------------------------------------------------
foreach(Name IN LISTS Names)
  set(Top "${CPACK_TEMPORARY_DIRECTORY}/${Name}")
  set(Package "${PackageOf_${Name}}")
  set(Doc "${Top}/usr/share/doc/${Package}")
  file(MAKE_DIRECTORY "${Doc}")
  run(python3 "${Here}/copyright.py" "${CPACK_VORION_POCL}/debian/copyright" "${Doc}/copyright")
  execute_process(COMMAND date -u -R -d "@${Time}" OUTPUT_VARIABLE Date OUTPUT_STRIP_TRAILING_WHITESPACE)
  file(WRITE "${Doc}/changelog"
       "vorion (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium\n\n"
       "  * CHANGELOG.md in the package vorion-doc says what has changed.\n\n"
       " -- ${CPACK_PACKAGE_CONTACT}  ${Date}\n")
  run(gzip -9nf "${Doc}/changelog")
  if(EXISTS "${Here}/overrides/${Package}")
    file(COPY "${Here}/overrides/${Package}" DESTINATION "${Top}/usr/share/lintian/overrides")
  endif()
  run(chmod -R u=rwX,go=rX "${Top}")
  run(find "${Top}" -exec touch -h -d "@${Time}" {} +)
endforeach()
