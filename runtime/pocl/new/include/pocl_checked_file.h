/* Files of the kernel cache: contents with a checksum behind them, and what
 * went wrong when a file or a folder could not be made. */
#ifndef POCL_CHECKED_FILE_H
#define POCL_CHECKED_FILE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What pocl_read_checked_file() found. */
typedef enum {
  POCL_CHECKED_FILE_OK,
  POCL_CHECKED_FILE_NONE,   /* it is not there */
  POCL_CHECKED_FILE_DAMAGED /* it cannot be read or was changed */
} pocl_checked_file_status;

/* Writes a file as pocl_write_file() does, with the checksum of its place in
 * the cache and its contents behind it: eight bytes, which readers of bitcode
 * and of ELF files ignore. 0 on success. */
int pocl_write_checked_file(const char *path, const char *content,
                            uint64_t size);

/* The contents without the checksum, to be freed by the caller. A file that is
 * damaged or may be another user's is removed, which standard error is told of.
 * What is missing then becomes a copy of the system's, if that has it. */
pocl_checked_file_status pocl_read_checked_file(const char *path,
                                                char **content, uint64_t *size);

/* Writes all bytes, in as many pieces as it takes. 0 on success, else -1 with
 * errno. */
int pocl_write_all(int fd, const char *content, uint64_t size);

/* The function of the checksums, for the keys of entries that builds with other
 * ones would find. */
#define POCL_CHECKSUM "XXH3"

/* The checksum of bytes. */
uint64_t pocl_checksum(const void *bytes, uint64_t size);

/* Keeps a sentence's beginning that says why the cache is of no use, unless
 * this thread keeps another reason already. */
void pocl_note_cache_problem(const char *text);

/* Keeps errno as the reason why something cannot be done with the path, unless
 * this thread keeps another reason already. */
void pocl_note_file_problem(const char *path, const char *what);

/* The same with such a sentence of another process. */
void pocl_adopt_file_problem(const char *text);

/* The sentence of this thread's first noted problem since the last call of
 * pocl_forget_file_problem(); NULL if there is none. */
const char *pocl_file_problem(void);
void pocl_forget_file_problem(void);

#ifdef __cplusplus
}
#endif

#endif
