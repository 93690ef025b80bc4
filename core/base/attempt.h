#pragma once
/// Work that may be abandoned before its end because there is a cheaper alternative. Examples are an estimate
/// that becomes too large, and a first attempt on several threads that may exceed a limit. Abandoned work is
/// neither an error nor a Stop; code outside attempt() is not affected.
namespace seedmesh {

/// Thrown by abandon_attempt(), caught by attempt() alone.
struct Abandoned {};

[[noreturn]] inline void abandon_attempt() { throw Abandoned{}; }

/// Runs `work`. False: it was abandoned, and its results must not be used. A Stop is passed on.
template <class Work>
bool attempt(const Work& work) {
  try {
    work();
    return true;
  } catch (const Abandoned&) {
    return false;
  }
}

}  // namespace seedmesh
