#include "breathing/form_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include "breathing/direction_unknowns.h"

namespace pneuma {
namespace {

constexpr Eigen::Index ShiftSize = 3;
constexpr int DirectionSize = 5;
constexpr int PairingRounds = 10;

/// Constants and shift as numbers without bounds and back.
struct FormUnknowns {
  FormKind kind;

  Eigen::VectorXd from(const MotionForm& form, const Vec3& shift) const {
    std::vector<double> constants = constantsOf(form, kind);
    if (const auto* published = std::get_if<PublishedForm>(&form)) {
      std::ranges::copy(directionUnknowns(*published), constants.begin());
    }
    Eigen::VectorXd x(static_cast<Eigen::Index>(constants.size()) + ShiftSize);
    x << Eigen::Map<const Eigen::VectorXd>(constants.data(), x.size() - ShiftSize), shift;
    return x;
  }

  MotionForm form(const Eigen::VectorXd& x) const {
    std::vector<double> constants(x.data(), x.data() + x.size() - ShiftSize);
    if (kind == FormKind::Published) {
      const MotionForm directions = directionsOf(x.head<DirectionSize>());
      std::ranges::copy_n(constantsOf(directions, kind).begin(), DirectionSize, constants.begin());
    }
    return formOf(kind, constants);
  }

  static Vec3 shift(const Eigen::VectorXd& x) { return x.tail<ShiftSize>(); }
};

/// A wall with what its points are brought to while constants are looked for.
struct PairedWall {
  StrainedLung lung;
  std::vector<WallPair> pairs;
};

/// What landmarks, surfaces and the pull of evenForm() leave, mm.
struct AllResiduals {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  static constexpr int InputsAtCompileTime = Eigen::Dynamic;
  static constexpr int ValuesAtCompileTime = Eigen::Dynamic;

  std::span<const LandmarkPair> landmarks;
  const StrainedLungs& lungs;
  std::span<const PairedWall> walls;
  const FormFitOptions& options;
  std::vector<double> pulledTo{};  ///< constants of evenForm(); none for the published form
  std::vector<double> pullsMm{};   ///< of each of them
  std::size_t wallPairs = 0;

  AllResiduals(std::span<const LandmarkPair> given, const StrainedLungs& strained,
               std::span<const PairedWall> paired, const FormFitOptions& with)
      : landmarks(given), lungs(strained), walls(paired), options(with) {
    for (const PairedWall& wall : walls) wallPairs += wall.pairs.size();
    if (options.kind == FormKind::Published) return;
    pulledTo = constantsOf(evenForm(), options.kind);
    Vec3 unit = Vec3::Zero();  // mean of strain L_k, mm
    for (const auto& [side, lung] : lungs) unit += lung.strain * lung.frame.lengths();
    unit *= std::sqrt(options.ridge * static_cast<double>(landmarks.size())) /
            static_cast<double>(lungs.size());
    PolynomialForm pulls;
    pulls.constants.colwise() = unit;
    pullsMm = constantsOf(pulls, options.kind);
  }

  int inputs() const {
    return static_cast<int>(constantCount(options.kind)) + static_cast<int>(ShiftSize);
  }

  int values() const {
    return static_cast<int>(3 * landmarks.size() + wallPairs + pulledTo.size());
  }

