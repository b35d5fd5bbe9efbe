#pragma once
#include <opensubdiv/far/topologyLevel.h>

namespace sateen {

/// Whether Bfr's patches of a cage cost more than a few kilobytes a face. Around an irregular vertex it makes for
/// each face a dense matrix of control points by patch points, both of which grow with the faces around the face's
/// vertices; faces share one where all that surrounds them is alike. A sharp or open fan of n faces is alike nowhere:
/// n matrices of n^2 numbers, 3 GB and half a minute for n = 400.
bool patches_cost_too_much(const OpenSubdiv::Far::TopologyLevel& cage);

}  // namespace sateen
