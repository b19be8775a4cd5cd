#include "breathing/motion_fit.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <Eigen/QR>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include "breathing/direction_unknowns.h"
#include "core/error.h"

namespace pneuma {
namespace {

constexpr double SurfaceWeight = 0.1;  // of all landmarks'

void requireUsable(std::span<const LandmarkPair> landmarks, const StrainedLungs& lungs) {
  constexpr std::size_t Fewest = 12;  // three numbers each for nine constants and a shift
  if (landmarks.size() < Fewest) {
    throw InvalidInput("there are " + std::to_string(landmarks.size()) +
                       " landmarks; nine constants and a shift need 12 at least");
  }
  for (std::size_t n = 0; n < landmarks.size(); ++n) {
    const LandmarkPair& pair = landmarks[n];
    const std::string which = "landmark " + std::to_string(n + 1);
    if (!pair.rest.allFinite() || !pair.moved.allFinite()) {
      throw InvalidInput(which + " has a coordinate that is no number");
    }
    const auto lung = lungs.find(pair.side);
    if (lung == lungs.end()) {
      throw InvalidInput(which + " lies in no lung that is known; say which lung it is in");
    }
    if (lung->second.strain == 0.0) {
      throw InvalidInput("the " + std::string(name(pair.side)) +
                         " lung keeps its volume while its landmarks move; a motion cannot be "
                         "fitted to that. Are its surface and the gain in the same units?");
    }
  }
}

/// What is left of landmarks and surfaces by the unknowns of directions; all else follows from them
/// in closed form (variable projection).
class DirectionResiduals {
 public:
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  static constexpr int InputsAtCompileTime = Eigen::Dynamic;
  static constexpr int ValuesAtCompileTime = Eigen::Dynamic;

  DirectionResiduals(std::span<const LandmarkPair> landmarks, const StrainedLungs& lungs,
                     std::span<const SurfaceReading> surfaces)
      : landmarks_(landmarks), lungs_(lungs), surfaces_(surfaces), moved_(3 * landmarks.size()) {
    for (std::size_t n = 0; n < landmarks.size(); ++n) {
      moved_.segment<3>(static_cast<Eigen::Index>(3 * n)) = landmarks[n].moved - landmarks[n].rest;
    }
    for (const SurfaceReading& surface : surfaces) {
      lines_ += surface.residualsMm(reasonedForm()).size();
    }
  }

  int inputs() const { return 5; }

  int values() const { return static_cast<int>(moved_.size() + static_cast<Eigen::Index>(lines_)); }

  int operator()(const Eigen::VectorXd& unknowns, Eigen::VectorXd& residuals) const {
    const PublishedForm form = directionsOf(unknowns);
    const Eigen::MatrixXd matrix = linearPart(form);
    residuals.resize(values());
    residuals.head(moved_.size()) = matrix * solved(matrix) - moved_;
    const double weight = std::sqrt(SurfaceWeight * static_cast<double>(moved_.size()) /
                                    static_cast<double>(std::max<std::size_t>(1, lines_)));
    Eigen::Index at = moved_.size();
    for (const SurfaceReading& surface : surfaces_) {
      for (const double residual : surface.residualsMm(form)) residuals[at++] = weight * residual;
    }
    return 0;
  }

  PublishedFit fitOf(const Eigen::VectorXd& unknowns) const {
    PublishedFit fit;
    fit.form = directionsOf(unknowns);
    const Eigen::VectorXd linear = solved(linearPart(fit.form));
    fit.form.constant = linear[0];
    fit.form.slopes = linear.segment<3>(1);
    fit.shift = linear.tail<3>();
    return fit;
  }

