#include "Shutter.h"

#include "Footprint.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

namespace vorion::reference {
namespace {

constexpr double Least = 0.25, End = 1.5;

Camera<double> inDouble(const Camera<float> &C) {
  Camera<double> D;
  D.Width = C.Width;
  D.Height = C.Height;
  D.Focal = C.Focal;
  D.Principal = C.Principal;
  D.Optics = C.Optics;
  D.Shutter = C.Shutter;
  return D;
}
Camera<double> inDouble(const Camera<double> &C) { return C; }

LensRows<double> heldRows(const Camera<double> &C, const glm::dvec3 &P,
                          Rules Rule) {
  if (!C.Optics.isPinhole())
    return rowsThrough(C, P, Rule);
  const Jacobian<double> J = jacobian(P, C, Rule);
  return {{J.XX, 0, J.XZ}, {0, J.YY, J.YZ}};
}

class Exposure {
public:
  Exposure(const Camera<double> &C, const glm::dvec3 &P)
      : C(C), S(*C.Shutter), P(P), Way(S.Across / C.Width, S.Down / C.Height) {}

  /// Goes to \p To; false if the camera does not see the point then.
  bool goTo(double To) {
    Moment = To;
    At = turned(S.Turn, -To, P - To * S.Motion);
    if (!placeThrough(C.Optics, At, Place))
      return false;
    Rate = -glm::cross(S.Turn, At) - turned(S.Turn, -To, S.Motion);
    Drift = drift(freeRowsThrough(C, At));
    return true;
  }
  /// How fast the point moves on the picture by the rows \p J, px an exposure.
  glm::dvec2 drift(const LensRows<double> &J) const {
    return {glm::dot(J.X, Rate), glm::dot(J.Y, Rate)};
  }
  /// What the picture's drift leaves of the shutter's way.
  double left() const { return 1 - glm::dot(Way, Drift); }
  /// Where Newton's step ends.
  double next() const {
    const double Own = momentAt(C, C.Focal * Place + C.Principal);
    return std::clamp(Moment + (Own - Moment) / std::max(left(), Least), -End,
                      End);
  }
  /// False if it has none.
  bool goToOwnMoment() {
    double Next = 0;
    for (int I = 0; I < 100; ++I) {
      if (!goTo(Next))
        return false;
      Next = next();
      if (std::abs(Next - Moment) < 1e-15)
        break;
    }
    return goTo(Next) && (isHeld() || left() >= Least);
  }
  bool isHeld() const { return std::abs(Moment) >= End; }
  /// A step of the point moves its moment, too, and with it the camera. The
  /// drift is that of the rows \p J: where they are held for a point far beside
  /// the picture, its own drift would be of another place.
  glm::dmat2 shear(const LensRows<double> &J) const {
    if (isHeld())
      return glm::dmat2(1);
    const glm::dvec2 D = drift(J);
    return glm::dmat2(1) +
           glm::outerProduct(D, Way) / std::max(1 - glm::dot(Way, D), Least);
  }
  /// Rows by the point in the axes of the pose from rows \p J by the point to
  /// the camera now, which stands still.
  LensRows<double> byPose(const LensRows<double> &J) const {
    const glm::dmat2 M = shear(J);
    return {turned(S.Turn, Moment, M[0].x * J.X + M[1].x * J.Y),
            turned(S.Turn, Moment, M[0].y * J.X + M[1].y * J.Y)};
  }

