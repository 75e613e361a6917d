// SPDX-License-Identifier: Zlib
#include "command/ccd/Gunzip.h"

#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

namespace command {
namespace {

constexpr std::size_t mostText = std::size_t(1) << 30;  // a small file can unpack to more than the memory holds

class Inflater {
 public:
  Inflater() {
    const int gzipOnly = 16 + MAX_WBITS;
    if (inflateInit2(&m_stream, gzipOnly) != Z_OK) throw std::runtime_error("zlib cannot be used");
  }
  ~Inflater() { inflateEnd(&m_stream); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// Appends what the member of a gzip file that begins at `begin` holds, and returns where it ends.
  std::size_t appendMember(std::string& data, std::size_t begin, std::string& text) {
    inflateReset(&m_stream);
    std::size_t next = begin;
    for (int status = Z_OK; status != Z_STREAM_END;) {
      const std::size_t given = std::min<std::size_t>(data.size() - next, std::numeric_limits<uInt>::max());
      m_stream.next_in = reinterpret_cast<Bytef*>(data.data() + next);
      m_stream.avail_in = static_cast<uInt>(given);
      status = inflateSome(text);
      next += given - m_stream.avail_in;
      if (status == Z_BUF_ERROR) throw std::invalid_argument("is gzip data that is cut short");
      if (status == Z_MEM_ERROR) throw std::runtime_error("zlib is out of memory");
      if (status != Z_OK && status != Z_STREAM_END) throw std::invalid_argument("is gzip data that is damaged");
      if (text.size() > mostText) throw std::invalid_argument("unpacks to more than 1 GiB, must be less");
    }
    return next;
  }

 private:
  int inflateSome(std::string& text) {
    char buffer[1 << 16];
    m_stream.next_out = reinterpret_cast<Bytef*>(buffer);
    m_stream.avail_out = sizeof buffer;
    const int status = inflate(&m_stream, Z_NO_FLUSH);
    text.append(buffer, sizeof buffer - m_stream.avail_out);
    return status;
  }

  z_stream m_stream = {};
};

}  // namespace

std::string gunzipped(std::string data) {
  const std::string magic = "\x1f\x8b";
  if (data.compare(0, magic.size(), magic) != 0) return data;
  Inflater inflater;
  std::string text;
  for (std::size_t next = 0; next < data.size();) {
    if (data.compare(next, magic.size(), magic) != 0) {
      throw std::invalid_argument("is gzip data with " + std::to_string(data.size() - next) +
                                  " bytes behind its end that are none");
    }
    next = inflater.appendMember(data, next, text);
  }
  return text;
}

}  // namespace command
