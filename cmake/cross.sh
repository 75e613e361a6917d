#!/usr/bin/env bash
# SPDX-License-Identifier: Zlib
# cross.sh TOOLCHAIN PREFIX SOURCES: into PREFIX, Bullet in float32, zlib and GoogleTest for another kind of machine, from
# Debian's sources, and the headers that serve all kinds. What is there already is not made again.
set -euo pipefail
toolchain=$1 prefix=$2 sources=$3
mkdir -p "$prefix" "$sources"

# source_of PACKAGE: its folder. Debian's own lists, read for sources; the machine's lists stay as they are.
source_of() {
  local found
  found=$(find "$sources" -maxdepth 1 -type d -name "$1-*" | head -n 1)
  if [[ -z $found ]]; then
    mkdir -p "$sources/lists.d" "$sources/lists/partial"
    local list
    for list in /etc/apt/sources.list /etc/apt/sources.list.d/debian.*; do
      if [[ -e $list ]]; then sed 's/^deb /deb-src /; s/^Types: deb$/Types: deb-src/' "$list" >"$sources/lists.d/${list##*/}"; fi
    done
    mv -f "$sources/lists.d/sources.list" "$sources/lists.d/old.list" 2>/dev/null || true
    local options=(-o Dir::Etc::sourcelist=/dev/null -o "Dir::Etc::sourceparts=$sources/lists.d"
      -o "Dir::State::lists=$sources/lists" -o APT::Sandbox::User=root)
    (cd "$sources" && apt-get "${options[@]}" -qq update && apt-get "${options[@]}" -qq source "$1") >&2
    found=$(find "$sources" -maxdepth 1 -type d -name "$1-*" | head -n 1)
  fi
  printf '%s\n' "$found"
}

# build FOLDER NAME [OPTION...]: by CMake, installed into the prefix
build() {
  local source=$1 name=$2
  shift 2
  cmake -S "$source" -B "$prefix/build/$name" -G Ninja "-DCMAKE_TOOLCHAIN_FILE=$toolchain" "-DWETCLOTH_CROSS_PREFIX=$prefix" \
    -DCMAKE_BUILD_TYPE=Release "-DCMAKE_INSTALL_PREFIX=$prefix" -DBUILD_SHARED_LIBS=OFF -DCMAKE_POSITION_INDEPENDENT_CODE=ON "$@"
  cmake --build "$prefix/build/$name"
  cmake --install "$prefix/build/$name"
}

mkdir -p "$prefix/include" "$prefix/share/cmake" "$prefix/lib"
for header in nlohmann CLI boost eigen3; do
  if [[ -e /usr/include/$header ]]; then ln -sfn "/usr/include/$header" "$prefix/include/$header"; fi
done
for package in nlohmann_json CLI11; do
  if [[ -e /usr/share/cmake/$package ]]; then cp -r "/usr/share/cmake/$package" "$prefix/share/cmake/"; fi
done
if [[ -e /usr/share/eigen3 ]]; then cp -r /usr/share/eigen3 "$prefix/share/"; fi

# Of Bullet and zlib the libraries are taken that are used, and not what their own build files would build.
project() { printf 'cmake_minimum_required(VERSION 3.21)\nproject(%s LANGUAGES %s)\n' "$1" "$2"; }

# library NAME SOURCES INCLUDE_DIR
library() {
  printf 'file(GLOB_RECURSE sources "%s")\nadd_library(%s STATIC ${sources})\n' "$2" "$1"
  printf 'target_include_directories(%s PRIVATE "%s")\ninstall(TARGETS %s)\n' "$1" "$3" "$1"
}

if [[ ! -e $prefix/include/bullet ]]; then
  source=${BULLET_SOURCE:-$(source_of bullet)}
  mkdir -p "$prefix/build/bullet-source"
  {
    project bullet CXX
    for name in BulletSoftBody BulletDynamics BulletCollision LinearMath; do
      library $name "$source/src/$name/*.cpp" "$source/src"
    done
    printf 'install(DIRECTORY "%s/src/" DESTINATION include/bullet FILES_MATCHING PATTERN "*.h")\n' "$source"
  } >"$prefix/build/bullet-source/CMakeLists.txt"
  build "$prefix/build/bullet-source" bullet
fi
if [[ ! -e $prefix/include/zlib.h ]]; then
  source=$(source_of zlib)
  mkdir -p "$prefix/build/zlib-source"
  {
    project zlib C
    printf 'set(CMAKE_C_STANDARD 99)\nadd_compile_definitions(HAVE_UNISTD_H)\n'
    library z "$source/[a-z]*.c" "$source"
    printf 'install(FILES "%s/zlib.h" "%s/zconf.h" DESTINATION include)\n' "$source" "$source"
  } >"$prefix/build/zlib-source/CMakeLists.txt"
  sed -i 's/GLOB_RECURSE/GLOB/' "$prefix/build/zlib-source/CMakeLists.txt"
  build "$prefix/build/zlib-source" zlib
fi
if [[ ! -e $prefix/include/gtest && ${WITHOUT_TESTS:-} != yes ]]; then build /usr/src/googletest googletest -DBUILD_GMOCK=OFF; fi
