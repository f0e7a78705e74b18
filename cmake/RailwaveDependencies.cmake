# Finds what Railwave stands on, and gives each a target: Kokkos::kokkos, Eigen3::Eigen, railwave::hdf5, railwave::zlib
# (empty where it is not there), railwave::ranks (MPI and METIS, likewise), railwave::toml, railwave::json, railwave::cli,
# railwave::fmt, railwave::spdlog, railwave::spectra, Catch2::Catch2 (tests).

# What scripts/setup has put there.
list(APPEND CMAKE_PREFIX_PATH "${CMAKE_SOURCE_DIR}/.deps/kokkos" "${CMAKE_SOURCE_DIR}/.deps/catch2/usr")

find_package(Kokkos 3.4 CONFIG QUIET)
if(NOT Kokkos_FOUND)
  message(FATAL_ERROR "Kokkos 3.4 or later was not found. Run scripts/setup, which builds it into .deps/, "
    "or name an installed one with -DKokkos_ROOT=FOLDER.")
endif()
message(STATUS "Kokkos ${Kokkos_VERSION}, ${Kokkos_DEVICES}: ${Kokkos_DIR}")
if(NOT Kokkos_ENABLE_OPENMP)
  message(FATAL_ERROR "The Kokkos in ${Kokkos_DIR} was built without OpenMP (Kokkos_ENABLE_OPENMP).")
endif()

# Whether kernels run on a GPU: its compilers want the memory for one source each, and device code is linked program by
# program.
set(RAILWAVE_DEVICE OFF)
if(Kokkos_ENABLE_CUDA OR Kokkos_ENABLE_HIP)
  set(RAILWAVE_DEVICE ON)
endif()

find_package(Eigen3 3.4 REQUIRED NO_MODULE)

find_package(Threads REQUIRED)

find_package(HDF5 REQUIRED COMPONENTS C)
add_library(railwave_hdf5 INTERFACE)
target_include_directories(railwave_hdf5 SYSTEM INTERFACE ${HDF5_C_INCLUDE_DIRS})
target_link_libraries(railwave_hdf5 INTERFACE ${HDF5_C_LIBRARIES})
add_library(railwave::hdf5 ALIAS railwave_hdf5)

# Reports compress their data by it, and results on several threads. Where HDF5's headers are it usually is too.
find_package(ZLIB QUIET)
add_library(railwave_zlib INTERFACE)
if(ZLIB_FOUND)
  target_link_libraries(railwave_zlib INTERFACE ZLIB::ZLIB)
  target_compile_definitions(railwave_zlib INTERFACE RAILWAVE_ZLIB)
else()
  message(STATUS "zlib was not found: 'railwave report' is left out, and results are compressed on one thread. Debian has it as zlib1g-dev.")
endif()
add_library(railwave::zlib ALIAS railwave_zlib)

# Runs over several processes, where both are there.
add_library(railwave_ranks INTERFACE)
if(RAILWAVE_MPI)
  find_package(MPI QUIET COMPONENTS C)
  find_path(METIS_INCLUDE_DIR metis.h)
  find_library(METIS_LIBRARY metis)
  mark_as_advanced(METIS_INCLUDE_DIR METIS_LIBRARY)
  if(MPI_C_FOUND AND METIS_INCLUDE_DIR AND METIS_LIBRARY)
    target_compile_definitions(railwave_ranks INTERFACE RAILWAVE_MPI OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
    target_include_directories(railwave_ranks SYSTEM INTERFACE ${METIS_INCLUDE_DIR})
    target_link_libraries(railwave_ranks INTERFACE MPI::MPI_C ${METIS_LIBRARY})
    message(STATUS "MPI ${MPI_C_VERSION} and METIS: runs may go over several processes")
    # Between GPUs of NVIDIA rows go by NCCL where it is there.
    if(Kokkos_ENABLE_CUDA)
      find_package(CUDAToolkit QUIET)
      find_path(NCCL_INCLUDE_DIR nccl.h HINTS ${CUDAToolkit_INCLUDE_DIRS})
      find_library(NCCL_LIBRARY nccl HINTS ${CUDAToolkit_LIBRARY_DIR})
      mark_as_advanced(NCCL_INCLUDE_DIR NCCL_LIBRARY)
      if(NCCL_INCLUDE_DIR AND NCCL_LIBRARY)
        target_compile_definitions(railwave_ranks INTERFACE RAILWAVE_NCCL)
        target_include_directories(railwave_ranks SYSTEM INTERFACE ${NCCL_INCLUDE_DIR})
        target_link_libraries(railwave_ranks INTERFACE ${NCCL_LIBRARY})
        message(STATUS "NCCL: ranks' rows go from GPU to GPU")
      endif()
    endif()
  else()
    message(STATUS "MPI or METIS was not found: a run is one process. scripts/setup --mpi installs both.")
  endif()
endif()
add_library(railwave::ranks ALIAS railwave_ranks)

include(RailwaveHeaderLibraries)

if(RAILWAVE_TESTS)
  find_package(Catch2 3 CONFIG QUIET)
  if(NOT Catch2_FOUND)
    # A machine that only runs cases need not have it: scripts/run sets up without the tests' needs.
    message(STATUS "Catch2 3 was not found: the tests are left out. scripts/setup --tests puts it into .deps/.")
    set(RAILWAVE_TESTS OFF)
  endif()
endif()
