# SPDX-License-Identifier: GPL-3.0-or-later
# Tests of the Python package, one line in ctest per file. Where Python, numpy or what a test needs is absent
# it is skipped and says so; tests of the compiled part need -DSPAM_BUILD_PYTHON=ON.
if(EXISTS /usr/bin/python3)
  set(spam_test_python /usr/bin/python3)
else()
  find_program(spam_test_python python3)
endif()
if(SPAM_BUILD_PYTHON)
  set(python_path ${PROJECT_BINARY_DIR}/python)
else()
  set(python_path ${PROJECT_SOURCE_DIR}/src/python)
endif()
# An extension that is compiled with sanitizers finds them in an interpreter that is not only where they are loaded
# first. Python's own memory is never given back: leaks of ours are looked for in the programs.
if(SPAM_BUILD_PYTHON AND SPAM_SANITIZE MATCHES "address")
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=libclang_rt.asan-${CMAKE_SYSTEM_PROCESSOR}.so
                  OUTPUT_VARIABLE sanitizer_runtime OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  set(python_sanitizers LD_PRELOAD=${sanitizer_runtime} ASAN_OPTIONS=detect_leaks=0
                        UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1)
endif()
file(GLOB python_tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/test_*.py)
foreach(file IN LISTS python_tests)
  get_filename_component(name ${file} NAME_WE)
  string(REPLACE "test_" "python." name ${name})
  if(NOT spam_test_python)
    add_test(NAME ${name} COMMAND ${CMAKE_COMMAND} -E echo "skipped: there is no python3")
    set_tests_properties(${name} PROPERTIES SKIP_REGULAR_EXPRESSION "skipped: there is no python3")
    continue()
  endif()
  add_test(NAME ${name} COMMAND ${spam_test_python} ${CMAKE_CURRENT_LIST_DIR}/run.py ${file})
  set(environment PYTHONPATH=${python_path} PYTHONDONTWRITEBYTECODE=1
                  SPAM_PROBLEMS=${PROJECT_BINARY_DIR}/problems SPAM_SOURCE=${PROJECT_SOURCE_DIR}
                  ${python_sanitizers})
  set_tests_properties(${name} PROPERTIES LABELS problem TIMEOUT ${timeout} SKIP_RETURN_CODE 77
                       ENVIRONMENT "${environment}")
endforeach()
