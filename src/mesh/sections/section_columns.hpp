#pragma once

#include <vector>

#include "mesh/sections/section.hpp"

namespace railwave {

/// Columns of elements across a running surface, by arc length on its curve.
struct SurfaceColumns {
  std::vector<double> boundaries;  ///< one more than columns
  std::vector<double> sizes;
  int zone_first = 0;  ///< first column of the contact band, and one past its last
  int zone_last = 0;
};

/// How many columns of a size cover the contact band: a multiple of 3, for the transition below it.
int zone_columns(double width, double size);

/// `zone` equal columns from `first` to `last`, graded ones on both sides to the ends `begin` and `end`, whose number
/// is a multiple of `multiple` where the space allows it.
SurfaceColumns surface_columns(double begin, double first, double last, double end, int zone, double size,
                               double growth, double largest, int multiple);

/// Group sizes for as many lateral 3:1 transitions as keep the band's merged columns within
/// `band_limit`; other columns are merged as far as `limit`. More than `most` remaining columns are merged once more;
/// `least` remain.
std::vector<std::vector<int>> plan_merges(const SurfaceColumns& columns, double band_limit, double limit, int least,
                                          int most);

/// `count` lateral transition rows below columns of the given size, each as high as its template wants.
std::vector<Row> lateral_rows(int count, double size);

/// 0 to 1 at the lines between rows.
std::vector<double> row_fractions(const std::vector<Row>& rows);
std::vector<double> even_fractions(int parts);

/// New nodes on the straight line between two that exist, ends included.
std::vector<int> straight_line(SectionMesh& section, int first, int last, const std::vector<double>& fractions);

/// Puts the first `layers` rows below the contact band's columns exactly below `surface`, along its normals, `size`
/// apart, where their normals don't run together; fixes them and marks their quads as zone. The surface's outside lies
/// on the left of its direction.
void fix_zone(SectionMesh& section, const std::vector<BlockRow>& rows, const SurfaceColumns& columns,
              const Curve& surface, int layers, double size);

}  // namespace railwave
