# SPDX-License-Identifier: GPL-3.0-or-later
# spam_add_sweeps(<target> <file.lanes.cpp>...): compiles laws of pairs, like those of the library, once for
# every instruction set in SPAM_LEVELS (SPAM_LEVEL says which) and adds the objects to the target.
# No -ffast-math: sums keep their order.
function(spam_add_sweeps target)
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ REGEX "^[^/]")
  foreach(level IN LISTS SPAM_LEVELS)
    set(objects ${target}_${level})
    add_library(${objects} OBJECT ${ARGN})
    target_compile_features(${objects} PRIVATE cxx_std_20)
    target_compile_definitions(${objects} PRIVATE SPAM_LEVEL=${level})
    if(target MATCHES "^spam_(runs|more)$")
      target_link_libraries(${objects} PRIVATE Eigen3::Eigen fmt::fmt SUNDIALS::nvecserial)
    else()
      target_link_libraries(${objects} PRIVATE spam::spam)
    endif()
    if(TARGET spam_flags)
      target_link_libraries(${objects} PRIVATE spam_flags)
    endif()
    # Scheduling before registers are given out, with an eye on how many there are, spares a twelfth of
    # the instructions of a pair.
    # Clang contracts products and sums otherwise in copies of one loop, and the bits of a run would depend on its
    # ranks: there they stay apart.
    target_compile_options(${objects} PRIVATE -fno-math-errno
      -ffp-contract=$<IF:$<CXX_COMPILER_ID:Clang,AppleClang>,off,fast>
      "$<$<CXX_COMPILER_ID:GNU>:-fschedule-insns;-fsched-pressure;-fno-gcse>")
    # What is compiled for the sanitizers (-O1) spends most of its time here.
    target_compile_options(${objects} PRIVATE $<$<CONFIG:Debug>:-O2>
      "$<$<AND:$<CONFIG:Debug>,$<CXX_COMPILER_ID:Clang>>:SHELL:-mllvm -inline-threshold=4000>")
    if(NOT level STREQUAL generic)
      target_compile_options(${objects} PRIVATE -march=x86-64-${level})
    endif()
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${objects}>)
  endforeach()
endfunction()
