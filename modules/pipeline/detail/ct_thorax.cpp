#include "pipeline/detail/ct_thorax.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pneuma {
namespace {

using Level = std::function<double(const Vec3&)>;

constexpr double CageScale = 1.09;  // of the lungs' formula, so that both have room in it

/// Positive inside; at most the distance to the wall.
double ellipsoidLevel(const Vec3& p, const Vec3& centre, const Vec3& semiAxes) {
  return -outsideEllipsoid(p, centre, semiAxes);
}

double slabLevel(double value, double low, double high) {
  return std::min(value - low, high - value);
}

/// Distance along z to the nearest of planes at every multiple of `pitch`.
double fromNearestMultiple(double value, double pitch) {
  return std::abs(value - pitch * std::round(value / pitch));
}

class Trunk {
 public:
  explicit Trunk(const ThoraxVariant& variant) : variant_(variant) {}

  CtBody build() {
    addHeartAndVessels();
    addSpine();
    addAbdomen();
    addCage();
    addWall();
    addTable();
    return std::move(body_);
  }

 private:
  void add(const Level& level, double hu, const Box3& box = endlessBox()) {
    CtShape shape;
    shape.box = box;
    shape.level = level;
    shape.hu = hu;
    body_.push_back(std::move(shape));
  }

  void addEllipsoid(const Vec3& centre, const Vec3& semiAxes, double hu) {
    add([=](const Vec3& p) { return ellipsoidLevel(p, centre, semiAxes); }, hu,
        Box3(centre - semiAxes, centre + semiAxes));
  }

  void addTube(const Vec3& from, const Vec3& to, double radius, double hu) {
    body_.push_back(tubeShape({from, to, radius, radius}, hu));
  }

  /// A chain of tubes through the points.
  void addVessel(const std::vector<Vec3>& points, double radius) {
    for (std::size_t i = 1; i < points.size(); ++i) {
      addTube(points[i - 1], points[i], radius, BloodHu);
    }
  }

  static double heartLevel(const Vec3& p, double fatMm) {
    double level = -1e9;
    for (const Side side : {Side::Right, Side::Left}) {
      const SampleLung lung = sampleLung(side);
      const Vec3 semiAxes = lung.scale * lung.heartSemiAxes - Vec3::Constant(fatMm);
      level = std::max(
          level, ellipsoidLevel(lung.modelFromLps(p), lung.scale * lung.heartCentre, semiAxes));
    }
    return std::min({level, cageLevel(p) - 3.0 - fatMm, p.z() + 155.0});
  }

  void addHeartAndVessels() {
    addVessel({{2, -30, -30}, {-2, -29, 28}}, 13.0);                 // ascending aorta
    addVessel({{10, 46, 26}, {10, 47, -130}, {6, 50, -260}}, 10.0);  // descending
    // The arch runs to the left of the trachea, flattened between it and the lung.
    for (const auto& [from, to] : {std::pair<Vec3, Vec3>{{4, -29, 28}, {14.8, -10, 38}},
                                   {{14.8, -10, 38}, {14.8, 22, 38}},
                                   {{14.8, 22, 38}, {10, 46, 26}}}) {
      constexpr double Flat = 2.8;
      const Vec3 stretch(Flat, 1.0, 1.0);
      const CtTube tube{from.cwiseProduct(stretch), to.cwiseProduct(stretch), 11.0, 11.0};
      add([=](const Vec3& p) { return tube.level(p.cwiseProduct(stretch)) / Flat; }, BloodHu);
    }
    addVessel({{-12, -22, -20}, {-13, -20, 80}, {-30, -30, 140}}, 6.5);    // superior vena cava
    addVessel({{12, -28, -22}, {12, -16, -6}, {28, 0, -6}}, 9.0);          // pulmonary trunk, left
    addVessel({{10, -18, -10}, {-20, -10, -12}, {-32, 0, -18}}, 7.5);      // right pulmonary artery
    addVessel({{-18, 0, -150}, {-18, -10, -165}, {-20, 20, -260}}, 11.0);  // inferior vena cava
    addVessel({{8, -14, 45}, {18, -8, 90}, {24, -8, 150}}, 4.0);           // left carotid
    addVessel({{-4, -18, 42}, {-14, -12, 90}, {-24, -8, 150}}, 5.0);       // brachiocephalic trunk
    addTube({1, 22, 20}, {1, 20, 60}, 1.8, -600.0);                        // air swallowed
    for (const auto& [from, to] : {std::pair<Vec3, Vec3>{{2, 18, 150}, {1, 22, 20}},
                                   {{1, 22, 20}, {0, 26, -60}},
                                   {{0, 26, -60}, {12, 20, -150}}}) {
      addTube(from, to, 6.0, 32.0);  // oesophagus
    }
    add([](const Vec3& p) { return heartLevel(p, 3.0); }, 42.0);
    add([](const Vec3& p) { return heartLevel(p, 0.0); }, FatHu);
  }

