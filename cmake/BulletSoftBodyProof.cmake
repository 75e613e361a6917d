# SPDX-License-Identifier: Zlib
# For FindBulletSoftBody: which version and precision headers and libraries of Bullet are.

# The main part is linked and not run. It calls one function of each library that has the scalar in its mangled name,
# so that it only links with four libraries of the precision it is compiled for.
set(_bullet_program
    [==[
#include <BulletCollision/BroadphaseCollision/btQuantizedBvh.h>
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <LinearMath/btGeometryUtil.h>
#include <btBulletDynamicsCommon.h>

#include <cstdio>

struct VersionOfTheLibrary : btQuantizedBvh
{
  int get() const { return m_bulletVersion; }
};

int main(int argc, char**)
{
  std::printf("compiled as %d\n", VersionOfTheLibrary().get());
  if (argc < 2) { return 0; }

  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.btDiscreteDynamicsWorld::stepSimulation(btScalar(1));
  btSoftBody body(&world.getWorldInfo());
  body.setTotalMass(btScalar(1), false);
  btSphereShape shape(btScalar(1));
  shape.btCollisionShape::getContactBreakingThreshold(btScalar(1));
  btGeometryUtil::isPointInsidePlanes(btAlignedObjectArray<btVector3>(), btVector3(), btScalar(1));
  return 0;
}
]==])

# The version: in the headers, in the libraries, and asked for ------------------------------------------------

# "... 324" -> 3.24; empty where there is no such number
function(_bullet_version text result)
  set(version "")
  if(text MATCHES " ([0-9]+)([0-9][0-9])$")
    set(version "${CMAKE_MATCH_1}.${CMAKE_MATCH_2}")
  endif()
  set(${result} "${version}" PARENT_SCOPE)
endfunction()

# From the first of the directories whose header can be read now; else empty
function(_bullet_header_version include_dirs result)
  set(version "")
  foreach(directory IN LISTS include_dirs)
    string(REGEX REPLACE "^\\$<BUILD_INTERFACE:(.*)>$" "\\1" directory "${directory}")
    set(header "${directory}/LinearMath/btScalar.h")
    if(NOT version AND EXISTS "${header}")
      file(STRINGS "${header}" line REGEX "^#define BT_BULLET_VERSION +[0-9]+")
      _bullet_version("${line}" version)
    endif()
  endforeach()
  set(${result} "${version}" PARENT_SCOPE)
endfunction()

# As the libraries were compiled; empty where this machine cannot run the program
function(_bullet_library_version program result)
  set(output "")
  if(NOT CMAKE_CROSSCOMPILING OR CMAKE_CROSSCOMPILING_EMULATOR)
    execute_process(
      COMMAND ${CMAKE_CROSSCOMPILING_EMULATOR} "${program}"
      OUTPUT_VARIABLE output
      ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  endif()
  _bullet_version("${output}" version)
  set(${result} "${version}" PARENT_SCOPE)
endfunction()

function(_bullet_check_version version problem)
  find_package_check_version("${version}" fits)
  if(fits OR NOT version)
    set(text "")
  elseif(BulletSoftBody_FIND_VERSION_EXACT)
    set(text "Bullet in ${BulletSoftBody_SOURCE} is version ${version}, and it has to be exactly \
${BulletSoftBody_FIND_VERSION}: Bullet keeps no binary interface between versions.")
  else()
    set(text "Bullet in ${BulletSoftBody_SOURCE} is version ${version}, and it has to be \
${BulletSoftBody_FIND_VERSION} or newer: 3.05 to 3.26 are known to work; 2.88 lacks the \
deformable world, and 2.89 its contacts of nodes.")
  endif()
  set(${problem} "${text}" PARENT_SCOPE)
endfunction()

# The proof ---------------------------------------------------------------------------------------------------

# A name for these arguments and the contents of these files: a later configure is quick, and a changed installation is
# tried anew.
function(_bullet_name_proof precision include_dirs libraries result)
  set(facts ${precision} ${include_dirs} ${libraries} "${CMAKE_CXX_COMPILER}" "${CMAKE_CXX_FLAGS}" "${_bullet_program}")
  set(files ${libraries})
  foreach(directory IN LISTS include_dirs)
    list(APPEND files "${directory}/LinearMath/btScalar.h")
  endforeach()
  foreach(file IN LISTS files)
    # A target of the parent is no file.
    if(EXISTS "${file}")
      file(MD5 "${file}" content)
      list(APPEND facts ${content})
    endif()
  endforeach()
  string(MD5 key "${facts}")
  set(${result} "_BULLET_PROOF_${key}" PARENT_SCOPE)
endfunction()

# Links the program with the libraries (paths or imported targets). Leaves its path, or one line that says why not.
function(_bullet_link precision include_dirs libraries program problem)
  set(source "${CMAKE_BINARY_DIR}/CMakeFiles/BulletSoftBodyProof.cpp")
  file(WRITE "${source}" "${_bullet_program}")
  set(definitions "")
  if(precision STREQUAL "float64")
    set(definitions COMPILE_DEFINITIONS -DBT_USE_DOUBLE_PRECISION)
  endif()
  set(linked "${CMAKE_BINARY_DIR}/CMakeFiles/BulletSoftBodyProof-${precision}${CMAKE_EXECUTABLE_SUFFIX}")
  try_compile(
    _BULLET_LINKS "${CMAKE_BINARY_DIR}/CMakeFiles/BulletSoftBodyProof" "${source}"
    CMAKE_FLAGS "-DINCLUDE_DIRECTORIES=${include_dirs}"
    ${definitions}
    LINK_LIBRARIES ${libraries}
    OUTPUT_VARIABLE output
    COPY_FILE "${linked}")
  set(text "")
  if(NOT _BULLET_LINKS)
    set(log "${CMAKE_BINARY_DIR}/CMakeFiles/BulletSoftBodyProof-${precision}.log")
    file(WRITE "${log}" "${output}")
    string(REGEX MATCH "[^\n]*(undefined|unresolved|error|cannot|not recognized)[^\n]*" reason "${output}")
    list(GET libraries 0 first)
    set(text "A ${precision} program does not link with ${first} and its siblings: ${reason} (more in ${log}).")
  endif()
  unset(_BULLET_LINKS CACHE)
  set(${program} "${linked}" PARENT_SCOPE)
  set(${problem} "${text}" PARENT_SCOPE)
endfunction()

# Are these libraries of this precision and of the headers' version? Leaves the version, or one line that says why not.
function(_bullet_prove precision include_dirs libraries version problem)
  _bullet_header_version("${include_dirs}" header_version)
  _bullet_name_proof(${precision} "${include_dirs}" "${libraries}" proof)
  set(text "")
  # A failure is not remembered: the user may be mending that installation.
  if(NOT ${proof})
    _bullet_link(${precision} "${include_dirs}" "${libraries}" program text)
    if(NOT text)
      _bullet_library_version("${program}" library_version)
      if(NOT library_version)
        set(library_version "${header_version}")
      endif()
      if(library_version VERSION_EQUAL header_version)
        set(${proof} "${library_version}" CACHE INTERNAL "What the Bullet of this name is proven to be")
      else()
        list(GET libraries 0 first)
        set(text "The headers in ${include_dirs} are Bullet ${header_version}, and ${first} and its siblings are \
${library_version}: they have to be of one installation.")
      endif()
    endif()
  endif()
  set(${version} "${${proof}}" PARENT_SCOPE)
  set(${problem} "${text}" PARENT_SCOPE)
endfunction()
