#include "breathing/spring_network.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "breathing/breathing_surfaces.h"
#include "breathing/pitcher_catcher.h"
#include "core/error.h"
#include "core/parallel.h"
#include "geometry/test_surfaces.h"
#include "support/progress_recorder.h"

namespace pneuma {
namespace {

std::vector<double> anyBetween(double low, double high, std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(low, high);
  std::vector<double> values;
  for (std::size_t n = 0; n < count; ++n) values.push_back(any(random));
  return values;
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Root mean square of a - b, as a share of that of b.
double apart(std::span<const double> a, std::span<const double> b) {
  double difference = 0.0;
  double all = 0.0;
  for (std::size_t n = 0; n < b.size(); ++n) {
    difference += (a[n] - b[n]) * (a[n] - b[n]);
    all += b[n] * b[n];
  }
  return std::sqrt(difference / all);
}

/// The network with its springs as an equation of all nodes: T_e, column by column.
struct WholeNetwork {
  Eigen::MatrixXd passed;  // P(i, j) = T_e[j -> i], nothing on the diagonal
  Eigen::VectorXd kept;    // T_e[j -> j]
  Eigen::VectorXd s;       // expandability

  explicit WholeNetwork(const SpringNetwork& network) {
    const auto springs = network.springNodes();
    const auto masses = static_cast<Eigen::Index>(network.masses());
    const auto nodes = masses + static_cast<Eigen::Index>(springs.size());
    passed = Eigen::MatrixXd::Zero(nodes, nodes);
    s.resize(nodes);
    for (Eigen::Index n = 0; n < masses; ++n) {
      s[n] = network.expandability(static_cast<std::size_t>(n));
    }
    for (std::size_t k = 0; k < springs.size(); ++k) {
      const Eigen::Index node = masses + static_cast<Eigen::Index>(k);
      s[node] = network.expandability(springs[k]);
      for (std::size_t end = 0; end < 2; ++end) {
        const auto mass = static_cast<Eigen::Index>(springs[k].mass[end]);
        passed(node, mass) = s[node] / springs[k].distance[end];
        passed(mass, node) = s[mass] / springs[k].distance[end];
      }
    }
    kept.resize(nodes);
    for (Eigen::Index j = 0; j < nodes; ++j) {
      const double all = s[j] + passed.col(j).sum();
      passed.col(j) /= all;
      kept[j] = s[j] / all;
    }
  }

  /// T(i, j) = T[j -> i]: what node i keeps of a force of 1 on node j.
  Eigen::MatrixXd transfer() const {
    const auto nodes = kept.size();
    const Eigen::MatrixXd all = Eigen::MatrixXd::Identity(nodes, nodes) - passed;
    return kept.asDiagonal() * all.partialPivLu().inverse();
  }
};

class Networks : public ::testing::TestWithParam<bool> {
 protected:
  const TriangleMesh mesh = testing::irregular(testing::sphere(20.0, Vec3::Zero(), 2));
  const std::vector<double> modulus = anyBetween(0.3, 3.0, mesh.points.size(), 5);
  const std::vector<double> force = anyBetween(0.0, 1.0, mesh.points.size(), 6);
  const SpringNetwork network{mesh, modulus, {true, GetParam()}};
};

TEST_P(Networks, PassOnAllThatIsNotKept) {
  const WholeNetwork whole(network);
  const Eigen::MatrixXd transfer = whole.transfer();
  for (Eigen::Index j = 0; j < whole.kept.size(); ++j) {
    EXPECT_NEAR(whole.passed.col(j).sum() + whole.kept[j], 1.0, 1e-14);
    EXPECT_NEAR(transfer.col(j).sum(), 1.0, 1e-12);
  }
  // S_j^2 T[j -> i] is symmetric: what i keeps of a force on j is what j keeps of one on i.
  const Eigen::MatrixXd weighed = transfer * whole.s.cwiseAbs2().asDiagonal();
  EXPECT_LE((weighed - weighed.transpose()).cwiseAbs().maxCoeff(), 1e-12 * weighed.maxCoeff());
}

TEST_P(Networks, KeepTheForcesOfTheEquationWithAllSprings) {
  const WholeNetwork whole(network);
  Eigen::VectorXd applied = Eigen::VectorXd::Zero(whole.kept.size());
  for (std::size_t n = 0; n < force.size(); ++n) applied[static_cast<Eigen::Index>(n)] = force[n];
  const Eigen::VectorXd expected = whole.transfer() * applied;
  const std::vector<double> kept = network.forces(force, {1e-15});
  const std::vector<double> springs = network.springForces(kept);
  for (std::size_t n = 0; n < kept.size(); ++n) {
    EXPECT_NEAR(kept[n], expected[static_cast<Eigen::Index>(n)], 1e-12);
  }
  for (std::size_t n = 0; n < springs.size(); ++n) {
    EXPECT_NEAR(springs[n], expected[static_cast<Eigen::Index>(kept.size() + n)], 1e-12);
  }
  EXPECT_NEAR((sum(kept) + sum(springs)) / sum(force), 1.0, 1e-12);
}

TEST_P(Networks, ArePositiveLinearAndInvertible) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(mesh.points.size()),
                                                static_cast<Eigen::Index>(mesh.points.size()));
  const PointMatrix& matrix = network.matrix();
  for (std::uint32_t row = 0; row < matrix.size(); ++row) {
    dense(row, row) = matrix.diagonal[row];
    for (std::size_t at = matrix.first[row]; at < matrix.first[row + 1]; ++at) {
      dense(row, matrix.column[at]) = matrix.value[at];
      EXPECT_LT(matrix.value[at], 0.0);
    }
  }
  EXPECT_LE((dense - dense.transpose()).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_GT(dense.ldlt().vectorD().minCoeff(), 0.01);
  std::vector<double> one(force.size(), 0.0);
  one[7] = 1.0;
  const std::vector<double> ofOne = network.forces(one, {1e-15});
  for (const double kept : ofOne) EXPECT_GT(kept, 0.0);
  const std::vector<double> ofForce = network.forces(force, {1e-15});
  std::vector<double> both = force;
  for (double& f : both) f *= 3.0;
  both[7] += 2.0;
  const std::vector<double> ofBoth = network.forces(both, {1e-15});
  for (std::size_t n = 0; n < both.size(); ++n) {
    EXPECT_NEAR(ofBoth[n], 3.0 * ofForce[n] + 2.0 * ofOne[n], 1e-12);
  }
  EXPECT_LE(apart(network.appliedFor(ofForce), force), 1e-13);
}

TEST_P(Networks, PitchUntilTheyKeepWhatTheEquationSays) {
  const std::vector<double> expected = network.forces(force);
  const std::vector<double> springs = network.springForces(expected);
  for (const PitchOrder order : {PitchOrder::Heap, PitchOrder::Buckets, PitchOrder::Sweeps}) {
    // At every stage all that was applied is still there.
    for (const double tolerance : {0.5, 0.1, 1e-3, 1e-6}) {
      const PitchedForces pitched = pitchForces(network, force, {order, tolerance});
      EXPECT_NEAR(pitched.sum() / sum(force), 1.0, 1e-12);
      EXPECT_LE(*std::ranges::max_element(pitched.pitcher),
                tolerance * sum(force) / static_cast<double>(force.size()));
    }
    const PitchedForces pitched = pitchForces(network, force, {order, 1e-6});
    EXPECT_LE(apart({pitched.catcher.data(), expected.size()}, expected), 1e-5);
    EXPECT_LE(apart({pitched.catcher.data() + expected.size(), springs.size()}, springs), 1e-5);
    EXPECT_GT(pitched.steps, 5 * expected.size());
  }
}

INSTANTIATE_TEST_SUITE_P(Valence, Networks, ::testing::Bool());

TEST(SpringNetwork, KeepsTheShareOfTheFormulaWhereAllPointsAreAlike) {
  // An octahedron has equal edges, n = 4 at every point: g = (h E^2 + 2) / (n E^4 + h E^2 + 2).
  for (const double e : {0.3, 1.0, 3.0}) {
    for (const double h : {1.0, 3.0}) {
      TriangleMesh mesh = testing::sphere(1.0, Vec3::Zero(), 0);
      const auto& [i, j, k] = mesh.triangles[0];
      mesh = testing::scaled(mesh, 2.0 * h / (mesh.points[i] - mesh.points[j]).norm());
      const std::vector<double> modulus(mesh.points.size(), e);
      const std::vector<double> ones(mesh.points.size(), 1.0);
      const double expected = (h * e * e + 2.0) / (4.0 * std::pow(e, 4.0) + h * e * e + 2.0);
      for (const double kept : SpringNetwork(mesh, modulus, {false}).forces(ones)) {
        EXPECT_NEAR(kept, expected, 1e-12) << e << " " << h;
      }
    }
  }
  // Edges below 2 mm count as 2 mm: six at every point of a torus.
  const TriangleMesh torus = testing::torus(5.0, 2.0);
  const std::vector<double> ones(torus.points.size(), 1.0);
  for (const double kept : SpringNetwork(torus).forces(ones)) EXPECT_NEAR(kept, 1.0 / 3.0, 1e-12);
}

TEST(SpringNetwork, DoesNotDependOnTheUnitOfModuli) {
  const TriangleMesh mesh = testing::lungShaped(3);
  const std::vector<double> modulus = anyBetween(0.3, 3.0, mesh.points.size(), 5);
  std::vector<double> four = modulus;
  for (double& e : four) e *= 4.0;
  const std::vector<double> force = anyBetween(0.0, 1.0, mesh.points.size(), 6);
  EXPECT_LE(
      apart(SpringNetwork(mesh, four).forces(force), SpringNetwork(mesh, modulus).forces(force)),
      1e-12);
  // As the paper has it, it does, in the pattern too.
  const std::vector<double> a = SpringNetwork(mesh, modulus, {false}).forces(force);
  std::vector<double> b = SpringNetwork(mesh, four, {false}).forces(force);
  const double ratio = sum(a) / sum(b);
  for (double& kept : b) kept *= ratio;
  EXPECT_GT(apart(b, a), 0.1);
}

TEST(SpringNetwork, EvensOutValence) {
  const TriangleMesh mesh =
      testing::irregular(testing::scaled(testing::sphere(1.0, Vec3::Zero(), 4), 15.0));
  const std::vector<double> ones(mesh.points.size(), 1.0);
  const auto scatter = [&](bool even) {
    const std::vector<double> kept = SpringNetwork(mesh, {}, {true, even}).forces(ones);
    const std::vector<double> mean(kept.size(), sum(kept) / static_cast<double>(kept.size()));
    return apart(kept, mean);
  };
  EXPECT_GT(scatter(false), 0.1);
  EXPECT_LT(scatter(true), 0.5 * scatter(false));
}

TEST(SpringNetwork, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = testing::lungShaped(5);
  const std::vector<double> force = anyBetween(0.0, 1.0, mesh.points.size(), 6);
  const SpringNetwork network(mesh);
  const std::vector<double> many = network.forces(force);
  const ThreadLimit one(1);
  EXPECT_EQ(network.forces(force), many);
}

/// Steps that a mass-spring-damper of the same network takes until it is within 0.1 % of its rest,
/// with critical damping, at a step that is just stable; its state after 200 steps.
int stepsOfDampedMasses(const WholeNetwork& whole, const Eigen::VectorXd& applied,
                        Eigen::VectorXd& rest) {
  const auto nodes = whole.kept.size();
  // (diag(S^2) + L) z = f with F = S^2 z: forces between nodes are those of P.
  const Eigen::MatrixXd matrix = (Eigen::MatrixXd::Identity(nodes, nodes) - whole.passed) *
                                 whole.kept.cwiseInverse().asDiagonal() *
                                 whole.s.cwiseAbs2().asDiagonal();
  const Eigen::VectorXd expected = matrix.partialPivLu().solve(applied);
  const double highest = 2.0 * matrix.diagonal().maxCoeff();
  const double dt = 1.8 / std::sqrt(highest);
  const double damping = 2.0 * std::sqrt(whole.s.cwiseAbs2().minCoeff());
  Eigen::VectorXd z = Eigen::VectorXd::Zero(nodes);
  Eigen::VectorXd speed = z;
  int needed = 0;
  for (int step = 1; step <= 200; ++step) {
    speed = (speed + dt * (applied - matrix * z)) / (1.0 + dt * damping);
    z += dt * speed;
    if ((z - expected).norm() > 1e-3 * expected.norm()) needed = step;
  }
  rest = whole.s.cwiseAbs2().cwiseProduct(z);
  return needed;
}

TEST(PitcherCatcher, RestsWhereDampedMassesDoAndIsThereSooner) {
  constexpr int Across = 15;
  const TriangleMesh mesh = testing::sheet(Across, 5.0);
  std::vector<double> bend;
  for (const Vec3& p : mesh.points) {
    const double x = p.x() / (5.0 * (Across - 1));
    const double y = p.y() / (5.0 * (Across - 1));
    bend.push_back(std::sin(3.14159 * x) * std::sin(3.14159 * y));
  }
  const SpringNetwork network(mesh);
  const WholeNetwork whole(network);
  Eigen::VectorXd applied = Eigen::VectorXd::Zero(whole.kept.size());
  for (std::size_t n = 0; n < bend.size(); ++n) applied[static_cast<Eigen::Index>(n)] = bend[n];
  Eigen::VectorXd rest;
  const int damped = stepsOfDampedMasses(whole, applied, rest);
  const std::vector<double> expected = network.forces(bend);
  EXPECT_LE(apart({rest.data(), expected.size()}, expected), 1e-3);
  int sweeps = 0;
  for (double tolerance = 1.0; tolerance > 1e-6; tolerance *= 0.5) {
    const PitchedForces pitched = pitchForces(network, bend, {PitchOrder::Sweeps, tolerance});
    sweeps = static_cast<int>(pitched.steps / pitched.catcher.size()) + 1;
    if (apart({pitched.catcher.data(), expected.size()}, expected) <= 1e-3) break;
  }
  EXPECT_LE(sweeps, 13);
  EXPECT_GE(damped, 2 * sweeps);
}

TEST(PitcherCatcher, MovesStiffPointsOfADiscLess) {
  // Fig. 9: a disc, every sixth point stiff, the same force outwards on all.
  TriangleMesh mesh = testing::sheet(31, 1.5);
  const Vec3 centre(22.5, 22.5, 0.0);
  for (Vec3& p : mesh.points) {  // the square bent into a disc
    const Vec3 out = (p - centre) / 22.5;
    const double longest = std::max(std::abs(out.x()), std::abs(out.y()));
    if (out.norm() > 0.0) p = centre + 22.5 * longest * out.normalized();
  }
  const std::vector<double> ones(mesh.points.size(), 1.0);
  std::mt19937 random(4);
  std::vector<bool> stiff;
  for (std::size_t n = 0; n < ones.size(); ++n) stiff.push_back(random() % 6 == 0);
  double before = 1.0;
  for (const double ratio : {2.0, 4.0, 16.0, 64.0}) {
    std::vector<double> modulus;
    for (const bool isStiff : stiff) modulus.push_back(isStiff ? ratio : 1.0);
    const SpringNetwork network(mesh, modulus, {false});
    const PitchedForces pitched = pitchForces(network, ones);
    std::array<double, 2> squares{};
    std::array<double, 2> count{};
    for (std::size_t n = 0; n < ones.size(); ++n) {
      squares[stiff[n]] += pitched.catcher[n] * pitched.catcher[n];
      count[stiff[n]] += 1.0;
    }
    const double share = std::sqrt(squares[1] / count[1] / (squares[0] / count[0]));
    EXPECT_LT(share, before);
    EXPECT_NEAR(pitched.sum() / sum(ones), 1.0, 1e-12);
    before = share;
  }
  EXPECT_LE(before, 1e-3);
}

TEST(PitcherCatcher, StopsWhenAsked) {
  const TriangleMesh mesh = testing::sphere(30.0, Vec3::Zero(), 3);
  const SpringNetwork network(mesh);
  const std::vector<double> ones(mesh.points.size(), 1.0);
  for (const PitchOrder order : {PitchOrder::Heap, PitchOrder::Buckets, PitchOrder::Sweeps}) {
    testing::ProgressRecorder impatient(0.0);
    EXPECT_THROW(pitchForces(network, ones, {order}, Progress(impatient)), Cancelled);
  }
  testing::ProgressRecorder impatient(0.0);
  EXPECT_THROW(network.forces(ones, {}, Progress(impatient)), Cancelled);
}

TEST(SpringNetwork, RefusesWhatIsNoModulusAndNoForce) {
  const TriangleMesh mesh = testing::sphere(30.0, Vec3::Zero(), 1);
  EXPECT_THROW(SpringNetwork(TriangleMesh{}), InvalidInput);
  std::vector<double> modulus(mesh.points.size(), 1.0);
  modulus[3] = 0.0;
  EXPECT_THROW(SpringNetwork(mesh, modulus), InvalidInput);
  modulus.pop_back();
  EXPECT_THROW(SpringNetwork(mesh, modulus), InvalidInput);
  const SpringNetwork network(mesh);
  std::vector<double> force(mesh.points.size(), 1.0);
  force[2] = std::nan("");
  EXPECT_THROW(network.forces(force), InvalidInput);
  EXPECT_THROW(pitchForces(network, force), InvalidInput);
  force.pop_back();
  EXPECT_THROW(network.forces(force), InvalidInput);
  EXPECT_THROW(pitchForces(network, force), InvalidInput);
}

}  // namespace
}  // namespace pneuma
