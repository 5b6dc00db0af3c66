# SPDX-License-Identifier: GPL-3.0-or-later
# The tests, room by room.
spam_test(rhs/oracle unit)
spam_test(rhs/conservation property)
spam_test(rhs/covariance property)
spam_test(physics/pair_force property)
spam_test(physics/passes unit)
spam_test(physics/lagrangian_passes unit)
spam_test(physics/scheme unit)
spam_test(physics/closest_approach property)
spam_test(physics/density_potentials property)
spam_test(physics/lattice_strength property)
spam_test(kernel/weight_functions property GSL::gsl GSL::gslcblas)
spam_test(material/elastic_solid property)
spam_test(material/batch_law unit)
spam_test(material/returns property)
spam_test(material/yielding property)
spam_test(material/flowing_solid property)
spam_test(material/equations_of_state property)
spam_test(material/transport_coefficients property)
spam_test(core/state unit)
spam_test(core/unit_names unit)
spam_test(core/exact_sum unit)
spam_test(core/nvector_operations unit)
spam_test(neighbors/cluster_list property)
spam_test(neighbors/old_lists property)
spam_test(neighbors/sweep unit)
spam_test(neighbors/ordering unit)
spam_test(rhs/images property)
spam_test(rhs/walls property)
spam_test(rhs/wall_heat property)
spam_test(rhs/wall_accounts property)
spam_test(rhs/wall_conduction property)
spam_test(rhs/rigid_walls property)
spam_test(rhs/pair_friction property)
spam_test(rhs/shifting property)
spam_test(rhs/purity property)
spam_test(rhs/list_order property)
spam_test(rhs/pair_potential property)
spam_test(rhs/contact property)
spam_test(rhs/fluid_model property)
spam_test(rhs/fluid_transport property)
spam_test(rhs/own_work property)
spam_test(rhs/resolution property)
spam_test(rhs/variable_range property)
spam_test(rhs/density_potential_model property)
spam_test(rhs/externals property)
spam_test(rhs/accounts property)
spam_test(external/rigid_wall property)
spam_test(rhs/combinations property)
spam_test(rhs/walled_combinations property)
spam_test(rhs/units property)
spam_test(rhs/selections property)
foreach(test combinations walled_combinations units)
  target_compile_definitions(test.rhs.${test} PRIVATE SPAM_SOURCE="${PROJECT_SOURCE_DIR}")
endforeach()
spam_test(rhs/plastic_solids property)
spam_test(rhs/total_lagrangian property)
spam_test(rhs/total_lagrangian_contract unit)
spam_test(rhs/material_vectors property)
spam_test(rhs/material_vectors_contract unit)
spam_test(rhs/material_vectors_flow property)
spam_test(rhs/material_vectors_breaking property)
spam_test(rhs/elements property)
spam_test(rhs/elements_in_motion property)
spam_test(rhs/allocation unit)
spam_test(integrate/methods unit)
spam_test(integrate/events unit)
find_package(SUNDIALS REQUIRED COMPONENTS arkode)  # its tables
spam_test(integrate/orders property SUNDIALS::arkode)
spam_test(integrate/restarts property)
spam_test(integrate/relaxation property)
spam_test(integrate/step_control unit)
spam_test(integrate/guards unit)
spam_test(integrate/interrupts unit)
spam_test(rhs/closest_approach property)
spam_test(diagnostics/measures unit)
spam_test(diagnostics/convergence property)
spam_test(diagnostics/rotating_disk property)
spam_test(diagnostics/body_ledger unit)
spam_test(diagnostics/fields property)
spam_test(diagnostics/entropy property)
spam_test(diagnostics/lattice_modes property)
spam_test(diagnostics/bonded_lattice property)
spam_test(diagnostics/pair_torques property)
spam_test(diagnostics/vibrations unit)
spam_test(diagnostics/convection_grid property)
spam_test(diagnostics/gas_dynamics property)
spam_test(drift/hexagon drift)
spam_test(drift/closest_approach drift)
spam_test(drift/constraints drift)
spam_test(drift/promises drift)
spam_test(drift/symplectic_swing drift)
spam_test(drift/total_lagrangian drift)
spam_test(drift/material_vectors drift)
spam_test(drift/material_vector_matter drift)
spam_test(drift/material_vector_bodies drift)
spam_test(io/text unit)
spam_test(io/option_rules unit)
spam_test(core/threads unit)
spam_test(io/study_table unit)
spam_test(io/pictures unit)
find_package(nlohmann_json REQUIRED)  # result_files.hpp
spam_test(io/image_file unit nlohmann_json::nlohmann_json)
spam_test(io/checkpoint_file unit hdf5::hdf5)
spam_test(io/checkpoint_damage property OpenSSL::Crypto)
spam_test(io/checkpoint_pair property)
spam_test(io/checkpoint_faults property)
spam_test(front_door/front_door problem)
target_compile_definitions(test.front_door.front_door PRIVATE SPAM_SOURCE="${PROJECT_SOURCE_DIR}")
if(SPAM_BUILD_VIEW)
  foreach(test reader page hostile_folders)
    spam_test(view/${test} unit spam_view)
    target_include_directories(test.view.${test} PRIVATE ${PROJECT_SOURCE_DIR}/src
                                                         ${CMAKE_CURRENT_SOURCE_DIR}/view)
    target_compile_definitions(test.view.${test} PRIVATE SPAM_VIEW="$<TARGET_FILE:spam-view>")
    add_dependencies(test.view.${test} spam-view)
  endforeach()
