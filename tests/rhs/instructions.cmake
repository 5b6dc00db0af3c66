# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DVALGRIND=... -DPROGRAM=... -DDIMENSIONS=2|3 -DSCHEME=one_sweep|two_sweeps|fluid|total_lagrangian
#       -DMOST=65 -P instructions.cmake
# Instructions of a right-hand side per undirected pair within the range, counted by callgrind for
# x86-64-v3: everything between two calls, packing and the stress law included.
set(ENV{SPAM_ISA} v3)
set(few 1)
set(many 101)
foreach(calls few many)
  execute_process(
    COMMAND ${VALGRIND} --tool=callgrind --callgrind-out-file=/dev/null
            ${PROGRAM} ${DIMENSIONS} ${SCHEME} ${${calls}}
    OUTPUT_VARIABLE pairs ERROR_VARIABLE said RESULT_VARIABLE failed)
  if(failed OR NOT said MATCHES "Collected : ([0-9]+)")
    message(FATAL_ERROR "valgrind failed (${failed}): ${said}")
  endif()
  set(instructions_${calls} ${CMAKE_MATCH_1})
endforeach()
string(STRIP "${pairs}" pairs)
math(EXPR hundredths "(${instructions_many} - ${instructions_few}) / ${pairs}")
math(EXPR most "100 * ${MOST}")
math(EXPR whole "${hundredths} / 100")
math(EXPR rest "${hundredths} % 100 + 100")
string(SUBSTRING "${rest}" 1 2 rest)
message("${SCHEME} in ${DIMENSIONS} dimensions: ${whole}.${rest} instructions per pair, at most ${MOST} allowed, ${pairs} pairs")
if(hundredths GREATER most)
  message(FATAL_ERROR "too many instructions")
endif()
