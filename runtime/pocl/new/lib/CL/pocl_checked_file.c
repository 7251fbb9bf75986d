#include "pocl_checked_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <CL/cl_vorion.h>

#include "pocl_cache.h"
#include "pocl_file_util.h"

#define CHECKSUM_SIZE sizeof(uint64_t)

static _Thread_local char problem[1024];

/* Words, since the largest file has 3 MB. Each step is one to one, so that no
 * change of a single word goes unnoticed. */
static uint64_t add_bytes(uint64_t hash, const void *bytes, uint64_t size) {
  const unsigned char *at = bytes;
  for (; size >= sizeof(uint64_t); size -= sizeof(uint64_t)) {
    uint64_t word;
    memcpy(&word, at, sizeof(word));
    at += sizeof(word);
    hash = (hash ^ word) * 0x9e3779b97f4a7c15; /* odd */
    hash ^= hash >> 32;
  }
  for (; size > 0; --size)
    hash = (hash ^ *at++) * 0x100000001b3;
  return hash;
}

uint64_t pocl_checksum(const void *bytes, uint64_t size) {
  return add_bytes(0xcbf29ce484222325, bytes, size);
}

/* The checksum of a file, which knows its place in the cache: a whole file of
 * another place is not this one's. */
static uint64_t file_checksum(const char *path, const void *bytes,
                              uint64_t size) {
  const char *place = pocl_cache_place(path);
  return add_bytes(pocl_checksum(place, strlen(place)), bytes, size);
}

int pocl_write_all(int fd, const char *content, uint64_t size) {
  while (size > 0) {
    const ssize_t written = write(fd, content, size);
    if (written < 0 && errno == EINTR)
      continue;
    if (written < 0)
      return -1;
    content += written;
    size -= written;
  }
  return 0;
}

int pocl_write_checked_file(const char *path, const char *content,
                            uint64_t size) {
  char *sealed = (char *)malloc(size + CHECKSUM_SIZE);
  if (sealed == NULL)
    return -1;
  const uint64_t checksum = file_checksum(path, content, size);
  memcpy(sealed, content, size);
  memcpy(sealed + size, &checksum, CHECKSUM_SIZE);
  const int status = pocl_write_file(path, sealed, size + CHECKSUM_SIZE, 0);
  free(sealed);
  return status;
}

pocl_checked_file_status
pocl_read_checked_file(const char *path, char **content, uint64_t *size) {
  *content = NULL;
  *size = 0;
  if (access(path, F_OK) != 0)
    return POCL_CHECKED_FILE_NONE;
  char *bytes = NULL;
  uint64_t length = 0;
  if (pocl_read_file(path, &bytes, &length) == 0 && length >= CHECKSUM_SIZE) {
    uint64_t checksum;
    length -= CHECKSUM_SIZE;
    memcpy(&checksum, bytes + length, CHECKSUM_SIZE);
    if (checksum == file_checksum(path, bytes, length)) {
      *content = bytes;
      *size = length;
      return POCL_CHECKED_FILE_OK;
    }
  }
  free(bytes);
  fprintf(stderr,
          "vorion: warning: kernel cache: %s is damaged, it is made again\n",
          path);
  pocl_remove(path);
  return POCL_CHECKED_FILE_DAMAGED;
}

void pocl_note_file_problem(const char *path, const char *what) {
  if (problem[0] == 0)
    snprintf(problem, sizeof(problem),
             CL_KERNEL_CACHE_PROBLEM_VORION
             "%s: %s: %s, expected a folder that can be written and has room "
             "(POCL_CACHE_DIR, XDG_CACHE_HOME or HOME names it)",
             path, what, strerror(errno));
}

const char *pocl_file_problem(void) { return problem[0] ? problem : NULL; }

void pocl_forget_file_problem(void) { problem[0] = 0; }
