#include "pipeline/detail/ct_thorax.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pipeline/sample_lung.h"

namespace pneuma {
namespace {

using Level = std::function<double(const Vec3&)>;

constexpr double FatHu = -95.0;
constexpr double MuscleHu = 50.0;
constexpr double HeartHu = 41.0;
constexpr double CompactBoneHu = 700.0;
constexpr double SpongyBoneHu = 220.0;

double ellipsoidLevel(const Vec3& p, const Vec3& centre, const Vec3& semiAxes) {
  return -outsideEllipsoid(p, centre, semiAxes);
}

/// A cylinder along z about (x, y).
double columnLevel(const Vec3& p, double x, double y, double semiX, double semiY) {
  constexpr double Endless = 1e9;
  return ellipsoidLevel({p.x(), p.y(), 0.0}, {x, y, 0.0}, {semiX, semiY, Endless});
}

/// Distance to the nearest multiple of `pitch`.
double fromNearestMultiple(double value, double pitch) {
  return std::abs(value - pitch * std::round(value / pitch));
}

class Trunk {
 public:
  Trunk(const ThoraxVariant& variant, std::shared_ptr<const ThoraxLevels> levels)
      : variant_(variant), levels_(std::move(levels)) {}

  CtBody build() {
    addAorta();
    addOtherVessels();
    addOesophagusAndHeart();
    addVertebrae();
    addProcesses();
    addStomach();
    addAbdomen();
    addRibsAndSternum();
    addWall();
    addTable();
    return std::move(body_);
  }

 private:
  void add(double hu, const Level& level, const Box3& box = endlessBox()) {
    CtShape shape;
    shape.box = box;
    shape.level = level;
    shape.hu = hu;
    body_.push_back(std::move(shape));
  }

  /// A shape told from the cage: `level` takes a point and how deep in the cage it is.
  template <class F>
  void addAtCage(double hu, const F& level, const Box3& box = endlessBox()) {
    add(
        hu, [level, levels = levels_](const Vec3& p) { return level(p, levels->cage(p)); }, box);
  }

  void addTube(const Vec3& from, const Vec3& to, double radius, double hu) {
    body_.push_back(tubeShape({from, to, radius, radius}, hu));
  }

  /// A chain of tubes through the points.
  void addVessel(const std::vector<Vec3>& points, double radius, double hu = HeartHu) {
    for (std::size_t i = 1; i < points.size(); ++i) addTube(points[i - 1], points[i], radius, hu);
  }

  void addAorta() {
    addVessel({{2, -30, -30}, {-2, -29, 28}}, 13.0);
    addVessel({{10, 46, 26}, {10, 47, -130}, {6, 50, -300}}, 10.0);
    // The arch runs to the left of the trachea, flattened between it and the lung.
    const std::vector<Vec3> arch = {{4, -29, 28}, {14.8, -10, 38}, {14.8, 22, 38}, {10, 46, 26}};
    for (std::size_t i = 1; i < arch.size(); ++i) {
      constexpr double Flat = 2.8;
      const Vec3 stretch(Flat, 1.0, 1.0);
      const CtTube tube{arch[i - 1].cwiseProduct(stretch), arch[i].cwiseProduct(stretch), 11.0,
                        11.0};
      add(
          HeartHu, [=](const Vec3& p) { return tube.level(p.cwiseProduct(stretch)) / Flat; },
          CtTube{arch[i - 1], arch[i], 11.0, 11.0}.box());
    }
  }

  void addOtherVessels() {
    addVessel({{-12, -22, -20}, {-13, -20, 80}, {-30, -30, 140}, {-50, -30, 260}}, 6.5);
    addVessel({{12, -28, -22}, {12, -16, -6}, {28, 0, -6}}, 9.0);          // pulmonary, to the left
    addVessel({{10, -18, -10}, {-20, -10, -12}, {-32, 0, -18}}, 7.5);      // and to the right
    addVessel({{-18, 0, -150}, {-18, -10, -165}, {-20, 20, -300}}, 11.0);  // lower vena cava
    addVessel({{8, -14, 45}, {18, -8, 90}, {24, -8, 260}}, 4.0);           // left carotid
    addVessel({{-4, -18, 42}, {-14, -12, 90}, {-24, -8, 260}}, 5.0);       // brachiocephalic trunk
  }

  void addOesophagusAndHeart() {
    addTube({1, 22, 20}, {1, 20, 60}, 1.8, -600.0);  // air that was swallowed
    addVessel({{2, 18, 260}, {1, 22, 20}, {0, 26, -60}, {12, 20, -150}}, 6.0, 32.0);
    constexpr double HeartFatMm = 3.0;
    const Box3 box(Vec3(-80.0, -115.0, -180.0), Vec3(100.0, 40.0, 10.0));
    add(
        42.0, [levels = levels_](const Vec3& p) { return levels->heart(p) - HeartFatMm; }, box);
    add(
        FatHu, [levels = levels_](const Vec3& p) { return levels->heart(p); }, box);
  }

  static constexpr double VertebraMm = 24.0;

