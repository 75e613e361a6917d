// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <cstddef>
#include <iterator>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// What a vector of owners owns, to look at in a range-for, by number or with the standard algorithms: `T&` each, and
/// `const T&` where T is const. Holds nothing itself; adding to the vector or removing from it ends its iterators.
/// @tparam Owner  of a T, which `*owner` gives: a std::unique_ptr, for example
template <class T, class Owner>
class Range {
 public:
  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = T;
    using difference_type = std::ptrdiff_t;
    using pointer = T*;
    using reference = T&;

    Iterator() = default;
    explicit Iterator(const Owner* owner) : m_owner(owner) {}

    T& operator*() const { return **m_owner; }
    T* operator->() const { return &**m_owner; }
    Iterator& operator++() {
      ++m_owner;
      return *this;
    }
    Iterator operator++(int) { return Iterator(m_owner++); }
    friend bool operator==(Iterator a, Iterator b) { return a.m_owner == b.m_owner; }
    friend bool operator!=(Iterator a, Iterator b) { return a.m_owner != b.m_owner; }

   private:
    const Owner* m_owner = nullptr;
  };

  explicit Range(const std::vector<Owner>& owners) : m_owners(&owners) {}

  Iterator begin() const { return Iterator(m_owners->data()); }
  Iterator end() const { return Iterator(m_owners->data() + m_owners->size()); }
  std::size_t size() const { return m_owners->size(); }
  bool empty() const { return m_owners->empty(); }
  /// `i` must be in [0, size()).
  T& operator[](std::size_t i) const { return *(*m_owners)[i]; }
  /// Of a range that is not empty.
  T& front() const { return *m_owners->front(); }
  T& back() const { return *m_owners->back(); }

 private:
  const std::vector<Owner>* m_owners;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
