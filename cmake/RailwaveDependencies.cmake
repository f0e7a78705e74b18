# Finds what Railwave stands on, and gives each a target: Kokkos::kokkos, Eigen3::Eigen, railwave::hdf5,
# railwave::toml, railwave::cli, railwave::fmt, railwave::spdlog, railwave::spectra, Catch2::Catch2 (tests).

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

find_package(Eigen3 3.4 REQUIRED NO_MODULE)

find_package(Threads REQUIRED)

find_package(HDF5 REQUIRED COMPONENTS C)
add_library(railwave_hdf5 INTERFACE)
target_include_directories(railwave_hdf5 SYSTEM INTERFACE ${HDF5_C_INCLUDE_DIRS})
target_link_libraries(railwave_hdf5 INTERFACE ${HDF5_C_LIBRARIES})
add_library(railwave::hdf5 ALIAS railwave_hdf5)

# Header-only libraries: a folder of unpacked packages comes first when the user names one.
function(railwave_header_library name header hint)
  if(RAILWAVE_HEADERS)
    find_path(RAILWAVE_${name}_INCLUDE ${header} PATHS "${RAILWAVE_HEADERS}/usr/include" NO_DEFAULT_PATH)
  else()
    find_path(RAILWAVE_${name}_INCLUDE ${header})
  endif()
  mark_as_advanced(RAILWAVE_${name}_INCLUDE)
  if(NOT RAILWAVE_${name}_INCLUDE)
    message(FATAL_ERROR "${header} was not found. Install ${hint}, or name a folder that has it under "
      "usr/include with -DRAILWAVE_HEADERS=FOLDER.")
  endif()
  add_library(railwave_${name} INTERFACE)
  target_include_directories(railwave_${name} SYSTEM INTERFACE ${RAILWAVE_${name}_INCLUDE})
  add_library(railwave::${name} ALIAS railwave_${name})
endfunction()

railwave_header_library(toml toml++/toml.h libtomlplusplus-dev)
railwave_header_library(cli CLI/CLI.hpp libcli11-dev)
railwave_header_library(fmt fmt/format.h libfmt-dev)
railwave_header_library(spdlog spdlog/spdlog.h libspdlog-dev)
railwave_header_library(spectra Spectra/SymEigsShiftSolver.h libspectra-dev)
target_link_libraries(railwave_spdlog INTERFACE railwave_fmt)
target_compile_definitions(railwave_spdlog INTERFACE SPDLOG_FMT_EXTERNAL)

# Compiled libraries of fmt and spdlog where they are installed, which spares compile time.
if(NOT RAILWAVE_HEADERS)
  find_package(fmt CONFIG QUIET)
  find_package(spdlog CONFIG QUIET)
endif()
if(TARGET fmt::fmt)
  target_link_libraries(railwave_fmt INTERFACE fmt::fmt)
else()
  target_compile_definitions(railwave_fmt INTERFACE FMT_HEADER_ONLY)
endif()
if(TARGET spdlog::spdlog AND TARGET fmt::fmt)
  target_link_libraries(railwave_spdlog INTERFACE spdlog::spdlog)
endif()

if(RAILWAVE_TESTS)
  find_package(Catch2 3 CONFIG QUIET)
  if(NOT Catch2_FOUND)
    # A machine that only runs cases need not have it: scripts/run sets up without the tests' needs.
    message(STATUS "Catch2 3 was not found: the tests are left out. scripts/setup --tests puts it into .deps/.")
    set(RAILWAVE_TESTS OFF)
  endif()
endif()
