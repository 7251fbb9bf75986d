# What `cmake --install` leaves: bin/, include/, lib/ with lib/cmake/Vorion, share/
# and pocl/. Nothing in it names a folder of the build, so the tree can be moved; it
# needs the same Debian packages (the OpenCL platform uses LLVM's library, and
# vorion-clang the installed clang's headers).
#
# Each file belongs to the component `vorion` (what runs), `dev` or `doc`, which
# become the packages of VorionPackages.cmake.
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME vorion)

# vorion_public_headers(TARGET FOLDER): the headers under FOLDER are TARGET's
# interface, and are installed.
function(vorion_public_headers Target Folder)
  get_target_property(Kind ${Target} TYPE)
  set(Scope PUBLIC)
  if(Kind STREQUAL "INTERFACE_LIBRARY")
    set(Scope INTERFACE)
  endif()
  target_include_directories(${Target} ${Scope} "$<BUILD_INTERFACE:${Folder}>" "$<INSTALL_INTERFACE:include>")
  install(DIRECTORY "${Folder}/" DESTINATION include COMPONENT dev)
endfunction()

# vorion_generated_headers(TARGET HEADER...): headers of ${VORION_GENERATED}/include
# that are part of TARGET's interface, and are installed.
function(vorion_generated_headers Target)
  target_include_directories(${Target} PUBLIC "$<BUILD_INTERFACE:${VORION_GENERATED}/include>")
  add_dependencies(${Target} vorion_generated)
  foreach(Header IN LISTS ARGN)
    get_filename_component(Folder "${Header}" DIRECTORY)
    install(FILES "${VORION_GENERATED}/include/${Header}" DESTINATION "include/${Folder}" COMPONENT dev)
  endforeach()
endfunction()

# vorion_installs_with(TARGET...): each makes files that are installed.
function(vorion_installs_with)
  set_property(GLOBAL APPEND PROPERTY VORION_INSTALLED ${ARGN})
endfunction()

# vorion_install(TARGET...): each is installed, and known to find_package(Vorion)
# as Vorion::NAME, without our own prefix.
function(vorion_install)
  foreach(Target IN LISTS ARGN)
    string(REGEX REPLACE "^vorion[_-]" "" Name "${Target}")
    set_target_properties(${Target} PROPERTIES EXPORT_NAME "${Name}")
    install(TARGETS ${Target} EXPORT VorionTargets
            RUNTIME DESTINATION bin LIBRARY DESTINATION lib ARCHIVE DESTINATION lib COMPONENT dev)
    vorion_installs_with(${Target})
    get_target_property(Kind ${Target} TYPE)
    if(Kind STREQUAL "EXECUTABLE")
      set_property(GLOBAL APPEND PROPERTY VORION_PROGRAMS ${Target})
    endif()
  endforeach()
endfunction()

# All documents, in the folders that they have in the repository, so that every link between them leads somewhere
# (test/install/documents.test); and the samples' sources. README.md of the samples says how they are compiled, because
# their CMakeLists.txt works inside of the repository only.
function(vorion_install_documents)
  set(Folder share/doc/vorion)
  install(FILES README.md CITATION.cff CHANGELOG.md CONTRIBUTING.md SECURITY.md LICENSE DESTINATION ${Folder} COMPONENT doc)
  install(DIRECTORY docs DESTINATION ${Folder} COMPONENT doc PATTERN site EXCLUDE)
  # Each part has a README. What else lies beside them, such as build/ and its sources of LLVM, is none of ours.
  file(GLOB Parts RELATIVE "${CMAKE_SOURCE_DIR}" */README.md)
  list(TRANSFORM Parts REPLACE "README.md$" "*.md")
  file(GLOB_RECURSE Pages RELATIVE "${CMAKE_SOURCE_DIR}" ${Parts})
  # The inputs of tests are no documents.
  list(FILTER Pages EXCLUDE REGEX "/Inputs/")
  foreach(Page IN LISTS Pages)
    get_filename_component(Place "${Page}" DIRECTORY)
    install(FILES "${Page}" DESTINATION "${Folder}/${Place}" COMPONENT doc)
  endforeach()
  install(DIRECTORY docs/schemas/ DESTINATION share/vorion/schemas COMPONENT vorion FILES_MATCHING PATTERN "*.json")
  install(DIRECTORY test/install/Inputs/downstream DESTINATION ${Folder}/examples COMPONENT doc)
  install(DIRECTORY apps/samples DESTINATION ${Folder}/examples COMPONENT doc PATTERN CMakeLists.txt EXCLUDE)
  # What Python leaves beside a sample that was run in the repository is no sample.
  install(DIRECTORY apps/splat/python/samples/ DESTINATION ${Folder}/examples/python COMPONENT doc
          PATTERN __pycache__ EXCLUDE)
endfunction()

# The package of what the components have named by now.
function(vorion_install_package)
  get_property(Targets GLOBAL PROPERTY VORION_INSTALLED)
  if(NOT Targets)
    return()
  endif()
  # What `cmake --install` needs, without tests and fuzzers.
  add_custom_target(vorion_installed DEPENDS ${Targets})
  # What scripts/demo.sh and the first steps of README.md use of that.
  set(Demo splat splat-figures splat-hard-cases vorion-compiler vorion_libdevice vorion_pocl)
  add_custom_target(vorion_demo)
  foreach(Target IN LISTS Demo)
    if(Target IN_LIST Targets)
      add_dependencies(vorion_demo ${Target})
    endif()
  endforeach()
  set(Folder lib/cmake/Vorion)
  set(Version "${CMAKE_BINARY_DIR}/VorionConfigVersion.cmake")
  write_basic_package_version_file("${Version}" COMPATIBILITY SameMinorVersion)
  install(FILES "${CMAKE_SOURCE_DIR}/cmake/VorionConfig.cmake" "${Version}" DESTINATION ${Folder}
          COMPONENT dev)
  install(EXPORT VorionTargets NAMESPACE Vorion:: DESTINATION ${Folder} COMPONENT dev)
  foreach(Name runtime isasim)
    configure_file("${CMAKE_SOURCE_DIR}/cmake/vorion-${Name}.pc.in" "${CMAKE_BINARY_DIR}/vorion-${Name}.pc" @ONLY)
    install(FILES "${CMAKE_BINARY_DIR}/vorion-${Name}.pc" DESTINATION lib/pkgconfig COMPONENT dev)
  endforeach()
  vorion_install_documents()
endfunction()
