// SPDX-License-Identifier: Zlib
#include "command/pictures/PngFile.h"

#include "command/pictures/OutputFile.h"

#include <stdexcept>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif
#include <stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace pictures {

void writePng(const std::string& path, const Image& image) {
  OutputFile file(path);
  const auto append = [](void* stream, void* bytes, int count) {
    static_cast<std::ostream*>(stream)->write(static_cast<const char*>(bytes), count);
  };
  const int isEncoded =
      stbi_write_png_to_func(append, &file.stream(), image.width, image.height, 3, image.rgb.data(), 3 * image.width);
  if (isEncoded == 0) throw std::runtime_error("the picture is too large for memory");
  file.close();
}

}  // namespace pictures
