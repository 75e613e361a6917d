// SPDX-License-Identifier: Zlib
#pragma once

namespace wetcloth_test {

inline constexpr double kPi = 3.14159265358979323846;  // M_PI is not C++, and not everywhere

}  // namespace wetcloth_test
