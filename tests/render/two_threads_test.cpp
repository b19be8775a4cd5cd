#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkTimerLog.h>
#include <vtkUnsignedCharArray.h>

#include "render/drawing.h"
#include "render/generated_lungs.h"
#include "render/picture.h"
#include "render/scene.h"
#include "render/vtk_messages.h"

// A film or a report is drawn on a thread of its own while the window is drawn.
namespace pneuma {
namespace {

constexpr int SmallestFont = 9;
constexpr int LargestFont = 60;

/// Texts of many sizes, more than a cache of glyphs holds, so that it forgets and loads.
std::vector<Picture> textsDrawn() {
  std::vector<Picture> pictures;
  for (int size = SmallestFont; size < LargestFont; ++size) {
    Picture picture = blank(300, 70, Rgb{0.0, 0.0, 0.0});
    drawText(picture, "Right lower lobe: 1234.5 mL", {5.0, 5.0}, size, Rgb{1.0, 1.0, 1.0});
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

/// How many pictures, drawn `rounds` times, differ from those before.
int differentFrom(const std::vector<Picture>& before, std::vector<Picture> (*draw)(), int rounds) {
  int different = 0;
  for (int round = 0; round < rounds; ++round) {
    const std::vector<Picture> now = draw();
    for (std::size_t i = 0; i < now.size(); ++i) different += now[i].rgb != before[i].rgb;
  }
  return different;
}

/// How many pictures that two threads draw at once, `rounds` times each, differ from those of one.
int differentAtOnce(std::vector<Picture> (*draw)(), int rounds) {
  const std::vector<Picture> alone = draw();
  std::atomic<int> different = 0;
  const auto compareAll = [&] { different += differentFrom(alone, draw, rounds); };
  {
    const std::jthread other(compareAll);
    compareAll();
  }
  return different;
}

TEST(TwoThreads, DrawTextAtOnce) { EXPECT_EQ(differentAtOnce(&textsDrawn, 40), 0); }

/// Everything that stands in a picture, with whatever VTK makes anew for each.
std::vector<Picture> scenesDrawn() {
  std::vector<Picture> pictures;
  for (const int size : {48, 80, 112}) {
    Scene scene;
    scene.setSurfaces(test::generatedLobes());
    scene.setTree(test::generatedTree(3));
    pictures.push_back(renderPicture(scene, size, size));
  }
  return pictures;
}

TEST(TwoThreads, DrawScenesAtOnce) {
  vtkTimerLog::ResetLog();
  EXPECT_EQ(differentAtOnce(&scenesDrawn, 3), 0);
  EXPECT_EQ(vtkTimerLog::GetNumberOfEvents(), 0)
      << "the log is one for all threads, without a lock";
}

/// As the program's window does, which keeps its context while films and reports are drawn.
TEST(TwoThreads, AWindowIsDrawnWhilePicturesAre) {
  vtkTimerLog::ResetLog();
  const std::vector<Picture> alone = scenesDrawn();
  Scene scene;
  const vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetSize(200, 150);
  scene.attachTo(window);
  const auto pixelsOfNewContent = [&] {
    scene.setSurfaces(test::generatedLobes());
    scene.setTree(test::generatedTree(3));
    scene.updateAnnotations();
    const vtkNew<vtkUnsignedCharArray> pixels;
    window->Render();
    window->GetPixelData(0, 0, 199, 149, 0, pixels);
    return std::vector<std::uint8_t>(pixels->Begin(), pixels->End());
  };
  const std::vector<std::uint8_t> before = pixelsOfNewContent();
  std::atomic<bool> drawn = false;
  int different = 0;
  bool same = true;
  {
    const std::jthread other([&] {
      different = differentFrom(alone, &scenesDrawn, 3);
      drawn = true;
    });
    do {
      same = pixelsOfNewContent() == before && same;
    } while (!drawn);
  }
  scene.attachTo(nullptr);
  EXPECT_EQ(different, 0);
  EXPECT_TRUE(same);
  EXPECT_EQ(vtkTimerLog::GetNumberOfEvents(), 0);
}

void say(const std::string& what) {
  vtkNew<vtkPolyData> speaker;
  vtkErrorWithObjectMacro(speaker, << what);
}

TEST(TwoThreads, EachKeepsItsOwnErrors) {
  constexpr int Times = 500;
  const auto listen = [](const std::string& name, int& wrong) {
    for (int i = 0; i < Times; ++i) {
      VtkMessages outer;
      {
        VtkMessages messages;
        say(name);
        say("later");
        wrong += messages.firstError() != name;
      }
      say("outside " + name);
      wrong += outer.firstError() != "outside " + name;
    }
  };
  int wrong = 0;
  int besides = 0;
  {
    const std::jthread other(listen, "the film", std::ref(besides));
    listen("the window", wrong);
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(besides, 0);
}

TEST(TwoThreads, NothingIsPrintedOnceVtkIsSilent) {
  { const VtkMessages installed; }
  silenceVtk();
  ::testing::internal::CaptureStderr();
  say("on this thread");
  std::jthread([] { say("on another"); }).join();
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(TwoThreads, MessagesMayEndInAnyOrder) {
  auto first = std::make_unique<VtkMessages>();
  auto second = std::make_unique<VtkMessages>();
  first.reset();
  say("one");
  EXPECT_EQ(second->firstError(), "one");
  second.reset();
  VtkMessages third;
  EXPECT_EQ(third.firstError(), "");
}

}  // namespace
}  // namespace pneuma
