# SPDX-License-Identifier: Zlib
# What CPack packs for Debian: unpacked, the command finds its scenes, a precision whose package is not there is missed in
# words, and each package names what it needs. `./dev packages check` installs them in a bare Debian.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")

set(packages "${WORK_DIR}/packages")
set(root "${WORK_DIR}/root")
file(REMOVE_RECURSE "${packages}" "${root}")
# Packing tightly is most of the time.
run("${CPACK}" --config "${BUILD_DIR}/CPackConfig.cmake" -G DEB -B "${packages}" -C "${CONFIG}"
    -D CPACK_DEBIAN_COMPRESSION_TYPE=none)

# unpack(<name>): and leaves what it depends on in `output`
function(unpack name)
  file(GLOB package "${packages}/${name}_*.deb")
  run("${DPKG_DEB}" -x "${package}" "${root}")
  run("${DPKG_DEB}" -f "${package}" Depends)
  set(output "${output}" PARENT_SCOPE)
endfunction()

list(GET PRECISIONS 0 precision)
unpack(libbullet-wetcloth-dev)
set(found -DMETHOD=find_package "-DCMAKE_PREFIX_PATH=${root}/usr")
set(consumer "${CMAKE_CURRENT_LIST_DIR}/consumer")
configure("${consumer}" "${WORK_DIR}/build" ${found} -DCOMPONENTS=collision)
configure_fails("${consumer}" "${WORK_DIR}/build" ${found} "-DCOMPONENTS=${precision}" MATCHES
                "its library for cloth is not .*libbullet-wetcloth-float32-dev")
unpack(libbullet-wetcloth-${precision}-dev)
must_match("${output}" "libbullet-wetcloth-dev \\(= ")
if(BULLET_PREFIX STREQUAL "/usr")
  must_match("${output}" "libbullet-dev \\(>= 3.[0-9]+\\), libbullet-dev \\(<< 3.[0-9]+~\\)")
endif()
configure("${consumer}" "${WORK_DIR}/build" ${found} "-DCOMPONENTS=${precision}")
if("float64" IN_LIST PRECISIONS AND precision STREQUAL "float32")
  configure_fails("${consumer}" "${WORK_DIR}/build" ${found} -DCOMPONENTS=float64 MATCHES
                  "Component float64: this package was built in float32")
endif()

file(GLOB command "${packages}/wetcloth_*.deb")
if(command)
  unpack(wetcloth)
  find_program(shlibdeps dpkg-shlibdeps)
  find_program(file file)
  if(shlibdeps AND file)
    must_match("${output}" "libc6 ")
  endif()
  run("${CMAKE_COMMAND}" -E chdir "${WORK_DIR}" "${root}/usr/bin/wetcloth" validate hanging_towel.json)
endif()

file(GLOB python "${packages}/python3-wetcloth_*.deb")
if(python)
  unpack(python3-wetcloth)
  must_match("${output}" "python3 \\(>= 3\\.[0-9]+\\), python3 \\(<< 3\\.[0-9]+~\\)")
endif()
