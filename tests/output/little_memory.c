/* Stands between a program and the system (LD_PRELOAD) and gives it only so much memory, byte for byte, whatever the
 * processor, the threads and the C library make of a limit of address space. What is taken by malloc and by mmap
 * counts. LITTLE_MEMORY=BYTES   so much in all LITTLE_MEMORY_AT=N    at the N-th time that anything but HDF5 asks, all
 * is taken but LITTLE_MEMORY_LEFT bytes (none by default) LITTLE_MEMORY_TELL=FILE  written there at the end: how often
 * anything but HDF5 asked, the most that was taken, and the most that HDF5 took on top of what it had when its thread
 * looked last whether memory is free (a mapping of 8 MiB or more) */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <link.h>
#include <malloc.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);
extern void* __libc_memalign(size_t, size_t);
extern void __libc_free(void*);

static atomic_long taken, most, asked, most_of_hdf5, limit;
static long fail_at, left;
static __thread long in_hdf5, most_in_hdf5;
static struct { atomic_uintptr_t begin, end; } libraries[4]; /* HDF5 and what compresses for it */

static int of_hdf5(struct dl_phdr_info* info, size_t size, void* count) {
  (void)size;
  int* next = count;
  if (*next == 4 || !(strstr(info->dlpi_name, "libhdf5") || strstr(info->dlpi_name, "libz.so") ||
                      strstr(info->dlpi_name, "libsz.so")))
    return 0;
  for (int i = 0; i < info->dlpi_phnum; ++i)
    if (info->dlpi_phdr[i].p_type == PT_LOAD && (info->dlpi_phdr[i].p_flags & PF_X)) {
      libraries[*next].begin = info->dlpi_addr + info->dlpi_phdr[i].p_vaddr;
      libraries[*next].end = libraries[*next].begin + info->dlpi_phdr[i].p_memsz;
      ++*next;
    }
  return 0;
}

static long number(const char* name) {
  const char* text = getenv(name);
  return text ? atol(text) : 0;
}

__attribute__((constructor)) static void begin(void) {
  int count = 0;
  dl_iterate_phdr(of_hdf5, &count);
  limit = number("LITTLE_MEMORY");
  fail_at = number("LITTLE_MEMORY_AT");
  left = number("LITTLE_MEMORY_LEFT");
}

static int is_hdf5(const void* caller) {
  const uintptr_t place = (uintptr_t)caller;
  for (int i = 0; i < 4; ++i)
    if (place >= libraries[i].begin && place < libraries[i].end) return 1;
  return 0;
}

static void raise_to(atomic_long* largest, long value) {
  long before = *largest;
  while (value > before && !atomic_compare_exchange_weak(largest, &before, value)) {
  }
}

static int refused(size_t size, int hdf5) {
  if (!hdf5 && ++asked == fail_at) limit = taken + left;
  if (limit && (size > (size_t)limit || taken + (long)size > limit)) {
    errno = ENOMEM;
    return 1;
  }
  return 0;
}

static void count(long size, int hdf5) {
  raise_to(&most, taken += size);
  if (!hdf5) return;
  in_hdf5 += size;
  if (in_hdf5 > most_in_hdf5) raise_to(&most_of_hdf5, most_in_hdf5 = in_hdf5);
}

static void* given(void* place, int hdf5) {
  if (place) count((long)malloc_usable_size(place), hdf5);
  return place;
}

void* malloc(size_t size) {
  const int hdf5 = is_hdf5(__builtin_return_address(0));
  return refused(size, hdf5) ? NULL : given(__libc_malloc(size), hdf5);
}

void* calloc(size_t number, size_t size) {
  const int hdf5 = is_hdf5(__builtin_return_address(0));
  return refused(number * size, hdf5) ? NULL : given(__libc_calloc(number, size), hdf5);
}

void* realloc(void* old, size_t size) {
  const int hdf5 = is_hdf5(__builtin_return_address(0));
  const long before = old ? (long)malloc_usable_size(old) : 0;
  if (refused(size, hdf5)) return NULL;
  void* place = __libc_realloc(old, size);
  if (place || size == 0) count(-before, hdf5);
  return given(place, hdf5);
}

void free(void* place) {
  if (place) count(-(long)malloc_usable_size(place), is_hdf5(__builtin_return_address(0)));
  __libc_free(place);
}

static void* aligned(size_t alignment, size_t size, int hdf5) {
  return refused(size, hdf5) ? NULL : given(__libc_memalign(alignment, size), hdf5);
}
void* memalign(size_t alignment, size_t size) { return aligned(alignment, size, is_hdf5(__builtin_return_address(0))); }
void* aligned_alloc(size_t alignment, size_t size) {
  return aligned(alignment, size, is_hdf5(__builtin_return_address(0)));
}
int posix_memalign(void** place, size_t alignment, size_t size) {
  void* found = aligned(alignment, size, is_hdf5(__builtin_return_address(0)));
  if (!found) return ENOMEM;
  *place = found;
  return 0;
}

static struct {
  atomic_uintptr_t place;
  size_t size;
} mapped[64];

void* mmap(void* where, size_t size, int protection, int flags, int file, off_t offset) {
  const int counts = (flags & MAP_ANONYMOUS) != 0;
  if (counts && refused(size, 0)) return MAP_FAILED;
  void* place = (void*)syscall(SYS_mmap, where, size, protection, flags, file, offset);
  if (!counts || place == MAP_FAILED) return place;
  if (size >= 8 << 20) in_hdf5 = most_in_hdf5 = 0; /* its thread looks */
  count((long)size, 0);
  for (int i = 0; i < 64; ++i) {
    uintptr_t none = 0;
    if (!atomic_compare_exchange_strong(&mapped[i].place, &none, (uintptr_t)place)) continue;
    mapped[i].size = size;
    break;
  }
  return place;
}
void* mmap64(void* where, size_t size, int protection, int flags, int file, off_t offset) {
  return mmap(where, size, protection, flags, file, offset);
}

int munmap(void* place, size_t size) {
  for (int i = 0; i < 64; ++i) {
    uintptr_t there = (uintptr_t)place;
    const size_t its_size = mapped[i].size;
    if (atomic_compare_exchange_strong(&mapped[i].place, &there, 0)) count(-(long)its_size, 0);
  }
  return (int)syscall(SYS_munmap, place, size);
}

__attribute__((destructor)) static void tell(void) {
  const char* file = getenv("LITTLE_MEMORY_TELL");
  if (!file) return;
  char text[100];
  const int length = snprintf(text, sizeof text, "%ld %ld %ld\n", (long)asked, (long)most, (long)most_of_hdf5);
  /* A process that did not use HDF5 does not write over what its child reported, which did. */
  const int to = open(file, O_WRONLY | O_CREAT | (most_of_hdf5 > 0 ? O_TRUNC : O_EXCL), 0666);
  if (to >= 0 && write(to, text, (size_t)length) != length) abort();
}
