# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DNM=nm -DOBJDUMP=objdump -DOBJECTS=a.o;b.o -P lanes_symbols.cmake
# What is compiled for several instruction sets must share no function: the linker keeps one of a
# name, and a processor might meet instructions that it does not have. Names of our own carry the
# set; no others may be left over, but for names of types (_ZTI, _ZTS), which are data. What runs before main() does so
# on every processor, and has to do without their instructions: a file of a user's law registers its sweeps there.
set(foreign "")
set(early "")
foreach(object IN LISTS OBJECTS)
  execute_process(COMMAND ${NM} ${object}
    COMMAND awk "/ [WVu] / && !/InstructionSet|lanes_(sse4|avx2|avx512)|DW[.]ref[.]|_ZT[IS]/"
    COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE shared)
  string(REGEX MATCHALL "[^\n]+" shared "${shared}")
  list(APPEND foreign ${shared})
  execute_process(COMMAND ${NM} ${object} COMMAND awk "/_GLOBAL__sub_I_/ { print $NF }"
    COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE begins)
  string(REGEX MATCHALL "[^\n]+" begins "${begins}")
  foreach(begin IN LISTS begins)
    execute_process(COMMAND ${OBJDUMP} -d --no-show-raw-insn --disassemble=${begin} ${object}
      OUTPUT_VARIABLE code COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX MATCHALL "\t[^\n]*%([xyz]mm|k[0-7])[^\n]*" wide "${code}")
    if(wide)
      list(APPEND early "${object}: ${wide}")
    endif()
  endforeach()
endforeach()
if(early)
  list(JOIN early "\n" early)
  message(FATAL_ERROR "instructions before main() that a processor may not have:\n${early}")
endif()
if(foreign)
  list(JOIN foreign "\n" foreign)
  message(FATAL_ERROR "functions that another instruction set might call:\n${foreign}")
endif()
list(LENGTH OBJECTS count)
message("${count} objects share nothing")
