/* The device driver API of a Vorion machine, for C hosts and the PoCL device.
 *
 * A device is one simulated machine. A program image (ELF) is loaded into a
 * handle. A run executes one kernel of one image with packed arguments, and
 * waiting for it returns a result. A fault of the guest is reported in the
 * result and does not terminate the host.
 *
 * Every call returns a vx_status. If it is not VX_OK, vx_last_error() on the
 * same thread describes the error and the expected value. NULL or out-of-range
 * arguments return VX_ERROR_ARGUMENT. Outputs are written only on VX_OK.
 *
 * Threads: any thread may call. A device executes one run at a time; vx_start
 * during a run returns VX_ERROR_BUSY. Copies, fills and vx_wait block until the
 * run has ended; allocation blocks only if an observer is attached. A handle
 * must not be closed while another thread uses it.
 *
 * Addresses and layouts: docs/abi.md. */
#ifndef VORION_RUNTIME_H
#define VORION_RUNTIME_H

#include <stddef.h>
#include <stdint.h>
#include <vorion/counters.h> /* vx_counters, generated */

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default) /* the only exported symbols */
/* C names. NOLINTBEGIN(readability-identifier-naming) */

typedef enum vx_status {
  VX_OK = 0,
  VX_ERROR_ARGUMENT = 1,  /* NULL, out of range, or an address not allocated */
  VX_ERROR_CONFIG = 2,    /* malformed or impossible configuration */
  VX_ERROR_FILE = 3,      /* unreadable, unwritable or malformed file */
  VX_ERROR_IMAGE = 4,     /* not an ELF for this machine */
  VX_ERROR_MEMORY = 5,    /* device, local or host memory exhausted */
  VX_ERROR_BUSY = 6,      /* a run is in progress, or none is */
  VX_ERROR_NOT_FOUND = 7, /* no kernel or argument of that name or number */
  VX_ERROR_INTERNAL = 70  /* bug in this library */
} vx_status;

typedef struct vx_device vx_device;
typedef struct vx_image vx_image;

/* Alignment of every allocation, in bytes. */
#define VX_MEM_ALIGNMENT 128

/* Message of the last failed call on this thread, "" if none has failed. Never
 * NULL. Valid until the next call on this thread. */
const char *vx_last_error(void);

/* --- Devices ------------------------------------------------------------ */

/* An option of a machine: the name of an environment variable and its value.
 *   VORION_CONFIG  the machine: JSON text (begins with '{'), the name of a
 *                  machine (without dots and slashes), or a JSON file. "" and
 *                  absent keys select the values of the default machine
 *   VORION_SET     "KEY=VALUE,...", overrides keys of VORION_CONFIG
 *   VORION_TIME    the clock: "on" (or "1"), "off" (or "0"), a frequency in MHz
 *                  ("100", "100MHz"), or "profiled": on, but only for runs
 *                  enabled by vx_device_set_profiled
 *   VORION_TRACE and the other observers of docs/debugging.md */
typedef struct vx_option {
  const char *name;
  const char *text;
} vx_option;

/* Opens a machine. An option overrides the environment variable of its name.
 * VX_ERROR_MEMORY: the memory of the machine cannot be allocated on the host.
 */
vx_status vx_device_open_with(const vx_option *options, uint32_t num_options,
                              vx_device **device);

/* Opens a machine with the option VORION_CONFIG, or without if config is NULL.
 */
vx_status vx_device_open(const char *config, vx_device **device);

/* Enables (not 0) or disables (0, the initial state) the clock for subsequent
 * runs if VORION_TIME is "profiled". A run without the clock takes no simulated
 * time and does not change the simulated caches. */
vx_status vx_device_set_profiled(vx_device *device, int profiled);

/* Waits for a run in progress. Images of the device must be freed first. NULL
 * is allowed. */
vx_status vx_device_close(vx_device *device);

typedef struct vx_device_info {
  uint32_t clusters, sockets, cores; /* of the whole device */
  uint32_t warps, lanes;             /* per core, per warp */
  uint32_t barriers;                 /* per core */
  uint32_t rasterizers;              /* of the whole device */
  uint32_t stack_bytes;              /* per lane */
  uint32_t local_base, local_bytes;  /* local memory of a core */
  uint32_t global_base;              /* lowest address of an allocation */
  uint64_t global_bytes;             /* total; above 2 GiB in two parts */
  uint64_t free_bytes;               /* currently unallocated */
  uint64_t largest_free_bytes;       /* largest allocation that can succeed */
  uint32_t max_group_items;          /* largest work-group the ABI supports */
  uint32_t clock_mhz;                /* of the cores */
  uint32_t dma_engines;              /* that time copies; 0 without a clock */
} vx_device_info;

vx_status vx_device_get_info(vx_device *device, vx_device_info *info);

