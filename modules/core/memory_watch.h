#pragma once

namespace pneuma {

/// From now on memoryRanOut() tells. Libraries swallow std::bad_alloc, streams of the standard
/// library among them, and go on with half of what they read: a program that ends when memory is
/// out asks before it trusts a result. Not for one that goes on, such as the window.
void watchMemory();

/// Whether operator new has failed since watchMemory().
bool memoryRanOut();

}  // namespace pneuma
