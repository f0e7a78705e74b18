/* Stands between a program and the system (LD_PRELOAD) and makes the disk fail, or kills the program, at a chosen call.
 * Calls that change something under FAULTY_FOLDER are counted, from 1.
 *
 * - FAULTY_COUNT=FILE: their number is written there at the end.
 * - FAULTY_LIST=FILE: each is listed there.
 * - FAULTY_KILL=N: the program is killed at the N-th; FAULTY_TORN=1: when half of what it writes is written.
 * - FAULTY_FAIL=N: the N-th and all after it are refused, but for removing and shortening; FAULTY_ERRNO=E: so, else
 *   no space is left.
 * - FAULTY_ONLY=TEXT: those are counted only on files whose names hold TEXT.
 * - FAULTY_CLOCK=S: the clock on the wall is S seconds off at every other look at it.
 * - FAULTY_TAKEN=FILE: as soon as FILE is there and the program has asked for the facts of an open file (FAULTY_ONLY),
 *   FILE takes that file's name. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static atomic_long calls;

static long number(const char* name) {
  const char* text = getenv(name);
  return text ? atol(text) : 0;
}

static int watched(const char* path) {
  const char *folder = getenv("FAULTY_FOLDER"), *only = getenv("FAULTY_ONLY");
  char whole[8192];
  if (!folder) return 0;
  if (path[0] != '/') {
    if (!getcwd(whole, 4096)) return 0;
    strncat(strcat(whole, "/"), path, 4000);
    path = whole;
  }
  return strncmp(path, folder, strlen(folder)) == 0 && (!only || strstr(path, only));
}

static const char* path_of(int file, char* path) {
  char link[64];
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t length = readlink(link, path, 4095);
  path[length < 0 ? 0 : length] = 0;
  return path;
}

static void list(long call, const char* what, const char* path) {
  const char* file = getenv("FAULTY_LIST");
  if (!file) return;
  char line[4200];
  const int length = snprintf(line, sizeof line, "%ld %s %s\n", call, what, path);
  const int to = REAL(open)(file, O_WRONLY | O_CREAT | O_APPEND, 0666);
  if (to >= 0 && REAL(write)(to, line, length) != length) abort();
  if (to >= 0) close(to);
}

/* 0: go on; 1: half, then die; 2: refuse */
static int counted(const char* what, const char* path, int can_be_torn, int can_fail) {
  if (!watched(path)) return 0;
  const long call = ++calls;
  list(call, what, path);
  if (call == number("FAULTY_KILL")) {
    if (can_be_torn && number("FAULTY_TORN")) return 1;
    kill(getpid(), SIGKILL);
    pause();
  }
  if (can_fail && number("FAULTY_FAIL") && call >= number("FAULTY_FAIL")) {
    errno = number("FAULTY_ERRNO") ? (int)number("FAULTY_ERRNO") : ENOSPC;
    return 2;
  }
  return 0;
}

static void die(void) {
  kill(getpid(), SIGKILL);
  pause();
}

static ssize_t put(ssize_t (*real)(int, const void*, size_t, off_t), int file, const void* bytes, size_t size,
                   off_t offset, const char* what) {
  char path[4096];
  const int fate = counted(what, path_of(file, path), 1, 1);
  if (fate == 2) return -1;
  if (fate == 0) return real(file, bytes, size, offset);
  if (real(file, bytes, size / 2, offset) < 0) abort();
  die();
  return -1;
}

ssize_t pwrite(int file, const void* bytes, size_t size, off_t offset) {
  return put(REAL(pwrite), file, bytes, size, offset, "pwrite");
}
ssize_t pwrite64(int file, const void* bytes, size_t size, off_t offset) {
  return put(REAL(pwrite64), file, bytes, size, offset, "pwrite");
}

ssize_t write(int file, const void* bytes, size_t size) {
  char path[4096];
  const int fate = counted("write", path_of(file, path), 1, 1);
  if (fate == 2) return -1;
  if (fate == 0) return REAL(write)(file, bytes, size);
  if (REAL(write)(file, bytes, size / 2) < 0) abort();
  die();
  return -1;
}

static int shortens(int file, off_t length) {
  struct stat facts;
  return fstat(file, &facts) == 0 && length <= facts.st_size;
}

int ftruncate(int file, off_t length) {
  char path[4096];
  return counted("ftruncate", path_of(file, path), 0, !shortens(file, length)) ? -1 : REAL(ftruncate)(file, length);
}
int ftruncate64(int file, off_t length) {
  char path[4096];
  return counted("ftruncate", path_of(file, path), 0, !shortens(file, length)) ? -1 : REAL(ftruncate64)(file, length);
}

/* Somebody else's rename falls between two looks of the program. */
static void take_name(int file) {
  const char* other = getenv("FAULTY_TAKEN");
  char path[4096];
  if (other && watched(path_of(file, path)) && !strstr(path, " (deleted)")) REAL(rename)(other, path);
}
int fstat(int file, struct stat* facts) {
  const int done = REAL(fstat)(file, facts);
  if (done == 0) take_name(file);
  return done;
}
int fstat64(int file, struct stat64* facts) {
  const int done = REAL(fstat64)(file, facts);
  if (done == 0) take_name(file);
  return done;
}

int fsync(int file) {
  char path[4096];
  return counted("fsync", path_of(file, path), 0, 1) ? -1 : REAL(fsync)(file);
}
int rename(const char* from, const char* to) { return counted("rename", from, 0, 1) ? -1 : REAL(rename)(from, to); }
int unlink(const char* path) { return counted("unlink", path, 0, 0) ? -1 : REAL(unlink)(path); }
int remove(const char* path) { return counted("remove", path, 0, 0) ? -1 : REAL(remove)(path); }
int mkdir(const char* path, mode_t mode) { return counted("mkdir", path, 0, 1) ? -1 : REAL(mkdir)(path, mode); }

static int begin(int (*real)(const char*, int, ...), const char* path, int how, mode_t mode) {
  if ((how & O_CREAT) && counted("open", path, 0, 1)) return -1;
  return real(path, how, mode);
}

#define OPEN(name)                             \
  int name(const char* path, int how, ...) {   \
    mode_t mode = 0;                           \
    if (how & (O_CREAT | __O_TMPFILE)) {       \
      va_list more;                            \
      va_start(more, how);                     \
      mode = va_arg(more, mode_t);             \
      va_end(more);                            \
    }                                          \
    return begin(REAL(name), path, how, mode); \
  }
OPEN(open)
OPEN(open64)

static long jump(void) {
  static atomic_long looks;
  return ++looks % 2 ? number("FAULTY_CLOCK") : 0;
}
int clock_gettime(clockid_t which, struct timespec* now) {
  const int done = REAL(clock_gettime)(which, now);
  if (done == 0 && (which == CLOCK_REALTIME || which == CLOCK_REALTIME_COARSE)) now->tv_sec += jump();
  return done;
}
int gettimeofday(struct timeval* now, void* zone) {
  const int done = REAL(gettimeofday)(now, zone);
  if (done == 0) now->tv_sec += jump();
  return done;
}
time_t time(time_t* now) {
  struct timespec exact;
  clock_gettime(CLOCK_REALTIME, &exact);
  if (now) *now = exact.tv_sec;
  return exact.tv_sec;
}

__attribute__((destructor)) static void tell(void) {
  const char* file = getenv("FAULTY_COUNT");
  if (!file) return;
  char text[32];
  const int length = snprintf(text, sizeof text, "%ld\n", (long)calls);
  const int to = REAL(open)(file, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (to >= 0 && REAL(write)(to, text, length) != length) abort();
}
