#pragma once
/// Results of operations that can fail because of the request. Failures that a request can cause are returned
/// as a Result; violated preconditions are asserts; Stop, thrown by Job (job.h), ends a request early.
#include <cassert>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace seedmesh {

/// Why a request was refused as a whole. The names of the enumerators are part of the public contract, so new
/// ones are only appended.
enum class Code {
  malformed,  ///< not JSON, duplicate key, bad UTF-8, nested too deep
  invalid,    ///< the schema, the grammar or the generator does not accept the request
  limit,      ///< the request would exceed a limit
  deadline,   ///< the time limit has passed
  cancelled,  ///< the client has closed the connection, or the service shuts down
  internal,   ///< a defect of this program
};

/// What is wrong with one value of a request. Programs branch on the kind, never on the message.
/// word_of(kind) is the member `code` of a problem body, which is part of the public contract. New
/// enumerators are therefore only appended.
enum class IssueKind : std::uint8_t {
  syntax,          ///< a text that cannot be read: JSON, grammar, expression, percent escape, foreign file
  duplicate_key,   ///< a key or a name that is given twice
  unknown_key,     ///< a member that its object does not have
  unknown_name,    ///< a name that refers to something which does not exist
  missing,         ///< something required is absent
  wrong_type,      ///< another JSON type, or a number where a text is expected
  out_of_range,    ///< a number, a length or a count outside its range
  invalid_value,   ///< the type is right but the value cannot be used: a form, an image, a polygon
  conflict,        ///< values that exclude each other, or one that needs another
  not_available,   ///< the generator, format or profile does not offer the requested feature
  evaluation,      ///< an expression or rule has no usable result: division by zero, an infinite size
  limit,           ///< a limit is exceeded: Issue::limit
  truncated_list,  ///< not an error; Issue::unlisted is the number of errors beyond the list
  deadline,        ///< the time limit has passed
  cancelled,       ///< the work was cancelled
  internal,        ///< a defect of this program
};

/// Returns the name of the enumerator, such as "unknown_key".
std::string_view word_of(IssueKind kind);

/// What a limit is about. Job counts the first four while a request runs.
enum class Resource : std::uint8_t {
  modules,
  shapes,
  triangles,
  output_bytes,
  memory_bytes,
  file_bytes,  ///< bytes of one file inside the output; the bound is that of its format
  vertices,    ///< vertices of one mesh, whose indices have 32 bits
  points,
  segments,  ///< segments of a turtle
  joints,    ///< joints of a skeleton
  leaves,
  iterations,
  depth,  ///< depth of nested brackets, lists, expressions or requests
  json_values,
  steps,  ///< steps of loops that rules control: rule applications, matches, cells
};

/// Returns the name of the enumerator, such as "memory_bytes".
std::string_view word_of(Resource resource);

struct Limit {
  Resource resource;
  std::uint64_t bound = 0;
  std::uint64_t needed = 0;  ///< at least this much is needed; above `bound`
};

bool operator==(const Limit& a, const Limit& b);

/// Why a value is refused: a kind, and the other members without which the value would not be an error.
/// A name is that of a member of the object that holds the value, or of an object around it, such as "format" or
/// "output/format".
struct IssueCause {
  IssueCause(IssueKind what) : kind(what) {}
  IssueCause(IssueKind what, std::initializer_list<std::string_view> names);

  IssueKind kind;
  std::vector<std::string> members;
};

/// Returns the cause of an IssueKind::conflict with these members. The list is empty if the value is in conflict with
/// no other member: with a value of the same list, say.
IssueCause conflict_with(std::initializer_list<std::string_view> members);

/// Returns the cause of an IssueKind::missing: these members are the reason why something is required.
IssueCause missing_for(std::initializer_list<std::string_view> members);

/// One error, tied to the value in the request that caused it.
struct Issue {
  Issue() = default;
  Issue(IssueCause what, std::string at, std::string sentence, int in_line = 0, int in_column = 0)
      : kind(what.kind),
        pointer(std::move(at)),
        message(std::move(sentence)),
        line(in_line),
        column(in_column),
        members(std::move(what.members)) {}

  IssueKind kind = IssueKind::internal;
  std::string pointer;         ///< JSON Pointer into the request body, "" = the whole body
  std::string message;         ///< one sentence for a human: what was found, what was expected
  int line = 0;                ///< line inside the string that `pointer` names, from 1; 0 = not in a string
  int column = 0;              ///< column inside that line in code points, from 1; 0 = not in a string
  std::optional<Limit> limit;  ///< for IssueKind::limit
  std::uint64_t unlisted = 0;  ///< for IssueKind::truncated_list: how many more were found
  std::vector<std::string> members;  ///< see IssueCause

  friend bool operator==(const Issue&, const Issue&) = default;
};

/// A remark about a request that is accepted all the same.
struct Warning {
  std::string pointer;
  std::string message;
  int line = 0, column = 0;
};

/// Every error found, in document order; never empty.
struct Error {
  Code code = Code::internal;
  std::vector<Issue> issues;
};

/// Returns an Issue of IssueKind::limit. `message` states what exceeds the limit, the amount that it needs,
/// and the limit.
Issue limit_issue(const Limit& limit, std::string message, std::string pointer = "");

/// Returns the last entry of a list that was cut: "and 12 more errors".
Issue truncated_list(std::uint64_t unlisted);

/// Line and column, both from 1, of byte `offset` in UTF-8 `text`. Columns count code points.
struct TextPosition {
  int line = 1;
  int column = 1;
};
/// Returns the position of byte `offset`.
TextPosition text_position(std::string_view text, std::size_t offset);

/// Returns an Issue about byte `offset` of the string `text`, which is the value at `pointer`.
Issue issue_at(IssueKind kind, std::string pointer, std::string_view text, std::size_t offset,
               std::string message);

/// A value, or the errors that prevented it.
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