  /// Positive within a disc between two vertebrae.
  static double discLevel(const Vec3& p) { return 2.5 - fromNearestMultiple(p.z(), VertebraMm); }

  void addVertebrae() {
    const Box3 box(Vec3(-19.0, 61.0, -1e9), Vec3(19.0, 93.0, 1e9));
    const auto body = [](const Vec3& p, double shellMm) {
      return columnLevel(p, 0.0, 77.0, 18.0 - shellMm, 15.0 - shellMm);
    };
    add(
        85.0, [=](const Vec3& p) { return std::min(body(p, 0.0), discLevel(p)); }, box);
    add(
        SpongyBoneHu, [=](const Vec3& p) { return std::min(body(p, 1.6), -discLevel(p) - 1.2); },
        box);
    add(
        CompactBoneHu, [=](const Vec3& p) { return body(p, 0.0); }, box);
    const Box3 arch(Vec3(-13.0, 88.0, -1e9), Vec3(13.0, 114.0, 1e9));
    add(
        28.0, [](const Vec3& p) { return columnLevel(p, 0.0, 101.0, 8.0, 8.0); }, arch);  // canal
    add(
        CompactBoneHu,
        [](const Vec3& p) {
          return std::min(columnLevel(p, 0.0, 101.0, 12.5, 12.5), -discLevel(p) - 1.0);
        },
        arch);
  }

  /// Of the vertebrae, to the back and to both sides.
  void addProcesses() {
    constexpr double MiddleMm = VertebraMm / 2.0;
    add(
        500.0,
        [](const Vec3& p) {
          const double z = p.z() + 0.6 * (p.y() - 110.0) - MiddleMm;  // slants down
          return std::min({3.0 - std::abs(p.x()), slabLevel(p.y(), 108.0, 138.0),
                           (7.0 - fromNearestMultiple(z, VertebraMm)) / 1.2});
        },
        Box3(Vec3(-4.0, 108.0, -1e9), Vec3(4.0, 138.0, 1e9)));
    add(
        430.0,
        [](const Vec3& p) {
          const double height = fromNearestMultiple(p.z() - MiddleMm, VertebraMm);
          const double back = p.y() - 96.0 - 0.45 * (std::abs(p.x()) - 12.0);
          return std::min(6.0 - std::hypot(back, height), 38.0 - std::abs(p.x())) / 1.2;
        },
        Box3(Vec3(-39.0, 84.0, -1e9), Vec3(39.0, 116.0, 1e9)));
  }

  /// Level of an organ and of what lies deeper than `depthMm` below the diaphragm.
  Level below(double depthMm, const Level& organ) const {
    return [=, levels = levels_](const Vec3& p) {
      return std::min(levels->abdomen(p) - depthMm, organ(p));
    };
  }

  void addStomach() {
    const double scale = sampleLung(Side::Left).scale;
    const Vec3 domeCentre = SampleLung::DomeCentre.cwiseProduct(Vec3(scale, -scale, scale));
    if (variant_.stomachGas) {
      constexpr double SheetMm = 1.0;
      constexpr double RadiusMm = 40.0;
      const Vec3 semiAxes = scale * SampleLung::DomeSemiAxes - Vec3::Constant(SheetMm);
      const Vec3 centre(96.0, -22.0, -124.0);  // clear of the heart
      const auto gas = [=](const Vec3& p) {
        return std::min(ellipsoidLevel(p, domeCentre, semiAxes), RadiusMm - (p - centre).norm());
      };
      add(GasHu, gas, Box3(centre - Vec3::Constant(RadiusMm), centre + Vec3::Constant(RadiusMm)));
    } else {
      const Vec3 centre(58.0, -50.0, -146.0);
      const Vec3 semiAxes(18.0, 13.0, 18.0);
      add(
          GasHu, [=](const Vec3& p) { return ellipsoidLevel(p, centre, semiAxes); },
          Box3(centre - semiAxes, centre + semiAxes));
    }
    const auto stomach = [](double wallMm) {
      return [=](const Vec3& p) {
        return ellipsoidLevel(p, {58.0, -30.0, -155.0}, Vec3(48.0, 50.0, 56.0).array() - wallMm);
      };
    };
    add(18.0, below(DiaphragmMm + 3.0, stomach(4.0)), UnderDomes);
    add(42.0, below(DiaphragmMm, stomach(0.0)), UnderDomes);
  }

  void addAbdomen() {
    const auto liver = [](const Vec3& p) { return (24.0 - 0.25 * p.y() - p.x()) / 1.04; };
    const auto spleen = [](const Vec3& p) {
      return ellipsoidLevel(p, {98.0, 55.0, -150.0}, {36.0, 48.0, 46.0});
    };
    const auto anything = [](const Vec3&) { return 1e9; };
    add(58.0, below(8.0, liver), UnderDomes);
    add(50.0, below(DiaphragmMm, spleen), UnderDomes);
    add(FatHu, below(DiaphragmMm, anything), UnderDomes);
    add(MuscleHu, below(0.0, anything), UnderDomes);  // the diaphragm
  }

