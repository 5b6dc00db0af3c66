# Every header compiles by itself. The build shows it, so that only what has changed is compiled again.
#   spam_headers_alone(<target> <folder>)   a target of all headers below <folder>/spam
# What most of ours include of libraries is read once. That changes nothing for a header that includes all of it
# itself, or through others of ours, and only for such headers it is done.
set(read_once Eigen/Core cmath span string vector)

# All that a header includes, itself or through others of ours.
function(spam_includes folder header result)
  set(all)
  set(some ${header})
  while(some)
    list(POP_FRONT some one)
    get_property(names GLOBAL PROPERTY spam_includes_${folder}/${one})
    if(NOT names)
      file(STRINGS ${folder}/${one} names REGEX "^#include <")
      list(TRANSFORM names REPLACE "^#include <(.*)>.*" "\\1")
      set_property(GLOBAL PROPERTY spam_includes_${folder}/${one} ${names})
    endif()
    foreach(name ${names})
      if(NOT name IN_LIST all AND EXISTS ${folder}/${name})
        list(APPEND some ${name})
      endif()
    endforeach()
    list(APPEND all ${names})
    list(REMOVE_DUPLICATES all)
  endwhile()
  set(${result} ${all} PARENT_SCOPE)
endfunction()

function(spam_headers_alone target folder)
  file(GLOB_RECURSE headers RELATIVE ${folder} CONFIGURE_DEPENDS ${folder}/spam/*.hpp)
  foreach(header ${headers})
    set(source ${CMAKE_CURRENT_BINARY_DIR}/${target}/${header}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "#include <${header}>\n")
    spam_includes(${folder} ${header} included)
    set(others ${read_once})
    list(REMOVE_ITEM others ${included})
    if(others)
      set_source_files_properties(${source} PROPERTIES SKIP_PRECOMPILE_HEADERS TRUE)
    endif()
    list(APPEND sources ${source})
  endforeach()
  add_library(${target} OBJECT ${sources})
  list(TRANSFORM read_once REPLACE "(.+)" "<\\1>" OUTPUT_VARIABLE precompiled)
  target_precompile_headers(${target} PRIVATE ${precompiled})
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
