# vorion_device_object(SOURCE OBJECT FLAGS...): compiles C or assembly for the
# device with the vorion-clang of this build, or with VORION_CLANG where the
# build has no compiler of its own.
set(VORION_CLANG "" CACHE FILEPATH "vorion-clang to use when this build does not make one")
if(TARGET vorion-clang)
  set(DeviceCompiler "$<TARGET_FILE:vorion-clang>")
  set(DeviceCompilerDepends vorion-clang)
elseif(VORION_CLANG)
  set(DeviceCompiler "${VORION_CLANG}")
  set(DeviceCompilerDepends "${VORION_CLANG}")
else()
  message(FATAL_ERROR "libdevice needs vorion-clang: add llvm-backend to VORION_COMPONENTS or set VORION_CLANG")
endif()

function(vorion_device_object Source Object)
  get_filename_component(Source "${Source}" ABSOLUTE)
  get_filename_component(Folder "${Object}" DIRECTORY)
  file(MAKE_DIRECTORY "${Folder}")
  add_custom_command(OUTPUT "${Object}"
    COMMAND "${DeviceCompiler}" -O2 -ffunction-sections -fdata-sections ${ARGN}
            -isystem "${VORION_GENERATED}/include" -MD -MF "${Object}.d" -c "${Source}" -o "${Object}"
    DEPENDS "${Source}" ${DeviceCompilerDepends} vorion_generated
    DEPFILE "${Object}.d" COMMENT "device: ${Object}" VERBATIM)
endfunction()
