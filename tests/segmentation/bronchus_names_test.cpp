#include "segmentation/bronchus_names.h"

#include <gtest/gtest.h>

namespace pneuma {
namespace {

/// A tree by hand: every branch from its parent's end to a point.
class Builder {
 public:
  std::size_t add(int parent, const Vec3& to) {
    const Vec3 from = parent < 0 ? Vec3::Zero() : tree[static_cast<std::size_t>(parent)].distal;
    return static_cast<std::size_t>(
        tree.add({.parent = parent, .proximal = from, .distal = to, .radiusMm = 2.0}));
  }

  AirwayTree tree;
};

struct Bronchi {
  AirwayTree tree;
  std::size_t rightMain, leftMain, intermedius, rul, rml, rll, lul, lll, superior;
};

/// Trachea 0 with a stub of the larynx, both sides, and on the right a superior segment of the
/// lower lobe that leaves to the back before the middle lobe does.
Bronchi typical(bool withMiddle) {
  Builder b;
  Bronchi x{};
  const std::size_t larynx = b.add(-1, {0, 0, -20});
  b.add(static_cast<int>(larynx), {6, 0, -20});
  const int trachea = static_cast<int>(b.add(static_cast<int>(larynx), {0, 20, -110}));
  x.rightMain = b.add(trachea, {-20, 22, -125});
  x.leftMain = b.add(trachea, {45, 25, -135});
  const int right = static_cast<int>(x.rightMain);
  x.rul = b.add(right, {-35, 20, -125});
  b.add(static_cast<int>(x.rul), {-60, 10, -90});
  b.add(static_cast<int>(x.rul), {-70, 40, -100});
  x.intermedius = b.add(right, {-30, 24, -145});
  x.superior = b.add(static_cast<int>(x.intermedius), {-45, 60, -145});
  const int trunk = static_cast<int>(b.add(static_cast<int>(x.intermedius), {-32, 25, -152}));
  if (withMiddle) {
    x.rml = b.add(trunk, {-50, -10, -165});
    x.rll = b.add(trunk, {-40, 35, -175});
    b.add(static_cast<int>(x.rll), {-50, 30, -220});
    b.add(static_cast<int>(x.rll), {-40, 60, -220});
  } else {
    x.rll = b.add(trunk, {-40, 35, -210});
  }
  const int left = static_cast<int>(x.leftMain);
  x.lul = b.add(left, {60, 18, -130});
  b.add(static_cast<int>(x.lul), {70, 20, -80});
  b.add(static_cast<int>(x.lul), {75, -20, -140});
  x.lll = b.add(left, {50, 40, -160});
  b.add(static_cast<int>(x.lll), {55, 60, -220});
  b.add(static_cast<int>(x.lll), {75, 40, -210});
  x.tree = b.tree;
  return x;
}

TEST(NameBronchi, NamesATypicalTree) {
  Bronchi bronchi = typical(true);
  const BronchusNames names = nameBronchi(bronchi.tree);
  ASSERT_TRUE(names.carina);
  EXPECT_EQ(*names.carina, Vec3(0, 20, -110));
  EXPECT_EQ(names.rightMain, bronchi.rightMain);
  EXPECT_EQ(names.leftMain, bronchi.leftMain);
  EXPECT_EQ(names.intermedius, bronchi.intermedius);
  EXPECT_EQ(names.rightUpper, bronchi.rul);
  EXPECT_EQ(names.rightMiddle, bronchi.rml);
  EXPECT_EQ(names.leftUpper, bronchi.lul);
  EXPECT_EQ(names.leftLower, bronchi.lll);
  EXPECT_EQ(names.lobarCount(), 5);
  EXPECT_EQ(bronchi.tree[bronchi.rll].lobe, Lobe::RightLower);
  EXPECT_EQ(bronchi.tree[bronchi.rml].lobe, Lobe::RightMiddle);
  EXPECT_EQ(bronchi.tree[bronchi.leftMain].lobe, Lobe::Central);
}

TEST(NameBronchi, DoesNotCallTheSuperiorSegmentMiddleLobe) {
  Bronchi bronchi = typical(false);
  const BronchusNames names = nameBronchi(bronchi.tree);
  EXPECT_FALSE(names.rightMiddle);
  EXPECT_TRUE(names.rightLower);
  EXPECT_EQ(names.lobarCount(), 4);
}

TEST(NameBronchi, FindsNothingInAWindpipeAlone) {
  AirwayTree tree;
  tree.add({.distal = {0, 0, -100}, .radiusMm = 8.0});
  const BronchusNames names = nameBronchi(tree);
  EXPECT_FALSE(names.carina);
  EXPECT_EQ(names.lobarCount(), 0);
  AirwayTree nothing;
  EXPECT_FALSE(nameBronchi(nothing).carina);
}

TEST(LengthBetween, RunsAlongTheWay) {
  const Bronchi bronchi = typical(true);
  const double main = (Vec3(-20, 22, -125) - Vec3(0, 20, -110)).norm();
  EXPECT_NEAR(lengthBetweenMm(bronchi.tree, bronchi.rightMain, bronchi.rul), main, 1e-9);
  EXPECT_NEAR(lengthBetweenMm(bronchi.tree, bronchi.rightMain, std::nullopt), main, 1e-9);
}

}  // namespace
}  // namespace pneuma
