# railwave_options: what every target of ours is compiled with. railwave_library(): one folder, one library.

add_library(railwave_options INTERFACE)
target_compile_features(railwave_options INTERFACE cxx_std_17)
target_include_directories(railwave_options INTERFACE "${CMAKE_SOURCE_DIR}" "${CMAKE_SOURCE_DIR}/src")
target_compile_options(railwave_options INTERFACE -Wall -Wextra -Wshadow)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13
    AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14)
  # New in g++ 13 and mistaken there about functions that take a temporary and return a reference to something else.
  target_compile_options(railwave_options INTERFACE -Wno-dangling-reference)
endif()
if(RAILWAVE_NATIVE)
  target_compile_options(railwave_options INTERFACE -march=native)
endif()
if(RAILWAVE_SOURCE_PLACES)
  set(RAILWAVE_SOURCE_REPORT "${CMAKE_SOURCE_DIR}/build/report/report.html")  # made by scripts/setup --report
  set(RAILWAVE_SOURCE_PICTURE "${CMAKE_SOURCE_DIR}/scripts/picture")
else()
  target_compile_options(railwave_options INTERFACE "-ffile-prefix-map=${CMAKE_SOURCE_DIR}/=")
endif()
if(RAILWAVE_SANITIZE STREQUAL "thread")
  target_compile_options(railwave_options INTERFACE -fsanitize=thread -fno-omit-frame-pointer)
  target_link_options(railwave_options INTERFACE -fsanitize=thread)
elseif(RAILWAVE_SANITIZE)
  target_compile_options(railwave_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined
    -fno-omit-frame-pointer)
  target_link_options(railwave_options INTERFACE -fsanitize=address,undefined)
endif()

if(RAILWAVE_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "libFuzzer belongs to clang: configure with -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++.")
  endif()
  if(RAILWAVE_FUZZ STREQUAL "coverage")  # what of the code a corpus reaches: nothing is searched, nothing checked
    target_compile_options(railwave_options INTERFACE -fprofile-instr-generate -fcoverage-mapping -Wno-unknown-warning-option)
    target_link_options(railwave_options INTERFACE -fprofile-instr-generate)
  else()
    target_compile_options(railwave_options INTERFACE -fsanitize=fuzzer-no-link,address,undefined
      -fno-sanitize-recover=undefined -fno-omit-frame-pointer -Wno-unknown-warning-option)
    target_link_options(railwave_options INTERFACE -fsanitize=address,undefined)
  endif()
endif()

# Kokkos with our options. Up to 4.7.0 it does not know two calls of CUDA 13, which a header then supplies.
add_library(railwave_kokkos INTERFACE)
target_link_libraries(railwave_kokkos INTERFACE Kokkos::kokkos)
# Eigen works on the host only; without its device side nvcc has much less to warn of.
if(Kokkos_ENABLE_CUDA)
  target_compile_definitions(railwave_kokkos INTERFACE EIGEN_NO_CUDA)
elseif(Kokkos_ENABLE_HIP)
  target_compile_definitions(railwave_kokkos INTERFACE EIGEN_NO_HIP)
endif()
if(Kokkos_ENABLE_CUDA AND Kokkos_VERSION VERSION_LESS_EQUAL 4.7.0)
  target_compile_options(railwave_kokkos INTERFACE
    "SHELL:-include ${CMAKE_SOURCE_DIR}/cmake/cuda13_overloads.hpp")
endif()

# railwave_unity(TARGET): several sources of a target are compiled together, which halves the time of a fresh build.
# Compilers of GPUs want the memory for themselves, and keep one source each.
option(RAILWAVE_UNITY "Compile several sources of a folder together" ON)
function(railwave_unity target)
  if(RAILWAVE_UNITY AND NOT RAILWAVE_DEVICE)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
  endif()
endfunction()

# railwave_library(NAME LINK...): library railwave_NAME of all sources in the folder NAME and in its subfolders. A folder
# that has headers only, or nothing yet, is an interface library.
function(railwave_library name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp")
  if(sources)
    add_library(railwave_${name} STATIC ${sources})
    target_link_libraries(railwave_${name} PUBLIC railwave_options ${ARGN})
    railwave_unity(railwave_${name})
  else()
    add_library(railwave_${name} INTERFACE)
    target_link_libraries(railwave_${name} INTERFACE railwave_options ${ARGN})
  endif()
endfunction()
