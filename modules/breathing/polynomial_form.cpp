#include "breathing/polynomial_form.h"

namespace pneuma {

Eigen::Vector<double, PolynomialForm::Terms> PolynomialForm::terms(const Vec3& q) {
  Eigen::Vector<double, Terms> phi;
  phi << q, q.x() * q.z(), q.y() * q.z(), q.z() * q.z();
  return phi;
}

PolynomialForm evenForm() {
  PolynomialForm form;
  form.constants.leftCols<3>().diagonal().setConstant(0.7);
  return form;
}

Vec3 PolynomialField::at(const Vec3& p) const {
  const Vec3 share = form_.constants * PolynomialForm::terms(frame_.shareOf(p));
  return frame_.toLps(strain_ * share.cwiseProduct(frame_.lengths()));
}

Mat3 PolynomialField::gradientAt(const Vec3& p) const {
  const Vec3 q = frame_.shareOf(p);
  Eigen::Matrix<double, PolynomialForm::Terms, 3> slopes;
  slopes.setZero();
  slopes.topRows<3>().setIdentity();
  slopes.row(3) << q.z(), 0.0, q.x();
  slopes.row(4) << 0.0, q.z(), q.y();
  slopes.row(5) << 0.0, 0.0, 2.0 * q.z();
  const Vec3 lengths = frame_.lengths();
  const Mat3 share =
      lengths.asDiagonal() * (form_.constants * slopes) * lengths.cwiseInverse().asDiagonal();
  const Mat3 toLps = frame_.axes();
  return strain_ * toLps * share * toLps;
}

}  // namespace pneuma
