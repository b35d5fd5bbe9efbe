#pragma once
#include <cstdint>
#include <numeric>
#include <vector>

namespace sateen {

/// Unions of corners of faces.
struct CornerGroups {
  std::vector<std::uint32_t> parent;
  explicit CornerGroups(size_t n) : parent(n) { std::iota(parent.begin(), parent.end(), 0u); }
  std::uint32_t find(std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  std::uint32_t root(std::uint32_t i) const {
    while (parent[i] != i) i = parent[i];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    // The smaller stays root, so that numbers follow the order of the file.
    if (a < b) parent[b] = a;
    if (b < a) parent[a] = b;
  }
};

}  // namespace sateen
