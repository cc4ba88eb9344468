## -----------------------------------------------------------------------------
##
## SPDX-License-Identifier: LGPL-2.1-or-later
## Copyright (C) 2026 by the ebsmpm authors
##
## This file is part of the ebsmpm library.
##
## -----------------------------------------------------------------------------

#
# Install ebsmpm from BINARY_DIR below WORK_DIR, where nothing is left from an
# earlier time, and build the project in SOURCE_DIR against it. Every step must
# succeed.
#
function(step _name)
  execute_process(COMMAND ${ARGN}
    RESULT_VARIABLE _result
    OUTPUT_VARIABLE _output
    ERROR_VARIABLE _output
    )
  message("---- ${_name}\n${_output}")
  if(NOT _result EQUAL 0)
    message(FATAL_ERROR "The step '${_name}' failed: ${_result}")
  endif()
  set(_output "${_output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})

step("build" ${CMAKE_COMMAND} --build ${BINARY_DIR})
step("install"
  ${CMAKE_COMMAND} --install ${BINARY_DIR} --prefix ${WORK_DIR}/prefix)
step("installed program" ${WORK_DIR}/prefix/bin/ebsmpm --version)
string(FIND "${_output}" "${VERSION}" _position)
if(_position EQUAL -1)
  message(FATAL_ERROR "The installed program is not version ${VERSION}.")
endif()

step("configure down-stream" ${CMAKE_COMMAND}
  -S ${SOURCE_DIR} -B ${WORK_DIR}/build -G ${GENERATOR}
  -DCMAKE_BUILD_TYPE=${FLAVOUR}
  -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix
  )
if(_output MATCHES "CMake Warning")
  message(FATAL_ERROR "Configuring the down-stream project gave a warning.")
endif()
step("build down-stream" ${CMAKE_COMMAND} --build ${WORK_DIR}/build)
step("run down-stream" ${WORK_DIR}/build/downstream)
string(STRIP "${_output}" _output)
if(NOT _output STREQUAL "ebsmpm ${VERSION}: FE_BSpline<2>(2) has 0.5625")
  message(FATAL_ERROR "The down-stream program printed something else.")
endif()
