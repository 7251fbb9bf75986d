#include "pocl_checked_file.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <CL/cl_vorion.h>
#define XXH_INLINE_ALL /* the header alone: no library to link */
#include <xxhash.h>

#include "pocl_cache.h"
#include "pocl_cache_folders.h"
#include "pocl_file_util.h"

#define CHECKSUM_SIZE sizeof(uint64_t)

static _Thread_local char problem[1024];

uint64_t pocl_checksum(const void *bytes, uint64_t size) {
  return XXH3_64bits(bytes, size);
}

/* The checksum of a file, which knows its place in the cache: a whole file of
 * another place is not this one's. */
static uint64_t file_checksum(const char *path, const void *bytes,
                              uint64_t size) {
  const char *place = pocl_cache_place(path);
  return XXH3_64bits_withSeed(bytes, size, pocl_checksum(place, strlen(place)));
}

/* write(), which fails with EFBIG where a file would grow beyond the limit of
 * its size (ulimit -f). The signal of that would end the program, whose own
 * action of it is left alone. */
static ssize_t write_within_limit(int fd, const char *content, uint64_t size) {
  sigset_t limit, had;
  sigemptyset(&limit);
  sigaddset(&limit, SIGXFSZ);
  pthread_sigmask(SIG_BLOCK, &limit, &had);
  const ssize_t written = write(fd, content, size);
  const int reason = errno;
  const struct timespec now = {0, 0};
  if (written < 0 && reason == EFBIG && !sigismember(&had, SIGXFSZ))
    sigtimedwait(&limit, NULL, &now);
  pthread_sigmask(SIG_SETMASK, &had, NULL);
  errno = reason;
  return written;
}

int pocl_write_all(int fd, const char *content, uint64_t size) {
  while (size > 0) {
    const ssize_t written = write_within_limit(fd, content, size);
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

/* All of a regular file that this user alone can have written; NULL of
 * another. */
static char *read_own_file(const char *path, uint64_t *size) {
  /* a pipe would wait for its writer */
  const int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  struct stat is;
  char *bytes = NULL;
  if (fd >= 0 && fstat(fd, &is) == 0 && S_ISREG(is.st_mode) &&
      is.st_uid == geteuid() && (is.st_mode & (S_IWGRP | S_IWOTH)) == 0 &&
      (bytes = malloc(is.st_size + 1)) != NULL) {
    *size = 0;
    ssize_t got = 0;
    while (*size < (uint64_t)is.st_size &&
           (got = read(fd, bytes + *size, is.st_size - *size)) != 0) {
      if (got > 0)
        *size += got;
      else if (errno != EINTR)
        break;
    }
  }
  if (fd >= 0)
    close(fd);
  return bytes;
}

static pocl_checked_file_status read_checked(const char *path, char **content,
                                             uint64_t *size) {
  *content = NULL;
  *size = 0;
  if (access(path, F_OK) != 0)
    return POCL_CHECKED_FILE_NONE;
  uint64_t length = 0;
  char *bytes = read_own_file(path, &length);
  if (bytes != NULL && length >= CHECKSUM_SIZE) {
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

pocl_checked_file_status
pocl_read_checked_file(const char *path, char **content, uint64_t *size) {
  const pocl_checked_file_status own = read_checked(path, content, size);
  if (own == POCL_CHECKED_FILE_OK || pocl_cache_take_from_system(path) != 0)
    return own;
  return read_checked(path, content, size);
}

void pocl_note_cache_problem(const char *text) {
  if (problem[0] == 0)
    snprintf(problem, sizeof(problem),
             CL_KERNEL_CACHE_PROBLEM_VORION
             "%s, expected a folder that you alone can write, with room "
             "(POCL_CACHE_DIR names it)",
             text);
}

void pocl_note_file_problem(const char *path, const char *what) {
  char text[sizeof(problem)];
  snprintf(text, sizeof(text), "%s: %s: %s", path, what, strerror(errno));
  pocl_note_cache_problem(text);
}

void pocl_adopt_file_problem(const char *text) {
  if (problem[0] == 0)
    snprintf(problem, sizeof(problem), "%s", text);
}

const char *pocl_file_problem(void) { return problem[0] ? problem : NULL; }

void pocl_forget_file_problem(void) { problem[0] = 0; }
