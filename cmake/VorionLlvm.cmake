# The installed LLVM: its CMake files in the folder that includes this, and two targets for what is
# linked with it.
#   vorion_llvm_headers    its headers, and how code is compiled that uses them
#   vorion_llvm_archives   every archive but those of targets and of what needs libraries we do not have
# (libLLVM.so cannot be used: it holds a RISC-V target too, and options would be registered twice.
# It also takes 0.02 s to load.)
find_program(LLVM_CONFIG llvm-config-19 REQUIRED)
execute_process(COMMAND "${LLVM_CONFIG}" --cmakedir OUTPUT_VARIABLE LlvmCMakeDir
                OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
# LLVM's package names libcurl for debuginfod, which no tool here uses.
if(NOT TARGET CURL::libcurl)
  add_library(CURL::libcurl INTERFACE IMPORTED)
endif()
find_package(LLVM ${VORION_LLVM_VERSION} EXACT REQUIRED CONFIG PATHS "${LlvmCMakeDir}" NO_DEFAULT_PATH)
find_package(ZLIB REQUIRED)
if(TARGET vorion_llvm_headers)
  return()
endif()

separate_arguments(LlvmDefinitions UNIX_COMMAND "${LLVM_DEFINITIONS}")
add_library(vorion_llvm_headers INTERFACE)
target_include_directories(vorion_llvm_headers SYSTEM INTERFACE "${LLVM_INCLUDE_DIRS}")
target_compile_definitions(vorion_llvm_headers INTERFACE ${LlvmDefinitions}
  # The installed archives are built without assertions; class layouts depend on it.
  NDEBUG)
target_compile_options(vorion_llvm_headers INTERFACE -fno-exceptions -fno-rtti -ffunction-sections -fdata-sections)

file(GLOB LlvmArchives "${LLVM_LIBRARY_DIR}/libLLVM*.a")
string(REPLACE ";" "|" OtherTargets "${LLVM_TARGETS_TO_BUILD}")
list(FILTER LlvmArchives EXCLUDE REGEX
  "/libLLVM(Exegesis|Debuginfod|${OtherTargets})(AsmParser|CodeGen|Desc|Disassembler|Info|Utils|TargetMCA|AArch64|Mips|PowerPC|RISCV|X86)?\\.a$")
find_library(ZSTD zstd REQUIRED)
find_library(XML2 xml2 REQUIRED)
find_library(Z3 z3 REQUIRED)
add_library(vorion_llvm_archives INTERFACE)
target_link_libraries(vorion_llvm_archives INTERFACE ${LlvmArchives} ZLIB::ZLIB "${ZSTD}" "${XML2}" "${Z3}" rt dl m)
# --as-needed: loading a library that nothing calls takes time at every start.
target_link_options(vorion_llvm_archives INTERFACE -Wl,--gc-sections -Wl,--as-needed)
