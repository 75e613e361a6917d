// SPDX-License-Identifier: Zlib
// A header of an application: it names the library's classes and knows no more of them.
#pragma once

#include <bullet_wetcloth/fwd.h>

namespace consumer {

class Towel {
 public:
  explicit Towel(wetcloth::WetCloth& cloth) : m_cloth(&cloth) {}
  wetcloth::WetCloth& cloth() const { return *m_cloth; }
  wetcloth::Wind* wind() const;
  bool runsAt(wetcloth::Stage stage) const;

 private:
  wetcloth::WetCloth* m_cloth;
};

}  // namespace consumer
