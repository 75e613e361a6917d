// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/Layout.h"

#include "bullet_wetcloth/Require.h"

#include <string>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

void requireSameSize(const char* type, std::size_t application, std::size_t library) {
  if (application == library) return;
  rejectValue("sizeof(" + std::string(type) + ") in the program", application,
              std::to_string(library) +
                  " as in the library: both must be compiled with the same settings, such as _GLIBCXX_DEBUG, and with "
                  "the same headers of Bullet and of bullet_wetcloth");
}

}  // namespace

void requireLayout(const Layout& application, const Layout& library) {
  requireSameSize("std::vector", application.vector, library.vector);
  requireSameSize("std::string", application.string, library.string);
  requireSameSize("std::function", application.function, library.function);
  requireSameSize("btSoftBody", application.softBody, library.softBody);
  requireSameSize("WetCloth", application.wetCloth, library.wetCloth);
  requireSameSize("WetClothWorld", application.wetClothWorld, library.wetClothWorld);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
