#include "mesh/edge_table.h"

#include <algorithm>

namespace sateen {

EdgeTable::EdgeTable(const ControlMesh& cage) {
  const size_t corners = cage.position_indices.size();
  first_.reserve(cage.face_sizes.size() + 1);
  face_.reserve(corners);
  first_.push_back(0);
  for (size_t face = 0; face < cage.face_sizes.size(); ++face) {
    face_.insert(face_.end(), size_t(cage.face_sizes[face]), std::uint32_t(face));
    first_.push_back(std::uint32_t(face_.size()));
  }
  const auto ends = [&](std::uint32_t corner) {
    return std::minmax(cage.position_indices[corner], cage.position_indices[next(corner)]);
  };
  start_.assign(cage.positions.size() + 1, 0);
  for (std::uint32_t i = 0; i < corners; ++i) ++start_[size_t(ends(i).first) + 1];
  for (size_t v = 1; v < start_.size(); ++v) start_[v] += start_[v - 1];
  sides_.resize(corners);
  std::vector<std::uint32_t> at(start_.begin(), start_.end() - 1);
  for (std::uint32_t i = 0; i < corners; ++i) {
    const auto [a, b] = ends(i);
    sides_[at[size_t(a)]++] = {b, i};
  }
  for (size_t v = 0; v + 1 < start_.size(); ++v)
    std::sort(sides_.begin() + start_[v], sides_.begin() + start_[v + 1], [](const Side& x, const Side& y) {
      return x.other != y.other ? x.other < y.other : x.corner < y.corner;
    });
}

std::span<const EdgeTable::Side> EdgeTable::find(int a, int b) const {
  if (a > b) std::swap(a, b);
  const auto begin = sides_.begin() + start_[size_t(a)], end = sides_.begin() + start_[size_t(a) + 1];
  const auto low = std::lower_bound(begin, end, b, [](const Side& s, int v) { return s.other < v; });
  const auto high = std::upper_bound(low, end, b, [](int v, const Side& s) { return v < s.other; });
  return {sides_.data() + (low - sides_.begin()), size_t(high - low)};
}

}  // namespace sateen
