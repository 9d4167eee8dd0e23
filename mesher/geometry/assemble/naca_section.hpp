#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A NACA section of unit chord, from (0, 0) to (1, 0) along the x-axis: four digits ("2412" or "naca2412"),
/// four digits modified ("0012-64": index of the nose radius, place of the largest thickness in tenths of the
/// chord; Stack and von Doenhoff, NACA report 492), or five digits ("23012", "23112" with a reflexed camber
/// line; Jacobs and Pinkerton, NACA report 537).
class NacaSection {
 public:
  /// With `sharp` both surfaces end in one point; otherwise the trailing edge is blunt, as in the original
  /// formulas. Throws InputError for a code that is none of these.
  NacaSection(const std::string& code, bool sharp);

  /// The point of the upper (side > 0) or lower surface that belongs to the place x of the chord, 0 to 1. The
  /// thickness is normal to the camber line.
  Point point_at(double x, int side) const;

  /// The height of the camber line at the place x.
  double camber_height(double x) const { return camber_at(x).height; }

  /// The place where two formulas of the camber line meet; 0 if there is none.
  double camber_joint() const { return camber_place_ > 0 ? camber_place_ : m_; }

  /// Points of one surface from the place `from` to the place `to`, both included, closer near the edges
  /// (cosine spacing): on the whole surface as many as `points`, which is at least 2.
  std::vector<Point> surface(int side, double from, double to, int points) const;

 private:
  struct Camber {
    double height = 0, slope = 0;
  };
  Camber camber_at(double x) const;
  double half_thickness(double x) const;
  void set_four_digits(const std::string& code);
  void set_five_digits(const std::string& code);
  void set_modified(int nose, int tenths);

  bool sharp_;
  double thickness_ = 0;                  ///< largest, by the chord
  double camber_ = 0, camber_place_ = 0;  ///< of four digits
  double k1_ = 0, k2_by_k1_ = 0, m_ = 0;  ///< of five digits
  bool reflexed_ = false;
  double place_ = 0;              ///< of the largest thickness, if modified; else 0
  double a_[4] = {}, d_[4] = {};  ///< of modified sections: before and behind that place
};

}  // namespace quadloop
