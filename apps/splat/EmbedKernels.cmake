# Writes OUTPUT, the C++ source of kernelSource(), from the kernel FILES.
# usage: cmake -DOUTPUT=... "-DFILES=a.cl;b.cl" -P EmbedKernels.cmake
set(Text "// Generated from apps/splat/kernels/ by EmbedKernels.cmake; do not edit.\n")
string(APPEND Text "#include \"Kernels.h\"\n\nnamespace vorion::splat {\n\n")
string(APPEND Text "std::string_view kernelSource(std::string_view File) {\n")
foreach(File IN LISTS FILES)
  get_filename_component(Name "${File}" NAME)
  file(READ "${File}" Source)
  string(APPEND Text "  if (File == \"${Name}\")\n    return R\"kernel(${Source})kernel\";\n")
endforeach()
string(APPEND Text "  return {};\n}\n\n} // namespace vorion::splat\n")
file(WRITE "${OUTPUT}" "${Text}")
