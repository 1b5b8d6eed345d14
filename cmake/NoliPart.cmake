# SPDX-License-Identifier: Apache-2.0
# A part of the project that is built where its package is, unless the option says ON (then it is an error that it is not) or OFF.
# Found anew each time, so that a package that is installed later counts.
macro(noli_part option_name package found description expected)
  set(${option_name} AUTO CACHE STRING "${description}: ON, OFF, or AUTO where it can be")
  if("${${option_name}}" STREQUAL "AUTO")
    if("${found}")
      set(${option_name} ON)
    else()
      set(${option_name} OFF)
    endif()
  elseif(${option_name} AND NOT "${found}")
    message(FATAL_ERROR "${option_name} is ON, but there is no ${package}; expected ${expected}")
  endif()
endmacro()