 private:
  /// Displacements by the force's constant and slopes and the shift.
  Eigen::MatrixXd linearPart(const PublishedForm& form) const {
    Eigen::MatrixXd matrix(moved_.size(), 7);
    for (std::size_t n = 0; n < landmarks_.size(); ++n) {
      const StrainedLung& lung = lungs_.at(landmarks_[n].side);
      PublishedForm unit = form;
      auto rows = matrix.middleRows<3>(static_cast<Eigen::Index>(3 * n));
      for (int k = 0; k < 4; ++k) {
        unit.constant = k == 0 ? 1.0 : 0.0;
        unit.slopes = k == 0 ? Vec3(Vec3::Zero()) : Vec3(Vec3::Unit(k - 1));
        rows.col(k) = PublishedField(unit, lung.frame, lung.strain).at(landmarks_[n].rest);
      }
      rows.rightCols<3>().setIdentity();
    }
    return matrix;
  }

  Eigen::VectorXd solved(const Eigen::MatrixXd& matrix) const {
    return matrix.completeOrthogonalDecomposition().solve(moved_);
  }

  std::span<const LandmarkPair> landmarks_;
  const StrainedLungs& lungs_;
  std::span<const SurfaceReading> surfaces_;
  Eigen::VectorXd moved_;
  std::size_t lines_ = 0;
};

}  // namespace

PolynomialFit fitPolynomialForm(std::span<const LandmarkPair> landmarks, const StrainedLungs& lungs,
                                const TermChoice& terms, double ridge) {
  requireUsable(landmarks, lungs);
  const PolynomialForm drawnTo = evenForm();
  const auto count = static_cast<Eigen::Index>(landmarks.size());
  PolynomialFit fit;
  // Of each direction: its terms and the shift; rows are weighed by 1 / (strain L_k).
  for (int k = 0; k < 3; ++k) {
    std::vector<int> used;
    for (int j = 0; j < PolynomialForm::Terms; ++j) {
      if (terms(k, j)) used.push_back(j);
    }
    const auto constants = static_cast<Eigen::Index>(used.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count + constants, constants + 1);
    Eigen::VectorXd wanted = Eigen::VectorXd::Zero(count + constants);
    for (Eigen::Index n = 0; n < count; ++n) {
      const LandmarkPair& pair = landmarks[static_cast<std::size_t>(n)];
      const StrainedLung& lung = lungs.at(pair.side);
      const double unit = 1.0 / (lung.strain * lung.frame.lengths()[k]);
      const auto phi = PolynomialForm::terms(lung.frame.shareOf(pair.rest));
      matrix.row(n).head(constants) = phi(used).transpose();
      matrix(n, constants) = unit * lung.frame.toLps(Vec3::Unit(k))[k];
      wanted[n] = unit * lung.frame.toLps(pair.moved - pair.rest)[k];
    }
    const double pull = std::sqrt(ridge * static_cast<double>(count));
    matrix.bottomLeftCorner(constants, constants).diagonal().setConstant(pull);
    wanted.tail(constants) = pull * drawnTo.constants.row(k)(used).transpose();
    const Eigen::VectorXd solved = matrix.colPivHouseholderQr().solve(wanted);
    fit.form.constants.row(k)(used) = solved.head(constants).transpose();
    fit.shift[k] = solved[constants];
  }
  return fit;
}

PublishedFit fitPublishedForm(std::span<const LandmarkPair> landmarks, const StrainedLungs& lungs,
                              std::span<const SurfaceReading> surfaces) {
  requireUsable(landmarks, lungs);
  const DirectionResiduals residuals(landmarks, lungs, surfaces);
  Eigen::VectorXd best;
  double least = std::numeric_limits<double>::infinity();
  for (const MotionPreset start : {MotionPreset::Deep, MotionPreset::Quiet}) {
    Eigen::VectorXd unknowns = directionUnknowns(publishedForm(start));
    Eigen::NumericalDiff<DirectionResiduals> function(residuals, 1e-10);
    Eigen::LevenbergMarquardt<Eigen::NumericalDiff<DirectionResiduals>> solver(function);
    solver.parameters.maxfev = 600;
    solver.minimize(unknowns);
    if (solver.fnorm < least) {
      least = solver.fnorm;
      best = unknowns;
    }
  }
  return residuals.fitOf(best);
}

}  // namespace pneuma
