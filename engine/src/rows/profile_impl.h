// SPDX-License-Identifier: GPL-3.0-or-later
// The loop of the actions that lay a profile along a stroke. Included by rows_impl.h.

/// A profile in section: see ProfileJob.
struct ProfileSection {
  float scale;
  float inverse_width;
  float round;
};

/// What it does so far beside the path: how far the surface has sunk, and how steeply it rises.
struct SunkSurface {
  float by;
  float steep;
};

ARGIL_ROWS SunkSurface sunk_at(const ProfileSection& section, float beside) {
  const float x = lesser(beside * section.inverse_width, 1.0F);
  const bool is_round = x < section.round;
  const float rest = 1.0F - (is_round ? 0.5F * (x * x / section.round + section.round) : x);
  const float pointed = is_round ? x / section.round : 1.0F;
  return {section.scale * rest * rest,
          2.0F * section.scale * rest * pointed * section.inverse_width};
}

/// The distance to the profile of a point so far beside the path that lies `height` over the
/// profile and `above` over the surface as it was. Three steps towards the foot as Gauss and Newton
/// take them: each point of the profile that they meet is an upper bound.
ARGIL_ROWS float way_to_profile(const ProfileSection& section, float beside, float above,
                                float height, float wall) {
  const float at_middle = above + sunk_at(section, 0.0F).by;
  float square = lesser(height * height, beside * beside + at_middle * at_middle);
  // The first step as if the profile were pointed: in its middle it is level and tells no way.
  float foot = greater(beside + height * wall / (1.0F + wall * wall), 0.0F);
  for (int step = 0; step < 3; ++step) {
    const SunkSurface there = sunk_at(section, foot);
    const float off = beside - foot;
    const float over = above + there.by;
    square = lesser(square, off * off + over * over);
    foot = greater(foot + (off + over * there.steep) / (1.0F + there.steep * there.steep), 0.0F);
  }
  return __builtin_sqrtf(square);
}

/// The signed distance to the profile. Up to a voxel away it is measured across the wall as if that
/// were straight: edges of the lattice that cross the rounded point are then cut truer.
ARGIL_ROWS float distance_to_profile(const ProfileSection& section, float beside, float above,
                                     float voxel) {
  const float height = above + sunk_at(section, beside).by;
  const float wall = sunk_at(section, greater(beside, section.round / section.inverse_width)).steep;
  const float way = way_to_profile(section, beside, above, height, wall);
  const float across = magnitude(height) / __builtin_sqrtf(1.0F + wall * wall);
  const float part = lesser(greater(magnitude(height) / voxel - 1.0F, 0.0F), 1.0F);
  const float distance = across + part * (way - across);
  return height < 0.0F ? -distance : distance;
}

/// 1 where the surface faces as the plane does or across it, 0 where it faces back, so that the far
/// side of a thin wall stays. By how the field rises along the normal: what is small against the
/// profile has sides that face anywhere, and is worn away evenly.
ARGIL_ROWS float facing_of(const float* at, const float* normal, float voxel) {
  constexpr float kAnything = 1e30F;
  float rise = 0.0F;
  for (int a = 0; a < 3; ++a) rise += normal[a] * rise_of(at, kStride[a], kAnything);
  return lesser(greater(1.0F + 2.0F * rise / voxel, 0.0F), 1.0F);
}

/// The part of the profile that a point of the surface gets which lies `off` the path along the
/// normal, and `sunk` beyond the plane to the profile's side, in reaches: none of it where the hand
/// is far off, and less the deeper the surface lies already, since one V over another grows too
/// steep for a lattice.
ARGIL_ROWS float part_of_profile(float off, float sunk) {
  const float near = lesser(greater(2.0F - 2.0F * magnitude(off), 0.0F), 1.0F);
  const float shallow = lesser(greater(2.0F - 4.0F * sunk, 0.0F), 1.0F);
  return near * near * (3.0F - 2.0F * near) * shallow;
}

/// Of the nodes of a row: how far beside the path they lie, how far along it as a part of it, and
/// how far along the normal.
struct ProfileRow {
  float beside[kRowNodes];
  float along[kRowNodes];
  float up[kRowNodes];
};

/// Returns whether the profile reaches some node.
ARGIL_ROWS bool place_row(const ProfileJob& job, const float* __restrict from, float i, float j,
                          ProfileRow& row) {
  float is_reached = 0.0F;
  const float x = job.first[0] + job.voxel * i;
  const float y = job.first[1] + job.voxel * j;
  for (int k = 0; k < kRowNodes; ++k) {
    const float z = job.first[2] + job.voxel * static_cast<float>(k);
    const float up = x * job.normal[0] + y * job.normal[1] + z * job.normal[2];
    const float flat_x = x - up * job.normal[0];
    const float flat_y = y - up * job.normal[1];
    const float flat_z = z - up * job.normal[2];
    const float on_path = flat_x * job.path[0] + flat_y * job.path[1] + flat_z * job.path[2];
    const float along = lesser(greater(on_path * job.inverse_square, 0.0F), 1.0F);
    const float off_x = flat_x - along * job.path[0];
    const float off_y = flat_y - along * job.path[1];
    const float off_z = flat_z - along * job.path[2];
    const float beside = __builtin_sqrtf(off_x * off_x + off_y * off_y + off_z * off_z);
    const float above = job.side * from[k];
    const bool is_near = (above < job.band) & (above > -job.band - job.deepest);
    const bool is_beside = beside < job.width[0] + along * job.width[1];
    is_reached = is_beside & (is_near | (magnitude(above) >= job.known)) ? 1.0F : is_reached;
    row.beside[k] = beside;
    row.along[k] = along;
    row.up[k] = up;
  }
  return is_reached > 0.0F;
}

ARGIL_ROWS void lay_row(const ProfileJob& job, const ProfileRow& row, const float* __restrict from,
                        const float* __restrict free, float* __restrict now) {
  for (int k = 0; k < kRowNodes; ++k) {
    const float over_plane = row.up[k] + job.above;
    const bool is_cut = magnitude(from[k]) >= job.known;
    const float farther =
        from[k] < 0.0F ? lesser(over_plane, from[k]) : greater(over_plane, from[k]);
    const float start = is_cut ? farther : from[k];
    const float facing = is_cut ? 1.0F : facing_of(from + k, job.normal, job.voxel);
    const float off = (row.up[k] - start) * job.inverse_reach;
    const float sunk = job.side * (start - over_plane) * job.inverse_reach;
    const float scale = (job.scale[0] + row.along[k] * job.scale[1]) *
                        (free[k] * facing * part_of_profile(off, sunk));
    const float width = job.width[0] + row.along[k] * job.width[1];
    const float distance = distance_to_profile({scale, 1.0F / width, job.round}, row.beside[k],
                                               job.side * start, job.voxel);
    const float value = lesser(greater(distance, -job.band), job.band);
    const float before = job.side * now[k];
    const bool is_laid = (row.beside[k] < width) & (scale > 0.0F);
    now[k] = job.side * (is_laid ? greater(before, value) : before);
  }
}

void lay_profile(const ProfileJob& job, const HaloBlock& start, const float* free,
                 float* values) noexcept {
  for (int i = 0; i < kRowNodes; ++i) {
    for (int j = 0; j < kRowNodes; ++j) {
      const int n = kRowNodes * (kRowNodes * i + j);
      const float* from = start.value + HaloBlock::index(i, j, 0);
      ProfileRow row;
      if (!place_row(job, from, static_cast<float>(i), static_cast<float>(j), row)) continue;
      lay_row(job, row, from, free + n, values + n);
    }
  }
}
