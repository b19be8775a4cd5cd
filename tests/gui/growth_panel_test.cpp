#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLocale>
#include <QMenu>
#include <QPushButton>

#include "growth/kitaoka.h"
#include "pipeline/organs.h"
#include "widgets/efficiency_card.h"
#include "window_fixture.h"

namespace pneuma {
namespace {

/// Step "Airways" on a built-in organ.
class GrowthPanelTest : public testing::WindowTest {
 protected:
  void openOrgan(const char* action) {
    find<QAction>(action).trigger();
    ASSERT_TRUE(idle());
    click("stepAirways");
  }

  const GrowthOptions& options() { return window.document().growthOptions(); }

  const KitaokaOptions& kitaoka() { return std::get<KitaokaOptions>(options()); }
};

TEST_F(GrowthPanelTest, HasATabForEveryMethod) {
  for (const GrowthMethod& method : growthMethods()) {
    const std::string name = "method_" + std::string(method.name);
    click("stepAirways");
    click(name.c_str());
    EXPECT_EQ(growthMethod(options()).name, method.name);
    EXPECT_TRUE(find<QAbstractButton>(name.c_str()).isChecked());
    EXPECT_EQ(find<QAbstractButton>(name.c_str()).text().toStdString(), method.title);
  }
}

TEST_F(GrowthPanelTest, EveryTabRemembersItsOptions) {
  click("stepAirways");
  setTerminals(777);
  click("method_centroid");
  setTerminals(888);
  find<QDoubleSpinBox>("option_ratio").setValue(0.4);
  click("method_kitaoka");
  EXPECT_EQ(find<QDoubleSpinBox>("option_terminals").value(), 777.0);
  EXPECT_EQ(kitaoka().terminals, 777U);
  click("method_centroid");
  EXPECT_EQ(find<QDoubleSpinBox>("option_terminals").value(), 888.0);
  EXPECT_EQ(find<QDoubleSpinBox>("option_ratio").value(), 0.4);
}

TEST_F(GrowthPanelTest, ASwitchIsATick) {
  click("stepAirways");
  auto& rescue = find<QCheckBox>("option_rescue");
  ASSERT_EQ(rescue.isChecked(), kitaoka().rescue == Switch::On);
  const QPoint tick(8, rescue.height() / 2);
  for (int i = 0; i < 2; ++i) {
    const Switch before = kitaoka().rescue;
    QTest::mouseClick(&rescue, Qt::LeftButton, {}, tick);
    EXPECT_NE(kitaoka().rescue, before);
    EXPECT_EQ(rescue.isChecked(), kitaoka().rescue == Switch::On);
  }
}

TEST_F(GrowthPanelTest, ASmallFlowThresholdIsShownAndTakenAsItIs) {
  click("stepAirways");
  auto& threshold = find<QDoubleSpinBox>("option_flow-threshold");
  EXPECT_EQ(threshold.text(), "0.00006");
  threshold.setValue(2.5e-5);
  EXPECT_DOUBLE_EQ(kitaoka().flowThreshold, 2.5e-5);
}

TEST_F(GrowthPanelTest, PapersValuesAndDefaultsSetAllOptions) {
  click("stepAirways");
  find<QDoubleSpinBox>("option_seed").setValue(5);
  EXPECT_TRUE(find<QAbstractButton>("paperValues").isEnabled());
  click("paperValues");
  EXPECT_EQ(kitaoka(), kitaokaPaper());
  EXPECT_FALSE(find<QCheckBox>("option_rescue").isChecked());
  EXPECT_FALSE(find<QAbstractButton>("paperValues").isEnabled());
  click("defaults");
  EXPECT_EQ(kitaoka(), KitaokaOptions{});
  EXPECT_FALSE(find<QAbstractButton>("defaults").isEnabled());
  click("method_centroid");
  EXPECT_EQ(window.findChild<QAbstractButton*>("paperValues"), nullptr);
}

TEST_F(GrowthPanelTest, AdvancedOptionsAreHiddenUntilAskedFor) {
  click("stepAirways");
  EXPECT_FALSE(find<QCheckBox>("option_rule-4a").isVisible());
  click("advanced");
  EXPECT_TRUE(find<QCheckBox>("option_rule-4a").isVisible());
  EXPECT_TRUE(find<QComboBox>("option_containment").isVisible());
  click("method_centroid");
  EXPECT_TRUE(QTest::qWaitFor([this] { return find<QWidget>("option_min-angle").isVisible(); }));
}

TEST_F(GrowthPanelTest, EveryBuiltInOrganIsInTheMenus) {
  const auto* menu = find<QPushButton>("startOrgan").menu();
  ASSERT_NE(menu, nullptr);
  EXPECT_EQ(static_cast<std::size_t>(menu->actions().size()), organNames().size());
  for (const QAction* action : menu->actions()) EXPECT_TRUE(action->isEnabled());
}

TEST_F(GrowthPanelTest, EveryOptionTellsItsRangeItsDefaultAndItsPaper) {
  openOrgan("actionOrgan_simple");
  click("method_kitaoka");
  const QString tip = find<QWidget>("option_rotation").toolTip();
  EXPECT_TRUE(tip.contains("\n-180 to 180 deg\n")) << tip.toStdString();
  EXPECT_TRUE(tip.contains("\nDefault: 90 deg\n")) << tip.toStdString();
  EXPECT_TRUE(tip.contains("Kitaoka H, Takaki R, Suki B.")) << tip.toStdString();
  click("method_centroid");
  const QString other = find<QWidget>("option_min-angle").toolTip();
  EXPECT_TRUE(other.contains("Huang XY")) << other.toStdString();
  const QString breath = find<QWidget>("option_period").toolTip();
  EXPECT_TRUE(breath.contains("0 to 60 s")) << breath.toStdString();
  EXPECT_TRUE(breath.contains("Santhanam")) << breath.toStdString();
}

TEST_F(GrowthPanelTest, AnOrganGrowsAndItsEfficiencyIsShown) {
  openOrgan("actionOrgan_simple");
  EXPECT_FALSE(find<QWidget>("efficiency").isVisible());
  find<QDoubleSpinBox>("option_flow-threshold").setValue(2e-3);
  click("grow");
  ASSERT_TRUE(idle());
  const auto& card = find<EfficiencyCard>("efficiency");
  EXPECT_TRUE(card.isVisible());
  const QString branchLine =
      QStringLiteral("N_T: %1,")
          .arg(QLocale(QLocale::English).toString(static_cast<qulonglong>(branches())));
  EXPECT_TRUE(card.text().contains(branchLine)) << card.text().toStdString();
  for (const char* function : {"Q_f", "C_n", "C_a", "V_r", "EL", "PI"}) {
    EXPECT_TRUE(card.text().contains(QString::fromUtf8(function) + QLatin1Char(':'))) << function;
  }
  bool explained = false;
  for (const QLabel* label : card.findChildren<QLabel*>()) {
    explained = explained || label->toolTip().startsWith("Share of the flow that ends in");
  }
  EXPECT_TRUE(explained);
  find<QAction>("actionUndo").trigger();
  EXPECT_FALSE(card.isVisible());
}

}  // namespace
}  // namespace pneuma
