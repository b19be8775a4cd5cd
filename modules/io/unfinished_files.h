#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace pneuma {

/// Removes what this process has written aside and not yet put into place. For a program that has
/// to end where no destructor is reached. Allocates nothing.
void removeUnfinished() noexcept;

/// What removeUnfinished() removes: a name aside; or an output once notePlaced() says that what has
/// its name now is of this process. Not noted where there is no memory for it.
void noteUnfinished(const std::filesystem::path& path) noexcept;

/// A file that is being replaced: removeUnfinished() puts it back from its second name, `before`,
/// once notePlaced() says that it was replaced. False if there is no memory for it.
bool noteReplaced(const std::filesystem::path& path, const std::filesystem::path& before) noexcept;

/// This process has put a file or a folder there. Nothing if the path was not noted.
void notePlaced(const std::filesystem::path& path) noexcept;

/// True if notePlaced() was called for it: otherwise what is there is somebody else's.
bool forgetUnfinished(const std::filesystem::path& path) noexcept;

/// A new name by chance for what is written aside: .pneuma-0123456789abcdef and `ending`.
std::string nameAside(std::string_view ending);

constexpr std::string_view PartEnding = ".part";    ///< of a file that is written aside
constexpr std::string_view StageEnding = ".parts";  ///< of a folder of them

/// Whether a name is one of nameAside(), with either ending.
bool isNameAside(std::string_view name);

/// Removes what killed processes of this user left written aside in a folder: it has such a name,
/// nobody holds its lock, and it is an hour old. Looks once at a folder; never throws for what it
/// finds. Machines that share a disk may not see each other's locks; an hour has to do there.
void removeAbandoned(const std::filesystem::path& folder);

/// From now on a crash of this process leaves no image of its memory behind, which may hold a
/// person's CT and name; unless the environment has PNEUMA_CORE_DUMPS, for who looks for a fault.
void leaveNoCoreDumps() noexcept;

/// Others' removeAbandoned() leaves what this open file or folder is, until it is closed.
void lockAside(int number) noexcept;

}  // namespace pneuma
