#include "PngFile.h"

#include "FileAside.h"

#include <fstream>
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

void writePng(const std::string& file, const Image& image) {
  FileAside aside(file);
  std::ofstream stream(aside.path(), std::ios::binary | std::ios::trunc);
  const auto append = [](void* context, void* bytes, int count) {
    static_cast<std::ofstream*>(context)->write(static_cast<const char*>(bytes), count);
  };
  const int isEncoded =
      stbi_write_png_to_func(append, &stream, image.width, image.height, 3, image.rgb.data(), 3 * image.width);
  stream.close();
  if (isEncoded == 0 || !stream) throw std::runtime_error("could not be written");
  aside.finish();
}

}  // namespace pictures
