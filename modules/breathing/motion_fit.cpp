#include "breathing/motion_fit.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <Eigen/QR>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include "core/error.h"

namespace pneuma {
namespace {

constexpr double LinearRidge = 2e-3;   // a share's variance is about 0.05
constexpr double SurfaceWeight = 0.1;  // of all landmarks'
constexpr double LeastPower = 0.05;
constexpr double MostPower = 5.0;
constexpr double MostLogWeight = 4.0;

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
                         " lung keeps its volume; a motion cannot be fitted to it");
    }
  }
}

double bounded(double x, double low, double high) {
  return low + (high - low) * 0.5 * (1.0 + std::tanh(x));
}

double unbounded(double value, double low, double high) {
  return std::atanh(2.0 * (value - low) / (high - low) - 1.0);
}

/// The five unknowns of directions, each without bounds.
Eigen::VectorXd unknownsOf(const PublishedForm& form) {
  Eigen::VectorXd unknowns(5);
  for (int k = 0; k < 2; ++k) {
    unknowns[k] = unbounded(std::log(form.weights[k]), -MostLogWeight, MostLogWeight);
  }
  for (int k = 0; k < 3; ++k) {
    unknowns[2 + k] = unbounded(form.powers[k], LeastPower, MostPower);
  }
  return unknowns;
}

PublishedForm directionsOf(const Eigen::VectorXd& unknowns) {
  PublishedForm form;
  for (int k = 0; k < 2; ++k) {
    form.weights[k] = std::exp(bounded(unknowns[k], -MostLogWeight, MostLogWeight));
  }
  for (int k = 0; k < 3; ++k) {
    form.powers[k] = bounded(unknowns[2 + k], LeastPower, MostPower);
  }
  return form;
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

Vec3 LinearForm::at(const StrainedLung& lung, const Vec3& p) const {
  const Vec3 share = slopes * lung.frame.shareOf(p);
  return lung.frame.toLps(lung.strain * share.cwiseProduct(lung.frame.lengths()));
}

LinearFit fitLinearForm(std::span<const LandmarkPair> landmarks, const StrainedLungs& lungs) {
  requireUsable(landmarks, lungs);
  const LinearForm drawnTo;
  const auto count = static_cast<Eigen::Index>(landmarks.size());
  LinearFit fit;
  // Of each direction: three slopes and the shift; rows are weighed by 1 / (strain L_k).
  for (int k = 0; k < 3; ++k) {
    Eigen::MatrixX4d matrix = Eigen::MatrixX4d::Zero(count + 3, 4);
    Eigen::VectorXd wanted = Eigen::VectorXd::Zero(count + 3);
    for (Eigen::Index n = 0; n < count; ++n) {
      const LandmarkPair& pair = landmarks[static_cast<std::size_t>(n)];
      const StrainedLung& lung = lungs.at(pair.side);
      const double unit = 1.0 / (lung.strain * lung.frame.lengths()[k]);
      matrix.row(n).head<3>() = lung.frame.shareOf(pair.rest).transpose();
      matrix(n, 3) = unit * lung.frame.toLps(Vec3::Unit(k))[k];
      wanted[n] = unit * lung.frame.toLps(pair.moved - pair.rest)[k];
    }
    const double ridge = std::sqrt(LinearRidge * static_cast<double>(count));
    matrix.block<3, 3>(count, 0).diagonal().setConstant(ridge);
    wanted.tail<3>() = ridge * drawnTo.slopes.row(k).transpose();
    const Eigen::Vector4d solved = matrix.colPivHouseholderQr().solve(wanted);
    fit.form.slopes.row(k) = solved.head<3>().transpose();
    fit.shift[k] = solved[3];
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
    Eigen::VectorXd unknowns = unknownsOf(publishedForm(start));
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
