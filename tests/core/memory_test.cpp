#include "core/memory.h"

#include <filesystem>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "io/temp_folder.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t NoLimit = std::numeric_limits<std::uint64_t>::max();

/// A folder that stands for "/", with files of control groups.
class MemoryGroups : public ::testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) const {
    fs::create_directories((root_ / file).parent_path());
    root_.put(file, text);
  }

  std::uint64_t left() const { return memoryLeftInGroups(root_.path()); }

 private:
  testing::TempFolder root_;
};

TEST_F(MemoryGroups, NoneLeavesAll) { EXPECT_EQ(left(), NoLimit); }

TEST_F(MemoryGroups, TheTightestOfVersion2Counts) {
  write("proc/self/cgroup", "0::/slurm/job_7/step_0\n");
  write("sys/fs/cgroup/slurm/memory.max", "9000\n");
  write("sys/fs/cgroup/slurm/memory.current", "8500\n");
  write("sys/fs/cgroup/slurm/job_7/memory.max", "4000\n");
  write("sys/fs/cgroup/slurm/job_7/memory.current", "1000\n");
  write("sys/fs/cgroup/slurm/job_7/step_0/memory.max", "max\n");
  write("sys/fs/cgroup/slurm/job_7/step_0/memory.current", "1000\n");
  EXPECT_EQ(left(), 500U);
  write("sys/fs/cgroup/slurm/memory.max", "max\n");
  EXPECT_EQ(left(), 3000U);
}

TEST_F(MemoryGroups, PagesOfFilesThatCanGoAreFree) {
  write("proc/self/cgroup", "0::/job\n");
  write("sys/fs/cgroup/job/memory.max", "4000\n");
  write("sys/fs/cgroup/job/memory.current", "3000\n");
  write("sys/fs/cgroup/job/memory.stat",
        "anon 500\ninactive_file 1500\nactive_file 500\nslab_reclaimable 100\n");
  EXPECT_EQ(left(), 3100U);
}

TEST_F(MemoryGroups, AFullOneLeavesNextToNothing) {
  write("proc/self/cgroup", "0::/job\n");
  write("sys/fs/cgroup/job/memory.max", "4000\n");
  write("sys/fs/cgroup/job/memory.current", "4001\n");
  EXPECT_EQ(left(), 1U) << "0 would mean that nobody knows";
}

TEST_F(MemoryGroups, Version1HasAFolderOfItsOwn) {
  write("proc/self/cgroup", "5:devices:/\n4:cpu,memory:/lent/7\n0::/\n");
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  write("sys/fs/cgroup/memory/memory.usage_in_bytes", "5000\n");
  write("sys/fs/cgroup/memory/lent/7/memory.limit_in_bytes", "4000\n");
  write("sys/fs/cgroup/memory/lent/7/memory.usage_in_bytes", "3000\n");
  write("sys/fs/cgroup/memory/lent/7/memory.stat", "inactive_file 100\ntotal_inactive_file 400\n");
  EXPECT_EQ(left(), 1400U);
}

TEST_F(MemoryGroups, AContainerMayNotSeeThePathOfItsGroup) {
  write("proc/self/cgroup", "0::/docker/abc\n");
  write("sys/fs/cgroup/memory.max", "4000\n");
  write("sys/fs/cgroup/memory.current", "1000\n");
  EXPECT_EQ(left(), 3000U);
}

TEST(AdviceForMemory, IsOfWhatLimitsIt) {
  EXPECT_EQ(adviceForMemory(5, NoLimit, NoLimit),
            "close other programs, or use a machine with more memory");
  EXPECT_EQ(adviceForMemory(5, 4, NoLimit), "allow more memory with --max-memory (or ulimit)");
  EXPECT_EQ(adviceForMemory(5, 4, 3), "give the job or the container more memory");
  EXPECT_EQ(adviceForMemory(5, 3, 4), "allow more memory with --max-memory (or ulimit)");
}

TEST(AvailableMemory, IsNotUnknownHere) { EXPECT_GT(availableMemoryBytes(), 1U); }

}  // namespace
}  // namespace pneuma
