# Pages of the manual and completion for shells, made of the definitions of command lines
# (support/definitions/make.py). Programs that are installed are in the global property
# VORION_PROGRAMS.
function(vorion_make_manual)
  get_property(Programs GLOBAL PROPERTY VORION_PROGRAMS)
  # A sanitizer's programs are not installed.
  if(NOT Programs OR VORION_SANITIZE)
    return()
  endif()
  find_package(Python3 3.11 REQUIRED COMPONENTS Interpreter)
  set(Maker "${CMAKE_SOURCE_DIR}/support/definitions")
  file(GLOB Parts CONFIGURE_DEPENDS "${Maker}/*.py" "${Maker}/*.toml")
  set(Share "${CMAKE_BINARY_DIR}/share")
  set(Done "${CMAKE_BINARY_DIR}/manual.stamp")
  set(Folders man bash-completion zsh fish)
  list(TRANSFORM Folders PREPEND "${Share}/")
  add_custom_command(
    OUTPUT "${Done}"
    # What a tool had that is gone has no page.
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${Folders}
    COMMAND "${Python3_EXECUTABLE}" -B "${Maker}/make.py" "${Share}" "${PROJECT_VERSION}"
            "${CMAKE_RUNTIME_OUTPUT_DIRECTORY}" ${Programs}
    COMMAND ${CMAKE_COMMAND} -E touch "${Done}"
    DEPENDS ${Programs} ${Parts}
    COMMENT "Making the pages of the manual"
    VERBATIM)
  add_custom_target(vorion_manual ALL DEPENDS "${Done}")
  install(DIRECTORY ${Folders} DESTINATION share)
  vorion_installs_with(vorion_manual)
endfunction()