  /// dL/d(point in the axes of the pose) at the point's own moment, from what
  /// the rows \p Rule holds give.
  glm::dvec3 back(std::optional<Rules> Rule, const ByExposedPoint &By) const {
    const LensRows<double> J =
        Rule ? heldRows(C, At, *Rule) : freeRowsThrough(C, At);
    const glm::dvec3 StillX = turned(S.Turn, Moment, J.X),
                     StillY = turned(S.Turn, Moment, J.Y);
    const glm::dmat2 M = shear(J);
    // The rows are M times the still camera's.
    const glm::dvec3 ByStillX = M[0].x * By.Rows.X + M[0].y * By.Rows.Y,
                     ByStillY = M[1].x * By.Rows.X + M[1].y * By.Rows.Y;
    LensRows<double> ByJ{turned(S.Turn, -Moment, ByStillX),
                         turned(S.Turn, -Moment, ByStillY)};
    if (isHeld())
      return turned(S.Turn, Moment, backThroughRows(Rule, ByJ));
    const glm::dmat2 ByShear =
        By.Shear +
        glm::dmat2(glm::dot(By.Rows.X, StillX), glm::dot(By.Rows.Y, StillX),
                   glm::dot(By.Rows.X, StillY), glm::dot(By.Rows.Y, StillY));
    // The shear is 1 + drift way^T / left, and left is 1 - way . drift, or
    // held.
    const glm::dvec2 Own = drift(J), ByWay = ByShear * Way;
    const double Free = 1 - glm::dot(Way, Own), Left = std::max(Free, Least);
    const glm::dvec2 ByDrift =
        ByWay / Left +
        (Free > Least ? glm::dot(Own, ByWay) / (Left * Left) : 0.) * Way;
    const glm::dvec3 ByRate = ByDrift.x * J.X + ByDrift.y * J.Y;
    ByJ.X += ByDrift.x * Rate;
    ByJ.Y += ByDrift.y * Rate;
    const glm::dvec3 ByAt =
        backThroughRows(Rule, ByJ) + glm::cross(S.Turn, ByRate);
    const double ByMoment =
        glm::dot(ByAt, Rate) +
        glm::dot(ByRate,
                 glm::cross(S.Turn, turned(S.Turn, -Moment, S.Motion))) +
        glm::dot(S.Turn,
                 glm::cross(StillX, ByStillX) + glm::cross(StillY, ByStillY));
    const LensRows<double> Unheld = freeRowsThrough(C, At);
    return turned(S.Turn, Moment,
                  ByAt + ByMoment / left() *
                             (Way.x * Unheld.X + Way.y * Unheld.Y));
  }
  /// dL/d(point to the camera now) from dL/d(rows by it).
  glm::dvec3 backThroughRows(std::optional<Rules> Rule,
                             const LensRows<double> &By) const {
    if (!Rule || !C.Optics.isPinhole())
      return backThrough(C, At, Rule, glm::dvec2(0), By);
    return backThroughJacobian(jacobian(At, C, *Rule), At.z, C.Focal, *Rule,
                               By);
  }

  const Camera<double> &C;
  const RollingShutter &S;
  glm::dvec3 P, At, Rate;
  glm::dvec2 Way, Place, Drift;
  double Moment = 0;
};

} // namespace

// Rodrigues.
glm::dvec3 turned(const glm::dvec3 &Turn, double Part, const glm::dvec3 &V) {
  const double Angle = std::sqrt(glm::dot(Turn, Turn));
  if (Angle == 0)
    return V;
  const glm::dvec3 Axis = Turn / Angle;
  const double C = std::cos(Part * Angle), S = std::sin(Part * Angle);
  return C * V + S * glm::cross(Axis, V) + (1 - C) * glm::dot(Axis, V) * Axis;
}

double momentAt(const Camera<double> &C, const glm::dvec2 &At) {
  const RollingShutter &S = *C.Shutter;
  return S.Start - 0.5 + S.Across / C.Width * At.x + S.Down / C.Height * At.y;
}

template <typename Real>
bool expose(const Camera<Real> &Of, const glm::dvec3 &P, Rules Rule,
            ExposedPoint &Found) {
  const Camera<double> &C = inDouble(Of);
  Exposure E(C, P);
  if (!E.goToOwnMoment())
    return false;
  const LensRows<double> Held = heldRows(C, E.At, Rule),
                         Free = freeRowsThrough(C, E.At);
  Found.Moment = E.Moment;
  Found.P = E.At;
  Found.Place = E.Place;
  Found.Rows = E.byPose(Held);
  Found.Free = E.byPose(Free);
  Found.Shear = E.shear(Held);
  Found.FreeShear = E.shear(Free);
  return true;
}

glm::dvec3 backThroughShutter(const Camera<double> &C, const glm::dvec3 &P,
                              std::optional<Rules> Rule,
                              const ByExposedPoint &By) {
  Exposure E(C, P);
  return E.goToOwnMoment() ? E.back(Rule, By) : glm::dvec3(0);
}

template bool expose(const Camera<float> &, const glm::dvec3 &, Rules,
                     ExposedPoint &);
template bool expose(const Camera<double> &, const glm::dvec3 &, Rules,
                     ExposedPoint &);

} // namespace vorion::reference
