# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
# The Debian packages, one a component: graspd, graspd-bench, libgraspd-dev and, where there is Java, graspd-spy.
set(changelog ${CMAKE_CURRENT_SOURCE_DIR}/changelog)
file(STRINGS ${changelog} newest LIMIT_COUNT 1)
if(NOT newest MATCHES "^graspd \\(${PROJECT_VERSION}-([0-9]+)\\) ")
  message(FATAL_ERROR "${changelog} does not begin with version ${PROJECT_VERSION}: ${newest}")
endif()
set(CPACK_DEBIAN_PACKAGE_RELEASE ${CMAKE_MATCH_1})
find_program(GRASPD_GZIP gzip REQUIRED)

# What Debian wants to find beside the files of the package.
function(graspd_gzip from to)
  add_custom_command(OUTPUT ${to}
    COMMAND ${GRASPD_GZIP} -9 --no-name --stdout ${from} > ${to}
    DEPENDS ${from} COMMENT "" VERBATIM)
endfunction()
graspd_gzip(${changelog} ${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian.gz)
graspd_gzip(${PROJECT_SOURCE_DIR}/CHANGELOG.md ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz)
graspd_gzip(${PROJECT_SOURCE_DIR}/README.md ${CMAKE_CURRENT_BINARY_DIR}/README.md.gz)
add_custom_target(graspd_changelogs ALL DEPENDS
  ${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian.gz ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz
  ${CMAKE_CURRENT_BINARY_DIR}/README.md.gz)

# graspd_package(COMPONENT NAME SECTION SUMMARY DESCRIPTION): the package of a component.
macro(graspd_package component name section summary description)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}\n${description}")
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian.gz ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz
    ${CMAKE_CURRENT_SOURCE_DIR}/copyright
    DESTINATION share/doc/${name} COMPONENT ${component})
  install(FILES ${CMAKE_CURRENT_SOURCE_DIR}/lintian/${name} DESTINATION share/lintian/overrides COMPONENT ${component})
endmacro()

set(CPACK_COMPONENTS_ALL)
graspd_package(graspd graspd misc "finds grasp handles in point clouds over LCM"
  "A daemon that takes point clouds and depth images over LCM and answers each\nwith a list of handles: poses in which a two-finger parallel-jaw gripper can\nhold something. With the programs beside it: simulated camera, listener,\nlogger, status, evaluation.")
graspd_package(bench graspd-bench misc "measures how long graspd takes, with PCL beside it"
  "Times the stages of graspd, its decoders and the way over LCM, and the same\nwork done with the Point Cloud Library in the same run.")
graspd_package(dev libgraspd-dev libdevel "grasp handles in point clouds, as a C++ library"
  "Headers, static library and CMake package (find_package(graspd)) of graspd's\npipeline, for use in-process and without LCM, with adapters for the clouds of\nthe Point Cloud Library.")
if(script_programs)
  graspd_package(spy graspd-spy misc "shows LCM messages live, with graspd's types decoded"
    "LCM's lcm-spy with the types of graspd, and the jar of these types for other\nJava programs.")
  set(CPACK_DEBIAN_SPY_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_SPY_PACKAGE_DEPENDS "default-jre, liblcm-java, libjchart2d-java")
endif()
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libeigen3-dev, libtbb-dev")
set(CPACK_DEBIAN_BENCH_PACKAGE_DEPENDS "graspd (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
set(CPACK_DEBIAN_GRASPD_PACKAGE_RECOMMENDS "iproute2")

# /etc belongs to the packages alone: the daemon of another prefix is told its file.
install(FILES etc/graspd.yaml DESTINATION ../etc/graspd COMPONENT etc EXCLUDE_FROM_ALL)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/README.md.gz DESTINATION share/doc/graspd)
list(APPEND CPACK_COMPONENTS_ALL etc)
set(CPACK_COMPONENT_ETC_GROUP graspd)
set(CPACK_COMPONENT_GRASPD_GROUP graspd)
set(scripts ${CMAKE_CURRENT_SOURCE_DIR}/scripts)
set(CPACK_DEBIAN_GRASPD_PACKAGE_CONTROL_EXTRA
  ${scripts}/postinst ${scripts}/prerm ${scripts}/postrm ${scripts}/conffiles)
set(CPACK_DEBIAN_GRASPD_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_VENDOR "The graspd authors")
set(CPACK_PACKAGE_CONTACT "The graspd authors <graspd@graspd.example>")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_OUTPUT_FILE_PREFIX ${PROJECT_BINARY_DIR}/packages)
include(CPack)
