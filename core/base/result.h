#pragma once
/// Outcomes of work that a request can make fail. What a request can cause is a Result; a broken promise
/// inside the code is an assert; "stop now" is the one exception, Stop, thrown by Job (job.h).
#include <cassert>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace seedmesh {

/// Why a request was refused. Append only: the words made from these are part of the public contract.
enum class Code {
  malformed,  ///< not JSON, duplicate key, bad UTF-8, nested too deep, bad token
  invalid,    ///< the schema or the grammar says no
  limit,      ///< it would pass a limit
  deadline,   ///< over the time limit
  cancelled,  ///< the caller has gone or the service drains
  internal,   ///< never on purpose
};

/// One fault, tied to the place in the request that caused it.
struct Issue {
  std::string pointer;  ///< JSON Pointer into the request body, "" = the whole body
  std::string message;  ///< one sentence for a human: what was found, what was expected
  int line = 0;         ///< line inside the string that `pointer` names, from 1; 0 = not in a string
  int column = 0;       ///< column inside that line in characters (code points), from 1; 0 = not in a string

  friend bool operator==(const Issue&, const Issue&) = default;
};

/// Every fault found, in document order; never empty.
struct Error {
  Code code = Code::internal;
  std::vector<Issue> issues;
};

/// Line and column, both from 1, of byte `offset` in UTF-8 `text`. Columns count code points.
struct TextPlace {
  int line = 1;
  int column = 1;
};
TextPlace place_of(std::string_view text, std::size_t offset);

/// An Issue that points at byte `offset` of the string `text` which stands at `pointer`.
Issue issue_at(std::string pointer, std::string_view text, std::size_t offset, std::string message);

/// A value, or the faults that prevented it.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {
    assert(!std::get<1>(state_).issues.empty());
  }

  explicit operator bool() const { return state_.index() == 0; }
  T& operator*() & { return std::get<0>(state_); }
  const T& operator*() const& { return std::get<0>(state_); }
  T&& operator*() && { return std::get<0>(std::move(state_)); }
  T* operator->() { return &std::get<0>(state_); }
  const T* operator->() const { return &std::get<0>(state_); }
  const Error& error() const& { return std::get<1>(state_); }
  Error&& error() && { return std::get<1>(std::move(state_)); }

 private:
  std::variant<T, Error> state_;
};

}  // namespace seedmesh
