# Every header compiles by itself. The build shows it, so that only what has changed is compiled again.
#   spam_headers_alone(<target> <folder>)   a target of all headers below <folder>/spam
function(spam_headers_alone target folder)
  file(GLOB_RECURSE headers RELATIVE ${folder} CONFIGURE_DEPENDS ${folder}/spam/*.hpp)
  foreach(header ${headers})
    set(source ${CMAKE_CURRENT_BINARY_DIR}/${target}/${header}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "#include <${header}>\n")
    list(APPEND sources ${source})
  endforeach()
  add_library(${target} OBJECT ${sources})
  target_compile_options(${target} PRIVATE -O0)
  target_include_directories(${target} PRIVATE ${folder})
  target_link_libraries(${target} PRIVATE spam::spam)
endfunction()

spam_headers_alone(headers_alone ${PROJECT_SOURCE_DIR}/include)
# One that does not must fail.
spam_headers_alone(header_not_alone ${CMAKE_CURRENT_SOURCE_DIR}/style/not_alone)
set_target_properties(header_not_alone PROPERTIES EXCLUDE_FROM_ALL TRUE)
add_test(NAME style.headers_gate COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR}
                                         --target header_not_alone)
set_tests_properties(style.headers_gate PROPERTIES LABELS style
  PASS_REGULAR_EXPRESSION "needs_vector.hpp:[0-9:]+ error: .*vector.* in namespace .*std")
