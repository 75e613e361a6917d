# SPDX-License-Identifier: Zlib
# An overlay port of the tree that it stands in; a registry's copy has vcpkg_from_github() in place of this line.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

vcpkg_check_features(
  OUT_FEATURE_OPTIONS FEATURE_OPTIONS
  FEATURES exact WETCLOTH_EXACT_COLLISION tools WETCLOTH_BUILD_COMMAND)
# vcpkg builds Bullet in float32, or with its feature double-precision in float64: whichever is there is built for.
vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS ${FEATURE_OPTIONS} -DWETCLOTH_BUILD_TESTS=OFF -DWETCLOTH_BUILD_EXAMPLES=OFF
          -DWETCLOTH_FILES_PER_OBJECT=130
          "-DBULLET_ROOT=${CURRENT_INSTALLED_DIR}"
  OPTIONS_DEBUG -DWETCLOTH_BUILD_COMMAND=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME bullet_wetcloth CONFIG_PATH lib/cmake/bullet_wetcloth)
vcpkg_fixup_pkgconfig()
if("tools" IN_LIST FEATURES)
  vcpkg_copy_tools(TOOL_NAMES wetcloth AUTO_CLEAN)
endif()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
