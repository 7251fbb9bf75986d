/// The parts of PoCL's objects that the kernel cache and messages to the
/// compiler hold: a function template visit() for each, which names them
/// (vorion/support/ToolMessages.h). Texts and arrays that are read are what
/// PoCL frees with the object.
#pragma once

#include "pocl_cl.h"
#include "vorion/support/ToolMessages.h"

namespace vorion {

template <typename Archive>
void visit(Archive &A, pocl_argument_info &Argument) {
  A.text(Argument.type_name);
  A.text(Argument.name);
  A.number(Argument.address_qualifier);
  A.number(Argument.access_qualifier);
  A.number(Argument.type_qualifier);
  A.number(Argument.type);
  A.number(Argument.type_size);
  A.number(Argument.image_type);
  A.number(Argument.is_depth);
}

template <typename Archive>
void visit(Archive &A, pocl_kernel_metadata_t &Kernel) {
  A.text(Kernel.name);
  A.text(Kernel.attributes);
  A.array(Kernel.arg_info, Kernel.num_args);
  A.number(Kernel.has_arg_metadata);
  A.array(Kernel.local_sizes, Kernel.num_locals);
  for (size_t &Size : Kernel.reqd_wg_size)
    A.number(Size);
  for (size_t &Size : Kernel.wg_size_hint)
    A.number(Size);
  A.number(Kernel.non_uniform_groups);
  for (char &Letter : Kernel.vectypehint)
    A.number(Letter);
}

/// What the host has to know of a program's kernels.
struct ProgramKernels {
  size_t VariableBytes = 0; ///< of program scope
  pocl_kernel_metadata_t *All = nullptr;
  cl_uint Count = 0;
};
template <typename Archive> void visit(Archive &A, ProgramKernels &Kernels) {
  A.number(Kernels.VariableBytes);
  A.array(Kernels.All, Kernels.Count);
}

/// What the compiler has to know of a device.
template <typename Archive> void visit(Archive &A, _cl_device_id &Device) {
  for (const char **Text :
       {&Device.extensions, &Device.features, &Device.kernellib_name,
        &Device.kernellib_subdir, &Device.llvm_abi, &Device.llvm_cpu,
        &Device.llvm_features, &Device.llvm_fp_contract_mode,
        &Device.llvm_target_triplet, &Device.opencl_c_version_as_opt})
    A.text(const_cast<char *&>(*Text));
  A.number(Device.address_bits);
  A.number(Device.arg_buffer_launcher);
  A.number(Device.args_as_id);
  A.number(Device.autolocals_to_args);
  A.number(Device.constant_as_id);
  A.number(Device.context_as_id);
  A.number(Device.device_alloca_locals);
  A.number(Device.device_side_printf);
  A.number(Device.endian_little);
  A.number(Device.global_as_id);
  A.number(Device.global_var_max_size);
  A.number(Device.grid_launcher);
  A.number(Device.grid_width_specialization_limit);
  A.number(Device.has_64bit_long);
  A.number(Device.image_support);
  A.number(Device.local_as_id);
  A.number(Device.max_work_item_dimensions);
  for (size_t &Size : Device.max_work_item_sizes)
    A.number(Size);
  A.number(Device.native_vector_width_in_bits);
  A.number(Device.run_program_scope_variables_pass);
  A.number(Device.run_workgroup_pass);
  A.number(Device.simt_lanes);
  A.number(Device.spmd);
  A.number(Device.use_only_clang_opencl_headers);
  A.number(Device.version_as_int);
}

} // namespace vorion
