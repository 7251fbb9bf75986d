/* Where the kernel cache lies: folders that no other user can have written. */
#ifndef POCL_CACHE_FOLDERS_H
#define POCL_CACHE_FOLDERS_H

#include "pocl_cl.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Paths have room for POCL_MAX_PATHNAME_LENGTH bytes. What returns -1 has noted
 * a problem (pocl_file_problem()), unless it says otherwise. */

/* The folder of what is kept from run to run
 * (vorion/support/KernelCacheFolder.h) or, if there is none, a new one that
 * goes with this process. */
int pocl_find_cache_folder(int is_cached, char *path);

/* Says once on standard error, with the reason, if that folder goes with this
 * process. */
void pocl_tell_of_private_cache(void);

/* From here on programs, and what is made of them, are in no file: for
   vorion-clang, which wants them once. To be called before the first build.
   Precompiled headers are kept all the same. */
void pocl_cache_keep_no_programs(void);
int pocl_cache_keeps_programs(void);

/* pocl_write_checked_file(), for programs. */
int pocl_cache_write_program(const char *path, const char *content,
                             uint64_t size);

/* Copies the file at a place of the system's cache, below one of its folders or
 * "", to a path. -1, and no problem noted, if there is none that can be
 * trusted. */
int pocl_copy_from_system_cache(const char *folder, const char *place,
                                const char *path);

/* Makes a file of the cache such a copy (pocl_cache.c). */
int pocl_cache_take_from_system(const char *path);

/* Makes a folder for what is built of a program, which goes with it. */
int pocl_cache_create_uncached_dir(cl_program program, unsigned device_i,
                                   char *program_bc_path);

#ifdef __cplusplus
}
#endif

#endif
