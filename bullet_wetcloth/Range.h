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
  /// A forward iterator over what the owners point to.
  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;  ///< as algorithms ask
    using value_type = T;                                 ///< as algorithms ask
    using difference_type = std::ptrdiff_t;               ///< as algorithms ask
    using pointer = T*;                                   ///< as algorithms ask
    using reference = T&;                                 ///< as algorithms ask

    /// Of no range.
    Iterator() = default;
    /// At this owner.
    explicit Iterator(const Owner* owner) : m_owner(owner) {}

    /// What the owner points to.
    T& operator*() const { return **m_owner; }
    /// Its address.
    T* operator->() const { return &**m_owner; }
    /// To the next.
    Iterator& operator++() {
      ++m_owner;
      return *this;
    }
    /// To the next; returns where it was.
    Iterator operator++(int) { return Iterator(m_owner++); }
    /// Whether both are at the same place.
    friend bool operator==(Iterator a, Iterator b) { return a.m_owner == b.m_owner; }
    /// Whether they are not.
    friend bool operator!=(Iterator a, Iterator b) { return a.m_owner != b.m_owner; }

   private:
    const Owner* m_owner = nullptr;
  };

  /// Over all of these, which must outlive the range and stay as many.
  explicit Range(const std::vector<Owner>& owners) : m_owners(&owners) {}

  /// The first.
  Iterator begin() const { return Iterator(m_owners->data()); }
  /// Past the last.
  Iterator end() const { return Iterator(m_owners->data() + m_owners->size()); }
  /// How many there are.
  std::size_t size() const { return m_owners->size(); }
  /// Whether there are none.
  bool empty() const { return m_owners->empty(); }
  /// `i` must be in [0, size()).
  T& operator[](std::size_t i) const { return *(*m_owners)[i]; }
  /// Of a range that is not empty.
  T& front() const { return *m_owners->front(); }
  /// Of a range that is not empty.
  T& back() const { return *m_owners->back(); }

 private:
  const std::vector<Owner>* m_owners;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
