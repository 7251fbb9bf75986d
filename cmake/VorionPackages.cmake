# Debian packages by CPack: `cmake --build build/dev --target package`. What is installed lies as
# one tree in /usr/lib/vorion, as it does after `cmake --install`; debian/Stage.cmake adds what
# Debian wants elsewhere, such as the commands in /usr/bin and the loader's file.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME vorion)
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
# The owner's address is not known here (SECURITY.md).
set(CPACK_PACKAGE_CONTACT "Vorion maintainers <vorion-maintainers@lists.example.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr/lib/vorion)
set(CPACK_PACKAGE_DIRECTORY "${CMAKE_BINARY_DIR}/packages")
set(CPACK_COMPONENTS_ALL vorion dev doc)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/debian/Stage.cmake")
set(CPACK_POST_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/debian/Seal.cmake")
# For that script, which cpack runs with these and nothing else.
set(CPACK_VORION_SOURCE "${CMAKE_SOURCE_DIR}")
set(CPACK_VORION_POCL "${VORION_SOURCES}/pocl")

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# xz would save a sixth, in ten times the time.
set(CPACK_DEBIAN_COMPRESSION_TYPE gzip)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_VORION_PACKAGE_NAME vorion)
set(CPACK_DEBIAN_VORION_PACKAGE_SECTION devel)
set(CPACK_DEBIAN_VORION_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_BINARY_DIR}/lib;${CMAKE_BINARY_DIR}/pocl/lib")
# What no ELF file names: headers of OpenCL C and of the compiler, and the reader of SPIR-V, which the tools start.
set(CPACK_DEBIAN_VORION_PACKAGE_DEPENDS "libclang-common-19-dev")
if(VORION_LLVM_SPIRV)
  cmake_path(GET VORION_LLVM_SPIRV FILENAME SpirvPackage)
  string(APPEND CPACK_DEBIAN_VORION_PACKAGE_DEPENDS ", ${SpirvPackage}")
endif()
# The Python package has code for the interpreter that it was built with.
execute_process(
  COMMAND /usr/bin/python3 -c "import sys; a, b = sys.version_info[:2]; print(f'python3 (>= {a}.{b}~), python3 (<< {a}.{b + 1})', end='')"
  OUTPUT_VARIABLE Python COMMAND_ERROR_IS_FATAL ANY)
string(APPEND CPACK_DEBIAN_VORION_PACKAGE_DEPENDS ", ${Python}")
set(CPACK_DEBIAN_VORION_PACKAGE_RECOMMENDS "python3-numpy")
set(CPACK_DEBIAN_VORION_PACKAGE_SUGGESTS "clinfo, vorion-dev, vorion-doc")
set(CPACK_DEBIAN_VORION_DESCRIPTION "simulated RISC-V GPU with a Gaussian rasterizer
The simulator of a GPU whose cores run RISC-V instructions, its compiler for
OpenCL C, an OpenCL device for every OpenCL program on this computer, and the
program splat, which draws and trains scenes of 3D Gaussians on it.")
set(CPACK_DEBIAN_VORION_PACKAGE_CONTROL_EXTRA "${CMAKE_CURRENT_LIST_DIR}/debian/conffiles")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME vorion-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "vorion (= ${PROJECT_VERSION}), libfmt-dev, libdw-dev, opencl-c-headers")
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "cmake, pkgconf, ocl-icd-opencl-dev")
set(CPACK_DEBIAN_DEV_DESCRIPTION "simulated RISC-V GPU - development files
Headers, the simulator as a library, and files for CMake and pkg-config: for
programs that use the driver's API or the simulator without OpenCL, and for
observers of the simulator.")

set(CPACK_DEBIAN_DOC_PACKAGE_NAME vorion-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOC_DESCRIPTION "simulated RISC-V GPU - documents and examples
What the machine is, how its compiler and its model of time work, how to use
and to change them, and the sources of small OpenCL programs.")

# CMake would make a target `package` that needs everything, tests too, for a file of the usual name.
set(CPACK_OUTPUT_CONFIG_FILE "${CMAKE_BINARY_DIR}/Packages.cmake")
file(REMOVE "${CMAKE_BINARY_DIR}/CPackConfig.cmake") # of a build that was configured before this was so
include(CPack)
if(TARGET vorion_installed)
  add_custom_target(package COMMAND "${CMAKE_CPACK_COMMAND}" --config "${CPACK_OUTPUT_CONFIG_FILE}"
                    DEPENDS vorion_installed WORKING_DIRECTORY "${CMAKE_BINARY_DIR}" USES_TERMINAL VERBATIM)
endif()
