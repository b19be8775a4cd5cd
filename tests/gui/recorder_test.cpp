// What a person does is written down as a script, and the script does it again.
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QFile>
#include <QMouseEvent>
#include <cmath>

#include <gtest/gtest.h>

#include "io/volume_file.h"
#include "script_recorder.h"
#include "scripting.h"
#include "widgets/slice_view.h"
#include "window_fixture.h"

namespace pneuma {
namespace {

using testing::WindowTest;

class RecorderTest : public WindowTest {
 protected:
  /// The steps as "do name", with what else they say.
  static std::vector<std::string> stepsOf(const ScriptRecorder& recorder) {
    std::vector<std::string> lines;
    for (const auto& entry : recorder.steps()) {
      const QJsonObject step = entry.toObject();
      QString line = step["do"].toString() + ' ' + step["name"].toString();
      for (const char* key : {"value", "keys", "notches"}) {
        if (step.contains(key)) line += ' ' + step[key].toVariant().toString();
      }
      lines.push_back(line.trimmed().toStdString());
    }
    return lines;
  }

  /// As a hand clicks: the window goes on in between.
  void clickByHand(const char* name) {
    click(name);
    QTest::qWait(20);
  }
};

TEST_F(RecorderTest, WhatWasDoneIsDoneAgain) {
  QByteArray script;
  std::size_t grown = 0;
  {
    const ScriptRecorder recorder(window);
    clickByHand("startSample");
    ASSERT_TRUE(idle());
    clickByHand("stepAirways");
    clickByHand("method_centroid");
    auto& terminals = find<QDoubleSpinBox>("option_terminals");
    terminals.setFocus();
    terminals.selectAll();
    QTest::keyClicks(&terminals, "250");
    QTest::keyClick(&terminals, Qt::Key_Return);
    QTest::qWait(20);
    clickByHand("grow");
    ASSERT_TRUE(idle());
    QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);  // undo
    QTest::qWait(20);
    grown = branches();
    const std::vector<std::string> expected = {"click startSample",
                                               "wait",
                                               "click stepAirways",
                                               "click method_centroid",
                                               "set option_terminals 250",
                                               "click grow",
                                               "wait",
                                               "trigger actionUndo"};
    EXPECT_EQ(stepsOf(recorder), expected);
    script = recorder.text();
  }
  const QString file = folder.filePath("script.json");
  QFile out(file);
  ASSERT_TRUE(out.open(QIODevice::WriteOnly));
  out.write(script);
  out.close();
  MainWindow again;
  again.resize(1366, 768);
  again.show();
  ASSERT_NO_THROW(ScriptPlayer(again, folder.path()).play(file)) << script.toStdString();
  ASSERT_NE(again.document().tree(), nullptr);
  EXPECT_EQ(again.document().tree()->size(), grown);
  EXPECT_TRUE(again.document().canRedo());
}

TEST_F(RecorderTest, WhatTheProgramDoesItselfIsNoStep) {
  openChestFromFiles();
  const ScriptRecorder recorder(window);
  setTerminals(700);
  find<QComboBox>("colourBy").setCurrentIndex(1);
  find<QAction>("actionUndo").setEnabled(true);
  QTest::qWait(20);
  EXPECT_TRUE(stepsOf(recorder).empty());
}

TEST_F(RecorderTest, PointsOfSlicesAreInMillimetres) {
  CtImage ct;
  ct.geometry.size = {60, 60, 40};
  ct.geometry.spacing = Vec3(2.0, 2.0, 2.5);
  ct.geometry.origin = Vec3(-60.0, -60.0, -50.0);
  ct.voxels.assign(ct.geometry.voxelCount(), -500);
  const auto file = inFolder("ct.nii.gz");
  writeVolume(file, ct);
  window.open({file});
  ASSERT_TRUE(idle());
  auto& slice = find<SliceView>("slice_axial");
  const ScriptRecorder recorder(window);
  const Vec3 from(10.0, -20.0, 0.0);
  const Vec3 to(-14.0, 12.0, 0.0);
  const auto send = [&](QEvent::Type type, const Vec3& at, Qt::MouseButton button,
                        Qt::MouseButtons buttons) {
    const QPoint pixel = slice.positionOf(at);
    QMouseEvent event(type, pixel, slice.mapToGlobal(pixel), button, buttons, Qt::NoModifier);
    QApplication::sendEvent(&slice, &event);
  };
  send(QEvent::MouseMove, from, Qt::NoButton, Qt::NoButton);
  send(QEvent::MouseButtonPress, from, Qt::LeftButton, Qt::LeftButton);
  send(QEvent::MouseButtonRelease, from, Qt::LeftButton, Qt::NoButton);
  QTest::qWait(20);
  send(QEvent::MouseButtonPress, from, Qt::LeftButton, Qt::LeftButton);
  send(QEvent::MouseMove, to, Qt::NoButton, Qt::LeftButton);
  send(QEvent::MouseButtonRelease, to, Qt::LeftButton, Qt::NoButton);
  QTest::qWait(20);
  const QJsonArray steps = recorder.steps();
  ASSERT_EQ(steps.size(), 2) << recorder.text().toStdString();
  EXPECT_EQ(steps[0].toObject()["do"].toString(), "click-point");
  EXPECT_EQ(steps[1].toObject()["do"].toString(), "drag-point");
  const auto near = [](const QJsonValue& value, const Vec3& p) {
    const QJsonArray array = value.toArray();
    return std::abs(array[0].toDouble() - p.x()) < 1.0 &&
           std::abs(array[1].toDouble() - p.y()) < 1.0;
  };
  EXPECT_TRUE(near(steps[0].toObject()["point"], from)) << recorder.text().toStdString();
  EXPECT_TRUE(near(steps[1].toObject()["to"], to)) << recorder.text().toStdString();
}

}  // namespace
}  // namespace pneuma
