# A program that speaks the line protocol (rasterproof.h), judged by CTest:
#
#     include(rasterproof.cmake)
#     rasterproof_test(fill mine --cases 100)
#
# registers the test `fill`, which judges the target `mine`, once; what follows are options of `rasterproof judge`. Its output is
# the message of the judge. Beside that, fill.junit.xml in the build folder has a test case for each property. The program
# rasterproof is searched for in the path, and where RASTERPROOF names it.
cmake_minimum_required(VERSION 3.19)

# CTest runs this file as a script.
if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  # What follows `--judge` are the program, the name of the file, and the words of the judge.
  set(words)
  foreach(number RANGE 1 ${CMAKE_ARGC})
    list(APPEND words "${CMAKE_ARGV${number}}")
  endforeach()
  list(FIND words --judge start)
  math(EXPR start "${start} + 1")
  list(SUBLIST words ${start} -1 words)
  list(POP_FRONT words program junit)
  # Where nothing can be judged, no file of an earlier run is left.
  file(REMOVE ${junit})
  execute_process(COMMAND ${program} judge --junit ${junit} ${words} RESULT_VARIABLE status)
  if(status EQUAL 1)
    message(FATAL_ERROR "rasterproof judge ended with status 1; each property is in ${junit}")
  elseif(NOT status EQUAL 0)
    message(FATAL_ERROR "rasterproof judge ended with status ${status} and judged nothing")
  endif()
  return()
endif()

function(rasterproof_test name target)
  find_program(RASTERPROOF rasterproof)
  if(NOT RASTERPROOF)
    message(FATAL_ERROR "the program rasterproof is not in the path; name it: cmake -DRASTERPROOF=/path/to/rasterproof")
  endif()
  add_test(NAME ${name} COMMAND ${CMAKE_COMMAND} -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE} --judge ${RASTERPROOF}
    ${CMAKE_CURRENT_BINARY_DIR}/${name}.junit.xml ${ARGN} -- $<TARGET_FILE:${target}>)
endfunction()
