#pragma once

#include <sys/stat.h>

namespace pneuma {

/// Gives an open file the group and the permissions of another. Where this user may not give it
/// that group, its own group may do no more than everybody. Lists of access (ACL) are not copied.
void takeAccess(int file, const struct stat& of) noexcept;

}  // namespace pneuma