endif()
include(${CMAKE_CURRENT_SOURCE_DIR}/python/tests.cmake)
# All of libspam as a shared object, from what was compiled for the static library: what
# -DBUILD_SHARED_LIBS=ON links, and what a module of an interpreter holds.
add_library(spam_module MODULE builds/module.cpp)
target_include_directories(spam_module PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(spam_module PRIVATE $<LINK_LIBRARY:WHOLE_ARCHIVE,spam> spam_flags)
if(NOT SPAM_SANITIZE)  # the sanitizers' functions are in the program
  target_link_options(spam_module PRIVATE LINKER:--no-undefined)
endif()
add_executable(test.builds.load_module builds/load_module.cpp)
target_link_libraries(test.builds.load_module PRIVATE spam_test_main spam_flags ${CMAKE_DL_LIBS})
if(SPAM_SANITIZE)  # clang adds libraries of its own, which lie beside the one of OpenMP
  find_package(OpenMP REQUIRED COMPONENTS CXX)
  target_link_libraries(test.builds.load_module PRIVATE OpenMP::OpenMP_CXX)
endif()
target_compile_definitions(test.builds.load_module PRIVATE
                           SPAM_MODULE="$<TARGET_FILE:spam_module>")
add_dependencies(test.builds.load_module spam_module)
add_test(NAME builds.load_module COMMAND test.builds.load_module)
set_tests_properties(builds.load_module PROPERTIES LABELS unit TIMEOUT ${timeout})
spam_test(style/house_rules style)
target_compile_definitions(test.style.house_rules PRIVATE SPAM_SOURCE="${PROJECT_SOURCE_DIR}")
spam_test(style/models style)
target_compile_definitions(test.style.models PRIVATE SPAM_SOURCE="${PROJECT_SOURCE_DIR}")

# What depends on the instruction set, with each that this build has and the processor can do.
if(NOT SPAM_LEVELS STREQUAL "generic")
  foreach(level IN LISTS SPAM_LEVELS)
    add_executable(test.core.lanes.${level} core/lanes.cpp)
    target_link_libraries(test.core.lanes.${level} PRIVATE spam::spam spam_test_main spam_flags)
    target_compile_options(test.core.lanes.${level} PRIVATE -march=x86-64-${level}
                                                            -ffp-contract=fast)
    add_test(NAME core.lanes.${level} COMMAND test.core.lanes.${level})
    set_tests_properties(core.lanes.${level} PROPERTIES LABELS unit)
    set(tests core.lanes.${level})
    foreach(name rhs.oracle rhs.conservation rhs.purity rhs.pair_potential
                 rhs.contact rhs.density_potential_model rhs.total_lagrangian
                 neighbors.cluster_list)
      add_test(NAME ${name}.${level} COMMAND test.${name})
      set_tests_properties(${name}.${level} PROPERTIES LABELS property)
      list(APPEND tests ${name}.${level})
    endforeach()
    set_tests_properties(${tests} PROPERTIES TIMEOUT ${timeout} ENVIRONMENT SPAM_ISA=${level}
      SKIP_REGULAR_EXPRESSION "more than this processor can do")
  endforeach()
endif()

# Counted and looked at in optimised code only.
if(NOT SPAM_LEVELS STREQUAL "generic" AND CMAKE_BUILD_TYPE STREQUAL "Release"
   AND NOT SPAM_SANITIZE AND NOT SPAM_COVERAGE)
  set(objects "")
  foreach(level IN LISTS SPAM_LEVELS)
    list(APPEND objects $<TARGET_OBJECTS:spam_${level}>)
  endforeach()
  add_test(NAME core.lanes_symbols COMMAND ${CMAKE_COMMAND} -DNM=${CMAKE_NM} "-DOBJECTS=${objects}"
                                           -P ${CMAKE_CURRENT_SOURCE_DIR}/core/lanes_symbols.cmake)
  set_tests_properties(core.lanes_symbols PROPERTIES LABELS unit)

  find_program(VALGRIND NAMES valgrind)
  add_executable(instructions rhs/instructions.cpp)
  target_link_libraries(instructions PRIVATE spam::spam spam_flags)
  # spam_instructions_test(<name> <scheme> <most per pair>)
  function(spam_instructions_test name scheme most)
    add_test(NAME ${name} COMMAND ${CMAKE_COMMAND} -DVALGRIND=${VALGRIND}
      -DPROGRAM=$<TARGET_FILE:instructions> -DSCHEME=${scheme} -DMOST=${most}
      -P ${CMAKE_CURRENT_SOURCE_DIR}/rhs/instructions.cmake)
    set_tests_properties(${name} PROPERTIES LABELS property TIMEOUT ${timeout})
    if(NOT VALGRIND)
      set_tests_properties(${name} PROPERTIES DISABLED TRUE)
    endif()
  endfunction()
  spam_instructions_test(rhs.instructions one_sweep 65)
  spam_instructions_test(rhs.instructions_two_sweeps two_sweeps 85)
  spam_instructions_test(rhs.instructions_total_lagrangian total_lagrangian 145)  # three sweeps
  spam_instructions_test(rhs.instructions_gate one_sweep 50)  # it fails where there are too many
  set_tests_properties(rhs.instructions_gate PROPERTIES WILL_FAIL TRUE)
endif()

# The same in every build: one installation will do.
if(SPAM_BUILD_PROBLEMS AND SPAM_BUILD_VIEW AND NOT SPAM_SANITIZE AND NOT SPAM_COVERAGE)
  list(LENGTH problems number)
  add_test(NAME front_door.installed COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR}
    -DSOURCE=${PROJECT_SOURCE_DIR} -DSHARED=${BUILD_SHARED_LIBS} -DPROBLEMS=${number}
    -DWORK=${CMAKE_CURRENT_BINARY_DIR}/installed -DCXX=${CMAKE_CXX_COMPILER}
    -P ${CMAKE_CURRENT_SOURCE_DIR}/front_door/installed.cmake)
  set_tests_properties(front_door.installed PROPERTIES LABELS problem TIMEOUT 300)
