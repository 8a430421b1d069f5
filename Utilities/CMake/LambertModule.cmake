# Helpers that every module uses: its Core library, its tests.

# Flags of our own code only; wrapped and third-party code keeps its own.
add_library(LambertFlags INTERFACE)
target_compile_options(LambertFlags INTERFACE -Wall -Wextra -Wshadow -Wno-unused-parameter
  $<$<BOOL:${LAMBERT_WERROR}>:-Werror>)
# Two builds of the same source give the same light: no value-changing floating-point shortcuts.
target_compile_options(LambertFlags INTERFACE -ffp-contract=off)

# lambert_add_core(<Module> SOURCES ... [LINK ...] [LINK_PRIVATE ...])
# The algorithms of one module: library lambert<Module>Core, alias Lambert::<Module>Core. Headers are included
# as "<Module>/Core/X.h" by others and by the module itself.
function(lambert_add_core module)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK;LINK_PRIVATE" ${ARGN})
  set(target Lambert${module}Core)
  add_library(${target} SHARED ${arg_SOURCES})
  add_library(Lambert::${module}Core ALIAS ${target})
  set_target_properties(${target} PROPERTIES
    OUTPUT_NAME lambert${module}Core
    EXPORT_NAME ${module}Core
    VERSION ${PROJECT_VERSION} SOVERSION 0
    CXX_VISIBILITY_PRESET default VISIBILITY_INLINES_HIDDEN OFF)
  target_include_directories(${target} PUBLIC
    "$<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/Modules>"
    "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/lambert>")
  target_compile_features(${target} PUBLIC cxx_std_17)
  target_link_libraries(${target} PUBLIC ${arg_LINK} PRIVATE $<BUILD_INTERFACE:LambertFlags> ${arg_LINK_PRIVATE})
  install(TARGETS ${target} EXPORT LambertCore LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  install(DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/lambert/${module}/Core"
    FILES_MATCHING PATTERN "*.h")
endfunction()

# One GoogleTest program of every Testing/Unit/*Test.cxx, one ctest entry of every Testing/Python/Test*.py.
function(lambert_add_module_tests module)
  set(directory "${CMAKE_SOURCE_DIR}/Modules/${module}/Testing")
  file(GLOB unit_sources CONFIGURE_DEPENDS "${directory}/Unit/*Test.cxx")
  if(unit_sources)
    set(program lambert${module}Tests)
    add_executable(${program} ${unit_sources})
    target_link_libraries(${program} PRIVATE LambertFlags Lambert::${module}Core GTest::gtest_main
      ${LAMBERT_${module}_TEST_LINK})
    target_compile_definitions(${program} PRIVATE LAMBERT_DATA_DIR="${CMAKE_SOURCE_DIR}/Data")
    include(GoogleTest)
    gtest_discover_tests(${program} TEST_PREFIX "${module}." DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300)
  endif()
  if(LAMBERT_WRAP_PYTHON)
    file(GLOB python_tests CONFIGURE_DEPENDS "${directory}/Python/Test*.py")
    foreach(source IN LISTS python_tests)
      lambert_add_python_test(${module} "${source}")
    endforeach()
  endif()
endfunction()

# A Python test is a plain script: it fails by raising.
function(lambert_add_python_test group source)
  get_filename_component(name "${source}" NAME_WE)
  add_test(NAME "${group}.${name}" COMMAND "${Python3_EXECUTABLE}" "${source}")
  set_tests_properties("${group}.${name}" PROPERTIES TIMEOUT 600
    ENVIRONMENT "PYTHONPATH=${LAMBERT_PYTHON_PATH};LAMBERT_DATA_DIR=${CMAKE_SOURCE_DIR}/Data;LAMBERT_BIN_DIR=${CMAKE_RUNTIME_OUTPUT_DIRECTORY};LAMBERT_SOURCE_DIR=${CMAKE_SOURCE_DIR};LAMBERT_TEMPORARY_DIR=${CMAKE_BINARY_DIR}/Testing/Temporary")
endfunction()
