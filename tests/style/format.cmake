# SPDX-License-Identifier: GPL-3.0-or-later
# clang-format has nothing to change. Its versions differ: 14 is the one that decides.
file(GLOB_RECURSE sources ${SOURCE}/include/*.hpp ${SOURCE}/src/*.hpp ${SOURCE}/src/*.cpp
     ${SOURCE}/problems/*.hpp
     ${SOURCE}/problems/*.cpp ${SOURCE}/tests/*.hpp ${SOURCE}/tests/*.cpp)
execute_process(COMMAND ${CLANG_FORMAT} --dry-run -Werror --ferror-limit=1 ${sources}
                RESULT_VARIABLE result ERROR_VARIABLE message)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "run ${CLANG_FORMAT} -i on these:\n${message}")
endif()
