# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DNM=nm -DOBJECTS=a.o;b.o -P lanes_symbols.cmake
# What is compiled for several instruction sets must share no function: the linker keeps one of a
# name, and a processor might meet instructions that it does not have. Names of our own carry the
# set; nobody else's may be left over.
set(foreign "")
foreach(object IN LISTS OBJECTS)
  execute_process(COMMAND ${NM} -C ${object} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]* [WVu] [^\n]*" shared "${symbols}")
  list(FILTER shared EXCLUDE REGEX "InstructionSet|lanes_(sse4|avx2|avx512)|DW[.]ref[.]")
  list(APPEND foreign ${shared})
endforeach()
if(foreign)
  list(JOIN foreign "\n" foreign)
  message(FATAL_ERROR "functions that another instruction set might call:\n${foreign}")
endif()
list(LENGTH OBJECTS count)
message("${count} objects share nothing")
