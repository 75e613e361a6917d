# SPDX-License-Identifier: Zlib
# wetcloth_compile_quickly(<target>): for code that sets up, asks and judges, while the time goes into the library and
# into Bullet. In Release it compiles in two thirds of the time, and no result changes. In a page it is to be small.
function(wetcloth_compile_quickly target)
  set(level -O1)
  if(EMSCRIPTEN)
    set(level -Os)
  endif()
  target_compile_options(${target} PRIVATE $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU,Clang,AppleClang>>:${level}>)
endfunction()

# bullet_wetcloth/IeeeArithmetic.h refuses what a compiler lets see of these; Clang lets see only some.
function(wetcloth_require_ieee_arithmetic)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" config)
  set(flags "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${config}}")
  set(parts fast-math finite-math-only unsafe-math-optimizations associative-math reciprocal-math no-signed-zeros
            fp-model=fast)
  list(JOIN parts "|" parts)
  if(flags MATCHES "(^| )(-f(${parts})|-Ofast|/fp:fast)( |$)")
    message(FATAL_ERROR "${CMAKE_MATCH_2} in CMAKE_CXX_FLAGS: bullet_wetcloth rests on IEEE arithmetic; compile it without "
                        "-ffast-math and all of its parts")
  endif()
endfunction()

# wetcloth_compile_options(<target>): what every target of this tree is compiled with, and none of its users.
#
# -Wconversion is left out on purpose: water is double and btScalar is float or double, so code for both
# precisions narrows at every border and the casts would hide more than the warning finds.
function(wetcloth_compile_options target)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_features(${target} PUBLIC cxx_std_17)

  if(MSVC)
    target_compile_options(${target} PRIVATE /W4 /permissive- $<$<BOOL:${WETCLOTH_WARNINGS_AS_ERRORS}>:/WX>)
    return()
  endif()

  # Results must not depend on whether the machine has a fused multiply-add.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  # Nobody reads errno or the floating-point flags here; without this no loop with a root in it is vectorised. It
  # changes no result.
  target_compile_options(${target} PRIVATE -fno-math-errno -fno-trapping-math)
  # Without optimization GCC makes a function of each std::move() and std::forward(), thousands of them, where it is not
  # told otherwise.
  target_compile_options(
    ${target}
    PRIVATE
      $<$<AND:$<CONFIG:Debug>,$<CXX_COMPILER_ID:GNU>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,12>>:-ffold-simple-inlines>
  )
  target_compile_options(
    ${target}
    PRIVATE -Wall
            -Wextra
            -Wpedantic
            -Wshadow
            -Wold-style-cast
            -Wnon-virtual-dtor
            -Woverloaded-virtual
            -Wcast-qual
            -Wextra-semi
            -Wunused
            -Wvla
            # Lanes.h: what takes or returns wide vectors is always inlined, so no calling convention is at stake.
            -Wno-psabi
            # btVector3() leaves its numbers unset by design, and GCC sees that through Bullet's inlined containers.
            $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>
            # GCC's library calls a function of its own in std::stable_sort() that C++17 does not like.
            $<$<AND:$<CXX_COMPILER_ID:Clang>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,17>>:-Wno-deprecated-declarations>
            $<$<BOOL:${WETCLOTH_WARNINGS_AS_ERRORS}>:-Werror>)

  # Binutils bring two linkers, of which this one takes half of the time.
  find_program(WETCLOTH_GOLD ld.gold)
  mark_as_advanced(WETCLOTH_GOLD)
  if(WETCLOTH_GOLD AND CMAKE_SYSTEM_NAME STREQUAL "Linux" AND NOT WETCLOTH_SANITIZE)
    target_link_options(${target} PRIVATE $<$<AND:$<CONFIG:Debug>,$<CXX_COMPILER_ID:GNU,Clang>>:-fuse-ld=gold>)
  endif()

  if(WETCLOTH_SANITIZE)
    set(sanitize -fsanitize=${WETCLOTH_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_compile_options(${target} PRIVATE ${sanitize})
    # Static libraries do not link; whatever links one needs the sanitizer's runtime too.
    target_link_options(${target} PUBLIC $<BUILD_INTERFACE:-fsanitize=${WETCLOTH_SANITIZE}>)
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "EXECUTABLE" AND CMAKE_SYSTEM_NAME STREQUAL "Linux")
      target_sources(${target} PRIVATE "${PROJECT_SOURCE_DIR}/cmake/SanitizedProgram.cpp")
      set_source_files_properties("${PROJECT_SOURCE_DIR}/cmake/SanitizedProgram.cpp"
                                  PROPERTIES SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
      target_link_options(${target} PRIVATE -Wl,--export-dynamic-symbol=dlclose)
    endif()
  endif()
endfunction()
