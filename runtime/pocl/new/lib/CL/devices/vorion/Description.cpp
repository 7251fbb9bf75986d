#include "Description.h"

extern "C" {
#include "common.h"
#include "common_driver.h"
#include "config.h"
#include "devices.h"
#include "pocl_util.h"
}

#include <CL/cl_vorion.h>

namespace vorion {

namespace {

constexpr const char *Extensions =
    "cl_khr_byte_addressable_store cl_khr_global_int32_base_atomics "
    "cl_khr_global_int32_extended_atomics cl_khr_local_int32_base_atomics "
    "cl_khr_local_int32_extended_atomics " CL_VORION_EXTENSION_NAME;

/// What the runtime gives a launch.
constexpr size_t PrintBufferBytes = 1u << 20;

constexpr uint64_t LaunchShare = 32;

/// "VO" of Vorion; there is no PCI vendor number.
constexpr cl_uint VendorId = 0x564F;

} // namespace

uint64_t keptForLaunches(const vx_device_info &Info) {
  return Info.global_bytes / LaunchShare;
}

void describeDevice(cl_device_id Device, const vx_device_info &Info) {
  pocl_init_default_device_infos(Device, Extensions);
  SETUP_DEVICE_CL_VERSION(Device, 1, 2);
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

  Device->address_bits = 32;
  Device->has_64bit_long = 1;
  Device->endian_little = CL_TRUE;
  Device->host_unified_memory = CL_FALSE;
  Device->global_mem_size = Info.global_bytes - keptForLaunches(Info);
  Device->max_mem_alloc_size = Info.largest_free_bytes - keptForLaunches(Info);
  Device->max_constant_buffer_size = Device->max_mem_alloc_size;
  Device->local_mem_type = CL_LOCAL;
  Device->local_mem_size = Info.local_bytes;
  Device->mem_base_addr_align = VX_MEM_ALIGNMENT;

  Device->single_fp_config = CL_FP_DENORM | CL_FP_INF_NAN |
                             CL_FP_ROUND_TO_NEAREST | CL_FP_FMA |
                             CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT;
  Device->double_fp_config = 0;
  Device->half_fp_config = 0;
  // A lane is a scalar.
  Device->preferred_vector_width_char = Device->native_vector_width_char = 1;
  Device->preferred_vector_width_short = Device->native_vector_width_short = 1;
  Device->preferred_vector_width_int = Device->native_vector_width_int = 1;
  Device->preferred_vector_width_long = Device->native_vector_width_long = 1;
  Device->preferred_vector_width_float = Device->native_vector_width_float = 1;
  Device->preferred_vector_width_double = Device->native_vector_width_double =
      0;
  Device->preferred_vector_width_half = Device->native_vector_width_half = 0;
  Device->native_vector_width_in_bits = 0;
  Device->image_support = CL_FALSE;
  Device->image2d_max_width = Device->image2d_max_height = 0;
  Device->image3d_max_width = Device->image3d_max_height = 0;
  Device->image3d_max_depth = 0;
  Device->image_max_buffer_size = Device->image_max_array_size = 0;
  Device->max_samplers = 0;
  Device->max_read_image_args = Device->max_write_image_args = 0;
  Device->max_read_write_image_args = 0;
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
  Device->arg_buffer_launcher = CL_TRUE;
  Device->grid_launcher = CL_FALSE;
  Device->autolocals_to_args = POCL_AUTOLOCALS_TO_ARGS_NEVER;
  Device->device_alloca_locals = CL_FALSE;
  // printf of the kernel library finds its buffer through the launch block.
  Device->device_side_printf = 0;
}

} // namespace vorion