/* The effective configuration as JSON text, valid until the device is closed.
 * Equal texts mean equal machines. */
vx_status vx_device_get_config(vx_device *device, const char **json);

/* --- Memory ------------------------------------------------------------- */

/* size 0 allocates VX_MEM_ALIGNMENT bytes. Contents are undefined. */
vx_status vx_mem_alloc(vx_device *device, uint64_t size, uint32_t *address);

/* address: a result of vx_mem_alloc; 0 is allowed and has no effect. */
vx_status vx_mem_free(vx_device *device, uint32_t address);

/* Ranges must be in global memory and may span allocations. The first two
 * functions also access raster CSRs, as aligned 4-byte words of the I/O window,
 * in ascending order. A command that the copy starts is complete at return. The
 * copy stops with VX_ERROR_ARGUMENT at a word that is no CSR or is read-only.
 */
vx_status vx_copy_to_device(vx_device *device, uint32_t to, const void *from,
                            uint64_t size);
vx_status vx_copy_from_device(vx_device *device, void *to, uint32_t from,
                              uint64_t size);
/* Ranges may overlap, as in memmove. */
vx_status vx_copy_on_device(vx_device *device, uint32_t to, uint32_t from,
                            uint64_t size);
/* Repeats the pattern; size is a multiple of pattern_size (1 to 128 bytes). */
vx_status vx_fill_device(vx_device *device, uint32_t to, const void *pattern,
                         uint32_t pattern_size, uint64_t size);

/* Returns a host pointer to global memory [address, address + size), valid
 * until the device is closed, for drivers that copy rectangles or map buffers.
 * The caller must not access memory that a run in progress uses. */
vx_status vx_mem_host_pointer(vx_device *device, uint32_t address,
                              uint64_t size, void **pointer);

/* Must be called after the host has written or read [address, address + size)
 * through such a pointer. They notify observers, such as the checker for
 * uninitialized memory (docs/debugging.md), and wait for a run in progress.
 * Without observers they return immediately. */
vx_status vx_mem_written(vx_device *device, uint32_t address, uint64_t size);
vx_status vx_mem_read(vx_device *device, uint32_t address, uint64_t size);

/* --- Commands of the clock ------------------------------------------------ */

/* Order and copies of a command, for the clock of a machine with DMA engines
 * (docs/adr/0011-command-processor.md). They change nothing but times, and are
 * ignored if vx_device_info.dma_engines is 0. Without these calls, every run
 * and every vx_copy_to_device, vx_copy_from_device, vx_copy_on_device and
 * vx_fill_device is a command that waits for the one before. */

/* The copies and runs until vx_command_end wait for these commands: numbers
 * from vx_command_end, 0 for none. host_after: the host has waited for these
 * before it sent the command. The arrays are copied. */
vx_status vx_command_begin(vx_device *device, const uint64_t *after,
                           uint32_t num_after, const uint64_t *host_after,
                           uint32_t num_host_after);
/* number: that of the last copy or run since vx_command_begin, 0 if there was
 * none. */
vx_status vx_command_end(vx_device *device, uint64_t *number);

typedef enum vx_copy_kind {
  VX_COPY_TO_DEVICE = 0,
  VX_COPY_FROM_DEVICE = 1,
  VX_COPY_ON_DEVICE = 2,
  VX_COPY_FILL = 3 /* with a pattern */
} vx_copy_kind;

/* A copy that the host has made through vx_mem_host_pointer. address: on the
 * device, the target of VX_COPY_ON_DEVICE; from: its source. */
vx_status vx_command_copy(vx_device *device, vx_copy_kind kind,
                          uint32_t address, uint32_t from, uint64_t size);

/* The host waits until all copies have ended in the clock. This time belongs to
 * no run. */
vx_status vx_command_settle(vx_device *device);

/* --- Images and kernels -------------------------------------------------- */

/* Copies the ELF. VX_ERROR_IMAGE also if a kernel was compiled for another
 * number of lanes than the device has. Writable data of the image persists
 * between runs until the handle is freed. */
vx_status vx_image_load(vx_device *device, const void *elf, size_t size,
                        vx_image **image);
vx_status vx_image_load_file(vx_device *device, const char *path,
                             vx_image **image);
/* Waits for a run in progress. NULL is allowed. */
vx_status vx_image_free(vx_image *image);

/* Number of kernels in the image's table; 0 if it has only main(). */
vx_status vx_image_num_kernels(vx_image *image, uint32_t *count);
vx_status vx_image_find_kernel(vx_image *image, const char *name,
                               uint32_t *kernel);