  /// Vertebrae of 24 mm with discs, their arches and the canal.
  void addSpine() {
    constexpr double PitchMm = 24.0;
    const auto disc = [](const Vec3& p) {
      return 2.5 - fromNearestMultiple(p.z(), PitchMm);  // positive within a disc
    };
    const auto body = [](const Vec3& p, double shellMm) {
      return ellipsoidLevel({p.x(), p.y(), 0.0}, {0.0, 77.0, 0.0},
                            {18.0 - shellMm, 15.0 - shellMm, 1e9});
    };
    const auto ring = [](const Vec3& p, double radius) {
      return radius - std::hypot(p.x(), p.y() - 101.0);
    };
    const auto within = [](double low, double high) {
      return Box3(Vec3(-70.0, low, -1e9), Vec3(70.0, high, 1e9));
    };
    add([=](const Vec3& p) { return std::min(body(p, 0.0), disc(p)); }, 85.0, within(61, 93));
    add([=](const Vec3& p) { return std::min(body(p, 1.6), -disc(p) - 1.2); }, 190.0,
        within(61, 93));
    add([=](const Vec3& p) { return body(p, 0.0); }, 480.0, within(61, 93));
    add([=](const Vec3& p) { return ring(p, 8.0); }, 28.0, within(91, 112));
    // Arches, the processes to the back and to the sides; gaps between them.
    add([=](const Vec3& p) { return std::min(ring(p, 12.5), -disc(p) - 1.0); }, 420.0,
        within(88, 114));
    add(
        [](const Vec3& p) {
          const double z = p.z() + 0.6 * (p.y() - 110.0);  // slants down
          return std::min({3.0 - std::abs(p.x()), slabLevel(p.y(), 108.0, 138.0),
                           (7.0 - fromNearestMultiple(z - 12.0, PitchMm)) / 1.2});
        },
        430.0, within(108, 138));
    add(
        [](const Vec3& p) {
          const double height = fromNearestMultiple(p.z() - 12.0, PitchMm);
          const double back = p.y() - 96.0 - 0.45 * (std::abs(p.x()) - 12.0);
          return std::min(6.0 - std::hypot(back, height), 38.0 - std::abs(p.x())) / 1.2;
        },
        400.0, within(85, 118));
  }

  /// Level of what lies below the diaphragm's domes.
  static double abdomenLevel(const Vec3& p, double depthMm) {
    double level = -1e9;
    for (const Side side : {Side::Right, Side::Left}) {
      const SampleLung lung = sampleLung(side);
      const Vec3 q = lung.modelFromLps(p);
      const Vec3 semiAxes = lung.scale * SampleLung::DomeSemiAxes + Vec3::Constant(8.0 - depthMm);
      level = std::max(level, ellipsoidLevel(q, lung.scale * SampleLung::DomeCentre, semiAxes));
      const double base = lung.scale * -152.0 + 0.4 * std::max(q.y(), 0.0) + 4.0 - depthMm;
      if (q.x() > 0.0) level = std::max(level, (base - q.z()) / 1.08);
    }
    return std::min(level, cageLevel(p) + 1.0 - depthMm);
  }

  void addAbdomen() {
    const double left = sampleLung(Side::Left).scale;
    const Vec3 dome = left * Vec3(70.0, -20.0, -158.0);
    if (variant_.stomachGas) {
      const Vec3 below = left * SampleLung::DomeSemiAxes - Vec3::Constant(1.0);
      const Vec3 bubble(68.0, -32.0, -122.0);
      add(
          [=](const Vec3& p) {
            return std::min(ellipsoidLevel(p, dome, below), 40.0 - (p - bubble).norm());
          },
          -985.0, Box3(bubble - Vec3::Constant(40.0), bubble + Vec3::Constant(40.0)));
    } else {
      addEllipsoid({58, -45, -140}, {16, 12, 16}, -980.0);
    }
    const auto inside = [](const Level& organ, double depthMm) {
      return [=](const Vec3& p) { return std::min(organ(p), abdomenLevel(p, depthMm)); };
    };
    add(inside([](const Vec3& p) { return (24.0 - 0.25 * p.y() - p.x()) / 1.04; }, 8.0), 58.0);
    add(inside(
            [](const Vec3& p) {
              return ellipsoidLevel(p, {58, -30, -150}, {44, 46, 52});
            },
            10.0),
        18.0);
    add(inside(
            [](const Vec3& p) {
              return ellipsoidLevel(p, {58, -30, -150}, {48, 50, 56});
            },
            8.0),
        42.0);
    add(inside(
            [](const Vec3& p) {
              return ellipsoidLevel(p, {98, 55, -150}, {36, 48, 46});
            },
            12.0),
        50.0);
    add([](const Vec3& p) { return abdomenLevel(p, 12.0); }, FatHu);
    add([](const Vec3& p) { return abdomenLevel(p, 0.0); }, MuscleHu);  // diaphragm
  }

