# Every header compiles by itself. The build shows it, so that only what has changed is compiled again.
# Those that read Eigen, themselves or by another, get it precompiled: that is most of what they take.
#   spam_reads_eigen(<result> <folder> <header>)   whether a header does
function(spam_reads_eigen result folder header)
  get_property(known GLOBAL PROPERTY spam_eigen_${header})
  if("${known}" STREQUAL "")
    set(known OFF)
    file(STRINGS ${folder}/${header} others REGEX "^#include <(Eigen|spam)/")
    foreach(other ${others})
      string(REGEX REPLACE "^#include <(.*)>.*" "\\1" other ${other})
      if(other MATCHES "^Eigen/")
        set(known ON)
      elseif(NOT known)
        spam_reads_eigen(known ${folder} ${other})
      endif()
    endforeach()
    set_property(GLOBAL PROPERTY spam_eigen_${header} ${known})
  endif()
  set(${result} ${known} PARENT_SCOPE)
endfunction()

#   spam_headers_alone(<target> <folder>)   a target of all headers below <folder>/spam
function(spam_headers_alone target folder)
  file(GLOB_RECURSE headers RELATIVE ${folder} CONFIGURE_DEPENDS ${folder}/spam/*.hpp)
  foreach(header ${headers})
    set(source ${CMAKE_CURRENT_BINARY_DIR}/${target}/${header}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "#include <${header}>\n")
    spam_reads_eigen(eigen ${folder} ${header})
    if(NOT eigen)
      set_source_files_properties(${source} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
    endif()
    list(APPEND sources ${source})
  endforeach()
  add_library(${target} OBJECT ${sources})
  target_compile_options(${target} PRIVATE -O0)
  target_include_directories(${target} PRIVATE ${folder})
  target_link_libraries(${target} PRIVATE spam::spam)
  target_precompile_headers(${target} PRIVATE <Eigen/Core>)
endfunction()

spam_headers_alone(headers_alone ${PROJECT_SOURCE_DIR}/include)
# One that does not must fail.
spam_headers_alone(header_not_alone ${CMAKE_CURRENT_SOURCE_DIR}/style/not_alone)
set_target_properties(header_not_alone PROPERTIES EXCLUDE_FROM_ALL TRUE)
add_test(NAME style.headers_gate COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR}
                                         --target header_not_alone)
set_tests_properties(style.headers_gate PROPERTIES LABELS style
  PASS_REGULAR_EXPRESSION "needs_vector.hpp:[0-9:]+ error: .*vector.* in namespace .*std")
