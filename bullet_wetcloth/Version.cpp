// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/Version.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

const char* libraryVersion() { return WETCLOTH_VERSION_STRING; }

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