  /// Ribs, cartilage and sternum around the cage; fat of the mediastinum inside.
  void addCage() {
    add([](const Vec3& p) { return std::min(cageLevel(p), 118.0 - p.z()); }, FatHu);
    const auto ribs = [](const Vec3& p, double thinnerMm) {
      constexpr double PitchMm = 27.0;
      const double height = fromNearestMultiple(p.z() - 0.42 * p.y(), PitchMm);
      const double across = (cageLevel(p) + 7.5) / 4.2;
      const double level = (1.0 - std::hypot(across, height / 6.5)) * 3.8 - thinnerMm;
      return std::min({level, std::abs(p.x()) - 14.0, slabLevel(p.z(), -235.0, 104.0)});
    };
    add(
        [](const Vec3& p) {
          return std::min({slabLevel(cageLevel(p), -12.0, -4.0) - 1.3, 15.0 - std::abs(p.x()),
                           -p.y(), slabLevel(p.z(), -95.0, 58.0)});
        },
        210.0);
    add(
        [](const Vec3& p) {
          return std::min({slabLevel(cageLevel(p), -12.0, -4.0), 17.0 - std::abs(p.x()), -p.y(),
                           slabLevel(p.z(), -97.0, 60.0)});
        },
        480.0);
    const auto cartilage = [](const Vec3& p) { return -p.y() - 62.0 + 0.12 * p.z(); };
    add([=](const Vec3& p) { return std::min(ribs(p, 0.0), cartilage(p)); }, 115.0);
    add([=](const Vec3& p) { return ribs(p, 1.4); }, 260.0);
    add([=](const Vec3& p) { return ribs(p, 0.0); }, 720.0);
  }

  /// Muscles, fat and skin.
  void addWall() {
    add([](const Vec3& p) { return std::min(cageLevel(p) + 14.0, 112.0 - p.z()); }, MuscleHu);
    for (const double x : {-34.0, 34.0}) {  // along the spine
      add(
          [=](const Vec3& p) {
            return ellipsoidLevel({p.x(), p.y(), 0.0}, {x, 118.0, 0.0}, {29.0, 19.0, 1e9});
          },
          MuscleHu);
    }
    const auto blades = [](const Vec3& p, double deepMm) {
      return std::min({slabLevel(cageLevel(p), -24.0 + deepMm, -17.0 - deepMm),
                       p.y() - 50.0 - deepMm, std::abs(p.x()) - 58.0 - deepMm,
                       p.z() - 0.4 * (std::abs(p.x()) - 60.0) + 60.0});
    };
    add([=](const Vec3& p) { return blades(p, 2.4); }, 420.0);  // shoulder blades
    add(
        [=](const Vec3& p) {
          return std::min(slabLevel(cageLevel(p), -27.0, -17.5),
                          std::max(p.y() - 5.0, -p.y() - 40.0));
        },
        MuscleHu);
    add([](const Vec3& p) { return bodyLevel(p) - 2.0; }, FatHu - 10.0);
    add([](const Vec3& p) { return bodyLevel(p); }, 20.0);
  }

  static double bodyLevel(const Vec3& p) {
    const double up = std::max(p.z() - 40.0, 0.0);
    const double wide = 181.0 + 0.06 * up;
    const double deep = 139.0 - 0.12 * up;
    const double x = std::abs(p.x()) / wide;
    const double y = std::abs(p.y() - 13.0) / deep;
    return (1.0 - std::pow(std::pow(x, 2.4) + std::pow(y, 2.4), 1.0 / 2.4)) * deep / 1.02;
  }

  /// A curved plate of carbon fibre around foam, and a mattress.
  void addTable() {
    const auto below = [](const Vec3& p) { return p.y() - 152.0 + 0.0011 * p.x() * p.x(); };
    const auto between = [=](double low, double high) {
      return [=](const Vec3& p) {
        return std::min(slabLevel(below(p), low, high), 215.0 - std::abs(p.x())) / 1.2;
      };
    };
    add(between(0.0, 8.0), -940.0);
    add(between(10.0, 26.0), -920.0);
    add(between(8.0, 28.0), -260.0);
  }

  static constexpr double FatHu = -95.0;
  static constexpr double MuscleHu = 50.0;
  static constexpr double BloodHu = 41.0;

  ThoraxVariant variant_;
  CtBody body_;
};

}  // namespace

double cageLevel(const Vec3& p) {
  constexpr double Power = 2.3;
  const Vec3 q = p / CageScale;
  const double t = std::clamp((q.z() + 158.0) / 270.0, 0.0, 0.985);
  const double waist = 1.0 - std::pow(t, 2.4);
  const double across = std::max(std::abs(q.x()) - 18.0, 0.0) / 118.0;
  const double along = std::abs(q.y() - 8.0) / 98.0;
  const double gauge = std::pow(std::pow(across, Power) + std::pow(along, Power), 1.0 / Power);
  const double steep = 98.0 * 1.2 * std::pow(t, 1.4) / (270.0 * std::sqrt(waist));
  return CageScale * 98.0 * (std::sqrt(waist) - gauge) / std::sqrt(1.0 + steep * steep);
}

CtBody trunkShapes(const ThoraxVariant& variant) { return Trunk(variant).build(); }

}  // namespace pneuma
