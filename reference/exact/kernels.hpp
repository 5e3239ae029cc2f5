// The smoothing kernels once more, from the polynomial pieces printed in the literature, and what theory says about a kernel:
// moments, derivative, Fourier transform. Lengths are in units of the smoothing length h unless
// a function takes h.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace furrow::exact {

/// A kernel in 1, 2 or 3 dimensions as polynomials of q = r/h between knots. The normalisation is not looked up: it follows
/// from the exact integral of the pieces.
class Kernel {
 public:
  struct Piece {
    double to;                               ///< the piece reaches from the end of the one before to here
    std::vector<long double> coefficients;   ///< c0 + c1 q + c2 q^2 + ...; thirds must not be rounded to double
  };
  Kernel(int dimension, std::vector<Piece> pieces);

  int dimension() const { return dimension_; }
  double support() const { return pieces_.back().to; }
  double normalisation() const { return normalisation_; }   ///< factor of the polynomials
  double value(double r, double h) const;                   ///< W, 1/m^d
  double derivative(double r, double h) const;              ///< dW/dr, 1/m^(d+1)
  double second_moment() const;                             ///< <x^2>/h^2 = integral of x^2 W, exact
  double projection(double x) const;                        ///< integral of W over a line at distance x, exact; h = 1

 private:
  double radial_moment(int power) const;
  int dimension_;
  std::vector<Piece> pieces_;
  double normalisation_ = 1.0;
};

/// "cubic_spline" (Monaghan & Lattanzio 1985), "quintic_spline" (Morris, Fox & Zhu 1997), "wendland_c2" and "wendland_c4"
/// (Wendland 1995; support 2h). Throws std::invalid_argument for another name or dimension.
Kernel kernel(std::string_view name, int dimension);

/// A function of the distance r.
using Radial = std::function<double(double)>;

/// Integrals of W, x W and x^2 W over the whole ball of this radius, by quadrature over angle and radius.
struct Moments {
  double zeroth = 0.0, first = 0.0, second = 0.0;
};
Moments moments(const Radial& W, double radius, int dimension);

/// Fourier transform of a radial function at wave number k: cosine, Hankel J0 and sinc transform in 1, 2, 3 dimensions.
double fourier_transform(const Radial& W, double radius, int dimension, double k);

/// The transform of a kernel of the plane (h = 1) by another way than Bessel's function: the cosine transform of its projection
/// onto a line (Fourier slice theorem). Throws std::invalid_argument in other dimensions.
double fourier_transform_by_projection(const Kernel& kernel, double k);

/// Closed-form transform of the B-spline of `order` (4 cubic, 6 quintic) of unit knot distance: sinc(k/2)^order on the line;
/// in space -F1'(k)/k times a factor that makes it one at k = 0. Dimension 1 or 3, k > 0.
double b_spline_transform(int order, int dimension, double k);

/// Where and how deep a transform first turns negative. Scans (0, k_max] in steps of k_step.
struct NegativePart {
  bool found = false;
  double begins = 0.0;    ///< first k with F(k) < 0 after F(k) > 0, to 1e-10
  double deepest = 0.0;   ///< smallest F(k) on the scanned points
};
NegativePart negative_part(const std::function<double(double)>& F, double k_max, double k_step);

}  // namespace furrow::exact