endif()

add_test(NAME package.agree COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR}
                                    -P ${CMAKE_CURRENT_SOURCE_DIR}/package/agree.cmake)
set_tests_properties(package.agree PROPERTIES LABELS style)

find_program(SHELLCHECK NAMES shellcheck)
file(GLOB_RECURSE scripts ${PROJECT_SOURCE_DIR}/src/*.bash)
add_test(NAME style.shell COMMAND ${SHELLCHECK} -x ${PROJECT_SOURCE_DIR}/spam ${scripts}
  ${PROJECT_SOURCE_DIR}/.ci/run ${CMAKE_CURRENT_SOURCE_DIR}/front_door/cmake_stub
  ${PROJECT_SOURCE_DIR}/src/package/debian/man_pages
  ${PROJECT_SOURCE_DIR}/src/package/debian/tests/consumer
  ${PROJECT_SOURCE_DIR}/src/package/debian/tests/problems
  ${PROJECT_SOURCE_DIR}/src/package/debian/tests/python
  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
set_tests_properties(style.shell PROPERTIES LABELS style)
if(NOT SHELLCHECK)
  set_tests_properties(style.shell PROPERTIES DISABLED TRUE)
endif()

find_program(CLANG_FORMAT NAMES clang-format-14 clang-format)
add_test(NAME style.format COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR}
                                   -DCLANG_FORMAT=${CLANG_FORMAT}
                                   -P ${CMAKE_CURRENT_SOURCE_DIR}/style/format.cmake)
set_tests_properties(style.format PROPERTIES LABELS style)
if(NOT CLANG_FORMAT)
  set_tests_properties(style.format PROPERTIES DISABLED TRUE)
endif()

# Nothing of this is run: it is the same in every build, and one will do.
if(NOT SPAM_SANITIZE AND NOT SPAM_COVERAGE)
  separate_arguments(flags UNIX_COMMAND "${CMAKE_CXX_FLAGS} -std=c++20 -fopenmp")
  # /usr/include in the wrong place hides the C library from the C++ library.
  set(includes $<TARGET_PROPERTY:test.style.house_rules,INCLUDE_DIRECTORIES>)
  set(includes $<FILTER:${includes},EXCLUDE,^/usr/include$>)
  # spam_headers_test(<name> <folder>)
  function(spam_headers_test name folder)
    add_test(NAME ${name} COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/style/headers.sh ${folder}
      ${CMAKE_CURRENT_BINARY_DIR}/${name} ${CMAKE_CXX_COMPILER} ${flags}
      "-isystem;$<JOIN:${includes},;-isystem;>" COMMAND_EXPAND_LISTS)
    set_tests_properties(${name} PROPERTIES LABELS style TIMEOUT ${timeout} PROCESSORS 2)
  endfunction()
  spam_headers_test(style.headers ${PROJECT_SOURCE_DIR}/include)
  spam_headers_test(style.headers_gate ${CMAKE_CURRENT_SOURCE_DIR}/style/not_alone)
  set_tests_properties(style.headers_gate PROPERTIES
    PASS_REGULAR_EXPRESSION "needs_vector.hpp does not compile by itself")
endif()

# What is written in Python needs 3.11, for TOML.
find_package(Python3 3.11 COMPONENTS Interpreter)
function(spam_python_test path)
  string(REPLACE "/" "." name ${path})
  add_test(NAME ${name} COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/${path}.py)
  set_tests_properties(${name} PROPERTIES LABELS unit TIMEOUT ${timeout}
                                          SKIP_REGULAR_EXPRESSION "skipped: ")
  if(NOT Python3_EXECUTABLE)
    set_tests_properties(${name} PROPERTIES DISABLED TRUE)
  endif()
endfunction()
# Optimised code only: flags of other builds take other times.
if(CMAKE_BUILD_TYPE STREQUAL "Release" AND NOT SPAM_SANITIZE AND CMAKE_GENERATOR STREQUAL "Ninja")
  add_test(NAME builds.compile_time COMMAND ${Python3_EXECUTABLE} -B
    ${CMAKE_CURRENT_SOURCE_DIR}/builds/compile_time.py ${PROJECT_BINARY_DIR})
  set_tests_properties(builds.compile_time PROPERTIES LABELS style TIMEOUT ${timeout}
                                                      SKIP_REGULAR_EXPRESSION "skipped: ")
endif()
spam_python_test(numbers/numbers)
spam_python_test(docs/docs)

set(readme_flags "${CMAKE_CXX_FLAGS}")
if(SPAM_SANITIZE)
  string(APPEND readme_flags " -fsanitize=${SPAM_SANITIZE}")
elseif(SPAM_COVERAGE)
  string(APPEND readme_flags " --coverage")
endif()
add_test(NAME readme.example COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR}
  -DSOURCE=${PROJECT_SOURCE_DIR} -DWORK=${CMAKE_CURRENT_BINARY_DIR}/readme
  -DCXX=${CMAKE_CXX_COMPILER} "-DFLAGS=${readme_flags}"
  -P ${CMAKE_CURRENT_SOURCE_DIR}/readme/example.cmake)
set_tests_properties(readme.example PROPERTIES LABELS problem TIMEOUT 300)

spam_test(problem/remake property)
spam_test(problem/remake_solids property)

# What users add, each in one file.
spam_test(extend/external property)
spam_test(extend/observer unit)
spam_test(extend/stepping unit)
spam_test(extend/terms property)
spam_test(extend/history_material property)
spam_test(extend/pair_law.lanes property)
spam_add_sweeps(test.extend.pair_law.lanes extend/pair_law.lanes.cpp)
spam_test(extend/column.lanes property)
spam_add_sweeps(test.extend.column.lanes extend/column.lanes.cpp)

# What serves one problem lives beside it, and is tested here.
function(spam_test_of_problem test)
  target_include_directories(${test} PRIVATE ${PROJECT_SOURCE_DIR}/problems)
  foreach(source IN LISTS ARGN)
    target_sources(${test} PRIVATE ${PROJECT_SOURCE_DIR}/problems/${source})
  endforeach()
endfunction()
spam_test_of_problem(test.diagnostics.body_ledger fragmenting_bar/body_ledger.cpp)
spam_test_of_problem(test.diagnostics.entropy free_expansion/entropy.cpp)
spam_test_of_problem(test.diagnostics.measures drop/roundness.cpp)
spam_test_of_problem(test.diagnostics.pair_torques plane_wave/block_rotation.cpp)
spam_test_of_problem(test.diagnostics.rotating_disk)
spam_test_of_problem(test.diagnostics.vibrations sheared_square/vibrations.cpp)
spam_test_of_problem(test.physics.lattice_strength lattice_stability/lattice_strength.cpp)
spam_test_of_problem(test.diagnostics.convection_grid rayleigh_benard/grid.cpp)
spam_test_of_problem(test.diagnostics.gas_dynamics shock_tube/riemann.cpp blast/sedov.cpp)
spam_test_of_problem(test.rhs.fluid_transport diffusion_waves/diffusion_waves.cpp)
