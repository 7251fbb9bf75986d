#include "Description.h"
#include "Images.h"

extern "C" {
#include "common.h"
#include "common_driver.h"
#include "config.h"
#include "devices.h"
#include "pocl_util.h"
}

#include <CL/cl_vorion.h>

#include "vorion_features.h"

namespace vorion {

namespace {

/// The last two concern the host's calls alone.
constexpr const char *Extensions = VORION_OPENCL_EXTENSIONS
    " cl_khr_image2d_from_buffer " CL_VORION_EXTENSION_NAME;

/// What the runtime gives a launch.
constexpr size_t PrintBufferBytes = 1u << 20;

constexpr uint64_t LaunchShare = 32;

/// A variable of program scope may begin with as many bytes that are not 0, and
/// each image has them.
constexpr size_t MaxVariableBytes = 1u << 20;

/// What the translator of runtime/pocl/CMakeLists.txt reads whole.
constexpr const char *SpirvVersions =
    "SPIR-V_1.3 SPIR-V_1.2 SPIR-V_1.1 SPIR-V_1.0";

/// The standard wants a version of its suite; nobody certified the device.
constexpr const char *NoConformance = "v0000-01-01-00";

/// "VO" of Vorion; there is no PCI vendor number.
constexpr cl_uint VendorId = 0x564F;

void describeVersion(cl_device_id Device) {
  SETUP_DEVICE_CL_VERSION(Device, 3, 0);
  // A program that names no version of OpenCL C is of the newest 1.x.
  Device->opencl_c_version_as_opt = "CL1.2";
  Device->opencl_c_version_as_cl = CL_MAKE_VERSION(1, 2, 0);
  Device->features = VORION_OPENCL_FEATURES;
  pocl_setup_opencl_c_with_version(Device, CL_TRUE);
  pocl_setup_features_with_version(Device);
  pocl_setup_extensions_with_version(Device);
  Device->version_of_latest_passed_cts = NoConformance;
  Device->supported_spir_v_versions = SpirvVersions;
  pocl_setup_ils_with_version(Device);
}

/// Atomics execute one after the other, in the same order for all cores.
void describeConcurrency(cl_device_id Device, const vx_device_info &Info) {
  Device->atomic_memory_capabilities =
      CL_DEVICE_ATOMIC_ORDER_RELAXED | CL_DEVICE_ATOMIC_ORDER_ACQ_REL |
      CL_DEVICE_ATOMIC_ORDER_SEQ_CST | CL_DEVICE_ATOMIC_SCOPE_WORK_GROUP |
      CL_DEVICE_ATOMIC_SCOPE_DEVICE | CL_DEVICE_ATOMIC_SCOPE_ALL_DEVICES;
  Device->atomic_fence_capabilities =
      Device->atomic_memory_capabilities | CL_DEVICE_ATOMIC_SCOPE_WORK_ITEM;
  Device->generic_as_support = CL_TRUE;
  Device->wg_collective_func_support = CL_TRUE;
  Device->non_uniform_work_group_support = CL_TRUE;
  // The subgroups of a group take turns on one warp.
  Device->sub_group_independent_forward_progress = CL_FALSE;
  Device->max_num_sub_groups = Info.max_group_items / Info.lanes;
}

} // namespace

uint64_t keptForLaunches(const vx_device_info &Info) {
  return Info.global_bytes / LaunchShare;
}

void describeDevice(cl_device_id Device, const vx_device_info &Info) {
  pocl_init_default_device_infos(Device, Extensions);
  describeVersion(Device);
  Device->type = CL_DEVICE_TYPE_GPU;
  Device->vendor = "Vorion";
  Device->vendor_id = VendorId;
  Device->short_name = "vorion";
  Device->execution_capabilities = CL_EXEC_KERNEL;
  Device->on_host_queue_props =
      CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE | CL_QUEUE_PROFILING_ENABLE;
  Device->has_own_timer = 1; // see updateEvent() of Driver.cpp
  Device->max_clock_frequency = Info.clock_mhz;
  Device->max_compute_units = Info.cores;
  Device->max_work_group_size = Info.max_group_items;
  for (size_t &Size : Device->max_work_item_sizes)
    Size = Info.max_group_items;
  Device->preferred_wg_size_multiple = Info.lanes;
  describeConcurrency(Device, Info);

  Device->address_bits = 32;
  Device->has_64bit_long = 1;
  Device->endian_little = CL_TRUE;
  Device->host_unified_memory = CL_FALSE;
  Device->global_mem_size = Info.global_bytes - keptForLaunches(Info);
  Device->max_mem_alloc_size = Info.largest_free_bytes - keptForLaunches(Info);
  Device->max_constant_buffer_size = Device->max_mem_alloc_size;
  Device->global_var_max_size = MaxVariableBytes;
  Device->global_var_pref_size = Device->max_mem_alloc_size;
  Device->local_mem_type = CL_LOCAL;
  Device->local_mem_size = Info.local_bytes;
  Device->mem_base_addr_align = VX_MEM_ALIGNMENT;

  Device->single_fp_config = CL_FP_DENORM | CL_FP_INF_NAN |
                             CL_FP_ROUND_TO_NEAREST | CL_FP_FMA |
                             CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT;
  // Double precision is software, which always rounds to nearest. The standard
  // asks for the other modes of rounding all the same: it means conversions.
  Device->double_fp_config = CL_FP_DENORM | CL_FP_INF_NAN |
                             CL_FP_ROUND_TO_NEAREST | CL_FP_ROUND_TO_ZERO |
                             CL_FP_ROUND_TO_INF | CL_FP_FMA | CL_FP_SOFT_FLOAT;
  Device->half_fp_config =
      CL_FP_DENORM | CL_FP_INF_NAN | CL_FP_ROUND_TO_NEAREST;
  // A lane is a scalar.
  Device->preferred_vector_width_char = Device->native_vector_width_char = 1;
  Device->preferred_vector_width_short = Device->native_vector_width_short = 1;
  Device->preferred_vector_width_int = Device->native_vector_width_int = 1;
  Device->preferred_vector_width_long = Device->native_vector_width_long = 1;
  Device->preferred_vector_width_float = Device->native_vector_width_float = 1;
  Device->preferred_vector_width_double = Device->native_vector_width_double =
      1;
  Device->preferred_vector_width_half = Device->native_vector_width_half = 1;
  Device->native_vector_width_in_bits = 0;
  describeImages(Device);
  // PoCL's other limits of images are what the standard asks of OpenCL 3.0.
  Device->image2d_max_width = Device->image2d_max_height = 16384;
  Device->num_builtin_kernels = 0;
  POCL_MEM_FREE(Device->builtin_kernel_list);
  Device->printf_buffer_size = PrintBufferBytes;
  Device->max_sub_devices = 0;
  Device->num_partition_properties = 0;
  Device->partition_properties = nullptr;
}

void describeCompilation(cl_device_id Device, const vx_device_info &Info) {
  Device->llvm_target_triplet = "riscv32-unknown-unknown-elf";
  Device->llvm_abi = "ilp32f";
  Device->llvm_cpu = "generic-rv32";
  Device->llvm_features = "+m,+a,+f";
  Device->llvm_fp_contract_mode = "off";
  Device->kernellib_name = "kernel-vorion";
  Device->kernellib_fallback_name = nullptr;
  Device->kernellib_subdir = "vorion";
  Device->simt_lanes = Info.lanes;
  Device->run_program_scope_variables_pass = CL_TRUE;
  Device->arg_buffer_launcher = CL_TRUE;
  Device->grid_launcher = CL_FALSE;
  Device->autolocals_to_args = POCL_AUTOLOCALS_TO_ARGS_NEVER;
  Device->device_alloca_locals = CL_FALSE;
  // printf of the kernel library finds its buffer through the launch block.
  Device->device_side_printf = 0;
}

} // namespace vorion
