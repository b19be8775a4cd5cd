#include "breathing/surface_motion.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "breathing/elastic_surface.h"
#include "breathing/spring_network.h"
#include "breathing/volume_polynomial.h"
#include "core/error.h"

namespace pneuma {
namespace {

constexpr std::size_t Centres = 1000;
constexpr std::size_t Candidates = 50'000;  // more points of a wall tell no more

}  // namespace

struct SurfaceMotion::Operator {
  std::variant<SpringNetwork, ElasticSurface> of;

  Operator(const TriangleMesh& wall, MotionModel model, std::span<const double> stiffness)
      // A mesh's edges are no property of the lung: they are kept from showing.
      : of(model == MotionModel::Published
               ? std::variant<SpringNetwork, ElasticSurface>(
                     SpringNetwork(wall, stiffness, {true, true}))
               : std::variant<SpringNetwork, ElasticSurface>(ElasticSurface(wall, stiffness))) {}

  std::vector<double> response(const std::vector<double>& force) const {
    if (const auto* network = std::get_if<SpringNetwork>(&of)) return network->forces(force);
    return std::get<ElasticSurface>(of).response(force);
  }
};

SurfaceMotion::SurfaceMotion(const TriangleMesh& wall, const LungFrame& frame, MotionModel model,
                             std::span<const double> stiffness)
    : wall_(wall), frame_(frame), operator_(std::make_unique<Operator>(wall, model, stiffness)) {}

SurfaceMotion::~SurfaceMotion() = default;

std::vector<Vec3> SurfaceMotion::at(Posture posture, double wantedMm3) const {
  const Vec3 gravity = gravityOf(posture);
  const std::array<double, 4> law = forceCoefficients(frame_.side(), gravity);
  std::vector<double> force;
  force.reserve(wall_.points.size());
  for (const Vec3& p : wall_.points) force.push_back(forceAt(law, frame_.shareOf(p)));
  const std::vector<double> response = operator_->response(force);
  std::vector<Vec3> displacement;
  displacement.reserve(response.size());
  for (std::size_t n = 0; n < response.size(); ++n) {
    const Vec3 direction = motionDirection(frame_.shareOf(wall_.points[n]), frame_.side(), gravity);
    displacement.push_back(response[n] * frame_.toLps(direction));
  }
  const double multiple = multipleFor(wall_, displacement, wantedMm3);
  for (Vec3& u : displacement) u *= multiple;
  return displacement;
}

double multipleFor(const TriangleMesh& wall, const std::vector<Vec3>& displacement,
                   double wantedMm3) {
  const auto multiple = scaleForVolume(volumePolynomial(wall, displacement), wantedMm3);
  if (multiple) return *multiple;
  throw InvalidInput("the forces of this posture cannot bring a lung to " +
                     std::to_string(std::lround(wantedMm3 / 1000.0)) +
                     " ml; ask for a smaller breath with --tidal or use --model preset");
}

RadialField intoTheLung(const TriangleMesh& wall, const std::vector<Vec3>& displacement) {
  const std::size_t every = std::max<std::size_t>(1, wall.points.size() / Candidates);
  std::vector<Vec3> points;
  for (std::size_t n = 0; n < wall.points.size(); n += every) points.push_back(wall.points[n]);
  std::vector<Vec3> centres;
  std::vector<Vec3> values;
  for (const std::uint32_t n : farthestPoints(points, Centres)) {
    centres.push_back(points[n]);
    values.push_back(displacement[every * n]);
  }
  return {centres, values};
}

}  // namespace pneuma