  int operator()(const Eigen::VectorXd& x, Eigen::VectorXd& residuals) const {
    const MotionForm form = FormUnknowns{options.kind}.form(x);
    const Vec3 shift = FormUnknowns::shift(x);
    residuals.resize(values());
    Eigen::Index at = 0;
    for (const LandmarkPair& pair : landmarks) {
      residuals.segment<3>(at) = pair.rest + displacementBy(form, lungs, pair) + shift - pair.moved;
      at += 3;
    }
    const double weight =
        std::sqrt(options.surfaceWeight * static_cast<double>(3 * landmarks.size()) /
                  static_cast<double>(std::max<std::size_t>(1, wallPairs)));
    for (const PairedWall& wall : walls) {
      const FormField field(form, wall.lung.frame, wall.lung.strain);
      for (const WallPair& pair : wall.pairs) {
        residuals[at++] = weight * pair.distanceMm(pair.start + field.at(pair.start) + shift);
      }
    }
    for (std::size_t n = 0; n < pulledTo.size(); ++n) {
      residuals[at++] = pullsMm[n] * (x[static_cast<Eigen::Index>(n)] - pulledTo[n]);
    }
    return 0;
  }
};

/// By the landmarks' displacements linearised about the fit.
std::vector<double> standardErrorsOf(const FormFit& fit, std::span<const LandmarkPair> landmarks,
                                     const StrainedLungs& lungs) {
  constexpr double Step = 1e-5;
  constexpr double Unseen = 1e-9;  // mm for each unit of a constant
  const std::vector<double> constants = constantsOf(fit.form, fit.kind);
  const auto count = static_cast<Eigen::Index>(constants.size());
  const auto rows = static_cast<Eigen::Index>(3 * landmarks.size());
  const auto displacements = [&](const MotionForm& form) {
    Eigen::VectorXd all(rows);
    for (std::size_t n = 0; n < landmarks.size(); ++n) {
      all.segment<3>(static_cast<Eigen::Index>(3 * n)) = displacementBy(form, lungs, landmarks[n]);
    }
    return all;
  };
  Eigen::MatrixXd slopes(rows, count + ShiftSize);
  for (Eigen::Index k = 0; k < count; ++k) {
    std::vector<double> more = constants;
    std::vector<double> less = constants;
    more[static_cast<std::size_t>(k)] += Step;
    less[static_cast<std::size_t>(k)] -= Step;
    slopes.col(k) =
        (displacements(formOf(fit.kind, more)) - displacements(formOf(fit.kind, less))) /
        (2.0 * Step);
  }
  Eigen::VectorXd left = displacements(fit.form);
  for (std::size_t n = 0; n < landmarks.size(); ++n) {
    const auto at = static_cast<Eigen::Index>(3 * n);
    slopes.block<3, 3>(at, count).setIdentity();
    left.segment<3>(at) += fit.shift - (landmarks[n].moved - landmarks[n].rest);
  }
  std::vector<double> errors(constants.size(), std::numeric_limits<double>::infinity());
  const Eigen::VectorXd sizes = slopes.colwise().norm().transpose();
  std::vector<Eigen::Index> seen;
  for (Eigen::Index k = 0; k < sizes.size(); ++k) {
    if (sizes[k] > Unseen) seen.push_back(k);
  }
  const Eigen::MatrixXd scaled = slopes(Eigen::all, seen) * sizes(seen).cwiseInverse().asDiagonal();
  const Eigen::FullPivLU<Eigen::MatrixXd> normal(scaled.transpose() * scaled);
  const Eigen::Index free = rows - static_cast<Eigen::Index>(seen.size());
  if (!normal.isInvertible() || free < 1) return errors;
  const Eigen::MatrixXd covariance =
      left.squaredNorm() / static_cast<double>(free) * normal.inverse();
  for (std::size_t n = 0; n < seen.size(); ++n) {
    const auto k = static_cast<std::size_t>(seen[n]);
    const auto at = static_cast<Eigen::Index>(n);
    if (k < errors.size()) errors[k] = std::sqrt(covariance(at, at)) / sizes[seen[n]];
  }
  return errors;
}

}  // namespace

FormFit fitForm(std::span<const LandmarkPair> landmarks, const StrainedLungs& lungs,
                std::span<const WallReading> walls, const FormFitOptions& options) {
  FormFit fit{options.kind, {}, Vec3::Zero(), {}};
  if (options.kind == FormKind::Published) {
    const PublishedFit found = fitPublishedForm(landmarks, lungs);
    fit.form = found.form;
    fit.shift = found.shift;
  } else {
    const PolynomialFit found =
        fitPolynomialForm(landmarks, lungs, termsOf(options.kind), options.ridge);
    fit.form = found.form;
    fit.shift = found.shift;
  }
  if (options.surfaceWeight > 0.0) {
    for (int round = 0; round < PairingRounds && !walls.empty(); ++round) {
      std::vector<PairedWall> paired;
      for (const WallReading& wall : walls) {
        paired.push_back({wall.lung(), wall.pairs(fit.form, fit.shift)});
      }
      const AllResiduals residuals(landmarks, lungs, paired, options);
      Eigen::NumericalDiff<AllResiduals> function(residuals, 1e-10);
      Eigen::LevenbergMarquardt<Eigen::NumericalDiff<AllResiduals>> solver(function);
      solver.parameters.maxfev = 600;
      Eigen::VectorXd x = FormUnknowns{options.kind}.from(fit.form, fit.shift);
      solver.minimize(x);
      fit.form = FormUnknowns{options.kind}.form(x);
      fit.shift = FormUnknowns::shift(x);
    }
  }
  fit.standardErrors = standardErrorsOf(fit, landmarks, lungs);
  return fit;
}

Vec3 displacementBy(const MotionForm& form, const StrainedLungs& lungs, const LandmarkPair& pair) {
  const StrainedLung& lung = lungs.at(pair.side);
  return FormField(form, lung.frame, lung.strain).at(pair.rest);
}

}  // namespace pneuma
