#include "acceptance/fissure_population.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include <Eigen/Dense>

#include "io/atomic_file.h"
#include "io/fissure_file.h"
#include "support/lobe_dice.h"

namespace pneuma::testing {
namespace {

/// As ITK writes it: p goes to M (p - centre) + centre + shift.
struct ItkAffine {
  Eigen::Matrix3d matrix;
  Vec3 shift;
  Vec3 centre;

  /// The files lead from 10002K to the person.
  Vec3 backwards(const Vec3& p) const { return matrix.inverse() * (p - centre - shift) + centre; }
};

std::vector<double> numbersAfter(const std::string& text, const std::string& key) {
  const std::size_t at = text.find("\n" + key);
  if (at == std::string::npos) throw std::runtime_error("no " + key + " in an affine map");
  std::istringstream line(text.substr(at + key.size() + 1, text.find('\n', at + 1) - at));
  std::vector<double> numbers;
  for (double number = 0.0; line >> number;) numbers.push_back(number);
  return numbers;
}

ItkAffine readAffine(const std::filesystem::path& path) {
  const std::string text = readFile(path);
  const std::vector<double> values = numbersAfter(text, "Parameters:");
  const std::vector<double> fixed = numbersAfter(text, "FixedParameters:");
  if (values.size() != 12 || fixed.size() != 3) throw std::runtime_error("no affine map");
  ItkAffine affine;
  affine.matrix = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values.data());
  affine.shift = Vec3(values[9], values[10], values[11]);
  affine.centre = Vec3(fixed[0], fixed[1], fixed[2]);
  return affine;
}

/// One equation per point.
struct Equations {
  Eigen::MatrixXd terms;
  Eigen::VectorXd heights;
  Eigen::VectorXd weights;  ///< 1 per person in all
};

Equations equationsOf(const std::vector<Person>& people, std::size_t leftOut, Fissure fissure,
                      const LungBox& box) {
  std::vector<Vec3> places;
  std::vector<double> weights;
  for (std::size_t i = 0; i < people.size(); ++i) {
    if (i == leftOut || !people[i].points.contains(fissure)) continue;
    const std::vector<Vec3>& points = people[i].points.at(fissure);
    for (const Vec3& p : points) {
      places.push_back((p - box.low).cwiseQuotient(box.high - box.low));
      weights.push_back(1.0 / static_cast<double>(points.size()));
    }
  }
  const auto n = static_cast<Eigen::Index>(places.size());
  Equations equations{Eigen::MatrixXd(n, 6), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vec3& p = places[static_cast<std::size_t>(i)];
    equations.terms.row(i) << 1.0, p.x(), p.y(), p.x() * p.x(), p.x() * p.y(), p.y() * p.y();
    equations.heights(i) = p.z();
    equations.weights(i) = weights[static_cast<std::size_t>(i)];
  }
  return equations;
}

}  // namespace

std::vector<Person> fissurePopulation(const std::filesystem::path& folder) {
  constexpr std::string_view Points = "_regionAndTypePoints.csv";
  std::vector<Person> people;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    if (!file.ends_with(Points)) continue;
    Person person;
    person.name = file.substr(0, file.size() - Points.size());
    const ItkAffine affine =
        readAffine(folder / (person.name + "_TO_10002K_INSP_STD_BWH_COPD_transform.tfm"));
    for (const auto& [fissure, given] : readFissures(entry.path())) {
      for (const Vec3& p : given.points) person.points[fissure].push_back(affine.backwards(p));
    }
    people.push_back(std::move(person));
  }
  std::ranges::sort(people, {}, &Person::name);
  return people;
}

BoxQuadratic usualFissure(const std::vector<Person>& people, std::size_t leftOut, Fissure fissure,
                          const LungBox& box) {
  constexpr int Rounds = 10;
  const Equations equations = equationsOf(people, leftOut, fissure, box);
  Eigen::VectorXd weights = equations.weights;
  Eigen::VectorXd solved;
  for (int round = 0; round < Rounds; ++round) {
    const Eigen::MatrixXd weighted = weights.asDiagonal() * equations.terms;
    solved = (equations.terms.transpose() * weighted)
                 .ldlt()
                 .solve(weighted.transpose() * equations.heights);
    const Eigen::VectorXd off = (equations.terms * solved - equations.heights).cwiseAbs();
    const double scale = 1.48 * quantile({off.data(), off.data() + off.size()}, 0.5);
    weights = equations.weights.array() / (1.0 + (off / scale).array().square());
  }
  BoxQuadratic quadratic;
  std::ranges::copy(solved, quadratic.begin());
  return quadratic;
}

}  // namespace pneuma::testing
