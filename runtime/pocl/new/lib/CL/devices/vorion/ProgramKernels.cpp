#include "ProgramKernels.h"

extern "C" {
#include "pocl_cache.h"
#include "pocl_cache_folders.h"
#include "pocl_checked_file.h"
#include "pocl_file_util.h"
#include "pocl_util.h"
}

#include <cstdint>
#include <cstdlib>
#include <string>

namespace vorion {

namespace {

std::string pathOf(cl_program Program, cl_uint Index) {
  char Folder[POCL_MAX_PATHNAME_LENGTH];
  pocl_cache_program_path(Folder, Program, Index);
  return std::string(Folder) + "/kernels";
}

} // namespace

bool adoptKernels(cl_program Program, cl_uint Index, std::string_view Text) {
  ProgramKernels Known;
  const bool IsWhole = isReadInto(Known, Text);
  Program->kernel_meta = Known.All;
  Program->num_kernels = Known.Count;
  for (cl_uint I = 0; I != Known.Count; ++I)
    Known.All[I].data =
        static_cast<void **>(calloc(Program->num_devices, sizeof(void *)));
  Program->global_var_total_size[Index] = Known.VariableBytes;
  if (IsWhole)
    return true;
  for (cl_uint I = 0; I != Known.Count; ++I)
    pocl_free_kernel_metadata(Program, I);
  POCL_MEM_FREE(Program->kernel_meta);
  Program->num_kernels = 0;
  Program->global_var_total_size[Index] = 0;
  return false;
}

bool takeKernels(cl_program Program, cl_uint Index) {
  char *Bytes = nullptr;
  uint64_t Size = 0;
  if (pocl_read_checked_file(pathOf(Program, Index).c_str(), &Bytes, &Size) !=
      POCL_CHECKED_FILE_OK)
    return false;
  const bool IsTaken = adoptKernels(Program, Index, {Bytes, Size});
  free(Bytes);
  return IsTaken;
}

void keepKernels(cl_program Program, cl_uint Index, std::string_view Text) {
  pocl_cache_write_program(pathOf(Program, Index).c_str(), Text.data(),
                           Text.size());
}

} // namespace vorion
