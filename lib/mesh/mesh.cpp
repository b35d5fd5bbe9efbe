#include "mesh/mesh.h"

namespace sateen {

std::int64_t Mesh::triangles() const {
  std::int64_t count = 0;
  for (const std::array<std::uint32_t, 4>& q : quads) count += q[2] == q[3] ? 1 : 2;
  return count;
}

}  // namespace sateen
