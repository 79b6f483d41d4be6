# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
# Copies headers into a folder, with the include root of the installation.
#   cmake "-DHEADERS=...;..." -DTO=folder -P public_headers.cmake
foreach(header ${HEADERS})
  cmake_path(GET header FILENAME name)
  file(READ ${header} text)
  string(REPLACE "#include \"service/pipeline/" "#include \"graspd/pipeline/" public_text "${text}")
  if(public_text MATCHES "#include \"(service|client|lcmtypes)/")
    message(FATAL_ERROR "${header} includes a header that is not installed")
  endif()
  file(WRITE ${TO}/${name} "${public_text}")
endforeach()
