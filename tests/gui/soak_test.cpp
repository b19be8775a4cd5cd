#include <QAbstractButton>
#include <QPixmapCache>
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <vector>

#include <malloc.h>
#include <unistd.h>

#include "window_fixture.h"

// Somebody who opens, runs and closes all day.
namespace pneuma {
namespace {

/// How many times; PNEUMA_SOAK_CYCLES asks for more than a quick run has.
int cycleCount() {
  const char* wanted = std::getenv("PNEUMA_SOAK_CYCLES");
  return wanted == nullptr ? 6 : std::atoi(wanted);
}

/// Memory of this process, MB.
struct Memory {
  double resident = 0.0;  ///< in the machine's; the allocator keeps some of it for later
  double inUse = 0.0;     ///< asked of the allocator and not given back
};

Memory memoryNow() {
  // Qt keeps up to 10 MB of pictures of windows that are closed.
  QPixmapCache::clear();
  ::malloc_trim(0);
  std::ifstream file("/proc/self/statm");
  double pages = 0.0;
  file >> pages >> pages;
  const auto heap = ::mallinfo2();
  constexpr double Mb = 1 << 20;
  return {pages * static_cast<double>(::sysconf(_SC_PAGESIZE)) / Mb,
          static_cast<double>(heap.uordblks + heap.hblkhd) / Mb};
}

/// The least of some cycles: in which of them threads have left memory free is by chance.
double leastOf(const std::vector<double>& values, std::size_t from, std::size_t count) {
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(from);
  return *std::min_element(first, first + static_cast<std::ptrdiff_t>(count));
}

/// A window from when it opens until it closes.
class Day : public testing::WindowTest {
 public:
  Day() { WindowTest::SetUp(); }

  void run() {
    openChestFromFiles();
    grow(200);
    ASSERT_GT(branches(), 200U);
    click("stepBreathing");
    click("breathe");
    ASSERT_TRUE(idle());
    ASSERT_FALSE(find<QWidget>("errorCard").isVisible());
    EXPECT_FALSE(window.close());
    click("closeDiscard");
    EXPECT_FALSE(window.isVisible());
  }

 private:
  void TestBody() override {}
};

TEST(SoakTest, MemoryStaysWhatItWas) {
  const auto cycles = static_cast<std::size_t>(cycleCount());
  ASSERT_GE(cycles, 6U);
  std::vector<double> resident;
  std::vector<double> inUse;
  for (std::size_t cycle = 1; cycle <= cycles; ++cycle) {
    Day().run();
    ASSERT_FALSE(HasFailure());
    const Memory memory = memoryNow();
    resident.push_back(memory.resident);
    inUse.push_back(memory.inUse);
    if (cycle % 10 == 0) {
      std::printf("after %zu cycles: %.1f MB, %.2f in use\n", cycle, memory.resident, memory.inUse);
    }
  }
  // In the first cycles libraries make what they keep: fonts, shaders, threads.
  const std::size_t some = std::min<std::size_t>(10, cycles / 3);
  const double growth = leastOf(resident, cycles - some, some) - leastOf(resident, some, some);
  const double kept = inUse.back() - inUse[some];
  std::printf("%zu cycles: %.1f MB more in memory, %.2f MB more in use\n", cycles, growth, kept);
  // In a few cycles it goes up and down by more: threads leave free memory in more and more arenas.
  if (cycles >= 60) {
    EXPECT_LE(growth, 5.0);
  }
  EXPECT_LE(kept, std::max(0.5, 5.0 * static_cast<double>(cycles) / 200.0));
}

}  // namespace
}  // namespace pneuma
