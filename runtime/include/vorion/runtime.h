/* The device driver API of a Vorion machine, for C hosts and the PoCL device.
 *
 * A device is one simulated machine. A program image (ELF) is loaded into a
 * handle; a run starts one kernel of one image with packed arguments, and
 * waiting for it gives a result. A fault of the guest is a result, never the
 * host's end.
 *
 * Every call returns a vx_status. When it is not VX_OK, vx_last_error() of the
 * same thread says what was wrong and what was expected. NULL or out-of-range
 * arguments give VX_ERROR_ARGUMENT. Outputs are written only on VX_OK.
 *
 * Threads: any thread may call. A device does one run at a time; vx_start
 * while one is in progress gives VX_ERROR_BUSY. Copies, fills and vx_wait wait
 * until the run in progress has ended; allocation does so only where something
 * watches the runs. Handles must not be closed while another thread uses them.
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
#pragma GCC visibility push(default) /* the library hides all else */
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
  VX_ERROR_INTERNAL = 70  /* a bug of ours */
} vx_status;

typedef struct vx_device vx_device;
typedef struct vx_image vx_image;

/* Alignment of every allocation, in bytes. */
#define VX_MEM_ALIGNMENT 128

/* The text for the last call of this thread that failed; "" before the first.
 * Valid until the thread's next call. Never NULL. */
const char *vx_last_error(void);

/* --- Devices ------------------------------------------------------------ */

/* What a machine is opened with: the name of one of the environment's variables
 * that follow, and its text.
 *   VORION_CONFIG  the machine: JSON text (begins with '{'), the name of a
 *                  machine (without dots and slashes) or of a JSON file; keys
 *                  that are absent, or "", keep the default machine's values
 *   VORION_SET     "KEY=VALUE,...", changes what came of it
 *   VORION_TIME    the clock: "on" (or "1"), "off" (or "0"), a clock in MHz
 *                  ("100", "100MHz"), or "profiled": on, but only in runs
 *                  after vx_device_set_profiled
 *   VORION_TRACE and the others of docs/debugging.md: what watches runs */
typedef struct vx_option {
  const char *name;
  const char *text;
} vx_option;

/* Opens a machine. The environment's variables count where no option has their
 * name. VX_ERROR_MEMORY: the host has no room for the machine's memory. */
vx_status vx_device_open_with(const vx_option *options, uint32_t num_options,
                              vx_device **device);

/* With one option, VORION_CONFIG, or none if config is NULL. */
vx_status vx_device_open(const char *config, vx_device **device);

/* profiled: not 0 if the next runs are to be clocked where the clock is for
 * profiled runs only; they are not at first. What a machine's clock is not on
 * for takes no time on it and is not seen by its caches. */
vx_status vx_device_set_profiled(vx_device *device, int profiled);

/* Waits for a run in progress; images of the device must be freed before. NULL
 * is allowed. */
vx_status vx_device_close(vx_device *device);

typedef struct vx_device_info {
  uint32_t clusters, sockets, cores; /* of the whole device */
  uint32_t warps, lanes;             /* a core, a warp */
  uint32_t barriers;                 /* a core */
  uint32_t rasterizers;              /* of the whole device */
  uint32_t stack_bytes;              /* a lane */
  uint32_t local_base, local_bytes;  /* local memory of a core */
  uint32_t global_base;              /* first byte that can be allocated */
  uint64_t global_bytes;             /* all of it: above 2 GiB in two parts */
  uint64_t free_bytes;               /* not allocated now */
  uint64_t largest_free_bytes;       /* largest allocation possible now */
  uint32_t max_group_items;          /* largest work-group the ABI supports */
  uint32_t clock_mhz;                /* of the cores */
} vx_device_info;

vx_status vx_device_get_info(vx_device *device, vx_device_info *info);

/* The configuration in force as JSON text; valid until the device is closed.
 * Equal texts mean equal machines. */
vx_status vx_device_get_config(vx_device *device, const char **json);

/* --- Memory ------------------------------------------------------------- */