  /// With cartilage in front. The fat of the mediastinum fills the rest of the cage.
  void addRibsAndSternum() {
    constexpr double TopMm = 118.0;  // above it the neck begins
    addAtCage(FatHu, [](const Vec3& p, double cage) { return std::min(cage, TopMm - p.z()); });
    const auto sternum = [](const Vec3& p, double cage, double shellMm) {
      return std::min({slabLevel(cage, -12.0, -4.0), 17.0 - std::abs(p.x()),
                       slabLevel(p.z(), -97.0, 60.0)}) -
             shellMm;
    };
    const Box3 front(Vec3(-18.0, -130.0, -98.0), Vec3(18.0, -20.0, 61.0));
    addAtCage(
        SpongyBoneHu, [=](const Vec3& p, double cage) { return sternum(p, cage, 1.4); }, front);
    addAtCage(
        CompactBoneHu, [=](const Vec3& p, double cage) { return sternum(p, cage, 0.0); }, front);
    // A rib is a band around the cage that sinks from the spine to the front.
    const auto ribs = [](const Vec3& p, double cage, double shellMm) {
      constexpr double PitchMm = 27.0;
      const double height = fromNearestMultiple(p.z() - 0.42 * p.y(), PitchMm);
      const double round = 1.0 - std::hypot((cage + 7.5) / 4.2, height / 6.5);
      return std::min(
          {3.8 * round - shellMm, std::abs(p.x()) - 14.0, slabLevel(p.z(), -235.0, 104.0)});
    };
    const auto cartilage = [](const Vec3& p) { return -p.y() - 62.0 + 0.12 * p.z(); };
    addAtCage(115.0, [=](const Vec3& p, double cage) {
      return std::min(ribs(p, cage, 0.0), cartilage(p));
    });
    addAtCage(SpongyBoneHu, [=](const Vec3& p, double cage) { return ribs(p, cage, 1.4); });
    addAtCage(CompactBoneHu, [=](const Vec3& p, double cage) { return ribs(p, cage, 0.0); });
  }

  /// Muscles, shoulder blades, fat and skin.
  void addWall() {
    addAtCage(MuscleHu,
              [](const Vec3& p, double cage) { return std::min(cage + 14.0, 112.0 - p.z()); });
    for (const double x : {-34.0, 34.0}) {  // along the spine
      add(
          MuscleHu, [=](const Vec3& p) { return columnLevel(p, x, 118.0, 29.0, 19.0); },
          Box3(Vec3(x - 29.0, 99.0, -1e9), Vec3(x + 29.0, 137.0, 1e9)));
    }
    const auto blades = [](const Vec3& p, double cage, double shellMm) {
      const double below = p.z() - 0.4 * (std::abs(p.x()) - 60.0) + 60.0;
      return std::min(
                 {slabLevel(cage, -24.0, -17.0), p.y() - 50.0, std::abs(p.x()) - 58.0, below}) -
             shellMm;
    };
    const Box3 upper(Vec3(-200.0, 50.0, -64.0), Vec3(200.0, 170.0, 300.0));
    addAtCage(
        SpongyBoneHu, [=](const Vec3& p, double cage) { return blades(p, cage, 2.0); }, upper);
    addAtCage(
        CompactBoneHu, [=](const Vec3& p, double cage) { return blades(p, cage, 0.0); }, upper);
    addAtCage(MuscleHu, [](const Vec3& p, double cage) {
      return std::min(slabLevel(cage, -27.0, -17.5), std::max(p.y() - 5.0, -p.y() - 40.0));
    });
    constexpr double SkinMm = 2.0;
    add(FatHu - 10.0, [levels = levels_](const Vec3& p) { return levels->body(p) - SkinMm; });
    add(20.0, [levels = levels_](const Vec3& p) { return levels->body(p); });
  }

  /// A curved plate of carbon fibre around foam, and a mattress. The scan circle cuts it.
  void addTable() {
    const auto between = [](double low, double high) {
      return [=](const Vec3& p) {
        const double down = p.y() - 152.0 + 0.0011 * p.x() * p.x();
        return std::min(slabLevel(down, low, high), 215.0 - std::abs(p.x())) / 1.2;
      };
    };
    const Box3 box(Vec3(-216.0, 90.0, -1e9), Vec3(216.0, 182.0, 1e9));
    add(-940.0, between(0.0, 8.0), box);
    add(-920.0, between(10.0, 26.0), box);
    add(-260.0, between(8.0, 28.0), box);
  }

  static constexpr double GasHu = -985.0;
  static constexpr double DiaphragmMm = 11.0;  // 8 mm of it fill the gap to the lungs' round edges
  static inline const Box3 UnderDomes{Vec3(-1e9, -1e9, -1e9), Vec3(1e9, 1e9, -70.0)};

  ThoraxVariant variant_;
  std::shared_ptr<const ThoraxLevels> levels_;
  CtBody body_;
};

}  // namespace

CtBody trunkShapes(const ThoraxVariant& variant,
                   const std::shared_ptr<const ThoraxLevels>& levels) {
  return Trunk(variant, levels).build();
}

}  // namespace pneuma