typedef struct vx_kernel_info {
  const char *name; /* valid until the image is freed */
  uint32_t num_args;
  uint32_t args_bytes;      /* size of the packed arguments */
  uint32_t context_bytes;   /* per work-item, kept across barriers */
  uint32_t local_bytes;     /* static local memory */
  uint32_t local_size[3];   /* group size it was compiled for, 0 for any */
  uint32_t lanes;           /* per warp it was compiled for, 0 for any */
  uint32_t variables_bytes; /* program-scope variables, 0 for none */
  uint32_t stack_bytes;     /* required per lane, 0 if unknown */
} vx_kernel_info;

vx_status vx_image_get_kernel(vx_image *image, uint32_t kernel,
                              vx_kernel_info *info);

typedef struct vx_arg_info {
  const char *name; /* valid until the image is freed */
  uint32_t kind;    /* one of VX_ARG_* (docs/isa.md) */
  uint32_t offset;  /* bytes from the start of the packed arguments */
  uint32_t size;    /* in bytes: 4 for pointers */
} vx_arg_info;

vx_status vx_image_get_arg(vx_image *image, uint32_t kernel, uint32_t arg,
                           vx_arg_info *info);

/* Allocates the local-memory arguments after the kernel's static local memory,
 * each aligned to VX_MEM_ALIGNMENT, and stores their addresses in the packed
 * arguments. sizes: bytes of each VX_ARG_LOCAL argument in order.
 * VX_ERROR_MEMORY if they do not fit. total (may be NULL): local bytes used. */
vx_status vx_image_place_locals(vx_image *image, uint32_t kernel,
                                const uint64_t *sizes, uint32_t num_sizes,
                                void *packed_args, uint32_t *total);

/* Allocates and initializes the program-scope variables of the kernel;
 * vx_mem_free frees them. Kernels of one program that was linked into several
 * images can share this memory. VX_ERROR_NOT_FOUND if the kernel uses none. */
vx_status vx_variables_alloc(vx_image *image, uint32_t kernel,
                             uint32_t *address);

/* --- Runs ---------------------------------------------------------------- */

/* The complete range of which a launch is a part. */
typedef struct vx_whole_range {
  uint32_t enqueued_size[3]; /* work-items of all groups but the last */
  uint32_t groups_before[3]; /* before the first of the launch */
  uint32_t all_groups[3];
  uint32_t global_size[3]; /* work-items */
} vx_whole_range;

typedef struct vx_launch_params {
  uint32_t work_dim;      /* 1 to 3 */
  uint32_t num_groups[3]; /* 1 in unused dimensions; 0 runs nothing */
  uint32_t local_size[3]; /* 1 in unused dimensions */
  uint32_t global_offset[3];
  uint32_t variables;            /* from vx_variables_alloc; 0 if none */
  const vx_whole_range *part_of; /* NULL: the launch is the whole range */
  /* total of vx_image_place_locals, 0 if unknown: a kernel with local-memory
   * arguments then uses one warp per core. */
  uint32_t local_bytes;
} vx_launch_params;

/* Starts a kernel. The args_bytes bytes at args are copied before the call
 * returns. VX_ERROR_MEMORY: no memory for the launch itself, such as its stacks
 * (docs/abi.md). */
vx_status vx_start(vx_device *device, vx_image *image, uint32_t kernel,
                   const vx_launch_params *params, const void *args,
                   uint32_t args_bytes);

/* Starts the image without a launch block: main() on all lanes of all cores. */
vx_status vx_start_main(vx_device *device, vx_image *image);

typedef enum vx_outcome {
  VX_OUTCOME_DONE = 0,  /* every warp ended, exit code 0 */
  VX_OUTCOME_EXIT = 1,  /* every warp ended, exit code not 0 */
  VX_OUTCOME_FAULT = 2, /* a trap, described in the report */
  VX_OUTCOME_HANG = 3,  /* deadlock: the report lists the blocked warps */
  VX_OUTCOME_LIMIT = 4  /* instruction limit of the configuration reached */
} vx_outcome;

/* Strings are NUL-terminated, never NULL, and valid until the next start on the
 * device, or its close. */
typedef struct vx_result {
  vx_outcome outcome;
  uint32_t exit_code;
  const char *report;     /* for a fault, hang or limit; else "" */
  const char *print_text; /* output of printf, also of incomplete lines */
  size_t print_bytes;
  uint64_t print_dropped;   /* bytes beyond the size of the print buffer */
  const char *console_text; /* bytes stored to the console word */
  size_t console_bytes;
  uint64_t console_dropped; /* bytes after the first MiB */
  double host_seconds;
  double device_seconds; /* simulated time; 0 without the clock */
  vx_counters counters;  /* sums over cores and rasterizers */
  /* Report of the simulated time, as JSON (docs/model.md); "" without the
   * clock. */
  const char *time_report;
} vx_result;

/* Waits for the last started run and returns its result. Repeated calls return
 * the same result. VX_ERROR_BUSY if no run was started. */
vx_status vx_wait(vx_device *device, vx_result *result);

/* NOLINTEND(readability-identifier-naming) */
#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