/* size 0 allocates VX_MEM_ALIGNMENT bytes. Contents are undefined. */
vx_status vx_mem_alloc(vx_device *device, uint64_t size, uint32_t *address);

/* address: what vx_mem_alloc gave; 0 is allowed and does nothing. */
vx_status vx_mem_free(vx_device *device, uint32_t address);

/* Ranges must lie in global memory; they need not be one allocation. The first
 * two also take aligned 4-byte words of the I/O window, in rising order: raster
 * CSRs, and a command that is started has been executed at return. A word that
 * is no CSR, or is read-only, ends the copy there: VX_ERROR_ARGUMENT. */
vx_status vx_copy_to_device(vx_device *device, uint32_t to, const void *from,
                            uint64_t size);
vx_status vx_copy_from_device(vx_device *device, void *to, uint32_t from,
                              uint64_t size);
/* Overlapping ranges are copied as if through a temporary. */
vx_status vx_copy_on_device(vx_device *device, uint32_t to, uint32_t from,
                            uint64_t size);
/* Repeats the pattern; size is a multiple of pattern_size (1 to 128 bytes). */
vx_status vx_fill_device(vx_device *device, uint32_t to, const void *pattern,
                         uint32_t pattern_size, uint64_t size);

/* Where global memory [address, address + size) lies in the host, until the
 * device is closed: for drivers that copy rectangles or map buffers. The caller
 * keeps away from it while a run uses it. */
vx_status vx_mem_host_pointer(vx_device *device, uint32_t address,
                              uint64_t size, void **pointer);

/* To be called after the host has written or read [address, address + size)
 * through such a pointer, so that what watches runs knows it, as the check for
 * uninitialised memory has to (docs/debugging.md). Wait for a run in progress;
 * cost nothing where nothing watches. */
vx_status vx_mem_written(vx_device *device, uint32_t address, uint64_t size);
vx_status vx_mem_read(vx_device *device, uint32_t address, uint64_t size);

/* --- Images and kernels -------------------------------------------------- */

/* VX_ERROR_IMAGE also for a kernel compiled for warps of other than the
 * device's lanes. The image keeps a copy of the bytes. Its writable data lives
 * as long as the handle: a run sees what the image's earlier runs stored. */
vx_status vx_image_load(vx_device *device, const void *elf, size_t size,
                        vx_image **image);
vx_status vx_image_load_file(vx_device *device, const char *path,
                             vx_image **image);
/* Waits for a run in progress. NULL is allowed. */
vx_status vx_image_free(vx_image *image);

/* Kernels in the image's table; 0 for a program with main() alone. */
vx_status vx_image_num_kernels(vx_image *image, uint32_t *count);
vx_status vx_image_find_kernel(vx_image *image, const char *name,
                               uint32_t *kernel);

typedef struct vx_kernel_info {
  const char *name; /* valid until the image is freed */
  uint32_t num_args;
  uint32_t args_bytes;      /* size of the packed arguments */
  uint32_t context_bytes;   /* a work-item keeps across barriers */
  uint32_t local_bytes;     /* static local memory */
  uint32_t local_size[3];   /* group size it was compiled for, 0 for any */
  uint32_t lanes;           /* of the warps it was compiled for, 0 for any */
  uint32_t variables_bytes; /* of program scope, 0 if it uses none */
  uint32_t stack_bytes;     /* of a lane that it needs, 0 if not known */
} vx_kernel_info;

vx_status vx_image_get_kernel(vx_image *image, uint32_t kernel,
                              vx_kernel_info *info);

typedef struct vx_arg_info {
  const char *name; /* valid until the image is freed */
  uint32_t kind;    /* one of VX_ARG_* (docs/isa.md) */
  uint32_t offset;  /* bytes from the start of the packed arguments */
  uint32_t size;    /* bytes there: 4 for pointers */
} vx_arg_info;

vx_status vx_image_get_arg(vx_image *image, uint32_t kernel, uint32_t arg,
                           vx_arg_info *info);

