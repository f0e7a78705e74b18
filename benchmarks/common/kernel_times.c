/* Times of kernels by name, for any Kokkos program: loaded by KOKKOS_TOOLS_LIBS, see scripts/kernel_times. Kokkos waits
   for a kernel's end before it calls, so that on a GPU a time holds the launch too. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { most_kernels = 512 };
static struct {
  char* name;
  long calls;
  double seconds;
} kernels[most_kernels];
static int count = 0;
static double began = 0;

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void begin(const char* name, uint64_t* kernel) {
  int k = 0;
  while (k < count && strcmp(kernels[k].name, name) != 0) ++k;
  if (k == count && count < most_kernels) kernels[count++].name = strdup(name);
  *kernel = (uint64_t)k;
  began = now();
}

static void end(uint64_t kernel) {
  if (kernel >= (uint64_t)count) return;
  kernels[kernel].seconds += now() - began;
  ++kernels[kernel].calls;
}

void kokkosp_begin_parallel_for(const char* name, uint32_t device, uint64_t* kernel) {
  (void)device, begin(name, kernel);
}
void kokkosp_end_parallel_for(uint64_t kernel) { end(kernel); }
void kokkosp_begin_parallel_reduce(const char* name, uint32_t device, uint64_t* kernel) {
  (void)device, begin(name, kernel);
}
void kokkosp_end_parallel_reduce(uint64_t kernel) { end(kernel); }
void kokkosp_begin_parallel_scan(const char* name, uint32_t device, uint64_t* kernel) {
  (void)device, begin(name, kernel);
}
void kokkosp_end_parallel_scan(uint64_t kernel) { end(kernel); }

void kokkosp_finalize_library(void) {
  const char* path = getenv("RAILWAVE_KERNEL_TIMES");
  FILE* file = path ? fopen(path, "w") : NULL;
  if (!file) return;
  for (int k = 0; k < count; ++k) fprintf(file, "%.9f,%ld,%s\n", kernels[k].seconds, kernels[k].calls, kernels[k].name);
  fclose(file);
}
