# SPDX-License-Identifier: Apache-2.0
# Puts style, script and the notices of what is bundled into page.html, and that into a C++ source: bytes, so that nothing has to be escaped.
file(READ "${SOURCE}/page.html" page HEX)
file(READ "${BUNDLE}/main.js" script HEX)
file(READ "${BUNDLE}/node_modules/uplot/dist/uPlot.min.css" library_style HEX)
file(READ "${SOURCE}/src/page.css" style HEX)
file(READ "${BUNDLE}/node_modules/three/LICENSE" three_notice HEX)
file(READ "${BUNDLE}/node_modules/uplot/LICENSE" uplot_notice HEX)

# put(PLACE BYTES): instead of the one place of this name.
function(put place bytes)
  string(HEX "${place}" mark)
  string(FIND "${page}" "${mark}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "page.html has no place ${place}")
  endif()
  string(LENGTH "${mark}" size)
  math(EXPR behind "${at} + ${size}")
  string(SUBSTRING "${page}" 0 ${at} front)
  string(SUBSTRING "${page}" ${behind} -1 rest)
  set(page "${front}${bytes}${rest}" PARENT_SCOPE)
endfunction()
put("@STYLE@" "${library_style}${style}")
put("@NOTICES@" "${three_notice}${uplot_notice}")
put("@SCRIPT@" "${script}")

string(LENGTH "${page}" digits)
math(EXPR size "${digits} / 2")
string(REGEX REPLACE "(........................................)" "\\1\"\n\"" page "${page}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" page "${page}")
file(WRITE "${OUT}" "// Made by viewer/embed.cmake.
extern const char noli_report_page[];
extern const unsigned long noli_report_page_size;
const char noli_report_page[] =
\"${page}\";
const unsigned long noli_report_page_size = ${size};
")