/* Places the local-memory arguments after the kernel's static local memory,
 * each aligned to VX_MEM_ALIGNMENT, and stores their addresses into the packed
 * arguments. sizes: bytes wanted, one a VX_ARG_LOCAL argument in order.
 * VX_ERROR_MEMORY if they do not fit. total (may be NULL): local bytes used. */
vx_status vx_image_place_locals(vx_image *image, uint32_t kernel,
                                const uint64_t *sizes, uint32_t num_sizes,
                                void *packed_args, uint32_t *total);

/* Memory for the variables of program scope that the kernel uses, with their
 * initial values; vx_mem_free frees it. All kernels of a program that is linked
 * to several images can be launched with the same memory. VX_ERROR_NOT_FOUND if
 * the kernel uses none. */
vx_status vx_variables_alloc(vx_image *image, uint32_t kernel,
                             uint32_t *address);

/* --- Runs ---------------------------------------------------------------- */

/* The range that a launch is a part of. */
typedef struct vx_whole_range {
  uint32_t enqueued_size[3]; /* work-items of all groups but the last */
  uint32_t groups_before[3]; /* the launch's first */
  uint32_t all_groups[3];
  uint32_t global_size[3]; /* work-items */
} vx_whole_range;

typedef struct vx_launch_params {
  uint32_t work_dim;      /* 1 to 3 */
  uint32_t num_groups[3]; /* 1 where not used; 0 runs nothing */
  uint32_t local_size[3]; /* 1 where not used */
  uint32_t global_offset[3];
  uint32_t variables; /* of vx_variables_alloc; 0 for a kernel without */
  const vx_whole_range *part_of; /* NULL: the launch is the whole range */
  /* The total of vx_image_place_locals; 0: not known, so that a kernel with
   * local-memory arguments runs on one warp of each core. */
  uint32_t local_bytes;
} vx_launch_params;

/* Starts a kernel; args: args_bytes of it, copied before the call returns.
 * VX_ERROR_MEMORY: there is no room for what the launch itself needs, such as
 * its stacks (docs/abi.md). */
vx_status vx_start(vx_device *device, vx_image *image, uint32_t kernel,
                   const vx_launch_params *params, const void *args,
                   uint32_t args_bytes);

/* Starts the image without a launch block: main() on all lanes of all cores. */
vx_status vx_start_main(vx_device *device, vx_image *image);

typedef enum vx_outcome {
  VX_OUTCOME_DONE = 0,  /* every warp ended, exit code 0 */
  VX_OUTCOME_EXIT = 1,  /* every warp ended, exit code not 0 */
  VX_OUTCOME_FAULT = 2, /* a trap: the report names it */
  VX_OUTCOME_HANG =
      3, /* no warp can go on: the report says what each waits for */
  VX_OUTCOME_LIMIT = 4 /* the configuration's instruction limit reached */
} vx_outcome;

/* Texts are NUL-terminated, never NULL, and valid until the device's next
 * start or close. */
typedef struct vx_result {
  vx_outcome outcome;
  uint32_t exit_code;
  const char *report;     /* of a fault, hang or limit; else "" */
  const char *print_text; /* what printf wrote, complete lines or not */
  size_t print_bytes;
  uint64_t print_dropped;   /* bytes that did not fit the print buffer */
  const char *console_text; /* what was stored to the console word */
  size_t console_bytes;
  uint64_t console_dropped; /* bytes beyond the first MiB, which is kept */
  double host_seconds;
  double device_seconds; /* of the run on the machine; 0 without the clock */
  vx_counters counters;  /* sums over cores and rasterizers */
  /* How long the run took on the machine, as JSON (docs/model.md); "" without
   * the clock. */
  const char *time_report;
} vx_result;

/* Waits for the run that was started last and gives its result; a second wait
 * gives the same result again. VX_ERROR_BUSY if nothing was ever started. */
vx_status vx_wait(vx_device *device, vx_result *result);

/* NOLINTEND(readability-identifier-naming) */
#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
