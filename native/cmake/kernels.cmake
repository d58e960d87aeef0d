# Kernels: inner loops on vectors, compiled once for each instruction set and chosen at run time
# (src/mpm/base/instruction_set.h); the results are the same to the bit.
include(CheckCXXCompilerFlag)

# mpm_kernel(FILE AVX2 FLAG... [AVX512 FLAG...]) compiles src/mpm/FILE for the baseline and for each instruction set with
# the flags given, and appends to MPM_KERNEL_SOURCES and MPM_KERNEL_OBJECTS.
#
# The file defines what it has to offer in the namespace mpm::MPM_ISA, which is another one each time, and all else
# unnamed: the linker would keep one copy of what has the same name, perhaps one that the processor cannot run. For the
# same reason kernels see headers of plain structures only, and never a precompiled one.
#
# What a compiler does not know the flags of, it compiles like the baseline; no processor then asks for it.
function(mpm_kernel file)
  cmake_parse_arguments(PARSE_ARGV 1 MPM "" "" "AVX2;AVX512")
  # Vectors are passed between functions of one file only: how other compilers would pass them does not matter.
  set(MPM_BASELINE -Wno-psabi)
  cmake_path(GET file STEM kernel)
  foreach(instruction_set BASELINE AVX2 AVX512)
    if(NOT MPM_${instruction_set})
      continue()
    endif()
    list(JOIN MPM_${instruction_set} " " flags)
    check_cxx_compiler_flag("${flags}" MPM_HAVE_${kernel}_${instruction_set})
    string(TOLOWER ${instruction_set} namespace)
    set(target mpm_${kernel}_${namespace})
    add_library(${target} OBJECT src/mpm/${file})
    target_include_directories(${target} PRIVATE src)
    target_compile_definitions(${target} PRIVATE MPM_ISA=${namespace})
    if(MPM_HAVE_${kernel}_${instruction_set})
      target_compile_options(${target} PRIVATE ${MPM_${instruction_set}})
    else()
      target_compile_options(${target} PRIVATE ${MPM_BASELINE})
    endif()
    list(APPEND MPM_KERNEL_OBJECTS $<TARGET_OBJECTS:${target}>)
  endforeach()
  list(APPEND MPM_KERNEL_SOURCES ${CMAKE_CURRENT_SOURCE_DIR}/src/mpm/${file})
  set(MPM_KERNEL_OBJECTS ${MPM_KERNEL_OBJECTS} PARENT_SCOPE)
  set(MPM_KERNEL_SOURCES ${MPM_KERNEL_SOURCES} PARENT_SCOPE)
endfunction()
