// SPDX-License-Identifier: Apache-2.0

#include "pipeline/colour/icc_profile.h"

#include <Imath/ImathMatrix.h>

#include <cmath>
#include <cstdint>
#include <string_view>

#include "pipeline/colour/interop_spaces.h"

namespace lensplane {
namespace {

using Vec = Imath::V3d;
using Matrix = Imath::M33d;  // for row vectors: v * M

constexpr std::size_t kHeaderSize = 128;

// The profile connection space is lit by D50, in numbers of the ICC's specification.
const Vec kD50(0.9642, 1.0, 0.8249);

/// Big-endian bytes, as ICC has them.
class Bytes {
 public:
  Bytes& u32(std::uint32_t value) {
    for (const int shift : {24, 16, 8, 0}) bytes_.push_back(static_cast<char>(value >> shift));
    return *this;
  }
  Bytes& fixed(double value) {  // s15Fixed16
    return u32(static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(value * 65536.0))));
  }
  Bytes& text(std::string_view ascii) {
    bytes_ += ascii;
    return *this;
  }
  Bytes& vector(const Vec& v) { return fixed(v.x).fixed(v.y).fixed(v.z); }
  Bytes& zeros(std::size_t count) {
    bytes_.append(count, 0);
    return *this;
  }
  Bytes& add(const Bytes& other) {
    bytes_ += other.bytes_;
    return *this;
  }
  std::size_t size() const { return bytes_.size(); }
  std::vector<unsigned char> bytes() const { return {bytes_.begin(), bytes_.end()}; }

 private:
  std::string bytes_;
};

Vec xyz_from_xy(const std::array<float, 2>& xy) {
  const double x = xy[0], y = xy[1];
  return {x / y, 1.0, (1.0 - x - y) / y};
}

Matrix scaling(const Vec& s) {
  return {s.x, 0, 0, 0, s.y, 0, 0, 0, s.z};
}

/// XYZ of the display's red, green and blue (rows), which add up to its white.
Matrix primaries(const Chromaticities& c) {
  const Vec r = xyz_from_xy(c[0]), g = xyz_from_xy(c[1]), b = xyz_from_xy(c[2]);
  const Matrix unscaled(r.x, r.y, r.z, g.x, g.y, g.z, b.x, b.y, b.z);
  return scaling(xyz_from_xy(c[3]) * unscaled.inverse()) * unscaled;
}

/// Bradford's adaptation of XYZ from `white` to D50.
Matrix adaptation(const Vec& white) {
  const Matrix cones(.8951, -.7502, .0389, .2664, 1.7135, -.0685, -.1614, .0367, 1.0296);
  return cones * scaling((kD50 * cones) / (white * cones)) * cones.inverse();
}

Bytes localized(std::string_view ascii) {
  Bytes tag;
  tag.text("mluc").u32(0).u32(1).u32(12).text("enUS");
  tag.u32(static_cast<std::uint32_t>(2 * ascii.size())).u32(28);
  for (const char letter : ascii) tag.zeros(1).text({&letter, 1});
  return tag;
}

Bytes xyz(const Vec& v) {
  return Bytes().text("XYZ ").u32(0).vector(v);
}

/// A power, or the curve of IEC 61966-2-1 (sRGB).
Bytes curve_of(const InteropSpace& space) {
  Bytes tag;
  tag.text("para").u32(0);
  if (space.curve == InteropSpace::Curve::Power) return tag.u32(0).fixed(space.gamma);
  return tag.u32(3u << 16).fixed(2.4).fixed(1 / 1.055).fixed(.055 / 1.055).fixed(1 / 12.92).fixed(.04045);
}

Bytes matrix_tag(const Matrix& m) {
  Bytes tag;
  tag.text("sf32").u32(0);
  for (int row = 0; row < 3; ++row) tag.vector({m[0][row], m[1][row], m[2][row]});
  return tag;
}

Bytes header(std::size_t size) {
  Bytes bytes;
  bytes.u32(static_cast<std::uint32_t>(size)).u32(0).u32(0x04000000).text("mntrRGB XYZ ");
  bytes.u32(0x07EA0001).u32(0x00010000).u32(0);  // a date is required: the first day of 2026, midnight
  bytes.text("acsp").zeros(28).vector(kD50);
  return bytes.zeros(kHeaderSize - bytes.size());
}

}  // namespace

std::vector<unsigned char> icc_profile(const std::string& interop_id) {
  const InteropSpace* space = interop_space_of(interop_id);
  using Curve = InteropSpace::Curve;
  if (!space || space->curve == Curve::Linear || space->curve == Curve::Other) return {};
  const Matrix to_d50 = adaptation(xyz_from_xy(space->chromaticities[3]));
  const Matrix rgb = primaries(space->chromaticities) * to_d50;
  const Bytes trc = curve_of(*space);
  const std::vector<std::pair<std::string_view, Bytes>> tags = {
      {"desc", localized(interop_id)},
      {"cprt", localized("No copyright, use freely")},
      {"wtpt", xyz(kD50)},
      {"chad", matrix_tag(to_d50)},
      {"rXYZ", xyz({rgb[0][0], rgb[0][1], rgb[0][2]})},
      {"gXYZ", xyz({rgb[1][0], rgb[1][1], rgb[1][2]})},
      {"bXYZ", xyz({rgb[2][0], rgb[2][1], rgb[2][2]})},
      {"rTRC", trc},
      {"gTRC", trc},
      {"bTRC", trc}};
  Bytes table, data;
  table.u32(static_cast<std::uint32_t>(tags.size()));
  const std::size_t start = kHeaderSize + 4 + 12 * tags.size();
  for (const auto& [name, tag] : tags) {
    table.text(name).u32(static_cast<std::uint32_t>(start + data.size()));
    table.u32(static_cast<std::uint32_t>(tag.size()));
    data.add(tag).zeros((4 - tag.size() % 4) % 4);
  }
  return header(start + data.size()).add(table).add(data).bytes();
}

}  // namespace lensplane
