#pragma once
#include <filesystem>
#include <string_view>

#include "mesh/control_mesh.h"

namespace sateen {

/// Reads a Wavefront OBJ with OpenSubdiv's `t` tags (indices in tags count from 0). Positions, texture coordinates
/// and faces are read; normals, vertex colours, points and lines are passed over, groups and materials are counted in
/// a warning, for all of a mesh has one look. Free-form surfaces and curves, files that it calls and commands that it
/// runs are not read, which is a warning each. Lines end in LF, CR LF or CR, in any mixture; a # begins a comment
/// only where a word may begin; the 0x1A of DOS is passed over at the ends of text, lines and words. Faces keep their
/// corners, of any number up to what fits a line, and positions and texture coordinates keep their own indices.
///
/// Refused, as one InputError with file:line:column of every error (at most 100 are looked for): numbers that do not
/// parse, are not finite (nan, inf, 1.#IND and the like) or reach 1e15, an index 0 or out of range, a face of fewer
/// than 3 corners, a logical line above 1 MiB that is no comment; UTF-16 text; a file without a face, by what it
/// holds instead; 2^31 vertices, texture coordinates or corners. Mended with a counted warning: faces that meet a
/// vertex twice (cut, see cut_polygon.h), texture coordinates that are not finite (their faces lose their UVs), tags
/// that are unknown or malformed.
///
/// Why not tinyobjloader: it stops at 255 corners a face, tells no place, takes indices out of range and turns 1e999
/// into Inf. About 170 to 300 MB/s; tests/scene/million_triangles_test.cpp holds it above 50.
ControlMesh read_obj(const std::filesystem::path& path);
ControlMesh parse_obj(std::string_view text, const std::string& name);

}  // namespace sateen
